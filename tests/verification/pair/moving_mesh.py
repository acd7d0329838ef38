# SPDX-License-Identifier: GPL-3.0-or-later
"""Fluid meshes that move through the bulk grid, with particles on them; their walls move in the script as well.

    uniform stream past beads, points of the mesh move to and fro      it stays uniform
    tank that oscillates, full of liquid; a bead without drag          3/(1 + 2 rho_p/rho) of the tank's velocity (Auton et al. 1988)
    the same, neutral beads with drag, to where the tank turns back    they go with the tank, beside its walls, too
    stagnation flow u = (a x, -a y), a part of the mesh moves          a neutral bead without drag is the fluid's: x = x_0 exp(a t)
    piston that drives liquid and neutral beads to an outlet           all have the piston's velocity
    tank whose walls leave bulk cells in windows that grow, or fast    the exchange's books close
    tank with water, air and beads, moved on uniformly                 as the tank at rest
    the last, stopped and continued                                    is the one that was not stopped

Usage: moving_mesh.py DEMVOF [--long]"""
import math
import subprocess

import numpy
from box_case import (SIDES, BoxCase, Cyclic, Inlet, Open, Outlet, Particle, Slip, Wall, command_line, momentum_of_everything,
                      particle_states, patch_name, scratch, vector)
from moving_walls import foam_file, mesh_motion, moving_wall, walls_of_the_script
from record import Record

EDGE = 0.01  # of a bulk cell, m
AMPLITUDE, OMEGA = 4e-3, 2 * math.pi * 5  # of the tank that oscillates, m and 1/s
PISTON = 0.2  # m/s
TANK = (4 * EDGE, 4 * EDGE, 6 * EDGE)


def deform(demvof, held):
    """Largest difference of the fluid's largest and of its mean speed from that of the stream, over that."""
    window, stream = 1e-3, (0.1, 0.05, 0)
    case = BoxCase(scratch(f"moving_mesh/deform_{held}"), (6 * EDGE, 4 * EDGE, 4 * EDGE), (12, 8, 8), (6, 4, 4), 0.02, window,
                   sides={side: Cyclic() for side in SIDES}, gravity=(0, 0, 0), velocity=stream, tolerance=1e-13, relative_tolerance=0,
                   history_interval=window, dem_step=window / 10, first_step=window / 4, longest_step=window / 4,
                   forces=[] if held else [{"drag": "di_felice"}, "pressure_gradient"], prepare=["blockMesh", "topoSet"])
    case.particles = [Particle(((i + .3) * EDGE, (j + .4) * EDGE, (k + .5) * EDGE), 5e-3, 1000, held=held,
                               velocity=(0, 0, 0) if held else stream) for i in range(6) for j in range(4) for k in range(4)]
    case.extra_files["fluid/system/topoSetDict"] = foam_file("dictionary", """actions
( { name inner; type cellSet; action new; source boxToCell; box (0.02 0.01 0.01) (0.04 0.03 0.03); }
  { name inner; type cellZoneSet; action new; source setToCellZone; set inner; } );""")
    case.extra_files["fluid/constant/dynamicMeshDict"] = mesh_motion(
        "motionSolver solidBody; cellZone inner; solidBodyMotionFunction oscillatingLinearMotion;\n"
        "oscillatingLinearMotionCoeffs { amplitude (0.002 0.001 0.0005); omega 150; }")
    run = case.run(demvof)
    speed = math.hypot(*stream)
    energy = run.history["kinetic_energy"]
    return run, max(max(abs(run.history["max_speed"] / speed - 1)), max(abs(numpy.sqrt(energy / energy[0]) - 1)))


def tank(name, velocity, fluid_motion, script_motion, window, end_time, level=None, **keys):
    """A tank on a larger bulk grid. Without motions it stands still."""
    case = BoxCase(scratch(f"moving_mesh/{name}"), TANK, (8, 8, 12), (4, 4, 6), end_time, window, level=level, velocity=velocity,
                   sides={side: moving_wall() if fluid_motion else Wall() for side in SIDES}, tolerance=1e-12, relative_tolerance=0,
                   dem_step=window / 50, margin=0.05, **keys)
    case.sections = {"bulk_grid": {"lower": 3 * [-3 * EDGE], "upper": [7 * EDGE, 7 * EDGE, 9 * EDGE], "cells": [10, 10, 12]}}
    walls_of_the_script(case, (0, 0, 0), TANK, script_motion)
    if fluid_motion:
        case.extra_files["fluid/constant/dynamicMeshDict"] = mesh_motion("motionSolver solidBody; " + fluid_motion)
    return case


