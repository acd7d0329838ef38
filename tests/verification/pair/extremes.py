# SPDX-License-Identifier: GPL-3.0-or-later
"""Beads fall into water, one thing at a time driven to an extreme, then several at once.

Nothing is exact here but what always holds: the run goes to its end, the books close, alpha stays in [0, 1], and
nobody gains energy, that of fluids and particles together falls. Beads that fall through gas into a liquid thick enough to
stop each within its way through a DEM step fall as in any gas until they touch it, and stay there.
Usage: extremes.py DEMVOF [--long]"""
import concurrent.futures
import itertools
import math
import random
import re

import numpy
from box_case import BoxCase, Open, Particle, SIDES, Slip, command_line, momentum_of_everything, scratch
from record import Record

BASE = {"density": 2500.0, "gas": 1.0, "viscosity": 1e-6, "diameter": 3e-3, "window": 1e-3, "bulk": 6, "fine": 12,
        "gravity": 9.81, "dense": False, "forces": [{"drag": "schiller_naumann"}, "pressure_gradient"], "coupling": {},
        "tension": 0.07, "pimple": ""}
KERNELS = ("centre", "volume", "linear", "diffusion")
ADDED = [*BASE["forces"], {"added_mass": 0.5}]
LIGHT, HEAVY = {"density": 30.0}, {"density": 20000.0}

# name: what differs from BASE
SHORT = {
    "base": {},
    "beads of 30 kg/m3": LIGHT,
    "beads of 20 000 kg/m3": HEAVY,
    "beads of 30 kg/m3, dense, windows of 10 ms": {**LIGHT, "dense": True, "window": 1e-2},
    "viscosity 0.1 m2/s": {"viscosity": 0.1},
}
LONG = {
    **SHORT,
    "beads of 1 kg/m3": {"density": 1.0},
    "beads of 300 kg/m3": {"density": 300.0},
    "beads of 1000 kg/m3": {"density": 1000.0},
    "beads of 30 kg/m3, added mass": {**LIGHT, "forces": ADDED},
    "gas of 0.01 kg/m3": {"gas": 0.01},
    "gas of 1000 kg/m3": {"gas": 1000.0},
    "viscosity 1e-8 m2/s": {"viscosity": 1e-8},
    "viscosity 1e-3 m2/s": {"viscosity": 1e-3},
    "dense, viscosity 0.1 m2/s, concurrent": {"dense": True, "viscosity": 0.1, "coupling": {"schedule": "concurrent"}},
    "dense, viscosity 1 m2/s": {"dense": True, "viscosity": 1.0},
    "dense, viscosity 10 m2/s": {"dense": True, "viscosity": 10.0},
    "dense, viscosity 1 m2/s, five outer correctors": {"dense": True, "viscosity": 1.0, "pimple": "nOuterCorrectors 5;"},
    "beads of 0.3 mm": {"diameter": 3e-4},
    "beads as large as a bulk cell": {"diameter": 6.6e-3},
    "beads as large as two bulk cells": {"diameter": 6.6e-3, "bulk": 12},
    "windows of 0.1 ms": {"window": 1e-4},
    "windows of 5 ms": {"window": 5e-3},
    "windows of 20 ms": {"window": 2e-2},
    "gravity times 10": {"gravity": 98.1},
    "dense": {"dense": True},
    "dense, windows of 20 ms": {"dense": True, "window": 2e-2},
    "dense, beads of 20 000 kg/m3, windows of 10 ms": {**HEAVY, "dense": True, "window": 1e-2},
    "dense, beads of 1 kg/m3": {"density": 1.0, "dense": True},
    "dense, 0.3 mm, drag of Gidaspow, windows of 5 ms": {
        "dense": True, "diameter": 3e-4, "window": 5e-3, "forces": [{"drag": "gidaspow"}, "pressure_gradient"]},
    "no surface tension": {"tension": 0.0},
    "surface tension times 10": {"tension": 0.7},
    "volume_adding": {"coupling": {"phase_interchange": "volume_adding"}},
    "volume_adding, beads of 30 kg/m3, dense": {**LIGHT, "dense": True, "coupling": {"phase_interchange": "volume_adding"}},
    "concurrent": {"coupling": {"schedule": "concurrent"}},
    "explicit exchange": {"coupling": {"exchange": "explicit"}},
    **{f"kernel {kernel}, dense": {"dense": True, "coupling": {"averaging": {"kernel": kernel}}} for kernel in KERNELS},
}
# Known to gain energy: with volume_adding a bead in the air is as heavy for the fluid as water.
NOT_HELD = ("volume_adding, beads of 30 kg/m3, dense",)
WIDTH, HEIGHT, LEVEL, TIME = 0.04, 0.08, 0.04, 0.16  # m, m, m, s


