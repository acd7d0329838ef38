#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mass flow, level and a sinking bead: check.py [RUN]. Exit status: 0 inside, 1 outside, 2 no run.

  flow     1.03 rho_b sqrt(g) L (B - 1.4 d)^1.5      slot B x L, Beverloo's law for slots (Brown and Richards 1970;
                                                    Nedderman 1992); rho_b: bulk density of the beads over the slot
  level    rise = volume of the beads in the water / floor, once no air is left among them
  sinking  beta v = (rho_p - rho) V g                Schiller and Naumann (1933)
"""
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent))

from checks import Checks, beads, run_from_command_line, terminal_velocity  # noqa: E402

DIAMETER, SCOUT, DENSITY = 4e-3, 2e-3, 2500.0  # of the beads; of the one that starts in the water: 2 mm
WIDTH, LENGTH, FLOOR, LEVEL = 0.096, 0.016, 0.36, 0.16  # of the tank, of the hopper's floor and the water, m
SLOT, GRAVITY = 0.02, 9.81
VOLUME = math.pi / 6 * DIAMETER**3
FROM, TO = 0.1, 0.3  # when the flow is measured, s: begun, and the hopper still full over the slot


def bulk_density(filling):
    """From 5 to 25 mm over its floor, kg/m3."""
    low, high = FLOOR + 0.005, FLOOR + 0.025
    return DENSITY * (volume_below(filling, high) - volume_below(filling, low)) / (WIDTH * LENGTH * (high - low))


def volume_below(state, level):
    """Of the beads, under that level, m3."""
    radius = state["radius"]
    h = numpy.clip(level - (state["position"][:, 2] - radius), 0, 2 * radius)
    return float((math.pi * h**2 * (radius - h / 3)).sum())


def main():
    run, checks = run_from_command_line(here), Checks()
    checks.equal("status", run.status, "completed")
    checks.equal("beads lost", run.number("particles.lost"), 0)
    checks.at_most("exchange, worst window", run.number("conservation.exchange"), 1e-12)
    checks.at_most("liquid volume, drift", run.number("conservation.liquid_volume"), 1e-11)
    end = run.last_time or 0
    start = beads(run, 0.0)
    if start:
        hopper = start["radius"] > 0.75 * SCOUT
    if end >= 0.2:
        state = beads(run, 0.2)
        speed = -float(state["velocity"][~hopper, 2][0]) if state and start else None
        checks.near("bead of 2 mm in water at 0.2 s, terminal velocity", speed,
                    terminal_velocity(SCOUT, DENSITY, 1000.0, 1e-3), 0.03, "m/s")
    if end >= TO:
        counts = [int((state["position"][hopper, 2] < FLOOR).sum()) for state in (beads(run, FROM), beads(run, TO)) if state]
        flow = (counts[1] - counts[0]) * VOLUME * DENSITY / (TO - FROM) if len(counts) == 2 else None
        bulk = bulk_density({name: start[name][hopper] for name in ("position", "radius")})
        law = 1.03 * bulk * math.sqrt(GRAVITY) * LENGTH * (SLOT - 1.4 * DIAMETER) ** 1.5
        checks.near("mass flow from the hopper, Beverloo", flow, law, 0.3, "kg/s")
        checks.note("", f"bulk density {bulk:.0f} kg/m3; {counts} beads below the floor at {FROM} and {TO} s")
    state = beads(run, end)
    if state:
        found = float(run.history["mean_level"][-1])
        expected = LEVEL + volume_below(state, found) / (WIDTH * LENGTH)
        checks.near("rise of the level, volume of the beads in the water", found - LEVEL, expected - LEVEL, 0.08, "m")
        checks.note("", f"{int((state['position'][:, 2] < found).sum())} beads under the level; air that they take along makes "
                        "the rise smaller until it has come up")
    return checks.exit_code()


if __name__ == "__main__":
    sys.exit(main())
