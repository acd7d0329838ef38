# SPDX-License-Identifier: GPL-3.0-or-later
"""Fluid meshes that move through a periodic bulk grid: what leaves at one end is at the other.

    uniform stream past beads, the mesh as a whole to and fro, and on by more than a period    it stays uniform
    the same, cyclic ends that bulge                                                           it stays uniform
    water under air with beads, mesh, water and beads on by more than a period                 as the mesh at rest
    the last, stopped and continued                                                            is the one that was not stopped

Usage: periodic_mesh.py DEMVOF"""
import math
import subprocess

import numpy
from box_case import SIDES, BoxCase, Cyclic, Open, Particle, Slip, command_line, momentum_of_everything, particle_states, scratch, vector
from moving_walls import foam_file, mesh_motion
from record import Record
from reporting.run import Run

EDGE, WINDOW = 0.01, 1e-3  # of a bulk cell, m; s
BOX, STREAM, END = (6 * EDGE, 4 * EDGE, 4 * EDGE), (0.1, 0.05, 0), 0.02
TO_AND_FRO = "solidBodyMotionFunction oscillatingLinearMotion; oscillatingLinearMotionCoeffs { amplitude (0.002 0.001 0.0005); omega 150; }"


def on(velocity):
    return f"solidBodyMotionFunction linearMotion; linearMotionCoeffs {{ velocity {vector(velocity)}; }}"


def stream(name, motion, held, zone=False, **keys):
    """A periodic box full of liquid and beads. zone: of the mesh's points a tube from end to end moves alone."""
    case = BoxCase(scratch(f"periodic_mesh/{name}"), BOX, (12, 8, 8), (6, 4, 4), END, WINDOW, sides={side: Cyclic() for side in SIDES},
                   gravity=(0, 0, 0), velocity=STREAM, tolerance=1e-14, relative_tolerance=0, history_interval=WINDOW, dem_step=WINDOW / 10,
                   first_step=WINDOW / 4, longest_step=WINDOW / 4, forces=[] if held else [{"drag": "di_felice"}, "pressure_gradient"],
                   prepare=["blockMesh"] + (["topoSet"] if zone else []), **keys)
    case.particles = [Particle(((i + .3) * EDGE, (j + .4) * EDGE, (k + .5) * EDGE), 5e-3, 1000, held=held,
                               velocity=(0, 0, 0) if held else STREAM) for i in range(6) for j in range(4) for k in range(4)]
    if zone:
        case.extra_files["fluid/system/topoSetDict"] = foam_file("dictionary", """actions
( { name tube; type cellSet; action new; source boxToCell; box (-1 0.01 0.01) (1 0.03 0.03); }
  { name tube; type cellZoneSet; action new; source setToCellZone; set tube; } );""")
    case.extra_files["fluid/constant/dynamicMeshDict"] = mesh_motion(f"motionSolver solidBody; {'cellZone tube;' if zone else ''} {motion}")
    return case


def error_of_stream(run):
    """Largest difference of the largest and of the mean speed from that of the stream, over that."""
    energy = run.history["kinetic_energy"]
    return max(max(abs(run.history["max_speed"] / math.hypot(*STREAM) - 1)), max(abs(numpy.sqrt(energy / energy[0]) - 1)))


def channel(name, velocity, end_time=0.1, **keys):
    """Nine beads of three densities fall into and rise in water under air, periodic along x and y."""
    sides = {**{side: Cyclic() for side in SIDES}, "z-": Slip(), "z+": Open()}
    case = BoxCase(scratch(f"periodic_mesh/{name}"), (4 * EDGE, 4 * EDGE, 6 * EDGE), (8, 8, 12), (4, 4, 6), end_time, WINDOW, level=0.033,
                   velocity=velocity, sides=sides, tolerance=1e-12, relative_tolerance=0, dem_step=WINDOW / 50,
                   alpha_controls="nAlphaCorr 1; nAlphaSubCycles 2; cAlpha 1; MULESCorr no;", **keys)
    case.particles = [Particle((0.008 + 0.012 * i, 0.008 + 0.012 * j, 0.027 + 0.008 * ((i + j) % 3)), 6e-3, (300, 900, 2500)[(i * 2 + j) % 3],
                               velocity=velocity) for i in range(3) for j in range(3)]
    if any(velocity):
        case.extra_files["fluid/constant/dynamicMeshDict"] = mesh_motion("motionSolver solidBody; " + on(velocity))
    return case


