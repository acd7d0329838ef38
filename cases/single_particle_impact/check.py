#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds a run to what is known of it: check.py [RUN]. Exit status: 0 inside, 1 outside, 2 no run.

Falling: the bead's fall against one with the drag of Schiller & Naumann in air at rest, integrated here, and by how much
it has raised the level in the end (V_p over the floor). Both variants: the books.
"""
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, run_from_command_line  # noqa: E402

DIAMETER, DENSITY, FLOOR = 4e-3, 2000.0, 0.05**2  # m, kg/m3, m2
START, LEVEL = 0.14, 0.051  # centre of the bead and water, m
IN_AIR = LEVEL + 0.02       # all of its kernel is in air, m
AIR, VISCOSITY, GRAVITY = 1.184, 1.849e-5, 9.81  # kg/m3, Pa s, m/s2
VOLUME = math.pi / 6 * DIAMETER**3
MASS = DENSITY * VOLUME


def fall(end, step=1e-5):
    """Time and speed at which the bead's centre is at the height `end`, s and m/s."""
    time, height, speed = 0.0, START, 0.0
    while height > end:
        reynolds = AIR * speed * DIAMETER / VISCOSITY
        beta = 3 * math.pi * VISCOSITY * DIAMETER * (1 + 0.15 * reynolds**0.687)  # Re stays below 1000
        speed += step * ((1 - AIR / DENSITY) * GRAVITY - beta * speed / MASS)
        height -= step * speed
        time += step
    return time, speed


def fall_of(run, end):
    """The same of the run, from the bead's energies; None if it did not get there."""
    heights = run.history.get("particle_potential_energy", numpy.zeros(0)) / (MASS * GRAVITY)
    if not len(heights) or heights.min() > end:
        return None, None
    row = int(numpy.argmax(heights <= end))
    share = (heights[row - 1] - end) / (heights[row - 1] - heights[row])
    speeds = numpy.sqrt(2 * run.history["particle_kinetic_energy"] / MASS)
    return tuple(float(values[row - 1] + share * (values[row] - values[row - 1])) for values in (run.times, speeds))


def main():
    run, checks = run_from_command_line(here), Checks()
    checks.equal("status", run.status, "completed")
    checks.equal("beads lost", run.number("particles.lost"), 0)
    checks.at_most("exchange, worst window", run.number("conservation.exchange"), 1e-12)
    checks.at_most("momentum of the bead, worst window", run.number("conservation.momentum"), 1e-12)
    checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-11)
    if "falling" in run.setting("particles.script", ""):
        (time, speed), (found_time, found_speed) = fall(IN_AIR), fall_of(run, IN_AIR)
        checks.near("0.02 m above the water: time", found_time, time, 0.005, "s")
        checks.near("0.02 m above the water: speed of the bead", found_speed, speed, 0.01, "m/s")
        (time, speed), (found_time, found_speed) = fall(LEVEL + DIAMETER / 2), fall_of(run, LEVEL + DIAMETER / 2)
        checks.near("bead touches the water: time", found_time, time, 0.005, "s")
        if found_speed:
            checks.note("", f"{found_speed:.4f} m/s then; {speed:.4f} m/s if it felt only air until then")
        levels = run.history.get("mean_level", numpy.zeros(0))
        rise = float(levels[-1] - levels[0]) if len(levels) else None
        checks.near("rise of the mean level", rise, VOLUME / FLOOR, 0.01, "m")
    elif run.setting("coupling.phase_interchange") == "replacement":
        checks.at_least("beads that became liquid", run.number("replacement.became_liquid"), 1)
        checks.at_most("change of the liquid against the bead's volume", run.number("replacement.volume_error"), 1e-10)
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
