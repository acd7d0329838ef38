#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Plants the faults of faults.py and faults_of_runs.py in the sources, one at a time, and sees which of them the tests notice.

    plant.py BUILD [--only TEXT] [--out FILE]   builds what changed in the build folder, runs the fault's tests there
    plant.py --check                            every text stands exactly once in its file

Each file is put back before the next fault. A fault that does not compile says nothing and counts as stale. Exit
status: 0, or 1 when fewer than 90 % are noticed or a fault is stale. Takes a rebuild of a part of the tree and some
tests per fault: an hour or so in all.
"""
import argparse
import json
import pathlib
import subprocess
import sys

import faults
import faults_of_runs

ROOT = pathlib.Path(__file__).resolve().parents[2]
ENOUGH = 0.9


FAULTS = faults.FAULTS + faults_of_runs.FAULTS


def stale(chosen):
    def count(file, text):
        return (ROOT / file).read_text().count(text) if (ROOT / file).exists() else 0
    return [(file, text) for file, text, _, _ in chosen if count(file, text) != 1]


def run(*command):
    return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)


def tests_fail(build, tests):
    """True and the tests that fail, or False when all pass. Raises when none was run."""
    done = run("ctest", "--test-dir", str(build), "-R", tests, "--stop-on-failure", "--timeout", "300")
    if "No tests were found" in done.stdout:
        raise RuntimeError(f"no test matches {tests}")
    failed = [line.split()[2] for line in done.stdout.splitlines() if line.strip().endswith(")") and " - " in line
              and done.returncode]
    return done.returncode != 0, failed


def plant(build, fault):
    """What became of one fault."""
    file, text, faulty, tests = fault
    path = ROOT / file
    original = path.read_text()
    try:
        path.write_text(original.replace(text, faulty))
        targets = sorted({target for needed in tests.values() for target in needed})
        built = run("cmake", "--build", str(build), "-j2", "--target", *targets)
        if built.returncode != 0:
            return {"outcome": "does not compile", "said": built.stdout[-500:]}
        noticed, failed = tests_fail(build, "|".join(tests))
        return {"outcome": "noticed" if noticed else "missed", "by": failed}
    finally:
        path.write_text(original)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", nargs="?", type=pathlib.Path)
    parser.add_argument("--check", action="store_true")
    parser.add_argument("--only", default="", help="faults whose file or text holds this")
    parser.add_argument("--out", type=pathlib.Path, help="JSON file for the outcomes")
    options = parser.parse_args()
    chosen = [fault for fault in FAULTS if options.only in fault[0] or options.only in fault[1]]
    gone = stale(chosen)
    for file, text in gone:
        print(f"stale: {file} does not hold exactly once: {text}")
    if options.check:
        print(f"{len(FAULTS)} faults, {len(gone)} stale")
        return 1 if gone else 0
    if not options.build:
        parser.error("which build folder?")
    changed = run("git", "-C", str(ROOT), "status", "--porcelain", "--untracked-files=no").stdout
    if changed:
        sys.exit(f"commit or stash first, planting overwrites files:\n{changed}")
    outcomes = []
    for fault in chosen:
        if (fault[0], fault[1]) in gone:
            continue
        outcome = {"file": fault[0], "text": fault[1], "fault": fault[2], **plant(options.build, fault)}
        outcomes.append(outcome)
        print(f"{outcome['outcome']:<17} {fault[0]}: {fault[2] or 'without ' + fault[1]}", flush=True)
        if options.out:
            options.out.write_text(json.dumps(outcomes, indent=1) + "\n")
    noticed = sum(outcome["outcome"] == "noticed" for outcome in outcomes)
    planted = sum(outcome["outcome"] in ("noticed", "missed") for outcome in outcomes)
    print(f"{noticed} of {planted} faults noticed; {len(chosen) - planted} stale")
    return 0 if planted == len(chosen) and noticed >= ENOUGH * planted else 1


if __name__ == "__main__":
    sys.exit(main())