def moved_on(demvof, velocity, *options):
    """Run with the mesh that moves, and the largest distance of a bead from where it would be on the mesh at rest, over its diameter."""
    still, moved = (channel(name, u).run(demvof, *options) for name, u in (("still", (0, 0, 0)), ("moved", velocity)))
    way = particle_states(moved.folder)["position"] - particle_states(still.folder)["position"] - 0.1 * numpy.array(velocity)
    way[:, :2] -= 4 * EDGE * numpy.round(way[:, :2] / (4 * EDGE))
    return moved, abs(way).max() / 6e-3


def apart_when_continued(demvof, velocity):
    case = channel("continued", velocity, end_time=0.03, history_interval=WINDOW)
    case_file = case.write()

    def go(out, *more):
        subprocess.run([demvof, "run", str(case_file), "--out", str(case.folder / out), *more], check=True, stdout=subprocess.DEVNULL)
        return Run(case.folder / out).history

    whole = go("whole", "--force")
    go("parts", "--force", "--set", "coupling.end_time=0.02")
    parts = go("parts", "--continue")
    return max(abs(parts[name] - whole[name]).max() / max(abs(whole[name]).max(), 1e-300) for name in ("kinetic_energy", "particle_kinetic_energy", "max_speed"))


def main():
    options = command_line()
    record = Record("periodic_mesh", "Meshes that move through a periodic grid",
                    "The fluid's mesh has cyclic ends and moves along the periodic directions, through the ends of the bulk grid and of the "
                    "particles' box, which stay.", "tests/Alltest -- -R 'pair.periodic_mesh$'")
    streams, tank = [], (0.5, 0.3, 0)
    for name, motion, zone, bound in (("to and fro", TO_AND_FRO, False, 1e-10), ("on by more than a period", on((2.2, 2.2, 0)), False, 1e-10),
                                      ("ends that bulge", TO_AND_FRO, True, 5e-10)):
        for held in (True, False):
            streams.append(stream(f"{name.replace(' ', '_')}_{held}", motion, held, zone).run(options.demvof))
            record.at_most(f"mesh {name}, beads {'held' if held else 'in the stream'}: error of the stream's speed", error_of_stream(streams[-1]), bound)
    streams.append(stream("points", on((2.2, 2.2, 0)), False, sections={"coupling": {"mapping": {"to_bulk": "cell_point"}}}).run(
        options.demvof, "--fluid-ranks", "2", "--particle-ranks", "2"))
    record.at_most("mesh on by more than a period, two ranks each, fluid told at points: error of the stream's speed",
                   error_of_stream(streams[-1]), 1e-10)
    moved, way = moved_on(options.demvof, tank)
    record.at_most("water and air moved on, beads: from where they are on the mesh at rest, over their diameter", way, 0.15)
    record.at_most("water and air moved on, stopped and continued: energies and largest speed against the run that did not stop",
                   apart_when_continued(options.demvof, tank), 2e-13)
    record.at_most("water and air moved on: exchange", moved.results["conservation"]["exchange"], 5e-14)
    for quantity in ("liquid_volume", "solid_volume"):
        record.at_most(f"all runs: {quantity.replace('_', ' ')}", max(run.results["conservation"][quantity] for run in [*streams, moved]), 1.5e-13)
    momentum_of_everything(record, 1.5e-13)
    raise SystemExit(record.write())


main()
