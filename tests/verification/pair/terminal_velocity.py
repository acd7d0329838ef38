#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Verification row terminal_velocity: single spheres that settle in a wide box, against the drag law's own terminal
velocity, with and without the correction for the particle's own wake.

    terminal_velocity.py <demvof> [--long]
"""
import math
import sys

from box_case import BoxCase, Particle, Slip, Wall, scratch
from record import Record

GRAVITY = 9.81
WATER, AIR = (1000, 1e-6), (1.2, 1.5e-5)  # density, kg/m3; kinematic viscosity, m2/s
WIDE = {"across": 20, "ends": 12}  # bulk cells: slow flow reaches far
EXCHANGE_ERRORS = []  # of each run: what one side gave and the other did not receive, relative


def drag_factor(diameter, fluid, speed):
    """Schiller and Naumann 1935, kg/s."""
    density, nu = fluid
    reynolds = speed * diameter / nu
    if reynolds < 1000:
        return 3 * math.pi * density * nu * diameter * (1 + 0.15 * reynolds**0.687)
    return math.pi / 8 * 0.44 * density * speed * diameter**2


def bisect(function, low, high):
    """Where a rising function is zero."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return low


class Sphere:
    """Sphere of a density that reaches the given Reynolds number in the fluid."""

    def __init__(self, name, fluid, density, reynolds):
        self.name, self.fluid, self.density, self.reynolds = name, fluid, density, reynolds
        rho, nu = fluid

        def excess_weight(d):
            speed = reynolds * nu / d
            return math.pi / 6 * d**3 * (density - rho) * GRAVITY - drag_factor(d, fluid, speed) * speed

        self.diameter = bisect(excess_weight, 1e-7, 1)
        self.speed = reynolds * nu / self.diameter
        self.mass = density * math.pi / 6 * self.diameter**3

    def relaxation_length(self):
        """Way over which a difference from the terminal velocity falls to 1/e, at most, in diameters."""
        return self.mass / drag_factor(self.diameter, self.fluid, self.speed) * self.speed / self.diameter


SPHERES = [Sphere("glass in water, Re = 0.1", WATER, 2500, 0.1),
           Sphere("hollow glass in air, Re = 1", AIR, 200, 1),
           Sphere("glass in water, Re = 10", WATER, 2500, 10),
           Sphere("foam in air, Re = 100", AIR, 20, 100),
           Sphere("foam in air, Re = 900", AIR, 20, 900),
           Sphere("glass in water, Re = 4000", WATER, 2500, 4000)]


def settle(demvof, sphere, spacing, own_wake, across=12, refine=1, kernel="gaussian", fall=None,
           side=Slip, courant=0.2, ends=5, sections=None, law="schiller_naumann"):
    """Way fallen, in diameters, and speed over the exact one at each window. spacing: of the bulk grid, fall: in
    diameters; across, refine: bulk cells and fine cells in one of them; courant: bulk cells fallen per window."""
    h = spacing * sphere.diameter
    fall = max(8 * h, 5 * sphere.relaxation_length() * sphere.diameter) if fall is None else fall * sphere.diameter
    along = math.ceil(fall / h) + 2 * ends
    window = courant * h / sphere.speed
    windows = math.ceil(fall / sphere.speed / window)
    case = BoxCase(scratch("terminal_velocity"), upper=(across * h, across * h, along * h),
                   fine=(refine * across, refine * across, refine * along), bulk=(across, across, along),
                   end_time=windows * window, window=window, liquid=sphere.fluid, tolerance=1e-8,
                   forces=[{"drag": law}, "pressure_gradient"], dem_step=window / 4,
                   coupling={"averaging": {"kernel": kernel}}, sections=sections or {})
    if own_wake:
        case.forces.append({"own_wake": "oseen"})
    for name in case.sides:
        case.sides[name] = side()
    # Not on a symmetry plane of the grid; the start is slower than the end.
    case.particles = [Particle((0.5 * across * h + 0.13 * h, 0.5 * across * h - 0.21 * h, (along - ends) * h),
                               sphere.diameter, sphere.density, velocity=(0, 0, -0.9 * sphere.speed))]
    case.script_tail = f"neighbor {h:.17g} bin\n"  # one particle: no need for bins of its own size
    run = case.run(demvof)
    EXCHANGE_ERRORS.append(run.number("conservation.exchange"))
    energy = run.history["particle_kinetic_energy"]
    ratio = [math.sqrt(2 * e / sphere.mass) / sphere.speed for e in energy]
    return [courant * spacing * i for i in range(len(ratio))], ratio


