# SPDX-License-Identifier: GPL-3.0-or-later
"""A bed of free spheres in a rising and falling stream of liquid: pressure drop and minimum fluidisation.

    plateau    dp = W / A + rho (L_free + L_bed/eps) dU/dt, W the weight of the particles in the liquid, A the
               cross-section, U the superficial velocity: what the stream has to be accelerated with, 1 % of it, is taken off
    U_mf       where Ergun's equation, at the void fraction of each layer of bulk cells, reaches that plateau
    Wen and Yu (1966), for comparison:  Re_mf = sqrt(33.7^2 + 0.0408 Ar) - 33.7

Usage: fluidisation.py DEMVOF [--long]"""
import math

import numpy
from box_case import BoxCase, Cyclic, Inlet, Outlet, Particle, command_line, momentum_of_everything, particle_states, scratch, side_means
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
    """Superficial velocity at which Ergun's pressure gradient carries a bed of this void fraction, m/s."""
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


def simulate(demvof, across, layers, ramp, window, averaging, falls):
    """ramp: s from rest to the fastest stream, and, if it falls, as long back. Returns what the case was and its run."""
    bulk = 2 * LAYER
    edge, floor = across * LAYER, 2 * bulk  # clear liquid below the floor: there eps = 1 at the inlet
    cells = (across // 2, across // 2, 3 + layers)
    height = cells[2] * bulk
    fastest = 1.5 * minimum_velocity(0.42)
    case = BoxCase(scratch(f"fluidisation/{across}_{window:g}_{averaging['kernel']}"), (edge, edge, height), cells, cells, (2 if falls else 1) * ramp, window,
                   gravity=(0, 0, -GRAVITY), liquid=(DENSITY, VISCOSITY / DENSITY), stiffness=50,
                   dem_step=2e-5, forces=[{"drag": "gidaspow"}, "pressure_gradient"], watched={"z-": "p_rgh"},
                   coupling={"averaging": averaging})
    case.sides = {side: Cyclic() for side in ("x-", "x+", "y-", "y+")}
    stream = f"uniformFixedValue; uniformValue table ((0 (0 0 0)) ({ramp} (0 0 {fastest})) ({2 * ramp} (0 0 0)))"
    case.sides.update({"z-": Inlet(stream), "z+": Outlet()})
    case.particles = [Particle(place, DIAMETER, PARTICLE_DENSITY) for place in places(across, layers, floor)]
    case.script_tail = ("fix floor all wall/gran model hooke/stiffness tangential history primitive type 1 "
                        f"zplane {floor}\nrun 20000\n")
    run = case.run(demvof)
    times, drop = side_means(run.folder, "z-", "p_rgh")
    velocity = fastest * (1 - abs(times / ramp - 1))
    # A bed at rest, before the stream rises and after it has fallen.
    at_rest = [particle_states(run.folder, output)["position"][:, 2] for output in (0, -1)]
    eps = [void_fractions(z, edge**2, bulk * numpy.arange(cells[2] + 1)) for z in at_rest]
    solid = len(case.particles) * VOLUME / edge**2  # m
    inertia = DENSITY * (height + solid / eps[0].min())     # L_free + L_bed/eps = height + L_bed (1 - eps)/eps
    falling = times > ramp
    return {"drop": drop - numpy.where(falling, -1, 1) * inertia * fastest / ramp, "velocity": velocity, "falling": falling,
            "fastest": fastest, "run": run, "plateau": solid * (PARTICLE_DENSITY - DENSITY) * GRAVITY, "layer": bulk,
            "eps": eps}


def void_fractions(z, area, levels):
    """Between levels: of spheres at heights z."""
    r = DIAMETER / 2
    h = numpy.clip(levels[:, None] - (z - r), 0, 2 * r)
    below = (math.pi * h**2 * (r - h / 3)).sum(axis=1)  # volume of spheres below each level
    return 1 - numpy.diff(below) / (area * numpy.diff(levels))


def fixed_bed(bed, velocity, falling):
    """Pressure drop by Ergun's equation in each layer, Pa."""
    return sum(ergun(velocity, eps) * bed["layer"] for eps in bed["eps"][falling] if eps < 0.8)


def expected_minimum(bed, falling):
    low, high = 0.0, bed["fastest"]
    for _ in range(50):
        middle = (low + high) / 2
        low, high = (middle, high) if fixed_bed(bed, middle, falling) < bed["plateau"] else (low, middle)
    return low


def measured_minimum(bed, falling=False):
    """Where the fixed-bed line, a U + b U^2, of the rising or falling stream reaches the plateau."""
    fixed = (bed["falling"] == falling) & (bed["drop"] < 0.85 * bed["plateau"]) & (bed["velocity"] > 0.1 * bed["fastest"])
    u = bed["velocity"][fixed]
    (a, b), *_ = numpy.linalg.lstsq(numpy.column_stack([u, u**2]), bed["drop"][fixed], rcond=None)
    return (-a + math.sqrt(a * a + 4 * b * bed["plateau"])) / (2 * b)


def off_plateau(bed, falling=False):
    """Mean of the carried bed's pressure drop over its weight, less 1. In the falling stream the lowest layers rest on the
    floor while those above still come down."""
    carried = (bed["velocity"] > 1.25 * expected_minimum(bed, falling)) & (bed["falling"] == falling)
    return bed["drop"][carried].mean() / bed["plateau"] - 1


def onset_error(bed, falling=False):
    return measured_minimum(bed, falling) / expected_minimum(bed, falling) - 1


def main():
    options = command_line()
    record = Record(
        "fluidisation", "Minimum fluidisation of a bed in water",
        "Spheres of 1 mm and 2500 kg/m3 in a periodic column of water; the stream from below rises from rest to 1.5 "
        "times the velocity of minimum fluidisation and falls back. The plateau of the pressure drop must be the weight "
        "of the bed in water over its area; the velocity of minimum fluidisation is where the falling stream's fixed-bed "
        "line reaches that plateau, compared with Ergun's equation (the bed's drag law) at the void fraction that the "
        "bed has at the end.",
        "tests/Alltest --verification -- -R pair.fluidisation_long" if options.long else "tests/Alltest -- -R 'pair.fluidisation$'")
    # Kernels that do not spread the bed through its floor, which the liquid passes. In windows of 5 ms K dt/(rho eps) = 2,
    # longer than the spheres' response: grows without relaxation (docs/decisions/relaxation.md).
    sharp, wide = {"kernel": "volume"}, {"kernel": "gaussian", "width": 0.4 * DIAMETER}
    size = (6, 30, 4.0) if options.long else (4, 20, 0.6)
    beds = {"windows of 1 ms": simulate(options.demvof, *size, 1e-3, sharp, options.long)}
    if options.long:
        beds["windows of 5 ms"] = simulate(options.demvof, *size, 5e-3, sharp, True)
        beds["windows of 5 ms, gaussian kernel through the floor"] = simulate(options.demvof, *size, 5e-3, wide, True)
    for name, bed in beds.items():
        for stream, falling in (("rising", False), ("falling", True)) if options.long else (("rising", False),):
            record.note(f"{name}, {stream} stream: plateau of the pressure drop over the weight of the bed, less 1",
                        off_plateau(bed, falling))
            record.note(f"{name}, {stream} stream: minimum fluidisation velocity over Ergun's, less 1",
                        onset_error(bed, falling))
        if "gaussian" in name:
            continue  # the lowest layer samples clear liquid below it, and is carried later than the others
        record.at_most(f"{name}: error of the plateau", abs(off_plateau(bed)), 0.009)
        record.at_most(f"{name}: error of the minimum fluidisation velocity", abs(onset_error(bed)), 0.1)
    bed = beds["windows of 1 ms"]
    record.note("minimum fluidisation velocity, Ergun", expected_minimum(bed, options.long), "m/s")
    record.note("minimum fluidisation velocity, Wen and Yu (1966)", wen_yu(), "m/s")
    record.note("void fraction of the densest layer at rest", bed["eps"][options.long].min())
    record.at_most("exchange of momentum open", max(b["run"].results["conservation"]["exchange"] for b in beds.values()), 1.9e-14)
    step = max(1, len(bed["drop"]) // 400)
    for name, part in (("rising stream", ~bed["falling"]), ("falling stream", bed["falling"])):
        record.curve("Pressure drop of the bed", "superficial velocity, m/s", "pressure drop over weight per area", name,
                     bed["velocity"][part][::step], bed["drop"][part][::step] / bed["plateau"], style="-")
    u = numpy.linspace(0, bed["fastest"], 50)
    record.curve("Pressure drop of the bed", "superficial velocity, m/s", "pressure drop over weight per area",
                 "Ergun, fixed bed", u, numpy.minimum(fixed_bed(bed, u, options.long) / bed["plateau"], 1), style="k--")
    momentum_of_everything(record, 1e-8 if options.long else 6.9e-14)
    raise SystemExit(record.write())


main()
