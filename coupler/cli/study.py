#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the runs of a study one after the other and reports error against run time.

study.py --demvof PROGRAM STUDY [--out DIR] [--only ROW]... [--no-runs]; see demvof study --help.
Exit status: 0 every row is done, 2 the study file is wrong, 3 a row failed or the study was interrupted.

Needs matplotlib and PyYAML.
"""
import argparse
import fcntl
import os
import pathlib
import signal
import sys

SYSTEM_PYTHON = "/usr/bin/python3"  # has the distribution's modules, whichever python3 comes first in PATH

try:
    from studying import result
    from studying.errors import errors, errors_in_time, statements
    from studying.plan import BadStudy, read_plan
    from studying.runs import Interrupted, Runs
except ImportError as error:
    if sys.executable != SYSTEM_PYTHON and os.access(SYSTEM_PYTHON, os.X_OK):
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])
    print(f"study: {error} (Debian: python3-matplotlib, python3-yaml)", file=sys.stderr)
    sys.exit(3)


def say(line):
    print(line, flush=True)


def stop(*_):
    """As Ctrl-C, also where a shell made the study deaf to that: in the background."""
    raise KeyboardInterrupt


def lock(out):
    """A file that no other study in this folder may have, and no run of one that was killed; waits for their end."""
    file = open(out / ".lock", "w", encoding="utf-8")
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        say(f"study: waiting, another study or its last run is at work in {out}")
        fcntl.flock(file, fcntl.LOCK_EX)
    return file


def write_results(plan, runs, out):
    """study.json and study.html as far as the study got; returns their rows and sentences."""
    finished = {row.name: runs.run(row) for row in plan.rows if runs.finished(row)}
    reference_run = finished.get(plan.reference.get("row"))
    rows = []
    for row in plan.rows:
        run, converged = finished.get(row.name), finished.get(row.converged_in_time)
        rows.append(runs.described(row, errors(run, plan, reference_run) if run else {},
                                   errors_in_time(run, plan, converged) if run and converged else {}))
    said = statements(rows, plan)
    result.write_json(out / "study.json", rows, plan, said)
    (out / "study.html").write_text(result.html(rows, plan, said), encoding="utf-8")
    return rows, said


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=pathlib.Path)
    parser.add_argument("--demvof", required=True)
    parser.add_argument("--out", type=pathlib.Path)
    parser.add_argument("--only", action="append", default=[])
    parser.add_argument("--no-runs", action="store_true")
    arguments = parser.parse_args()
    signal.signal(signal.SIGTERM, stop)
    try:
        plan = read_plan(arguments.study)
        unknown = set(arguments.only) - {row.name for row in plan.rows}
        if unknown:
            raise BadStudy(f"--only: there is no row {', '.join(sorted(unknown))}")
    except BadStudy as mistake:
        print(mistake, file=sys.stderr)
        return 2
    out = (arguments.out or plan.file.parent / f"run_{plan.file.stem}").resolve()
    out.mkdir(parents=True, exist_ok=True)
    runs = Runs(plan, out, arguments.demvof, say)
    interrupted = False
    try:
        if not arguments.no_runs:
            runs.lock = lock(out)
        for row in plan.rows:
            if not arguments.no_runs and (not arguments.only or row.name in arguments.only):
                runs.make(row)
                write_results(plan, runs, out)
    except (KeyboardInterrupt, Interrupted):
        interrupted = True
    rows, said = write_results(plan, runs, out)
    say("\n" + result.text(rows, plan.quantities, said))
    say(f"\nstudy: {out / 'study.html'}, {out / 'study.json'}")
    if interrupted:
        say("study: interrupted; the same command goes on where it was")
    return 3 if interrupted or any(row["status"] != "completed" for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())
