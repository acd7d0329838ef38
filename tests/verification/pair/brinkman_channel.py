# SPDX-License-Identifier: GPL-3.0-or-later
"""Slow flow between two walls through beads that fill the channel: friction at the walls against drag.

    eps mu u'' - C u + eps G = 0,    mean/core = 1 - tanh(b/delta)/(b/delta),    delta = sqrt(eps mu/C)    (Brinkman 1949)

b: half the channel's width, m; G: pressure drop per length, Pa/m; C = n beta: drag of the beads, kg/(m3 s);
core = eps G/C: velocity where no wall is near.

Usage: brinkman_channel.py DEMVOF"""
import math

import numpy
from box_case import BoxCase, Particle, Slip, Wall, command_line, momentum_of_everything, scratch
from box_fields import output_times, vector_field
from record import Record

HALF_WIDTH, DELTA, EPS, VISCOSITY, DENSITY = 5e-3, 1e-3, 0.6, 0.1, 1000.0
DIAMETER = DELTA * math.sqrt(18 * (1 - EPS) / EPS)  # Stokes: C = 18 mu (1 - eps)/d^2
EDGE = math.sqrt(8 * math.pi / 6 * DIAMETER**3 / (1 - EPS) / (2 * HALF_WIDTH))  # of a bulk cell with eight beads
GRADIENT = 3.0  # Pa/m: Re = 1e-3
CELLS, LENGTH = 40, 3  # fine cells across, bulk cells along


def main():
    options = command_line()
    record = Record(
        "brinkman_channel", "Walls beside a bed",
        "Very slow flow through beads that fill a channel of ten friction lengths, driven by pressure, on a fluid mesh "
        "across one bulk cell: the beads' drag and the friction at the walls give Brinkman's profile.",
        "tests/Alltest -- -R pair.brinkman_channel")
    sides = {"x-": Wall(), "x+": Wall(), "y-": Slip(), "y+": Slip()}
    for side, pressure in (("z-", GRADIENT * LENGTH * EDGE), ("z+", 0)):
        sides[side] = {"type": "patch", "U": "zeroGradient", "alpha.water": "zeroGradient",
                       "p_rgh": f"fixedValue; value uniform {pressure:.17g}"}
    window = DENSITY * DELTA**2 / VISCOSITY  # eps rho/C
    case = BoxCase(scratch("brinkman_channel"), (2 * HALF_WIDTH, EDGE, LENGTH * EDGE), (CELLS, 1, LENGTH), (1, 1, LENGTH),
                   16 * window, window, sides=sides, gravity=(0, 0, 0), liquid=(DENSITY, VISCOSITY / DENSITY),
                   tolerance=1e-15, relative_tolerance=0, longest_step=window / 20,
                   coupling={"averaging": {"kernel": "centre"}})
    for i in range(2):
        for j in range(2):
            for k in range(2 * LENGTH):
                place = (HALF_WIDTH * (i + 0.5), EDGE / 2 * (j + 0.5), EDGE / 2 * (k + 0.5))
                case.particles.append(Particle(place, DIAMETER, 2500, held=True))
    run = case.run(options.demvof)
    u = vector_field(run, output_times(run)[-1], "U", case.fine)[:, 0, 1, 2]
    mean = u.mean()
    stokes = 18 * VISCOSITY * (1 - EPS) / DIAMETER**2
    core = EPS * GRADIENT / (stokes * (1 + 0.15 * (DENSITY * mean * DIAMETER / VISCOSITY)**0.687))
    ratio = 1 - math.tanh(HALF_WIDTH / DELTA) * DELTA / HALF_WIDTH
    x = (numpy.arange(CELLS) + 0.5) / CELLS * 2 - 1
    exact = 1 - numpy.cosh(x * HALF_WIDTH / DELTA) / math.cosh(HALF_WIDTH / DELTA)
    record.note("mean over core", mean / core)
    record.at_most("mean over core, against Brinkman", abs(mean / core / ratio - 1), 0.005)
    record.at_most("largest error of the profile, over the core", abs(u / core - exact).max(), 0.01)
    record.curve("Velocity across the channel", "x / half width", "u / core", "measured", x, u / core)
    record.curve("Velocity across the channel", "x / half width", "u / core", "Brinkman", x, exact, style="k-")
    momentum_of_everything(record, 1e-13)
    raise SystemExit(record.write())


main()