def oscillate(demvof, density, window):
    """Amplitude of the bead's velocity over the tank's, the exact one, and by how much it is ahead, degrees."""
    exact, end_time = 3 / (1 + 2 * density / 1000), 0.2
    case = tank(f"oscillate_{density}_{window:g}", (AMPLITUDE * OMEGA, 0, 0),
                f"solidBodyMotionFunction oscillatingLinearMotion; oscillatingLinearMotionCoeffs {{ amplitude ({AMPLITUDE} 0 0); omega {OMEGA:.15g}; }}",
                f"wiggle amplitude {AMPLITUDE} 0. 0. period {2 * math.pi / OMEGA:.15g}", window, end_time, gravity=(0, 0, 0),
                forces=["pressure_gradient", {"added_mass": 0.5}], output_interval=0.01)
    for side in ("y-", "y+", "z-", "z+"):
        case.sides[side] = {**moving_wall(), "U": "slip"}
    case.particles = [Particle((0.02, 0.02, 0.03), 4e-3, density, velocity=(exact * AMPLITUDE * OMEGA, 0, 0))]
    run = case.run(demvof)
    times = numpy.arange(0, end_time + 1e-9, case.output_interval)
    speed = [particle_states(run.folder, output)["velocity"][0, 0] for output in range(len(times))]
    waves = numpy.stack([numpy.cos(OMEGA * times), numpy.sin(OMEGA * times), numpy.ones_like(times)]).T
    a, b, _ = numpy.linalg.lstsq(waves, speed, rcond=None)[0]
    return run, math.hypot(a, b) / (AMPLITUDE * OMEGA), exact, math.degrees(math.atan2(b, a))


def carry(demvof, window):
    """Largest difference of the beads' velocity from the tank's, mean of a layer beside a wall, over the tank's largest. The tank
    turns back in the middle of a step, whose swept volumes are round-off."""
    omega, end_time = 2 * math.pi / (4 * 49.5 * 1e-3), 0.055
    case = tank(f"carry_{window:g}", (AMPLITUDE * omega, 0, 0),
                f"solidBodyMotionFunction oscillatingLinearMotion; oscillatingLinearMotionCoeffs {{ amplitude ({AMPLITUDE} 0 0); omega {omega:.15g}; }}",
                f"wiggle amplitude {AMPLITUDE} 0. 0. period {2 * math.pi / omega:.15g}", window, end_time, gravity=(0, 0, 0),
                forces=[{"drag": "di_felice"}, "pressure_gradient", {"added_mass": 0.5}], output_interval=0.005)
    case.particles = [Particle((0.003 + 0.0068 * i, 0.005 + 0.01 * j, 0.005 + 0.01 * k), 3e-3, 1000, velocity=(AMPLITUDE * omega, 0, 0))
                      for i in range(6) for j in range(4) for k in range(6)]
    run = case.run(demvof)
    layer = numpy.array([round((bead.position[0] - 0.003) / 0.0068) for bead in case.particles])
    worst = 0
    for output in range(12):
        against = particle_states(run.folder, output)["velocity"][:, 0] / (AMPLITUDE * omega) - math.cos(omega * output * case.output_interval)
        worst = max([worst] + [abs(against[layer == i].mean()) for i in range(6)])
    return run, worst


