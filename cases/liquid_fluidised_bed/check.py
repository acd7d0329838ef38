#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the bed's expansion to Richardson and Zaki's: check.py [RUN]. Exit status: 0 inside, 1 outside, 2 no run.

  U = u_t eps^n                                    Richardson and Zaki (1954), periodic sides: no correction for walls
  (4.8 - n)/(n - 2.4) = 0.043 Ar^0.57              Khan and Richardson (1989)
  u_t: weight in water = drag of one sphere        C_d = (0.63 + 4.8 Re^-0.5)^2, Dalla Valle (1948): that of the case's
                                                   drag law; beside it Schiller and Naumann's (1933)
  eps = 1 - V_solid/(A H),  H = 2 (mean height of the beads - floor)
"""
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, run_from_command_line, schiller_naumann, terminal_velocity  # noqa: E402

DIAMETER, DENSITY, COUNT = 2e-3, 1500.0, 640  # of the beads, m and kg/m3
AREA, FLOOR = 0.0176**2, 0.0088  # m2, m
FLUID_DENSITY, VISCOSITY, GRAVITY = 1000.0, 1e-3, 9.81  # kg/m3, Pa s, m/s2
STREAM = ((0.08, 2, 3), (0.065, 5, 6), (0.05, 8, 9), (0.035, 11, 12))  # m/s, from and to when the bed's height counts, s
VOLUME = math.pi / 6 * DIAMETER**3


def dalla_valle(reynolds):
    return (0.63 + 4.8 / math.sqrt(reynolds)) ** 2


def void_fraction(velocity, drag_coefficient=dalla_valle):
    """Richardson and Zaki's."""
    archimedes = DIAMETER**3 * FLUID_DENSITY * (DENSITY - FLUID_DENSITY) * GRAVITY / VISCOSITY**2
    single = terminal_velocity(DIAMETER, DENSITY, FLUID_DENSITY, VISCOSITY, drag_coefficient)
    ratio = 0.043 * archimedes**0.57
    exponent = (4.8 + 2.4 * ratio) / (1 + ratio)
    return (velocity / single) ** (1 / exponent)


def main():
    run, checks = run_from_command_line(here), Checks()
    checks.equal("status", run.status, "completed")
    checks.equal("beads lost", run.number("particles.lost"), 0)
    checks.at_most("exchange, worst window", run.number("conservation.exchange"), 1e-12)
    heights = run.history.get("particle_potential_energy", numpy.zeros(0)) / (COUNT * DENSITY * VOLUME * GRAVITY)
    for velocity, begin, end in STREAM:
        if begin > (run.last_time or 0):
            break  # a run that is meant to end early
        counts = (run.times >= begin) & (run.times <= end)
        eps = 1 - COUNT * VOLUME / (AREA * 2 * (heights[counts] - FLOOR)) if counts.any() else numpy.zeros(0)
        checks.near(f"void fraction at {1e3 * velocity:.0f} mm/s", float(eps.mean()) if len(eps) else None,
                    void_fraction(velocity), 0.03)
        if len(eps):
            checks.note("", f"bed {1e3 * COUNT * VOLUME / AREA / (1 - eps.mean()):.1f} mm, by the law "
                            f"{1e3 * COUNT * VOLUME / AREA / (1 - void_fraction(velocity)):.1f} mm; void fraction from "
                            f"{eps.min():.3f} to {eps.max():.3f}, with Schiller and Naumann's sphere "
                            f"{void_fraction(velocity, schiller_naumann):.3f}")
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