def main():
    demvof, long = sys.argv[1], "--long" in sys.argv
    record = Record(
        "terminal_velocity", "Terminal velocity of single spheres",
        "One sphere settles from 0.9 of its terminal velocity in a box of fluid at rest, through the real pair; the "
        "velocity it ends with is compared with the one at which the drag law balances its weight. A sphere alone does not see its own volume in the void fraction. Six spheres from "
        "Re = 0.1 to 4000 in water and air at a bulk spacing of 8 diameters with own_wake: oseen; the error against "
        "the bulk spacing with and without that correction; the same for the other kernels. The box has slip walls and "
        "is at least 96 diameters wide at the spacing of 8, 160 for Re = 0.1 in the long test, and 60 for the curves "
        "at Re = 1: there the fluid that flows back beside the wake, 11 nu d / (U L^2) of the velocity in a box of "
        "width L, is 0.3 %. A box of 256 diameters and no-slip walls must change little.",
        "tests/Alltest --verification -- -R pair.terminal_velocity")
    at_spacing_of_eight(demvof, record, SPHERES if long else [SPHERES[0], SPHERES[5]], long)
    own_volume(demvof, record)
    if long:
        curves(demvof, record)
        box_and_mesh(demvof, record)
    record.at_most("momentum exchanged: relative error, worst of all runs", max(EXCHANGE_ERRORS), 9e-14 if long else 1.8e-14)
    sys.exit(record.write())


def at_spacing_of_eight(demvof, record, spheres, wide):
    for sphere in spheres:
        box = WIDE if wide and sphere.reynolds < 1 else {}
        way, ratio = settle(demvof, sphere, 8, True, **box)
        record.at_most(f"{sphere.name}: error of the terminal velocity", abs(ratio[-1] - 1), 0.0045)
        record.at_most(f"{sphere.name}: change over the last fifth of the way",
                       abs(ratio[-1] - ratio[int(0.8 * len(ratio))]), 0.002 if wide else 7e-4)
        record.curve("approach to the terminal velocity, bulk spacing 8 d", "way / d", "velocity / exact",
                     sphere.name, way[1:], ratio[1:], "x", "-")
        uncorrected = settle(demvof, sphere, 8, False, **box)[1][-1] - 1
        record.note(f"{sphere.name}: velocity / exact - 1 without correction", uncorrected)
        if sphere.reynolds < 1:  # the test must see what the correction does
            record.at_least(f"{sphere.name}: too fast without correction", uncorrected, 0.03)


def own_volume(demvof, record):
    """A law that knows the void fraction is not given the sphere's own volume: alone it falls as with the law for one
    sphere, which Gidaspow's is at a void fraction of 1."""
    speeds = [settle(demvof, SPHERES[5], 2, False, fall=20, law=law)[1][-1] for law in ("gidaspow", "schiller_naumann")]
    record.at_most(f"{SPHERES[5].name}, spacing 2 d: drag law that knows eps against one that does not, velocity",
                   abs(speeds[0] / speeds[1] - 1), 1e-3)


def curves(demvof, record):
    def error(sphere, spacing, own_wake, **options):
        across = max(12, math.ceil(60 / spacing) if sphere.reynolds < 10 else 0)
        return settle(demvof, sphere, spacing, own_wake, across=across, fall=max(20, 8 * spacing), **options)[1][-1] - 1

    for sphere, spacings in ((SPHERES[1], [1.5, 2, 3, 4, 8]), (SPHERES[5], [1.5, 2, 3, 8])):
        for own_wake in (False, True):
            errors = [error(sphere, spacing, own_wake) for spacing in spacings]
            label = "corrected" if own_wake else "not corrected"
            record.curve("error of the terminal velocity against the bulk spacing", "bulk spacing / d",
                         "velocity / exact - 1", f"{sphere.name}, {label}", spacings, errors)
            for spacing, value in zip(spacings, errors):
                record.note(f"{sphere.name}, spacing {spacing} d, {label}: velocity / exact - 1", value)
    # What the correction does not know: the volume that the particle displaces, of order (d / spacing)^3.
    record.note(f"{SPHERES[5].name}, spacing 1.5 d, not corrected, without porosity: velocity / exact - 1",
                error(SPHERES[5], 1.5, False, sections={"scene": {"porosity": "off"}}))
    for kernel in ("centre", "volume", "linear", "diffusion"):
        for own_wake in (False, True):
            record.note(f"{SPHERES[1].name}, spacing 4 d, {kernel}, {'' if own_wake else 'not '}corrected: "
                        "velocity / exact - 1", error(SPHERES[1], 4, own_wake, kernel=kernel))


def box_and_mesh(demvof, record):
    sphere = SPHERES[0]
    normal = settle(demvof, sphere, 8, True, **WIDE)[1][-1]
    for what, options in {"box of 256 d": {"across": 32, "ends": 20}, "no-slip walls": {"side": Wall},
                          "windows half as long": {"courant": 0.1}}.items():
        change = settle(demvof, sphere, 8, True, **{**WIDE, **options})[1][-1] - normal
        record.note(f"{sphere.name}: change of velocity / exact, {what}", change)
        record.at_most(f"{sphere.name}: size of that change", abs(change), 0.004)
    fine = settle(demvof, sphere, 8, True, across=20, ends=8, courant=0.1, refine=2)[1][-1] - 1
    record.note(f"{sphere.name}: velocity / exact - 1, fluid mesh twice as fine as the bulk grid", fine)
    record.at_most(f"{sphere.name}: size of that error", abs(fine), 0.01)


if __name__ == "__main__":
    main()
