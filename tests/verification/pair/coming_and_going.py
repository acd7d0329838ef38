# SPDX-License-Identifier: GPL-3.0-or-later
"""Void fraction that changes without any motion: beads that are put into a liquid at rest, that leave through an outlet, and
a surface that passes from one layer of bulk cells to the next. Fluid makes room in one window, and nobody must feel it.

    put in, neutral, at rest, without gravity       everything stays at rest
    the same with gravity                           they come to rest, though nobody tells them of the liquid before the next window
    neutral beads in a plug flow to an outlet       those that stay go on as before when others have left
    beads that sink and rise under a surface        the speeds are those of the beads, whatever the window

Taken for motion, each gives a pulse of velocity of 1/window. Usage: coming_and_going.py DEMVOF [--long]"""
import concurrent.futures
import math

import numpy
import vtk  # noqa: F401  before two threads do it at once
from box_case import (SIDES, BoxCase, Inlet, Open, Outlet, Particle, Slip, command_line, momentum_of_everything,
                      particle_states, scratch)
from record import Record

DIAMETER = 4e-3
GRAVITY = 9.81  # m/s2
EDGE = 0.01  # of a bulk cell, m


PUSHED = [{"drag": "schiller_naumann"}, "pressure_gradient"]


def put_in(demvof, window, schedule, gravity=0, forces=PUSHED, start=30):
    """Largest speed of fluid and beads in all windows, and in the last, after 20 beads have come into being between two
    others, m/s."""
    case = BoxCase(scratch(f"coming_and_going/put_in_{window:g}_{schedule}_{gravity:g}_{len(forces)}_{start}"), (4 * EDGE, 4 * EDGE, 8 * EDGE), (8, 8, 16), (4, 4, 8),
                   12 * window, window, sides={side: Slip() for side in SIDES}, gravity=(0, 0, gravity), dem_step=window / 10, forces=forces,
                   contacts=True, tolerance=1e-14, relative_tolerance=0, history_interval=window,
                   coupling={"schedule": schedule}, momentum_judged=gravity != 0)  # at rest there is round-off alone
    case.sides["z+"] = Outlet()
    case.particles = [Particle((0.02, 0.02, z), DIAMETER, 1000) for z in (0.02, 0.06)]
    case.script_tail = f"""region source block 0.006 0.034 0.006 0.034 0.03 0.05 units box
fix bead all particletemplate/sphere 15485863 atom_type 1 density constant 1000 radius constant {DIAMETER / 2}
fix beads all particledistribution/discrete 15485867 1 bead 1.0
fix inject all insert/pack seed 32452843 distributiontemplate beads insert_every once start {start} overlapcheck yes &
 vel constant 0. 0. 0. region source particles_in_region 20
"""
    run = case.run(demvof)
    assert run.history["particles"][-1] == 22, run.history["particles"]
    mass = 1000 * math.pi / 6 * DIAMETER**3
    beads = numpy.sqrt(2 * run.history["particle_kinetic_energy"] / mass)  # were it one bead's
    return max(run.history["max_speed"].max(), beads.max()), beads[-1]


def leave(demvof, window, schedule):
    """Slowest and fastest layer of beads on their way to the outlet and while one layer leaves, over the fluid's speed."""
    speed, length = 0.2, 10
    case = BoxCase(scratch(f"coming_and_going/leave_{window:g}_{schedule}"), (length * EDGE, 4 * EDGE, 4 * EDGE),
                   (2 * length, 8, 8), (length, 4, 4), 0.05, window, sides={side: Slip() for side in SIDES}, gravity=(0, 0, 0),
                   velocity=(speed, 0, 0), dem_step=window / 10, output_interval=0.002, tolerance=1e-12, margin=0.05)
    case.sides.update({"x-": Inlet((speed, 0, 0)), "x+": Outlet()})
    case.particles = [Particle((0.07 + 0.0055 * layer, 0.0035 + 0.0055 * j, 0.0035 + 0.0055 * k), DIAMETER, 1000, velocity=(speed, 0, 0))
                      for layer in range(5) for j in range(7) for k in range(7)]
    run = case.run(demvof)
    layers = []
    for output in range(len(list((run.folder / "particles").glob("*.vtp")))):
        states = particle_states(run.folder, output)
        layer = (states["id"] - 1) // 49
        inside = states["position"][:, 0] < length * EDGE
        layers += [states["velocity"][inside & (layer == n), 0].mean() / speed for n in range(5) if (inside & (layer == n)).any()]
    assert (states["position"][:, 0] > length * EDGE).sum() == 49, "one layer has left"
    return min(layers), max(layers)