def leave(demvof, name, window, amplitude, omega, end_time, *options, **keys):
    """A tank whose walls leave bulk cells to which the kernel's tails give a little of the beads: what is owed there is due when the cells
    are gone."""
    speed, turn = amplitude * omega, f"{2 * math.pi / omega:.15g}"
    case = tank(f"leave_{name}", (speed, 0, speed),
                f"solidBodyMotionFunction oscillatingLinearMotion; oscillatingLinearMotionCoeffs {{ amplitude ({amplitude} 0 {amplitude}); omega {omega:.15g}; }}",
                f"wiggle amplitude {amplitude} 0. {amplitude} period {turn}", window, end_time,
                forces=[{"drag": "di_felice"}, "pressure_gradient"], **keys)
    grid, shift = case.sections["bulk_grid"], (6e-4, 0, 6e-4)  # faces that the walls reach when windows grow
    grid.update({corner: [at + by for at, by in zip(grid[corner], shift)] for corner in ("lower", "upper")})
    case.particles = [Particle((0.008 + 0.02 * i, 0.012 + 0.014 * j, 0.012 + 0.016 * k), 4e-3, 2500, velocity=(speed, 0, speed))
                      for i in range(2) for j in range(2) for k in range(2)]
    return case.run(demvof, *options)


def stagnate(demvof, zone_speed, order):
    """Velocity of the bead at the end, over its speed at the start. zone_speed: of the part of the mesh that moves, along x, m/s."""
    rate, box, cells, window, end_time = 5.0, (6 * EDGE, 6 * EDGE, 4 * EDGE), (12, 12, 8), 1e-3, 0.02

    def flow(lower, upper, counts):  # at the middles
        x, y, z = ([low + (i + 0.5) * (high - low) / n for i in range(n)] for low, high, n in zip(lower, upper, counts))
        return f"nonuniform List<vector> ({' '.join(vector((rate * a, -rate * b, 0)) for _ in z for b in y for a in x)})"

    case = BoxCase(scratch(f"moving_mesh/stagnate_{zone_speed:g}_{order}"), box, cells, (6, 6, 4), end_time, window, gravity=(0, 0, 0),
                   tolerance=1e-12, relative_tolerance=0, dem_step=window / 10, forces=["pressure_gradient", {"added_mass": 0.5}],
                   prepare=["blockMesh", "topoSet"], sides={side: Slip() for side in SIDES}, coupling={"order": order},
                   momentum_judged=False)
    case.sections["scene"] = {"porosity": "off"}
    case.particles = [Particle((0.03, 0.03, 0.02), 2e-3, 1000, velocity=(rate * 0.03, -rate * 0.03, 0))]
    for side in ("x-", "x+", "y-", "y+"):
        axis, low, high, counts = "xyz".index(side[0]), [0, 0, 0], list(box), list(cells)
        low[axis] = high[axis] = box[axis] if side[1] == "+" else 0
        counts[axis] = 1
        case.sides[side] = Inlet("fixedValue; value " + flow(low, high, counts))
    boundary = " ".join(f"{patch_name(side)} {{ type {entry['U']}; }}" for side, entry in case.sides.items())
    case.extra_files["fluid/0.orig/U"] = foam_file(
        "volVectorField", f"dimensions [0 1 -1 0 0 0 0];\ninternalField {flow((0, 0, 0), box, cells)};\nboundaryField {{ {boundary} }}")
    case.extra_files["fluid/system/topoSetDict"] = foam_file("dictionary", """actions
( { name inner; type cellSet; action new; source boxToCell; box (0.01 0.01 0.01) (0.05 0.05 0.03); }
  { name inner; type cellZoneSet; action new; source setToCellZone; set inner; } );""")
    case.extra_files["fluid/constant/dynamicMeshDict"] = mesh_motion(
        f"motionSolver solidBody; cellZone inner; solidBodyMotionFunction linearMotion; linearMotionCoeffs {{ velocity ({zone_speed} 0 0); }}")
    run = case.run(demvof)
    return run, particle_states(run.folder)["velocity"][0] / (rate * 0.03)


