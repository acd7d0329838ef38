#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds a run of the dam break to its bounds: check.py [RUN]. Exit status: 0 inside, 1 outside, 2 no run.

With beads: conservation, energy and speed. Without (Allrun --clear-water): the front of Martin & Moyce.
"""
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, run_from_command_line  # noqa: E402
from reporting.run import read_reference  # noqa: E402

WIDTH = 0.05  # of the water column, m
GRAVITY = 9.81  # m/s2


def conservation(run, checks):
    checks.equal("beads lost", run.number("particles.lost"), 0)
    checks.at_most("solid volume, bulk grid against beads, worst window", run.number("conservation.solid_volume"), 1e-12)
    checks.at_most("exchange, worst window", run.number("conservation.exchange"), 1e-12)
    checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-11)


def energy(run, checks):
    values = run.history.get("mechanical_energy", numpy.array([]))
    gain = float(values.max() / values[0] - 1) if len(values) else None
    checks.at_most("mechanical energy above its start", gain, 1e-3)


def speed(run, checks):
    """Against the largest speed of the distribution's interFoam, without beads, on the same mesh."""
    speeds = run.history.get("max_speed", numpy.array([]))
    if not len(speeds):
        return checks.at_most("largest fluid speed", None, 0)
    row = int(speeds.argmax())
    place = ", ".join(f"{run.history[f'max_speed_{axis}'][row]:.4f}" for axis in "xyz")
    where = f"at t = {run.times[row]:.3f} s in ({place}) m"
    _, peaks = read_reference(here / "reference" / "clear_water_peak_speed.csv")
    same_mesh = peaks["fine_cells"] == run.number("cells.fine_max")
    if same_mesh.any():
        checks.at_most("largest fluid speed", float(speeds[row]), 1.5 * float(peaks["speed"][same_mesh][0]), "m/s")
        checks.note("", where)
    else:
        checks.note("largest fluid speed", f"{speeds[row]:.3g} m/s {where}")


def front(run, checks):
    """rms of Z/Z_measured - 1 over 0.84 <= T <= 3.33, with the time offset (at most 0.2) that fits best."""
    _, measured = read_reference(here / "reference" / "martin_moyce_1952_n2_front.csv")
    used = (measured["T"] >= 0.84) & (measured["T"] <= 3.33)
    dimensionless = run.times * math.sqrt(2 * GRAVITY / WIDTH)
    if not len(dimensionless) or dimensionless[-1] < 3.33 - 0.2:
        return checks.at_most("front against Martin & Moyce, rms", None, 0.1)

    def error(offset):
        z = numpy.interp(measured["T"][used] - offset, dimensionless, run.history["liquid_front"] / WIDTH)
        return float(numpy.sqrt(numpy.mean((z / measured["Z"][used] - 1) ** 2)))

    offset = min(numpy.linspace(-0.2, 0.2, 41), key=error)
    checks.at_most("front against Martin & Moyce, rms", error(offset), 0.1)
    checks.note("", f"measured time - simulated time: {offset:+.2f} in T; without offset {error(0):.3g}")


def main():
    run, checks = run_from_command_line(here), Checks()
    checks.equal("status", run.status, "completed")
    if run.number("particles.initial"):
        conservation(run, checks)
        energy(run, checks)
        speed(run, checks)
    else:
        checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-11)
        speed(run, checks)
        front(run, checks)
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
