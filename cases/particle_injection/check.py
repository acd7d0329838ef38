#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds a run to the level that the beads' volume gives: check.py [RUN]. Exit status: 0 inside, 1 outside, 2 no run.

  level = 0.3 m + n V_p / (0.1 m x 0.1 m),   n beads below the surface: 0.30982 m with all 1500 of 5 mm, 0.31005 m with
  3000 of 4 mm

The mean level counts the beads that are in the water. A run of the injection may end early; the column has to be in
the water.
"""
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, run_from_command_line  # noqa: E402

FLOOR, LEVEL = 0.1 * 0.1, 0.3  # m2, m
BEADS = {"in.injection": (1500, 5e-3), "in.column": (3000, 4e-3)}  # count, diameter in m


def main():
    run, checks = run_from_command_line(here), Checks()
    count, diameter = BEADS.get(pathlib.Path(run.setting("particles.script", "")).name, (0, 0))
    volume = math.pi / 6 * diameter**3
    checks.equal("status", run.status, "completed")
    checks.equal("beads lost", run.number("particles.lost"), 0)
    present = run.number("particles.final")
    if (run.last_time or 0) > 1.0:
        checks.equal("beads in the end", present, count)
        # Windows in which beads come are left out of this book: until 1 s these are all windows of the injection.
        checks.at_most("momentum of the beads, worst window", run.number("conservation.momentum"), 1e-10)
    checks.at_most("exchange, worst window", run.number("conservation.exchange"), 1e-12)
    checks.at_most("solid volume, bulk grid against beads, worst window", run.number("conservation.solid_volume"), 1e-12)
    checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-11)
    levels = run.history.get("mean_level", numpy.zeros(0))
    if len(levels) and present:
        expected = LEVEL + present * volume / FLOOR
        checks.at_most("mean level in the end, error", abs(float(levels[-1]) - expected), 1e-4, "m")
        checks.note("", f"{levels[-1]:.6f} m of {expected:.6f} m with {present} beads")
    else:
        checks.at_most("mean level in the end, error", None, 1e-4, "m")
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
