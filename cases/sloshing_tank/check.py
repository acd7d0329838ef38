#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the ringing tank to its first mode: check.py [RUN]. Exit status: 0 inside, 1 outside, 2 no run.

  f = sqrt(g k tanh(k h))/(2 pi),  k = pi/L     of small waves in a tank (Lamb, Hydrodynamics, 1932)
  h   depth, of water and the beads in it
  f   of the run: from the times at which the momentum along x, of water and beads, goes through zero
"""
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, run_from_command_line  # noqa: E402

LENGTH, DEPTH, GRAVITY = 0.4, 0.1, 9.81  # m, m, m/s2
BEADS = 120
SHAKEN = 0.88  # s
FIRST_MODE = math.sqrt(GRAVITY * math.pi / LENGTH * math.tanh(math.pi * DEPTH / LENGTH)) / (2 * math.pi)  # 1/s


def zero_crossings(times, values):
    """Times, by lines between neighbours."""
    before = numpy.flatnonzero(values[:-1] * values[1:] < 0)
    return times[before] + (times[before + 1] - times[before]) * values[before] / (values[before] - values[before + 1])


def main():
    run, checks = run_from_command_line(here), Checks()
    with_beads = "particle_momentum_x" in run.history
    checks.equal("status", run.status, "completed")
    checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-10)
    if with_beads:
        checks.equal("beads lost", run.number("particles.lost"), 0)
        checks.equal("beads in the end", run.number("particles.final"), BEADS)
        checks.at_most("exchange, worst window", run.number("conservation.exchange"), 1e-12)
    if (run.last_time or 0) < 3:
        return checks.exit_code()  # a run that is meant to end early
    momentum = run.history["fluid_momentum_x"] + (run.history["particle_momentum_x"] if with_beads else 0)
    ringing = run.times > SHAKEN
    crossings = zero_crossings(run.times[ringing], momentum[ringing])
    half_period = float(numpy.polyfit(numpy.arange(len(crossings)), crossings, 1)[0])
    checks.note("half periods", len(crossings) - 1)
    checks.near("frequency of the first mode", 0.5 / half_period, FIRST_MODE, 0.02, "1/s")
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
