#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes report.html of one run, or of several runs side by side; also of runs that stopped early.

report.py RUN [RUN ...]: each RUN is the output folder of a run. The report is one self-contained file in the
first folder; with several runs results.csv beside it has one row per run, and a table of each is printed.
Says where the report is. --strip FILE: the first run's pictures side by side in one file, instead of a report.
Exit status: 0 done, 2 a folder is not that of a run, 3 the report could not be written.

Needs matplotlib; VTK's Python modules for the pictures of the surface, and three.js for the view in three dimensions
(left out, and said so, without them).
"""
import argparse
import os
import pathlib
import sys

SYSTEM_PYTHON = "/usr/bin/python3"  # has the distribution's modules, whichever python3 comes first in PATH

try:
    from reporting import figures, page, tables
    from reporting.run import NoRun, Run
except ImportError as error:
    if sys.executable != SYSTEM_PYTHON and os.access(SYSTEM_PYTHON, os.X_OK):
        os.execv(SYSTEM_PYTHON, [SYSTEM_PYTHON, *sys.argv])
    print(f"report: {error} (Debian: python3-matplotlib)", file=sys.stderr)
    sys.exit(3)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", type=pathlib.Path, metavar="RUN")
    parser.add_argument("--strip", type=pathlib.Path, metavar="FILE")
    arguments = parser.parse_args()
    folders = arguments.runs
    try:
        runs = [Run(folder) for folder in folders]
    except NoRun as error:
        print(f"report: {error}", file=sys.stderr)
        return 2
    report = folders[0] / "report.html"
    try:
        if arguments.strip:
            figures.strip(runs[0]).savefig(arguments.strip, dpi=130)
            return 0
        report.write_text(page.html(runs), encoding="utf-8")
        if len(runs) > 1:
            tables.write_csv(runs, folders[0] / "results.csv")
    except (OSError, RuntimeError) as error:
        print(f"report: {error}", file=sys.stderr)
        return 3
    if len(runs) > 1:  # of one run, `demvof run` has printed it
        print(tables.text(runs))
    print(f"report: {report.resolve()}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
