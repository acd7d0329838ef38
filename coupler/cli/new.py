#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes a case from an interFoam case and a LIGGGHTS script.

new.py --demvof PROGRAM NAME --fluid CASE --particles SCRIPT; see demvof new --help.
Exit status: 0 `demvof check` passes on the new case, 2 it does not, or the input is wrong.

What the two inputs do not say in their text the programs are asked: `demvof check` runs the script and reads the fields.
"""
import argparse
import pathlib
import subprocess
import sys
import tempfile

from creating.case_text import case_text
from creating.fluid import copy_fluid, fluid_facts
from creating.numbers import Numbers, asked, choose
from creating.particles import copy_particles
from creating.mistake import Mistake


def check(demvof, case_file):
    """Exit code and what is said."""
    done = subprocess.run([demvof, "check", case_file], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                          check=False)
    return done.returncode, done.stdout


def make(folder, fluid_case, script, demvof):
    """Exit code of check on what was made."""
    folder.mkdir(parents=True)
    prepare = copy_fluid(fluid_case, folder / "fluid")
    script_name, changed = copy_particles(script, folder / "particles")
    for line in changed:
        print(f"{folder.name}/particles/{script_name}: {line}")
    case_file = folder / "case.yaml"
    with tempfile.TemporaryDirectory(prefix="demvof-new-") as scratch:
        fluid = fluid_facts(demvof, folder, prepare, pathlib.Path(scratch))
    numbers, code, said = choose(fluid, Numbers()), None, ""
    # With each answer the numbers are better known; the first ones are a guess at the size of a particle.
    for _ in range(4):
        case_file.write_text(case_text(folder.name, script_name, prepare, fluid, numbers), encoding="utf-8")
        code, said = check(demvof, case_file)
        better = choose(fluid, asked(said, numbers))
        if better == numbers:
            break
        numbers = better
    print(said, end="")
    if code == 0:
        print(f"{case_file} is written; what it proposes and why stands beside each key.")
    else:
        print(f"{case_file} is written; what stands in its way is said above (docs/howto_your_own_case.md). "
              "Cells and window are known once nothing does: put it right in the originals, and write the case anew.")
    return code


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("name", type=pathlib.Path)
    parser.add_argument("--fluid", type=pathlib.Path, required=True)
    parser.add_argument("--particles", type=pathlib.Path, required=True)
    parser.add_argument("--demvof", required=True)
    arguments = parser.parse_args()
    try:
        folder = arguments.name.resolve()
        if folder.exists():
            raise Mistake(f"{arguments.name}: is there already; give another name")
        if not (arguments.fluid / "system" / "controlDict").is_file():
            raise Mistake(f"--fluid: {arguments.fluid} is no OpenFOAM case: there is no system/controlDict in it")
        if not arguments.particles.is_file():
            raise Mistake(f"--particles: there is no file {arguments.particles}")
        return make(folder, arguments.fluid.resolve(), arguments.particles.resolve(), arguments.demvof)
    except Mistake as mistake:
        print(f"demvof new: {mistake}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
