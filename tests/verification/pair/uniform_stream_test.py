# SPDX-License-Identifier: GPL-3.0-or-later
"""A sphere let go in a uniform stream: v(t) of the real pair against the exact solution of

    (m + C_m rho V) dv/dt = beta(|u - v|) (u - v)        beta of Schiller and Naumann

for windows from 0.01 to 1000 relaxation times tau = (m + C_m rho V)/beta(u). Two spheres: a heavy one, and one of a
hundredth of the water's density that moves mostly its added mass. Ten DEM steps per window, so that what is first order
in the DEM step (beta of its start, and the first half step, in which no fluid acts yet) falls with the window.

The box is periodic along the stream with slip walls around it, 125 000 sphere volumes of water: the stream slows down
by less than 1e-5. The sphere's own bulk cell holds 1000 d^3 of water; what it takes from there is part of the error. Porosity is left out
(scene.dilute_limit): the volume that the sphere displaces would make the water around it faster by 2e-5 of the stream.
Usage: uniform_stream_test.py DEMVOF [--long]"""
import math
import sys

import numpy

from box_case import BoxCase, Cyclic, Particle, Slip, momentum_of_everything, scratch
from record import Record

DEMVOF, LONG = sys.argv[1], "--long" in sys.argv
SPEED, DIAMETER, DENSITY, VISCOSITY = 0.05, 1e-3, 1000.0, 1e-3  # m/s, m, kg/m3, Pa s; Re = 50
VOLUME = math.pi / 6 * DIAMETER**3
SPHERES = {"heavy, 2500 kg/m3": (2500.0, 0.0), "light, 10 kg/m3, added mass 0.5": (10.0, 0.5)}


def drag_factor(slip):
    reynolds = DENSITY * abs(slip) * DIAMETER / VISCOSITY
    return 3 * math.pi * VISCOSITY * DIAMETER * (1 + 0.15 * reynolds**0.687)


def exact(times, inertia, tau):
    """v at ascending times, m/s: Runge-Kutta of fourth order, 2000 steps per tau (error below 1e-12); after 100 tau
    the sphere goes with the stream to the last digit."""
    def slope(v):
        return drag_factor(SPEED - v) * (SPEED - v) / inertia
    values, v, t = [], 0.0, 0.0
    for time in times:
        if time > 100 * tau:
            values.append(SPEED)
            continue
        steps = max(1, math.ceil((time - t) / tau * 2000))
        h = (time - t) / steps
        for _ in range(steps):
            a = slope(v)
            b = slope(v + h / 2 * a)
            c = slope(v + h / 2 * b)
            v += h / 6 * (a + 2 * b + 2 * c + slope(v + h * c))
        t = time
        values.append(v)
    return numpy.array(values)


def velocities(name, density, added_mass, tau, ratio):
    """Times and velocities along the stream at the end of each window."""
    window = ratio * tau
    case = BoxCase(scratch(f"uniform_stream_{name.split(',')[0]}_{ratio:g}"), upper=(0.05, 0.05, 0.05),
                   fine=(10, 10, 10), bulk=(5, 5, 5), end_time=max(round(2 / ratio), 4) * window, window=window)
    case.sides = {side: Cyclic() if side[0] == "x" else Slip() for side in case.sides}
    case.sections["scene"] = {"dilute_limit": 0.01}
    case.gravity, case.velocity = (0, 0, 0), (SPEED, 0, 0)
    case.dem_step = window / max(10, math.ceil(window * SPEED / 0.01))  # not through the box in one step
    case.particles = [Particle((0.025, 0.025, 0.025), DIAMETER, density)]
    if added_mass:
        case.forces = case.forces + [{"added_mass": added_mass}]
    run = case.run(DEMVOF)
    energy = numpy.array(run.history["particle_kinetic_energy"])
    conservation = run.results["conservation"]
    return (numpy.array(run.history["time"]), numpy.sqrt(2 * energy / (density * VOLUME)),
            max(conservation["exchange"], conservation["momentum"]))


def main():
    record = Record("uniform_stream", "A sphere let go in a uniform stream",
                    "Velocity of one sphere in a uniform stream, periodic box, real pair, against the exact solution of "
                    "its equation of motion (to 1e-12), for windows of 0.01 to 1000 relaxation times; a heavy sphere, and "
                    "a light one whose added mass is fifty times its own.",
                    "tests/Alltest --verification -- -R pair.uniform_stream")
    small = [0.01, 0.02, 0.05, 0.1, 0.2, 0.5] if LONG else [0.05, 0.1]
    large = [1, 10, 100, 1000] if LONG else [100]
    for name, (density, added_mass) in SPHERES.items():
        inertia = (density + added_mass * DENSITY) * VOLUME
        tau = inertia / drag_factor(SPEED)
        errors, excess, books = [], 0.0, 0.0
        for ratio in small + large:
            times, v, book = velocities(name, density, added_mass, tau, ratio)
            excess, books = max(excess, v.max() / SPEED - 1), max(books, book)
            right = exact(times, inertia, tau)
            if ratio in small:
                at_tau = numpy.argmin(abs(times - tau))
                errors.append(abs(v[at_tau] / right[at_tau] - 1))
            else:
                record.at_most(f"{name}: |v/u - 1| after 4 windows of {ratio} tau", abs(v[-1] / right[-1] - 1), 0.02 if LONG else 1.4e-4)
            if ratio in (0.05, 0.5, 10):
                record.curve(f"velocity, {name}", "t / tau", "v / u", f"window {ratio} tau", times / tau, v / SPEED)
                if ratio == 0.05:
                    record.curve(f"velocity, {name}", "t / tau", "v / u", "exact", times / tau, right / SPEED,
                                 style="k-")
        order = math.log(errors[-1] / errors[small.index(0.05)]) / math.log(small[-1] / 0.05)
        record.at_most(f"{name}: error at tau, window 0.05 tau", errors[small.index(0.05)], 0.01 if LONG else 1.4e-3)
        if LONG:
            record.note(f"{name}: error at tau, window 0.01 tau", errors[0])
        record.at_least(f"{name}: order in the window, 0.05 to {small[-1]} tau", order, 0.9)
        record.at_most(f"{name}: overshoot, any window", excess, 1e-6,
                       loose="none is measured: the velocity comes from below; 1e-6 is round-off of the output's digits")
        record.at_most(f"{name}: exchange and momentum books", books, 1e-10 if LONG else 7.8e-14)
        record.curve("error at tau against the window", "window / tau", "error, -", name, small, errors, "xy")
    momentum_of_everything(record, 1e-8 if LONG else 5e-13)
    sys.exit(record.write())


main()