def push(demvof, window, schedule):
    """Slowest and fastest bead and largest speed of the fluid at the end, over the piston's."""
    case = BoxCase(scratch(f"moving_mesh/push_{window:g}_{schedule}"), (10 * EDGE, 4 * EDGE, 4 * EDGE), (20, 8, 8), (10, 4, 4), 0.06, window,
                   sides={side: Slip() for side in SIDES}, gravity=(0, 0, 0), velocity=(PISTON, 0, 0), dem_step=window / 10, margin=0.05,
                   tolerance=1e-12, relative_tolerance=0, coupling={"schedule": schedule}, history_interval=window,
                   first_step=window / 4, longest_step=window / 4)
    case.sides.update({"x-": moving_wall(), "x+": {**Outlet(), "type": "wall"}})  # the mesh calls it a wall, which is nothing to what is open
    case.particles = [Particle((0.03 + 0.0055 * i, 0.0035 + 0.0055 * j, 0.0035 + 0.0055 * k), 4e-3, 1000, velocity=(PISTON, 0, 0))
                      for i in range(5) for j in range(7) for k in range(7)]
    walls_of_the_script(case, (0, 0, 0), (1e-4, 0.04, 0.04), f"linear {PISTON} 0. 0.")
    case.contacts = True
    case.extra_files["fluid/constant/dynamicMeshDict"] = mesh_motion("motionSolver velocityLaplacian; diffusivity uniform;")
    case.write()
    ends = {"xlow": f"fixedValue; value uniform {vector((PISTON, 0, 0))}", "xhigh": "fixedValue; value uniform (0 0 0)"}
    ends.update({side: "slip" for side in ("ylow", "yhigh", "zlow", "zhigh")})
    boundary = " ".join(f"{name} {{ type {entry}; }}" for name, entry in ends.items())
    case.extra_files["fluid/0.orig/pointMotionU"] = foam_file(
        "pointVectorField", f"dimensions [0 1 -1 0 0 0 0];\ninternalField uniform (0 0 0);\nboundaryField {{ {boundary} }}")
    solution = (case.folder / "fluid/system/fvSolution").read_text()
    case.extra_files["fluid/system/fvSolution"] = solution.replace(
        "solvers\n{", "solvers\n{\n    cellMotionU { solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0; }", 1)
    run = case.run(demvof)
    speed = particle_states(run.folder)["velocity"][:, 0] / PISTON
    return run, speed.min(), speed.max(), run.history["max_speed"][-1] / PISTON


def tank_with_surface(name, velocity, **keys):
    """Nine beads of three densities fall into and rise in water under air."""
    moves = any(velocity)
    case = tank(name, velocity, f"solidBodyMotionFunction linearMotion; linearMotionCoeffs {{ velocity {vector(velocity)}; }}" if moves else "",
                "linear {} {} {}".format(*velocity) if moves else "", 1e-3, keys.pop("end_time", 0.1), level=0.033,
                alpha_controls="nAlphaCorr 1; nAlphaSubCycles 2; cAlpha 1; MULESCorr no;", **keys)
    case.sides["z+"] = Open()
    case.particles = [Particle((0.008 + 0.012 * i, 0.008 + 0.012 * j, 0.02 + 0.008 * ((i + j) % 3)), 6e-3, (300, 900, 2500)[(i * 2 + j) % 3],
                               velocity=velocity) for i in range(3) for j in range(3)]
    return case


def move_on(demvof, velocity):
    """Largest distance of a bead from where it would be in the tank at rest, over its diameter."""
    still = tank_with_surface("still", (0, 0, 0)).run(demvof)
    moved = tank_with_surface("moved", velocity).run(demvof)
    way = particle_states(moved.folder)["position"] - particle_states(still.folder)["position"] - 0.1 * numpy.array(velocity)
    return moved, abs(way).max() / 6e-3


def same_when_continued(demvof, name, *options):
    """Whether history.csv of a run that was stopped and continued is that of one that was not."""
    case = tank_with_surface(name, (0.2, 0.1, 0), end_time=0.03, history_interval=1e-3)
    case_file = case.write()

    def go(out, *more):
        subprocess.run([demvof, "run", str(case_file), "--out", str(case.folder / out), *options, *more], check=True, stdout=subprocess.DEVNULL)
        return (case.folder / out / "history.csv").read_text()

    whole = go("whole", "--force")
    go("parts", "--force", "--set", "coupling.end_time=0.02")
    return go("parts", "--continue") == whole


