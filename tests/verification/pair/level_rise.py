#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Beads rain into water and raise its level by their volume: level_rise.py DEMVOF [--long]

1500 beads of 5 mm start as a loose block above the water (level 0.3 m, floor 0.1 x 0.1 m) and sink to the floor.
Paper, section 7.3: level 0.30982 m.
"""
import math
import sys

from box_case import BoxCase, Open, Particle, Wall, SIDES, momentum_of_everything, scratch
from box_fields import cell_field, output_times, surface_height
from record import Record

import random

BEADS, DIAMETER, DENSITY = 1500, 5e-3, 2600
WIDTH, LEVEL, TOP = 0.1, 0.3, 0.5
EXPECTED = LEVEL + BEADS * math.pi / 6 * DIAMETER**3 / WIDTH**2
LOWEST_START = LEVEL + 0.0305  # no bead reaches the water with its kernel: 3 widths of half a bulk cell


def beads():
    across = 15
    spacing = WIDTH / across
    jitter = random.Random(1)
    sites = [(i, j, k) for k in range(7) for j in range(across) for i in range(across)][:BEADS]
    return [Particle(tuple([(s + 0.5) * spacing + jitter.uniform(-0.3e-3, 0.3e-3) for s in site[:2]]
                           + [LOWEST_START + site[2] * spacing]), DIAMETER, DENSITY) for site in sites]


def rise(folder, demvof, fine, end_time):
    case = BoxCase(folder, (WIDTH, WIDTH, TOP), fine, (5, 5, 25), end_time, window=2e-3, level=LEVEL,
                   sides={side: Open() if side == "z+" else Wall() for side in SIDES}, particles=beads(),
                   contacts=True, dem_step=2e-5, tolerance=1e-8, history_interval=0.02)
    return case.run(demvof, timeout=20000)


def levels(run, fine):
    """Level from volumes, from the alpha field's integral, and the mean height of its 0.5 surface, m."""
    solid = BEADS * math.pi / 6 * DIAMETER**3
    from_volumes = (run.history["liquid_volume"][-1] + solid) / WIDTH**2
    alpha = cell_field(run, output_times(run)[-1], "alpha.water", fine)
    spacing = TOP / fine[2]
    heights = [surface_height(alpha[i, j], spacing) for i in range(fine[0]) for j in range(fine[1])]
    return from_volumes, run.history["mean_level"][-1], sum(heights) / len(heights)


def main():
    demvof, long = sys.argv[1], "--long" in sys.argv
    meshes = [(5, 5, 25), (15, 15, 75), (25, 25, 125), (30, 30, 150)] if long else [(5, 5, 25)]
    record = Record("level_rise", "Level rise of a water column by 1500 beads",
                    "1500 beads of 5 mm (2600 kg/m3) fall into a water column of 0.1 x 0.1 m with its level at 0.3 m "
                    "and sink (bulk cells of 0.02 m, porous phase interchange). The level must end at 0.3 m + volume "
                    "of the beads over the floor = 0.30982 m (paper, section 7.3) on every fine mesh: from the volumes "
                    "of liquid and beads, and from the liquid fraction between the beads (sum of alpha V over the "
                    "floor, and mean height of alpha = 0.5).",
                    f"tests/Alltest {'--verification ' if long else ''}-- -R pair.level_rise{'_long' if long else ''}")
    for fine in meshes:
        cells = fine[0] * fine[1] * fine[2]
        run = rise(scratch("level_rise") / str(cells), demvof, fine, 1.5 if long else 0.9)
        from_volumes, from_alpha, surface = levels(run, fine)
        name = f"{cells} fine cells"
        record.at_most(f"{name}: start, liquid + beads against 0.3 m and the beads",
                       abs(run.history["liquid_volume"][0] / WIDTH**2 - LEVEL), 1e-9 if long else 3.6e-14, "m")
        record.note(f"{name}: level from volumes", from_volumes, "m")
        record.note(f"{name}: level from alpha", from_alpha, "m")
        record.note(f"{name}: mean height of alpha = 0.5", surface, "m")
        record.at_most(f"{name}: level from volumes, error", abs(from_volumes - EXPECTED), 6e-12 if long else 1.1e-14, "m")
        record.at_most(f"{name}: level from alpha, error", abs(from_alpha - EXPECTED), 6e-12 if long else 5.6e-14, "m")
        record.at_most(f"{name}: liquid volume, drift", run.results["conservation"]["liquid_volume"], 2e-11 if long else 1.5e-13)
        record.at_most(f"{name}: momentum exchange", run.results["conservation"]["exchange"], 2e-13 if long else 4.3e-14)
        record.at_most(f"{name}: beads lost", run.number("particles.lost"), 0)
        record.note(f"{name}: kinetic energy of the beads at the end", run.history["particle_kinetic_energy"][-1], "J")
        record.note(f"{name}: run time", run.results["wall_seconds"]["total"], "s")
        record.curve("level", "t, s", "level from alpha, m", name, run.times, run.history["mean_level"], style="-")
    record.curve("level", "t, s", "level from alpha, m", "0.30982 m", [0, 1.5 if long else 0.9], [EXPECTED] * 2, style="k--")
    momentum_of_everything(record, 1e-8 if long else 3.1e-12)
    return record.write()


if __name__ == "__main__":
    sys.exit(main())
