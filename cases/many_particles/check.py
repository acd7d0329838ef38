#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds a run of many_particles to its books: check.py [RUN]. Exit status: 0 inside, 1 outside, 2 no run.

The beads fall freely through air: where the mean bead is follows from gravity alone, within the drag of the air.
"""
import math
import pathlib
import re
import sys

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, run_from_command_line  # noqa: E402

GRAVITY = 9.81  # m/s2
DENSITY = 2600  # kg/m3


def main():
    run, checks = run_from_command_line(here), Checks()
    checks.equal("status", run.status, "completed")
    expected = int(re.search(r"in\.(\d+)", run.setting("particles.script")).group(1))
    checks.equal("particles", run.number("particles.final"), expected)
    checks.equal("beads lost", run.number("particles.lost"), 0)
    # Round-off of sums over half a million beads
    checks.at_most("solid volume, bulk grid against beads, worst window", run.number("conservation.solid_volume"), 1e-11)
    checks.at_most("exchange, worst window", run.number("conservation.exchange"), 1e-11)
    checks.at_most("momentum of the particles, worst window", run.number("conservation.momentum"), 1e-10)
    checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-11)
    diameter = 0.004 if expected <= 3000 else 0.004 * (3000 / expected)**(1 / 3)
    mass = expected * DENSITY * math.pi / 6 * diameter**3
    checks.near("momentum, of the free fall", run.number("quantities.particle_momentum_z"),
                -mass * GRAVITY * run.times[-1], 0.01, "kg m/s")
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
