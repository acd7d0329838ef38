#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Neutral beads at rest in water at rest feel Archimedes' force and stay, wherever faces of the bulk grid lie in the fine
cells: beads_at_rest.py DEMVOF"""
import math
import random
import sys

import numpy

from box_case import BoxCase, Open, Particle, momentum_of_everything, particle_states, scratch
from record import Record

DEMVOF = sys.argv[1]
DIAMETER, EDGE = 4e-3, 0.08
# name: (fine cells, bulk cells, settings of coupling)
ROWS = {
    "fine cells of 10 mm, bulk cells of 13.3 mm": ((8, 8, 8), (6, 6, 6), {}),
    "fine cells of 13.3 mm, bulk cells of 10 mm": ((6, 6, 6), (8, 8, 8), {}),
    "fine cells of 7.3 mm, bulk cells of 16 mm": ((11, 11, 11), (5, 5, 5), {}),
    "10 mm in 13.3 mm, kernel diffusion": ((8, 8, 8), (6, 6, 6), {"averaging": {"kernel": "diffusion", "bandwidth": 0.02}}),
    "10 mm in 13.3 mm, nearest": ((8, 8, 8), (6, 6, 6), {"mapping": {"to_fine": "nearest", "to_bulk": "nearest"}}),
    "10 mm in 13.3 mm, surface above": ((8, 8, 8), (6, 6, 6), {"level": 0.0617}),
}


def places(number, upper):
    """None touches another or a wall."""
    random_number, found = random.Random(3), []
    while len(found) < number:
        place = tuple(random_number.uniform(0.003, top - 0.003) for top in upper)
        if all(math.dist(place, other) > 1.3 * DIAMETER for other in found):
            found.append(place)
    return found


def main():
    record = Record("beads_at_rest", "Beads at rest in water at rest",
                    "60 neutral beads of 4 mm at random places in water at rest, on bulk grids whose faces cut fine cells: the pressure's "
                    "force over rho V g and the beads' speed after 20 windows.", "tests/Alltest -- -R pair.beads_at_rest")
    for number, (name, (fine, bulk, coupling)) in enumerate(ROWS.items()):
        coupling = dict(coupling)
        level = coupling.pop("level", None)
        beads = [Particle(place, DIAMETER, 1000) for place in places(60, (EDGE, EDGE, (level or EDGE) - 0.003))]
        case = BoxCase(scratch(f"beads_at_rest/{number}"), (EDGE,) * 3, fine, bulk, 0.02, 1e-3, particles=beads, coupling=coupling, level=level,
                       level_in_cells=level is not None, tolerance=1e-12, relative_tolerance=0, longest_step=1e-3,
                       forces=[{"drag": "di_felice"}, "pressure_gradient", {"added_mass": 0.5}])
        case.sides["z+"] = Open(alpha=1 if level is None else 0)
        run = case.run(DEMVOF)
        states = particle_states(run.folder)
        force = states["pressure_force"][:, 2] / (1000 * 9.81 * math.pi / 6 * DIAMETER ** 3)
        solved = level is not None  # else the pressure is uniform, and nothing is left to a solver
        record.at_most(f"{name}: force / (rho V g) - 1, worst bead", float(numpy.abs(force - 1).max()), 6e-11 if solved else 8e-14)
        record.at_most(f"{name}: speed of the fastest bead", float(numpy.abs(states["velocity"]).max()), 2e-11 if solved else 1e-14, "m/s")
        record.at_most(f"{name}: momentum exchange", run.results["conservation"]["exchange"], 3e-13)
    momentum_of_everything(record, 1e-13)
    return record.write()


if __name__ == "__main__":
    sys.exit(main())