def pass_by(demvof, window):
    """Largest speed of the fluid while the surface over beads comes to the next layer of bulk cells, m/s."""
    case = BoxCase(scratch(f"coming_and_going/pass_{window:g}"), (8 * EDGE, EDGE, 6 * EDGE), (16, 2, 12), (8, 1, 6), 0.012, window,
                   sides={side: Slip() for side in SIDES}, level=0.03, dem_step=window / 10, contacts=True, history_interval=window)
    case.sides["z+"] = Open()
    case.particles = [Particle((0.04 + side * (0.004 + 0.008 * i), 0.005, 0.012 + 0.008 * j), DIAMETER, (2500, 500)[j])
                      for i in range(4) for j in range(2) for side in (-1, 1)]
    run = case.run(demvof)
    energy = run.history["mechanical_energy"]
    return run.history["max_speed"].max(), energy.max() / energy[0] - 1, run.results["conservation"]["solid_volume"]


def main():
    options = command_line()
    record = Record(
        "coming_and_going", "Beads that come and go",
        "Twenty neutral beads are put into a liquid at rest (a quarter of the volume there); layers of neutral beads drift out through "
        "an outlet; sinking and rising beads move a surface that lies on a face of the bulk grid. Room for what comes, goes, or is "
        "shared out anew is made by a flux without inertia: with it nobody is pushed, whatever the window.",
        "tests/Alltest --verification -- -R pair.coming_and_going_long" if options.long else "tests/Alltest -- -R 'pair.coming_and_going$'")
    windows = [1e-3, 2.5e-4, 5e-5] if options.long else [1e-3, 2.5e-4]
    schedules = ["staggered", "concurrent"]
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        put = [pool.submit(put_in, options.demvof, window, schedule) for window in windows for schedule in schedules]
        fallen = [pool.submit(put_in, options.demvof, windows[0], schedule, -GRAVITY, PUSHED, start=33) for schedule in schedules]
        left = [pool.submit(leave, options.demvof, window, schedule) for window in ([2e-3, 5e-4] if options.long else [1e-3])
                for schedule in schedules]
        passed = [pool.submit(pass_by, options.demvof, window) for window in windows]
        record.at_most("put in, at rest: speed of fluid and beads, worst", max(f.result()[0] for f in put), 8e-13, "m/s")
        fall = GRAVITY * windows[0] * math.sqrt(20)  # of all of them, a window long, as one bead's
        record.at_most("put in, with gravity: speed that is left, over that of a window's fall", max(f.result()[1] for f in fallen) / fall, 0.03)
        record.at_least("put in, with gravity: speed in between", min(f.result()[0] for f in fallen) / fall, 0.6)
        record.at_least("on their way out: slowest layer over the fluid's speed", min(f.result()[0] for f in left), 0.985)
        record.at_most("on their way out: fastest layer over the fluid's speed", max(f.result()[1] for f in left), 1.35)
        record.at_most("surface beside a face of the bulk grid: largest speed", max(f.result()[0] for f in passed), 6e-3, "m/s")
        record.at_most("surface beside a face of the bulk grid: energy above that of the start", max(f.result()[1] for f in passed), 3e-5)
        record.at_most("surface beside a face of the bulk grid: solid volume", max(f.result()[2] for f in passed), 2e-14)
    momentum_of_everything(record, 1e-8 if options.long else 2e-13)
    raise SystemExit(record.write())


main()
