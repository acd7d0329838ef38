#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Nothing may move under a still surface: check.py [RUN]. Exit status: 0 still, 1 not, 2 no run."""
import pathlib
import sys

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, run_from_command_line  # noqa: E402


def main():
    run, checks = run_from_command_line(here), Checks()
    checks.equal("status", run.status, "completed")
    checks.equal("beads lost", run.number("particles.lost"), 0)
    checks.at_least("fluid steps", run.number("steps.fluid"), 100)
    speeds = run.history.get("max_speed", [])
    checks.at_most("largest fluid speed of the run", float(max(speeds)) if len(speeds) else None, 1e-6, "m/s")
    checks.at_most("solid volume, bulk grid against beads, worst window", run.number("conservation.solid_volume"), 1e-12)
    checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-12)
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
