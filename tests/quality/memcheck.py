#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Real pairs under valgrind's memcheck: memcheck.py BIN FOLDER [--helgrind] [SCENE...]

Reads and writes of memory that is not there or was never set, and memory that nobody can give back any more. Errors
count when the innermost frame is compiled into foam_side or dem_side; those of the solvers' and of MPI's own libraries
are counted and named. A minute or some for each scene; no build of its own. With --helgrind races between their threads instead.
"""
import collections
import pathlib
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
TOOL = ["--tool=helgrind"] if "--helgrind" in sys.argv else ["--leak-check=full", "--show-leak-kinds=definite"]
BIN, FOLDER, *ONLY = [argument for argument in sys.argv[1:] if argument != "--helgrind"]
BIN, FOLDER = pathlib.Path(BIN).resolve(), pathlib.Path(FOLDER).resolve()
sys.argv[1:] = []
sys.path[:0] = [str(ROOT / "tests" / "verification" / "pair"), str(ROOT / "tests" / "support")]
from box_case import BoxCase, Open, Particle, SIDES, Wall  # noqa: E402
from moving_walls import mesh_motion, moving_wall, walls_of_the_script  # noqa: E402

ALL_FORCES = [{"drag": "beetstra"}, "pressure_gradient", "viscous_stress", {"added_mass": 0.5}, {"lift": "saffman_mei"},
              {"spin_lift": "rubinow_keller"}, "torque", "history", "capillary", "lubrication"]
UPPER = (0.04, 0.02, 0.04)


def beads(**keys):
    return [Particle((0.01 + 0.02 * (i % 2), 0.006 + 0.008 * (i // 2 % 2), 0.015 + 0.0021 * (i // 4)), 2e-3, 2500,
                     velocity=(0, 0, -0.3), **keys) for i in range(12)]


def case(name, windows=3, **keys):
    keys = {"fine": (8, 4, 8), "sides": {side: Open() if side == "z+" else Wall() for side in SIDES}, "particles": beads(), **keys}
    return BoxCase(FOLDER / name, UPPER, keys.pop("fine"), (8, 4, 8), 1e-3 * windows, window=1e-3, level=0.0174, gravity=(5, 0, -8.4),
                   contacts=True, dem_step=5e-5, output_interval=1e-3, **keys)


def moving(name):
    made = case(name, particles=beads(), sides={side: Open() if side == "z+" else moving_wall() for side in SIDES},
                sections={"bulk_grid": {"lower": 3 * [-0.01], "upper": [0.05, 0.03, 0.05], "cells": [12, 8, 12]}}, margin=0.02)
    made.contacts = False
    walls_of_the_script(made, (0, 0, 0), UPPER, "wiggle amplitude 0.002 0. 0. period 0.2")
    made.extra_files["fluid/constant/dynamicMeshDict"] = mesh_motion(
        "motionSolver solidBody; solidBodyMotionFunction oscillatingLinearMotion;\n"
        "oscillatingLinearMotionCoeffs { amplitude (0.002 0 0); omega 31.4159265358979; }")
    return made


# Name: the case, options of both programs, ranks of foam_side and dem_side
SCENES = {
    "all_forces": (lambda name: case(name, forces=ALL_FORCES, sigma=0.07), (), (1, 1)),
    "two_ranks": (lambda name: case(name, forces=ALL_FORCES, sections={"fluid": {"ranks": 2}, "particles": {"ranks": 2}}), (), (2, 2)),
    "own_windows": (lambda name: case(name, coupling={"window": {"tolerance": 0.01, "shortest": 2.5e-4, "longest": 1e-3}}), (), (1, 1)),
    "concurrent": (lambda name: case(name, coupling={"schedule": "concurrent", "averaging": {"kernel": "diffusion"}}), (), (1, 1)),
    "refined": (lambda name: case(name, sections={"fluid": {"refinement": {"levels": 1}}}), (), (1, 1)),
    "replaced": (lambda name: case(name, fine=(32, 16, 32), coupling={"phase_interchange": "replacement"},
                                   sections={"fluid": {"refinement": {"levels": 1, "particles": True}}}), (), (1, 1)),
    "moving": (moving, (), (1, 1)),
}


def run(command, **options):
    return subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          errors="replace", check=False, **options)


def pair(case_file, out, ranks, options):
    """Both programs under valgrind; what they printed, and whether they ended well."""
    valgrind = ["valgrind", *TOOL, "--num-callers=30", "--xml=yes",
                f"--xml-file={out}/memcheck.%p.xml"]
    arguments = [case_file, "--out", out, "--set", "coupling.time_out=7200", *options]
    done = run(["mpirun", "--oversubscribe", "-np", sum(ranks), BIN / "demvof_pair", "-np", ranks[0], *valgrind, BIN / "foam_side",
                *arguments, "+", "-np", ranks[1], *valgrind, BIN / "dem_side", *arguments])
    return done.returncode == 0, done.stdout


def frames(error):
    found = [(frame.findtext("obj", "?"), frame.findtext("fn", "?")) for frame in error.find("stack").findall("frame")]
    allocators = ("vgpreload", "libc.so", "libstdc++", "ld-linux")
    return [(obj, function) for obj, function in found if not any(name in obj for name in allocators)] or found


def errors(out):
    """Ours, with their frames, and how many of whose libraries."""
    ours, others = [], collections.Counter()
    for file in sorted(pathlib.Path(out).glob("memcheck.*.xml")):
        for error in ElementTree.parse(file).getroot().findall("error"):
            stack = frames(error)
            program = pathlib.Path(stack[0][0]).name
            if error.findtext("kind") == "Misc":  # helgrind's advice, e.g. to signal with the lock held
                continue
            if program not in ("foam_side", "dem_side"):
                others[f"{error.findtext('kind')} in {program}"] += 1
            else:
                what = error.findtext("what") or error.find("xwhat").findtext("text")
                ours.append(f"{program}: {what}\n    " + "\n    ".join(function for _, function in stack[:12]))
    return ours, others


def main():
    if not shutil.which("valgrind"):
        raise SystemExit("memcheck.py needs valgrind: install the package of that name")
    wrong = False
    for name in ONLY or SCENES:
        make, options, ranks = SCENES[name]
        case_file, out = make(name).write(), FOLDER / name / "run"
        prepared = run([BIN / "demvof", "prepare", case_file, "--out", out, "--force"])
        good, text = pair(case_file, out, ranks, options) if prepared.returncode == 0 else (False, prepared.stdout)
        if good and name == "all_forces":  # and the same, continued
            good, text = pair(case_file, out, ranks, ("--continue", "--set", "coupling.end_time=0.004"))
        ours, others = errors(out)
        print(f"{name}: {'' if good else 'did not end well, '}{len(ours)} errors; of others: {dict(others)}", flush=True)
        print("\n".join(ours if good else [*ours, text]), end="\n" if ours or not good else "")
        wrong |= not good or bool(ours)
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
