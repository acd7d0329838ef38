# SPDX-License-Identifier: GPL-3.0-or-later
"""A bed of free spheres in a rising and falling stream of liquid: pressure drop and minimum fluidisation.

    plateau    dp = W / A, W the weight of the particles in the liquid, A the cross-section
    U_mf       where Ergun's equation at the bed's own void fraction reaches that plateau
    Wen and Yu (1966), for comparison:  Re_mf = sqrt(33.7^2 + 0.0408 Ar) - 33.7

Usage: fluidisation.py DEMVOF [--long]"""
import math

import numpy
from box_case import BoxCase, Cyclic, Inlet, Outlet, Particle, command_line, particle_states, scratch, side_means
from record import Record

DIAMETER, PARTICLE_DENSITY = 1e-3, 2500.0
DENSITY, VISCOSITY, GRAVITY = 1000.0, 1e-3, 9.81
VOLUME = math.pi / 6 * DIAMETER**3
LAYER = 1.1 * DIAMETER  # between the places at the start


def ergun(velocity, eps):
    """Pressure gradient, Pa/m; velocity: superficial."""
    return (150 * VISCOSITY * (1 - eps)**2 * velocity / (eps**3 * DIAMETER**2)
            + 1.75 * DENSITY * (1 - eps) * velocity**2 / (eps**3 * DIAMETER))


def minimum_velocity(eps):
    """Superficial velocity at which Ergun's pressure gradient carries the bed, m/s."""
    a = 1.75 * DENSITY / (eps**3 * DIAMETER)
    b = 150 * VISCOSITY * (1 - eps) / (eps**3 * DIAMETER**2)
    weight = (PARTICLE_DENSITY - DENSITY) * GRAVITY
    return (-b + math.sqrt(b * b + 4 * a * weight)) / (2 * a)


def wen_yu():
    archimedes = DIAMETER**3 * DENSITY * (PARTICLE_DENSITY - DENSITY) * GRAVITY / VISCOSITY**2
    return (math.sqrt(33.7**2 + 0.0408 * archimedes) - 33.7) * VISCOSITY / (DENSITY * DIAMETER)


def places(across, layers, floor):
    """A loose cubic lattice above the floor, shifted a little so that it does not settle as one."""
    random = numpy.random.default_rng(1)
    for k in range(layers):
        for j in range(across):
            for i in range(across):
                x, y, z = (numpy.array([i, j, k]) + 0.5) * LAYER + random.uniform(-0.04, 0.04, 3) * DIAMETER
                yield x, y, floor + z


