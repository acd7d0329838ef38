#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Slow flow through a held bed of two sizes with Beetstra's law: size_mix.py DEMVOF

Every bulk cell holds two spheres of 2 mm and sixteen of 1 mm, equal volumes, void fraction 0.4.
"""
import math
import sys

from box_case import BoxCase, Cyclic, Particle, SIDES, command_line, particle_states, scratch
from record import Record

SMALL, LARGE, VOID = 1e-3, 2e-3, 0.4
SIDE = ((16 * SMALL**3 + 2 * LARGE**3) * math.pi / 6 / (1 - VOID)) ** (1 / 3)  # of a bulk cell
SAUTER, COARSENESS = 4 / 3 * SMALL, 1.5 / (4 / 3)


def share(diameter):
    y = diameter / SAUTER
    return (y + 0.064 * y**3) / (1 + 0.064 * COARSENESS)


def cell(corner):
    small = [(x, y, z) for x in (0.2, 0.8) for y in (0.2, 0.4, 0.6, 0.8) for z in (0.2, 0.8)]
    large = [(0.5, 0.5, 0.3), (0.5, 0.5, 0.7)]
    return [Particle(tuple(SIDE * (c + s) for c, s in zip(corner, site)), diameter, 2500, held=True)
            for sites, diameter in ((small, SMALL), (large, LARGE)) for site in sites]


def main():
    case = BoxCase(scratch("size_mix"), upper=(2 * SIDE,) * 3, fine=(2, 2, 2), bulk=(2, 2, 2), end_time=2e-6, window=1e-6,
                   sides={side: Cyclic() for side in SIDES}, gravity=(0, 0, 0), liquid=(1, 1), velocity=(1e-3, 0, 0),
                   forces=[{"drag": "beetstra"}], coupling={"averaging": {"kernel": "centre"}})
    case.particles = [p for i in range(2) for j in range(2) for k in range(2) for p in cell((i, j, k))]
    run = case.run(command_line().demvof)
    state = particle_states(run.folder)
    drag = {d: [f[0] for f, r in zip(state["drag_force"], state["radius"]) if abs(2 * r / d - 1) < 0.1] for d in (SMALL, LARGE)}
    mean = {d: sum(values) / len(values) for d, values in drag.items()}
    phi, expected = 1 - VOID, LARGE * share(LARGE) / (SMALL * share(SMALL))

    record = Record("size_mix", "Drag in a bed of two sizes",
                    "Slow flow through a held bed of spheres of 1 and 2 mm with equal volumes, void fraction 0.4, with "
                    "Beetstra's law through the real pair: the ratio of the drags against the law with the Sauter diameter.",
                    "tests/Alltest -- -R pair.size_mix")
    for d, value in mean.items():
        record.at_most(f"drag on a sphere of {1e3 * d:g} mm: spread", (max(drag[d]) - min(drag[d])) / value, 5e-13)
    record.note("ratio of the drags", mean[LARGE] / mean[SMALL])
    record.at_most("ratio of the drags against the law's: error", abs(mean[LARGE] / mean[SMALL] / expected - 1), 2e-14)
    pressure = {d: phi / VOID * (d / SAUTER) ** 2 / share(d) for d in mean}  # over the drag, in a bed at rest
    record.note("ratio of the whole forces in a bed at rest",
                mean[LARGE] * (1 + pressure[LARGE]) / (mean[SMALL] * (1 + pressure[SMALL])))
    sys.exit(record.write())


if __name__ == "__main__":
    main()
