# SPDX-License-Identifier: GPL-3.0-or-later
"""Pressure drop through a bed of held spheres against Ergun's equation, at any stiffness of the drag.

    dp/dz = 150 mu (1 - eps)^2 U / (eps^3 d^2) + 1.75 rho (1 - eps) U^2 / (eps^3 d)     U: superficial velocity, m/s

Usage: packed_bed.py DEMVOF [--long]"""
import concurrent.futures
import itertools
import math

import numpy
from box_case import BoxCase, Inlet, Outlet, Particle, Slip, command_line, momentum_of_everything, scratch, side_means
from record import Record

DIAMETER, DENSITY, EPS = 1e-3, 1000.0, 0.48
SPACING = DIAMETER * (math.pi / (6 * (1 - EPS)))**(1 / 3)  # of a cubic lattice: the spheres just touch
CELLS, PER_CELL = 8, 2  # bulk cells along the bed, particles per cell and direction
VELOCITY = 0.05  # superficial, m/s
WINDOWS = 25
# The bed goes on beyond the inlet: what is given there is the velocity between the particles.
VOID_FRACTION = """FoamFile { version 2.0; format ascii; class volScalarField; object voidFraction; }
dimensions [0 0 0 0 0 0 0];
internalField uniform 1;
boundaryField { ".*" { type zeroGradient; } }
"""


def ergun(reynolds):
    """Pressure gradient, Pa/m. reynolds: rho U d / mu."""
    viscosity = DENSITY * VELOCITY * DIAMETER / reynolds
    return (150 * viscosity * (1 - EPS)**2 * VELOCITY / (EPS**3 * DIAMETER**2)
            + 1.75 * DENSITY * (1 - EPS) * VELOCITY**2 / (EPS**3 * DIAMETER))


def simulate(demvof, reynolds, stiffness, schedule):
    edge, length = PER_CELL * SPACING, CELLS * PER_CELL * SPACING
    drag = ergun(reynolds) * EPS**2 / VELOCITY  # K: grad p = K u / eps, u = U / eps
    window = float(f"{stiffness * DENSITY * EPS / drag:.6g}")
    sides = {side: Slip() for side in ("x-", "x+", "y-", "y+")}
    sides.update({"z-": Inlet((0, 0, VELOCITY / EPS)), "z+": Outlet()})
    case = BoxCase(scratch(f"packed_bed/{reynolds:g}_{stiffness:g}_{schedule}"), (edge, edge, length),
                   (1, 1, 2 * CELLS), (1, 1, CELLS), WINDOWS * window, window, sides=sides, gravity=(0, 0, 0),
                   liquid=(DENSITY, VELOCITY * DIAMETER / reynolds), velocity=(0, 0, VELOCITY / EPS),
                   forces=[{"drag": "gidaspow"}, "pressure_gradient"], watched={"z-": "p_rgh"},
                   extra_files={"fluid/0.orig/voidFraction": VOID_FRACTION},
                   coupling={"schedule": schedule, "averaging": {"kernel": "centre"}})
    across, along = range(PER_CELL), range(CELLS * PER_CELL)
    for place in itertools.product(across, across, along):
        case.particles.append(Particle([(i + 0.5) * SPACING for i in place], DIAMETER, 2500, held=True))
    run = case.run(demvof)
    drop = side_means(run.folder, "z-", "p_rgh")[1]
    return {"reynolds": reynolds, "stiffness": stiffness, "schedule": schedule, "drop": drop / (ergun(reynolds) * length),
            "exchange": run.results["conservation"]["exchange"], "steps": run.results["steps"]["fluid"]}


def main():
    options = command_line()
    record = Record(
        "packed_bed", "Pressure drop of a packed bed",
        f"Flow through {PER_CELL**3 * CELLS} spheres held on a cubic lattice, void fraction {EPS}, from inlet to outlet; "
        "the pressure drop over the whole bed is compared with Ergun's equation, from viscous to inertial flow and from "
        "drag that the window resolves to drag a hundred times stiffer.",
        "tests/Alltest --verification -- -R pair.packed_bed_long" if options.long else "tests/Alltest -- -R 'pair.packed_bed$'")
    reynolds, stiffness = [1, 10, 100, 1000], [0.1, 1, 10, 100]
    cases = [(1, 100), (30, 1), (1000, 10)]
    if options.long:
        cases = list(itertools.product(reynolds, stiffness))
    cases = [(*case, schedule) for case in cases for schedule in ("staggered", "concurrent")]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        runs = list(pool.map(lambda case: simulate(options.demvof, *case), cases))
    for schedule in ("staggered", "concurrent"):
        some = [run for run in runs if run["schedule"] == schedule]
        record.at_most(f"{schedule}: pressure drop against Ergun, worst", max(abs(r["drop"][-1] - 1) for r in some), 0.006 if options.long else 0.0059)
        record.at_most(f"{schedule}: change of the pressure drop in the last fluid step",
                       max(abs(r["drop"][-1] - r["drop"][-2]) for r in some), 1e-3)
        record.at_most(f"{schedule}: exchange of momentum open", max(r["exchange"] for r in some), 3e-14)
        for s in sorted({r["stiffness"] for r in some}) if options.long else ():
            line = [r for r in some if r["stiffness"] == s]
            record.curve(f"Error of the pressure drop, {schedule}", "Re", "|dp / Ergun - 1|", f"K dt/(rho eps) = {s:g}",
                         [r["reynolds"] for r in line], [max(abs(r["drop"][-1] - 1), 1e-16) for r in line], "xy")
    momentum_of_everything(record, 1e-8 if options.long else 2e-14)
    raise SystemExit(record.write())


main()
