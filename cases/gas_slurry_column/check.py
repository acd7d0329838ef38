#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The floor carries everything, whatever stirs above it: check.py [RUN]. Exit status: 0 inside, 1 outside, 2 no run.

  pressure on the floor + walls' forces on the beads = weight of liquid, beads and gas + rate of their momentum
      means over the run, from rest; exact
  gas between two taps       = 1 - (dp/dz) / (density of the liquid there)    as a manometer measures it
beside Nicklin's and Collins's plane slugs, j/(1.2 j + 0.23 sqrt(g W)), which gas in so narrow a column may become
"""
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, run_from_command_line  # noqa: E402

WIDTH, DEPTH, HEIGHT = 0.096, 0.016, 0.384  # of the column, m
AIR = 1.2  # kg/m3
DIAMETER, DENSITY, COUNT, LIQUID, GRAVITY = 4e-3, 1200.0, 700, 1000.0, 9.81
GAS = 0.15 / 3  # superficial velocity, m/s: through the middle third of the floor
TAPS = 0.142 - 0.062  # distance, m
FROM = 0.8  # s, for the taps: the gas has come through


def mean(run, name, columns, begin=0.0):
    """Over time from then on, of the columns of the function object's table."""
    files = sorted((run.folder / "fluid" / "postProcessing" / name).glob("*/*"))
    if not files:
        return None
    table = numpy.concatenate([numpy.loadtxt(file, ndmin=2) for file in files])
    table = table[table[:, 0] >= begin]
    if len(table) < 2:
        return None
    steps = numpy.diff(table[:, 0])
    return [float((table[1:, column] * steps).sum() / steps.sum()) for column in columns]


def main():
    run, checks = run_from_command_line(here), Checks()
    checks.equal("status", run.status, "completed")
    checks.equal("beads lost", run.number("particles.lost"), 0)
    checks.at_most("exchange, worst window", run.number("conservation.exchange"), 1e-12)
    checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-5)
    if (run.last_time or 0) < 1.9:
        return checks.exit_code()  # a run that is meant to end early
    floor, sparger, taps = mean(run, "floor", [1]), mean(run, "sparger", [1]), mean(run, "taps", [1, 2], FROM)
    beads = COUNT * DENSITY * math.pi / 6 * DIAMETER**3
    volume = float(run.history["liquid_volume"].mean())
    air = AIR * (HEIGHT * WIDTH * DEPTH - volume - beads / DENSITY)
    weight = (LIQUID * volume + beads + air) * GRAVITY
    momentum = sum(run.history[f"{kind}_momentum_z"] for kind in ("fluid", "particle", "pending"))
    rest = (run.results["momentum"]["impulses"]["contacts"][2] - momentum[-1] + momentum[0]) / run.last_time
    # At the open top p_rgh is 0, and p with it that of air from the floor up.
    found = None if floor is None else ((2 * floor[0] + sparger[0]) / 3 + AIR * GRAVITY * HEIGHT) * WIDTH * DEPTH + rest
    checks.near("mean force of floor and walls, weight of everything", found, weight, 0.008, "N")
    if taps:
        gas = 1 - (taps[0] - taps[1]) / (TAPS * LIQUID * GRAVITY)
        slugs = GAS / (1.2 * GAS + 0.23 * math.sqrt(GRAVITY * WIDTH))
        checks.note("gas between the taps", f"{gas:.3f}; plane slugs: {slugs:.3f}")
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