def beads(diameter, density, dense):
    """At rest, half of them in the water and half over it. dense: side by side."""
    pitch = diameter * (1.02 if dense else 2.5)
    across = max(2, min(8 if dense else 4, int(0.9 * WIDTH / pitch)))
    layers = max(1, min(4, int(0.025 / pitch)))
    middle = 0.5 * WIDTH - 0.5 * (across - 1) * pitch
    for low in (0.008, LEVEL + 0.003):
        for i, j, k in itertools.product(range(across), range(across), range(layers)):
            yield Particle((middle + i * pitch, middle + j * pitch, low + (k + 0.5) * pitch), diameter, density)


def build(name, changes):
    given = {**BASE, **changes}
    folder = scratch("extremes") / re.sub(r"\W+", "_", name)
    bulk, fine = (given["bulk"],) * 2 + (2 * given["bulk"],), (given["fine"],) * 2 + (2 * given["fine"],)
    mass = numpy.pi / 6 * given["diameter"]**3 * given["density"]
    contact = 1e-4  # s, of a collision: the same DEM step for all
    case = BoxCase(folder, (WIDTH, WIDTH, HEIGHT), fine, bulk, TIME, given["window"], gravity=(0, 0, -given["gravity"]),
                   liquid=(1000, given["viscosity"]), gas=(given["gas"], 1e-5), sigma=given["tension"], level=LEVEL,
                   contacts=True, stiffness=0.5 * mass * (numpy.pi / contact)**2, dem_step=1e-5, forces=given["forces"],
                   # MULES's limiter stops after three iterations by itself, which leaves 1e-6 of a bound.
                   alpha_controls="nAlphaCorr 1; nAlphaSubCycles 1; cAlpha 1; MULESCorr no; nLimiterIter 10;",
                   coupling=given["coupling"], tolerance=1e-8, history_interval=given["window"],
                   pimple=given["pimple"],
                   particles=list(beads(given["diameter"], given["density"], given["dense"])))
    case.sides = {side: Open() if side == "z+" else Slip() for side in SIDES}
    return case


# Beads of 3 mm and 2500 kg/m3 fall from the gas into a thick liquid: fine cells of 5 mm, cut by bulk faces, nu dt/dx2 up
# to 8e4. count: of beads; 1000 m2/s is the most that a case may have.
FALL = {"viscosity": 1000.0, "window": 1e-3, "count": 40, "forces": BASE["forces"], "coupling": {}, "pimple": ""}
ONE = {"count": 1}
STRESS = {"forces": [*BASE["forces"], "viscous_stress"]}
FALL_SHORT = {"one": ONE, "forty": {}, "forty, viscous stress": STRESS}
FALL_LONG = {
    **FALL_SHORT,
    **{f"{name}, {nu:g} m2/s, windows of {1e3 * window:g} ms": {**count, "viscosity": nu, "window": window}
       for name, count in (("one", ONE), ("forty", {})) for nu in (1.0, 10.0, 50.0, 200.0, 1000.0)
       for window in (1e-4, 2.5e-4, 1e-3, 2e-3)},
    "forty, viscous stress, 10 m2/s": {**STRESS, "viscosity": 10.0},
    "forty, added mass": {"forces": ADDED},
    "forty, concurrent": {"coupling": {"schedule": "concurrent"}},
    "forty, order 2": {"coupling": {"order": 2}},
    "forty, three outer correctors": {"pimple": "nOuterCorrectors 3;"},
    "forty, own windows": {"coupling": {"window": {"tolerance": 1e-3, "shortest": 2e-4, "longest": 2e-3}}},
    "forty, fluid told at points": {"coupling": {"mapping": {"to_bulk": "cell_point"}}},
}
START, TOUCH = 0.0425, 0.0415  # height of the one bead's centre, m: 1 mm above where it meets the liquid


def falling(count, diameter=3e-3, density=2500.0):
    """One, or at random places 1.5 to 20 mm over the liquid."""
    if count == 1:
        return [Particle((0.0203, 0.0197, START), diameter, density)]
    draw, places = random.Random(1), []
    while len(places) < count:
        place = (draw.uniform(3e-3, 0.037), draw.uniform(3e-3, 0.037), draw.uniform(0.043, 0.06))
        if all(math.dist(place, other) > 1.1 * diameter for other in places):
            places.append(place)
    return [Particle(place, diameter, density) for place in places]


def fall(name, changes):
    given = {**FALL, **changes}
    step = 5e-5  # s, of the DEM
    mass = numpy.pi / 6 * 3e-3**3 * 2500
    return BoxCase(scratch("extremes") / re.sub(r"\W+", "_", "fall " + name), (WIDTH, WIDTH, HEIGHT), (8, 8, 16), (6, 6, 12),
                   0.03 if given["count"] == 1 else 0.06, given["window"], liquid=(1000, given["viscosity"]),
                   gas=(1, 1.48e-5), level=LEVEL, contacts=True, stiffness=0.5 * mass * (numpy.pi / (20 * step))**2,
                   dem_step=step, forces=given["forces"], coupling=given["coupling"], pimple=given["pimple"],
                   alpha_controls="nAlphaCorr 2; nAlphaSubCycles 1; cAlpha 1; MULESCorr no; nLimiterIter 10;",
                   velocity_solver="solver GAMG; smoother symGaussSeidel; tolerance 1e-12; relTol 1e-3;",
                   tolerance=1e-9, history_interval=2e-3 if "window" in given["coupling"] else given["window"],
                   particles=falling(given["count"]))