def main():
    options = command_line()
    record = Record(
        "moving_mesh", "Meshes that move",
        "The bulk grid stays, and the fluid's mesh moves through it: points inside a periodic box, a tank as a whole, a piston that "
        "compresses the cells before it. Void fraction, liquid and momentum are kept relative to the faces; in each window the particles hear "
        "what the mesh leaves of each bulk cell. The walls move in LIGGGHTS by its own fix move/mesh.",
        "tests/Alltest --verification -- -R pair.moving_mesh_long" if options.long else "tests/Alltest -- -R 'pair.moving_mesh$'")
    runs, alone = [], []  # alone: nobody pushes anybody, so that there is nothing but round-off to exchange
    for held in (True, False):
        run, error = deform(options.demvof, held)
        alone.append(run)
        record.at_most(f"uniform stream, points that move, beads {'held' if held else 'in the stream'}: error of the speed", error, 1e-10)
    windows = [2e-3, 1e-3, 5e-4, 2.5e-4] if options.long else [1e-3]
    for density in (1000, 2500):
        for window in windows:
            run, amplitude, exact, phase = oscillate(options.demvof, density, window)
            runs.append(run)
            name = f"tank that oscillates, bead of {density} kg/m3, window {1e3 * window:g} ms"
            record.at_most(f"{name}: error of its amplitude", abs(amplitude / exact - 1), 0.006)
            record.at_most(f"{name}: ahead by", abs(phase), 2 * window / 1e-3, "degrees")
    for window in windows:
        run, worst = carry(options.demvof, window)
        runs.append(run)
        record.at_most(f"tank that oscillates and turns back, neutral beads, window {1e3 * window:g} ms: against the tank", worst, 0.05)
    own = {"window": {"tolerance": 2e-3, "shortest": 2e-4, "longest": 2e-3}}
    growing = leave(options.demvof, "growing", 1e-3, 2e-3, 40, 0.015, coupling=own)
    fast = leave(options.demvof, "fast", 1e-3, AMPLITUDE, 150, 0.03, "--fluid-ranks", "2")
    runs += [growing, fast]  # their exchange, below
    too_late = [sum("the mesh had left" in line for line in run.results["warnings"]) for run in (growing, fast)]
    record.at_most("walls leave bulk cells, windows grow: warnings that something was due when they were gone", too_late[0], 0)
    record.at_least("walls leave bulk cells too fast: warnings of it", too_late[1], 1)
    for order in (1, 2):
        still, moved = (stagnate(options.demvof, speed, order)[1] for speed in (0, 0.15))
        record.at_most(f"stagnation flow, neutral bead without drag, order {order}: mesh that moves against the mesh at rest",
                       abs(moved - still).max(), 0.003)
    for window, schedule in [(1e-3, "staggered"), (1e-3, "concurrent")] + ([(2.5e-4, "staggered"), (2.5e-4, "concurrent")] if options.long else []):
        run, slowest, fastest, fluid = push(options.demvof, window, schedule)
        runs.append(run)
        name = f"piston, window {1e3 * window:g} ms, {schedule}"
        record.at_most(f"{name}: largest error of a bead's velocity", max(1 - slowest, fastest - 1), 3.7e-3)
        record.at_most(f"{name}: error of the fluid's at the end", abs(fluid - 1), 0.015)
    run, way = move_on(options.demvof, (0.2, 0.1, 0))
    runs.append(run)
    record.at_most("tank moved on, beads in water and air: from where they are in the tank at rest, over their diameter", way, 0.15)
    kinds = {"staggered": (), "concurrent": ("--set", "coupling.schedule=concurrent"), "two ranks each": ("--fluid-ranks", "2", "--particle-ranks", "2"),
             "windows of its own": ("--set", "coupling.window={tolerance: 0.01, shortest: 2.5e-4, longest: 2e-3}",
                                    "--set", "output.interval=0.01")}  # windows to a time that is met are equal parts: to the stop, too
    if not options.long:
        kinds = {"two ranks each": kinds["two ranks each"]}
    other = sum(not same_when_continued(options.demvof, "continued_" + kind.replace(" ", "_"), *more) for kind, more in kinds.items())
    record.at_most("tank moved on, stopped and continued: runs that differ from the one that did not stop", other, 0)
    for quantity, bound, of in (("exchange", 7e-14, runs), ("liquid_volume", 1.5e-13, runs + alone), ("solid_volume", 2e-13, runs + alone)):
        record.at_most(f"all runs: {quantity.replace('_', ' ')}", max(run.results["conservation"][quantity] for run in of), bound)
    momentum_of_everything(record, 2e-13)
    raise SystemExit(record.write())


main()
