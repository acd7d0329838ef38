# SPDX-License-Identifier: GPL-3.0-or-later
"""A closed box, whose pressure has no boundary, is the same on any number of fluid ranks: a bead and its liquid in motion, on 1 to 4.

Usage: closed_ranks_test.py DEMVOF FOLDER"""
import pathlib
import sys

import numpy
from box_case import BoxCase, Particle

DEMVOF, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
BOUND = 4e-12     # of the largest value
MOMENTUM = 5e-14
QUANTITIES = ("kinetic_energy", "max_speed", "pressure_squared_integral")


def box():
    return BoxCase(FOLDER, (0.04, 0.04, 0.06), (8, 8, 12), (4, 4, 6), 0.02, 2e-3, velocity=(0.12, 0, 0), gravity=(0, 0, 0), tolerance=1e-12,
                   relative_tolerance=0, dem_step=4e-5, forces=[{"drag": "schiller_naumann"}, "pressure_gradient"], history_interval=2e-3,
                   particles=[Particle((0.023, 0.017, 0.034), 3e-3, 2000, velocity=(0.124, 0, 0))])


def main():
    alone, failed = box().run(DEMVOF), False
    for ranks in (2, 3, 4):
        run = box().run(DEMVOF, "--fluid-ranks", str(ranks))
        for name in QUANTITIES:
            error = numpy.abs(run.history[name] - alone.history[name]).max() / numpy.abs(alone.history[name]).max()
            failed |= not error <= BOUND
            print(f"{ranks} ranks: {name:<26} differs by {error:.2e} (at most {BOUND:g})")
        momentum = run.results["conservation"]["momentum"]
        failed |= not momentum <= MOMENTUM
        print(f"{ranks} ranks: momentum open by {momentum:.2e} (at most {MOMENTUM:g})")
    sys.exit(failed)


main()
