#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the beads at rest to Archimedes' depth: check.py [RUN]. Exit status: 0 inside, 1 outside, 2 no run.

  x^2 (3 - 2 x) = rho_p / rho,  x: depth of a bead's lowest point under the level, over its diameter
  level = (liquid + wet parts of the beads) / floor
"""
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, beads, run_from_command_line  # noqa: E402

DIAMETER, LIQUID, FLOOR = 8e-3, 1221.0, 0.256 * 0.016  # m, kg/m3, m2
DENSITY = numpy.array([300.0, 600.0, 900.0])[numpy.arange(16) % 3]  # by id, kg/m3
VOLUME = math.pi / 6 * DIAMETER**3


def wet_share(depth):
    """Of a sphere's volume; depth over its diameter."""
    depth = numpy.clip(depth, 0, 1)
    return depth * depth * (3 - 2 * depth)


def exact_depth(ratio):
    low, high = 0.0, 1.0
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if wet_share(middle) < ratio else (low, middle)
    return low


def depths(height, liquid):
    """Of the beads' lowest points under the level that liquid and beads make, over the diameter."""
    level = liquid / FLOOR
    for _ in range(30):
        level = (liquid + VOLUME * wet_share((level - height) / DIAMETER + 0.5).sum()) / FLOOR
    return (level - height) / DIAMETER + 0.5


def main():
    run, checks = run_from_command_line(here), Checks()
    checks.equal("status", run.status, "completed")
    checks.equal("beads lost", run.number("particles.lost"), 0)
    checks.equal("beads in the end", run.number("particles.final"), len(DENSITY))
    checks.at_most("exchange, worst window", run.number("conservation.exchange"), 1e-12)
    checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-11)
    energy = run.history.get("mechanical_energy", numpy.zeros(0))
    checks.at_most("mechanical energy above its start", float(energy.max() / energy[0] - 1) if len(energy) else None, 1e-3)
    if (run.last_time or 0) < 5:
        return checks.exit_code()  # a run that is meant to end early: nothing is at rest yet
    state = beads(run, run.last_time)
    height = state["position"][:, 2] if state else numpy.zeros(0)
    if len(height) != len(DENSITY):
        checks.at_most("depth at rest, error over diameter", None, 0.04)
        return checks.exit_code()
    found, expected = depths(height, float(run.history["liquid_volume"][-1])), [exact_depth(r) for r in DENSITY / LIQUID]
    for density in numpy.unique(DENSITY):
        these = DENSITY == density
        error = (found - expected)[these]
        checks.at_most(f"depth at rest, {density:.0f} kg/m3, worst error over d", float(abs(error).max()), 0.04)
        checks.note("", f"{found[these].min():.4f} to {found[these].max():.4f} d, exact {exact_depth(density / LIQUID):.4f} d")
    checks.at_most("fastest bead in the end", float(numpy.linalg.norm(state["velocity"], axis=1).max()), 0.01, "m/s")
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
