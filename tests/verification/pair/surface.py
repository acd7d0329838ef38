#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What spheres at a water surface feel, where the answer is known: surface.py DEMVOF [--long]

  held bed across the surface        water and air stay at rest
  rising level through a held bed    the bed's floor load is its weight less that of the water it displaces
  fall through air above water       the drag of air, to one radius above the surface
  entry without gravity and drag     (m + m_a) v is kept: v+/v- = 1/(1 + C_m rho/rho_p)
"""
import math
import sys

import numpy

from box_case import BoxCase, Open, Particle, Slip, SIDES, command_line, momentum_of_everything, particle_states, scratch
from record import Record

G = 9.81


def bed(lower, upper, spacing, diameter, held=True, seed=None, sizes=None):
    """Spheres on a lattice, or around it at random with alternating sizes."""
    random = numpy.random.default_rng(seed)
    beads = []
    counts = [int(round((u - l) / spacing)) for l, u in zip(lower, upper)]
    for i, j, k in numpy.ndindex(*counts):
        at = [l + (n + 0.5) * spacing for l, n in zip(lower, (i, j, k))]
        d = diameter
        if seed is not None:
            at = [a + random.uniform(-0.12, 0.12) * spacing for a in at]
            d = sizes[(i + j + k) % len(sizes)]
        beads.append(Particle(tuple(at), d, 2500, held=held))
    return beads


def at_rest(folder, demvof, **random):
    """Largest fluid speed after 100 steps over a bed that the surface crosses."""
    h = 0.01
    case = BoxCase(folder, (4 * h, 4 * h, 8 * h), (8, 8, 16), (4, 4, 8), end_time=0.1, window=1e-3, level=0.0437, level_in_cells=True,
                   particles=bed((0, 0, 0.02), (0.04, 0.04, 0.06), h / 2, 4e-3, **random), longest_step=1e-3,
                   tolerance=1e-12, relative_tolerance=0, dem_step=1e-3, sides={side: Slip() for side in SIDES})
    case.sides["z+"] = Open()
    return case.run(demvof)


def floor_load(folder, demvof, level):
    """Pressure force on a held bed over the weight of the water that its wet part displaces."""
    h, d = 0.01, 4e-3
    beads = bed((0, 0, 0), (0.04, 0.04, 0.06), h / 2, d)
    case = BoxCase(folder, (4 * h, 4 * h, 10 * h), (8, 8, 40), (4, 4, 10), end_time=0.02, window=1e-3, level=level, level_in_cells=True,
                   particles=beads, longest_step=1e-3, tolerance=1e-12, relative_tolerance=0, dem_step=1e-3,
                   sides={side: Slip() for side in SIDES})
    case.sides["z+"] = Open()
    run = case.run(demvof)
    states = particle_states(run.folder)
    z = states["position"][:, 2]
    x = numpy.clip((level - (z - d / 2)) / d, 0, 1)
    wet = math.pi / 6 * d ** 3 * x ** 2 * (3 - 2 * x)
    water, air = case.liquid[0], case.gas[0]
    exact = G * numpy.sum(water * wet + air * (math.pi / 6 * d ** 3 - wet))
    return float(numpy.sum(states["pressure_force"][:, 2])) / exact


def fall(folder, demvof):
    """Speed of a bead that fell through air, its underside one radius above water, and the exact one, m/s."""
    d, density, start, level = 4e-3, 2500, 0.1095, 0.0212
    end = level + d
    case = BoxCase(folder, (0.03, 0.03, 0.12), (12, 12, 48), (6, 6, 24), end_time=0.14, window=5e-4, level=level, level_in_cells=True,
                   gas=(1.2, 1.5e-5), particles=[Particle((0.0147, 0.0152, start), d, density)], dem_step=5e-5,
                   tolerance=1e-9)
    case.sides["z+"] = Open()
    run = case.run(demvof)
    m = density * math.pi / 6 * d ** 3
    height = run.history["particle_potential_energy"] / (m * G)
    speed = numpy.sqrt(2 * run.history["particle_kinetic_energy"] / m)
    row = int(numpy.argmax(height < end))
    part = (height[row - 1] - end) / (height[row - 1] - height[row])
    found = speed[row - 1] + part * (speed[row] - speed[row - 1])
    # m dv/dt = m g - rho V g - beta v, Schiller and Naumann
    rho, mu, v, z, dt = 1.2, 1.8e-5, 0.0, start, 1e-6
    while z > end:
        beta = 3 * math.pi * mu * d * (1 + 0.15 * (rho * v * d / mu) ** 0.687)
        v += dt * ((1 - rho / density) * G - beta * v / m)
        z -= dt * v
    return float(found), v


def enter(folder, demvof, ratio):
    """Speed of a sphere under water over that in the gas before, without gravity and drag."""
    d, speed, level = 4e-3, 1.0, 0.03
    case = BoxCase(folder, (0.04, 0.04, 0.06), (20, 20, 30), (5, 5, 8), end_time=0.02, window=2e-4, level=level, level_in_cells=True,
                   gravity=(0, 0, 0), gas=(1e-3, 1e-6), liquid=(1000, 1e-12), dem_step=2e-5,
                   particles=[Particle((0.02, 0.02, level + 1.5 * d), d, 1000 * ratio, velocity=(0, 0, -speed))],
                   forces=[{"added_mass": 0.5}], tolerance=1e-9)
    case.sides["z+"] = Open()
    run = case.run(demvof)
    return run, float(run.history["particle_momentum_z"][-1] / run.history["particle_momentum_z"][0])


def main():
    arguments = command_line()
    record = Record("surface", "Spheres at a water surface",
                    "What spheres feel where the surface is: a held bed that the surface crosses, the load of a bed as the "
                    "level rises through one bulk cell, the fall of a bead in air just above water, and the loss of speed "
                    "on entry.", "tests/Alltest -- -R pair.surface")
    for name, settings in {"lattice": {}, "two sizes at random": {"seed": 7, "sizes": (3e-3, 4e-3)}}.items():
        run = at_rest(scratch("surface") / f"at_rest_{name.split()[0]}", arguments.demvof, **settings)
        record.at_most(f"held bed across the surface, {name}: speed after 100 steps", float(run.history["max_speed"][-1]),
                       3e-10, "m/s")
    levels = numpy.linspace(0.0405, 0.0495, 10 if arguments.long else 3)
    loads = [floor_load(scratch("surface") / f"load_{level:.4f}", arguments.demvof, level) for level in levels]
    for level, load in zip(levels, loads):
        record.at_most(f"level at {level:.4f} m: buoyancy of the bed / exact - 1", abs(load - 1), 3.2e-4)
    record.curve("load of a bed", "level, m", "buoyancy / exact", "measured", levels, loads)
    found, exact = fall(scratch("surface") / "fall", arguments.demvof)
    record.at_most("fall through air, underside one radius above the water: speed / exact - 1", abs(found / exact - 1),
                   1.6e-4)
    for ratio in (2, 2.5, 8) if arguments.long else (2,):
        run, kept = enter(scratch("surface") / f"enter_{ratio}", arguments.demvof, ratio)
        expected = 1 / (1 + 0.5 / ratio)
        record.at_most(f"entry, density ratio {ratio}: speed kept / exact - 1", abs(kept / expected - 1), 0.02)
        record.at_most(f"entry, density ratio {ratio}: momentum exchange", run.results["conservation"]["exchange"], 1e-12)
    momentum_of_everything(record, 1e-8 if arguments.long else 3.1e-12)
    return record.write()


if __name__ == "__main__":
    sys.exit(main())