def judge_falls(record, runs, long):
    record.at_most("beads that fall into thick liquid, runs that end with an error", sum(run is None for run in runs.values()), 0)
    done = {name: run for name, run in runs.items() if run}
    record.note("beads that fall into thick liquid, runs", len(runs))
    record.at_most("beads that fall into thick liquid, lost", sum(r.results["particles"]["lost"] for r in done.values()), 0)
    record.at_most("beads that fall into thick liquid, energy above its start, over it, worst run",
                   max(rise(run) for run in done.values()), 1.3e-5)
    weight = numpy.pi / 6 * 3e-3**3 * 2500 * 9.81
    arrival = math.sqrt(2 * (START - TOUCH) / 9.81)
    free, after, up = [], [], []
    for name, run in done.items():
        if not name.startswith("one"):
            continue
        time, momentum = run.history["time"], run.history["particle_momentum_z"]
        falls, rests = time < 0.95 * arrival, time > arrival + 3 * max(run.history["time"][1], 1e-3)
        free.append(abs(momentum[falls] / (-weight * (time[falls] + 2.5e-5)) - 1).max())
        after.append(abs(momentum[rests]).max() / (weight * arrival))
        up.append(momentum.max() / (weight * arrival))
    record.at_most("one bead: its fall through the gas, from that of a body in vacuum, relative", max(free), 1.7e-3)
    record.at_most("one bead: speed three windows after it has touched the liquid, over that on arrival", max(after), 0.05 if long else 5e-3)
    record.at_most("one bead: highest velocity upwards, over the speed on arrival", max(up), 0)


def simulate(demvof, name, case):
    try:
        return name, case.run(demvof)
    except RuntimeError:
        return name, None


def rise(run):
    """Of the energy of fluids and particles above its start, over that. Contacts and surface hold some for a while."""
    energy = run.history["mechanical_energy"]
    return float((energy - energy[0]).max() / abs(energy[0]))


def outside_bounds(run):
    """How far alpha left [0, 1]: the run warns beyond 1e-8."""
    said = [re.search(r"alpha left \[0, 1\] by up to (\S+):", line) for line in run.results["warnings"]]
    return max((float(found[1]) for found in said if found), default=0.0)


def main():
    options = command_line()
    record = Record(
        "extremes", "Extremes: beads in and over water",
        "Beads rest in water and fall into it from above while one thing at a time is driven to an extreme: their density "
        "(1 to 20 000 kg/m3), size (a tenth of a bulk cell to two bulk cells) and crowding, the densities' ratio (1 to 1e5), "
        "viscosity (1e-8 to 10 m2/s), window (0.1 to 20 ms), gravity, surface tension, kernel, schedule; then several "
        "at once. Each run has to come to its end with closed books and bounded alpha, and to give nobody energy.",
        "tests/Alltest --verification -- -R pair.extremes_long" if options.long else "tests/Alltest -- -R 'pair.extremes$'")
    chosen = LONG if options.long else SHORT
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        cases = {name: build(name, changes) for name, changes in chosen.items()}
        falls = {name: fall(name, changes) for name, changes in (FALL_LONG if options.long else FALL_SHORT).items()}
        runs, fallen = (dict(pool.map(lambda item: simulate(options.demvof, *item), some.items())) for some in (cases, falls))
    held = {name: run for name, run in runs.items() if name not in NOT_HELD}
    record.note("runs", len(runs))
    record.at_most("runs that end with an error", sum(run is None for run in held.values()), 0)
    done = {name: run for name, run in held.items() if run}
    for books, bound in (("exchange", 1.8e-13), ("solid_volume", 2e-13), ("liquid_volume", 1.6e-13)):
        record.at_most(f"conservation.{books}, worst run", max(r.results["conservation"][books] for r in done.values()),
                       1e-11 if options.long else bound)
    record.at_most("alpha outside [0, 1] by, worst run", max(map(outside_bounds, done.values())), 1e-6,
                   loose="none in the short form; 1.3e-7 in the long one")
    record.at_most("beads lost", sum(r.results["particles"]["lost"] for r in done.values()), 0)
    for name, run in runs.items():
        worst = rise(run) if run else float("nan")
        if name in NOT_HELD:
            record.note(f"{name}: energy above its start, over it", worst if run else "ended with an error")
        else:
            record.at_most(f"{name}: energy above its start, over it", worst, 0.01, loose="an extreme may give no energy that matters: 1.4e-3 at worst in the long form")
    judge_falls(record, fallen, options.long)
    momentum_of_everything(record)
    raise SystemExit(record.write())


main()