def simulate(demvof, across, layers, ramp, hold, window):
    """ramp: s from rest to the fastest stream, and as long back; hold: s between. Returns what the case was and its
    run."""
    bulk = 2 * LAYER
    edge, floor = across * LAYER, 2 * bulk  # clear liquid below the floor: there eps = 1 at the inlet
    cells = (across // 2, across // 2, 3 + layers)
    height = cells[2] * bulk
    fastest = 1.5 * minimum_velocity(0.42)
    case = BoxCase(scratch(f"fluidisation/{across}_{window:g}"), (edge, edge, height), cells, cells, 2 * ramp + hold, window,
                   gravity=(0, 0, -GRAVITY), liquid=(DENSITY, VISCOSITY / DENSITY), stiffness=50,
                   dem_step=2e-5, forces=[{"drag": "gidaspow"}, "pressure_gradient"], watched={"z-": "p_rgh"},
                   coupling={"averaging": {"kernel": "gaussian", "width": 0.4 * DIAMETER}})
    case.sides = {side: Cyclic() for side in ("x-", "x+", "y-", "y+")}
    stream = (f"uniformFixedValue; uniformValue table ((0 (0 0 0)) ({ramp} (0 0 {fastest})) "
              f"({ramp + hold} (0 0 {fastest})) ({2 * ramp + hold} (0 0 0)))")
    case.sides.update({"z-": Inlet(stream), "z+": Outlet()})
    case.particles = [Particle(place, DIAMETER, PARTICLE_DENSITY) for place in places(across, layers, floor)]
    case.script_tail = ("fix floor all wall/gran model hooke/stiffness tangential history primitive type 1 "
                        f"zplane {floor}\nrun 20000\n")
    run = case.run(demvof)
    times, drop = side_means(run.folder, "z-", "p_rgh")
    velocity = fastest * numpy.clip(numpy.minimum(times, 2 * ramp + hold - times) / ramp, 0, 1)
    return {"drop": drop, "velocity": velocity, "falling": times > ramp + hold, "fastest": fastest, "run": run,
            "carried": (times > ramp + hold / 2) & (times < ramp + hold),
            "plateau": len(case.particles) * VOLUME * (PARTICLE_DENSITY - DENSITY) * GRAVITY / edge**2,
            "eps": void_fraction_inside(particle_states(run.folder)["position"][:, 2], edge**2)}


def void_fraction_inside(z, area):
    """Of a bed at rest, two diameters away from its floor and its top."""
    low, high, r = z.min() + 1.5 * DIAMETER, z.max() - 1.5 * DIAMETER, DIAMETER / 2

    def below(level):  # volume of spheres below a level
        h = numpy.clip(level - (z - r), 0, 2 * r)
        return (math.pi * h**2 * (r - h / 3)).sum()
    return 1 - (below(high) - below(low)) / (area * (high - low))


def measured_minimum(bed):
    """Where the falling stream's fixed-bed line, a U + b U^2, reaches the plateau."""
    fixed = bed["falling"] & (bed["drop"] < 0.85 * bed["plateau"]) & (bed["velocity"] > 0.1 * bed["fastest"])
    u = bed["velocity"][fixed]
    (a, b), *_ = numpy.linalg.lstsq(numpy.column_stack([u, u**2]), bed["drop"][fixed], rcond=None)
    return (-a + math.sqrt(a * a + 4 * b * bed["plateau"])) / (2 * b)


def plateau_error(bed):
    """Over the second half of the time at the fastest stream: in a ramp the fluid's inertia takes part, and a bed that
    shrinks is carried by its floor in part."""
    return abs(bed["drop"][bed["carried"]].mean() / bed["plateau"] - 1)


def main():
    options = command_line()
    record = Record(
        "fluidisation", "Minimum fluidisation of a bed in water",
        "Spheres of 1 mm and 2500 kg/m3 in a periodic column of water; the stream from below rises from rest to 1.5 "
        "times the velocity of minimum fluidisation and falls back. The plateau of the pressure drop must be the weight "
        "of the bed in water over its area; the velocity of minimum fluidisation is where the falling stream's fixed-bed "
        "line reaches that plateau, compared with Ergun's equation (the bed's drag law) at the void fraction that the "
        "bed has at the end. The lowest layer stands in a bulk cell that the bed fills by half and feels less drag than the others: "
        "the floor carries up to a third of its weight, 1.4 % of the bed's.",
        "tests/Alltest --verification -- -R pair.fluidisation_long" if options.long else "tests/Alltest -- -R 'pair.fluidisation$'")
    size = (6, 30, 4.0, 1.0) if options.long else (4, 20, 0.6, 0.4)
    bed = simulate(options.demvof, *size, 1e-3)
    # K dt/(rho eps) = 2, longer than the spheres' response: grows without relaxation (docs/decisions/relaxation.md).
    in_long_windows = simulate(options.demvof, *size, 5e-3)
    expected, measured = minimum_velocity(bed["eps"]), measured_minimum(bed)
    record.at_most("plateau of the pressure drop against the weight of the bed", plateau_error(bed), 0.02)
    record.at_most("minimum fluidisation velocity against Ergun at the bed's void fraction",
                   abs(measured / expected - 1), 0.1)
    record.at_most("the same in windows of 5 ms: plateau", plateau_error(in_long_windows), 0.02)
    record.at_most("the same in windows of 5 ms: minimum fluidisation velocity",
                   abs(measured_minimum(in_long_windows) / minimum_velocity(in_long_windows["eps"]) - 1), 0.1)
    record.note("minimum fluidisation velocity, measured", measured, "m/s")
    record.note("minimum fluidisation velocity, Ergun", expected, "m/s")
    record.note("minimum fluidisation velocity, Wen and Yu (1966)", wen_yu(), "m/s")
    record.note("void fraction inside the bed at the end", bed["eps"])
    record.at_most("exchange of momentum open", bed["run"].results["conservation"]["exchange"], 1e-10)
    step = max(1, len(bed["drop"]) // 400)
    for name, part in (("rising stream", ~bed["falling"]), ("falling stream", bed["falling"])):
        record.curve("Pressure drop of the bed", "superficial velocity, m/s", "pressure drop over weight per area", name,
                     bed["velocity"][part][::step], bed["drop"][part][::step] / bed["plateau"], style="-")
    u = numpy.linspace(0, bed["fastest"], 50)
    height = bed["plateau"] / ((PARTICLE_DENSITY - DENSITY) * GRAVITY * (1 - bed["eps"]))
    record.curve("Pressure drop of the bed", "superficial velocity, m/s", "pressure drop over weight per area",
                 "Ergun, fixed bed", u, numpy.minimum(ergun(u, bed["eps"]) * height / bed["plateau"], 1), style="k--")
    raise SystemExit(record.write())


main()
