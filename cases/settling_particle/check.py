#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Holds the bead's terminal velocity to Schiller & Naumann's: check.py [RUN]. Exit status: 0 inside, 1 outside,
2 no run.

  beta v = (rho_p - rho) V g,  beta = (pi d^2 / 8) C_d rho v,  C_d = 24 (1 + 0.15 Re^0.687) / Re,  Re = rho v d / mu
"""
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, run_from_command_line, terminal_velocity  # noqa: E402

DIAMETER, DENSITY = 2.7e-3, 2500.0  # of the bead, m and kg/m3
FLUID_DENSITY, VISCOSITY = 1000.0, 1e-3  # kg/m3, Pa s
VOLUME = math.pi / 6 * DIAMETER**3


def main():
    run, checks = run_from_command_line(here), Checks()
    checks.equal("status", run.status, "completed")
    checks.equal("beads lost", run.number("particles.lost"), 0)
    speeds = numpy.sqrt(2 * run.history.get("particle_kinetic_energy", numpy.zeros(0)) / (DENSITY * VOLUME))
    lower, upper, cells = (run.setting(f"bulk_grid.{key}") for key in ("lower", "upper", "cells"))
    spacing = (upper[2] - lower[2]) / cells[2] / DIAMETER if cells else 0
    late = speeds[run.times >= 0.6 * run.times[-1]] if len(speeds) else speeds
    speed = float(late.mean()) if len(late) else None
    checks.near(f"terminal velocity, bulk spacing {spacing:.1f} d", speed,
                terminal_velocity(DIAMETER, DENSITY, FLUID_DENSITY, VISCOSITY), 0.01, "m/s")
    if len(late):
        checks.note("", f"{late.min():.4f} to {late.max():.4f} m/s from t = {0.6 * run.times[-1]:.2f} s on")
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
