# SPDX-License-Identifier: GPL-3.0-or-later
"""Boxes whose pressure has no boundary are the same on any number of fluid ranks: a closed one with a bead and its liquid in motion, on 1 to 4;
and a periodic one, its ends on one rank, in which a slab of liquid and beads go round on a mesh that refines itself, on 1 and 3.

Usage: closed_ranks_test.py DEMVOF FOLDER"""
import pathlib
import sys

import numpy
from box_case import BoxCase, Cyclic, Particle

DEMVOF, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
BOUND = 4e-12     # of the largest value
MOMENTUM = 3e-14
PERIOD = 8e-7
KEPT_TOGETHER = """FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }
numberOfSubdomains 3; method hierarchical; coeffs { n (3 1 1); order xyz; }
constraints { ends { type preservePatches; patches (xlow xhigh); enabled true; } }
"""
QUANTITIES = ("kinetic_energy", "max_speed", "pressure_squared_integral")


def box():
    return BoxCase(FOLDER / "box", (0.04, 0.04, 0.06), (8, 8, 12), (4, 4, 6), 0.02, 2e-3, velocity=(0.12, 0, 0), gravity=(0, 0, 0), tolerance=1e-12,
                   relative_tolerance=0, dem_step=4e-5, forces=[{"drag": "schiller_naumann"}, "pressure_gradient"], history_interval=2e-3,
                   particles=[Particle((0.023, 0.017, 0.034), 3e-3, 2000, velocity=(0.124, 0, 0))])


def period():
    """Two liquids of the same properties."""
    case = BoxCase(FOLDER / "period", (0.1, 0.02, 0.02), (20, 4, 4), (10, 2, 2), 0.05, 1e-3, gravity=(0, 0, 0), velocity=(1, 0, 0), level=0.01,
                   liquid=(1000, 1e-6), gas=(1000, 1e-6), tolerance=1e-12, relative_tolerance=0, dem_step=2e-5, history_interval=5e-3,
                   sections={"fluid": {"refinement": {"levels": 1, "particles": True}}},
                   particles=[Particle((.02 + .006 * i, .005 + .01 * j, .005 + .01 * k), 3e-3, 1000, velocity=(1, 0, 0))
                              for i in range(4) for j in range(2) for k in range(2)])
    case.sides.update({"x-": Cyclic(), "x+": Cyclic()})
    case.extra_files["fluid/system/decomposeParDict"] = KEPT_TOGETHER
    return case


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
    alone, cut = period().run(DEMVOF), period().run(DEMVOF, "--fluid-ranks", "3")
    for cells in ("fine_min", "fine_max", "mesh_changes"):
        failed |= cut.results["cells"][cells] != alone.results["cells"][cells]
        print(f"period on 3 ranks: {cells} {cut.results['cells'][cells]}, on one {alone.results['cells'][cells]}")
    for name in QUANTITIES[:2]:  # there is no pressure
        error = numpy.abs(cut.history[name] - alone.history[name]).max() / numpy.abs(alone.history[name]).max()
        failed |= not error <= PERIOD
        print(f"period on 3 ranks: {name:<26} differs by {error:.2e} (at most {PERIOD:g})")
    sys.exit(failed)


main()
