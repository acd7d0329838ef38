# SPDX-License-Identifier: GPL-3.0-or-later
"""Beads and fluid move with one velocity U in a periodic box: nothing pushes anything, at the edges of the beads neither.

    u = v = U everywhere, p uniform

A slab moves along the box; a disc crosses a flat box at an angle. The fluid's flux through a face has to change as the edge
passes, and no velocity with it. Usage: carried.py DEMVOF [--long]"""
import concurrent.futures
import itertools
import math

import numpy
from box_case import BoxCase, Cyclic, Particle, command_line, momentum_of_everything, scratch
from box_fields import cell_field, output_times, vector_field
from record import Record

DIAMETER, EPS, DENSITY = 1e-3, 0.6, 2500.0
SPACING = DIAMETER * (math.pi / (6 * (1 - EPS)))**(1 / 3)  # of a cubic lattice
PER_CELL = 2  # beads per bulk cell and direction
SPEED = 0.1   # m/s
WINDOWS, OUTPUTS = 60, 12


def simulate(demvof, shape, finer, kernel, schedule):
    edge = PER_CELL * SPACING
    bulk, velocity = ((24, 1, 1), (SPEED, 0, 0)) if shape == "slab" else ((14, 14, 1), (0.8 * SPEED, 0.6 * SPEED, 0))
    fine = tuple(n * finer for n in bulk)
    window = 0.1 * edge / SPEED
    case = BoxCase(scratch(f"carried/{shape}_{finer}_{kernel}_{schedule}"), tuple(n * edge for n in bulk), fine, bulk,
                   WINDOWS * window, window, sides={s: Cyclic() for s in ("x-", "x+", "y-", "y+", "z-", "z+")},
                   gravity=(0, 0, 0), velocity=velocity, dem_step=window / 100, courant=0.5,
                   forces=[{"drag": "gidaspow"}, "pressure_gradient"],
                   coupling={"schedule": schedule, "averaging": {"kernel": kernel}}, output_interval=WINDOWS / OUTPUTS * window)
    for place in itertools.product(*(range(n * PER_CELL) for n in bulk)):
        at = [(n + 0.5) * SPACING for n in place]
        inside = (8 <= at[0] / edge < 16 if shape == "slab" else
                  math.hypot(at[0] - 7 * edge, at[1] - 7 * edge) < 4 * edge)
        if inside:
            case.particles.append(Particle(at, DIAMETER, DENSITY, velocity=velocity))
    run = case.run(demvof)
    errors = [numpy.abs(vector_field(run, time, "U", fine) - numpy.array(velocity)).max() / SPEED
              for time in output_times(run)[1:]]
    momentum = run.results["momentum"]["error"]
    drift = [run.history[f"{side}_momentum_x"] for side in ("fluid", "particle", "pending")]
    total = sum(numpy.array(part) for part in drift)
    return {"shape": shape, "finer": finer, "kernel": kernel, "schedule": schedule, "error": max(errors),
            "drift": numpy.abs(total / total[0] - 1).max(), "books": max(momentum)}


def main():
    options = command_line()
    cases = [("slab", 1, "gaussian", "staggered"), ("slab", 2, "gaussian", "staggered"), ("disc", 1, "gaussian", "staggered")]
    if options.long:
        cases = [("slab", finer, kernel, schedule) for finer in (1, 2, 4) for kernel in ("volume", "gaussian", "linear")
                 for schedule in ("staggered", "concurrent")]
        cases += [("disc", finer, kernel, "staggered") for finer in (1, 2, 4) for kernel in ("gaussian", "volume")]
    record = Record(
        "carried", "Beads carried by their fluid",
        f"A slab and a disc of beads (void fraction {EPS}) move with their fluid through a periodic box, over six bulk cells. Nothing "
        "acts: the velocity stays what it was, at the edges of the beads too, and the momentum of everything.",
        "tests/Alltest --verification -- -R pair.carried_long" if options.long else "tests/Alltest -- -R 'pair.carried$'")
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        runs = list(pool.map(lambda case: simulate(options.demvof, *case), cases))
    for run in runs:
        print("{shape}, mesh {finer} times finer, {kernel}, {schedule}: velocity {error:.2e}, momentum {drift:.1e}".format(**run))
    # What is left is the solvers': the flux of the solid is found by a few iterations, what makes room to 1 %.
    for shape, bound in (("slab", 8e-6), ("disc", 7e-5)):
        some = [run for run in runs if run["shape"] == shape and run["schedule"] == "staggered"]
        record.at_most(f"{shape}: velocity error anywhere, over U, worst", max(run["error"] for run in some), 8e-3 if options.long else bound)
    if options.long:
        some = [run for run in runs if run["schedule"] == "concurrent"]
        record.at_most("slab, concurrent: velocity error anywhere, over U, worst", max(run["error"] for run in some), 1e-2)
    record.at_most("drift of the momentum of everything along U, worst", max(run["drift"] for run in runs), 1e-13 if options.long else 7e-14)
    momentum_of_everything(record, 1e-8 if options.long else 5.9e-14)
    raise SystemExit(record.write())


main()
