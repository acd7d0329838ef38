#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Spheres lighter than water come to rest where Archimedes says: floating.py DEMVOF [--long]

The surface lies anywhere in a bulk cell; what a sphere feels of it must not depend on that, and only weakly on the
bulk grid, which is up to four diameters wide.
"""
import math
import sys

import numpy

from box_case import BoxCase, Open, Particle, command_line, momentum_of_everything, particle_states, scratch
from record import Record

DIAMETER = 4e-3
DENSITIES = [100, 250, 500, 800, 900]  # kg/m3, in water of 1000


def depth(ratio):
    """Of a sphere's lowest point under the level, in diameters: 2 x^3 - 3 x^2 + ratio = 0, x = depth / diameter."""
    low, high = 0.0, 1.0
    for _ in range(60):
        x = (low + high) / 2
        low, high = (x, high) if x * x * (3 - 2 * x) < ratio else (low, x)
    return (low + high) / 2


def share_below(depth_of_sphere):
    x = min(max(depth_of_sphere / DIAMETER, 0), 1)
    return x * x * (3 - 2 * x)


def run(folder, demvof, spacing, fine, level, end_time):
    """One lane of spheres; spacing of the bulk grid and of the fine mesh in diameters."""
    bulk, cell = spacing * DIAMETER, fine * DIAMETER
    cells = (len(DENSITIES) * max(2, math.ceil(2 / spacing)), max(2, math.ceil(3 / spacing)), max(3, math.ceil(6 / spacing)))
    upper = tuple(n * bulk for n in cells)
    lane = upper[0] / len(DENSITIES)
    beads = [Particle(((i + 0.5) * lane + 0.1 * DIAMETER, 0.47 * upper[1],
                       level + (0.5 - depth(density / 1000)) * DIAMETER + (0.2 if i % 2 else -0.2) * DIAMETER),
                      DIAMETER, density) for i, density in enumerate(DENSITIES)]
    case = BoxCase(folder, upper, tuple(round(n * bulk / cell) for n in cells), cells, end_time=end_time, window=1e-3,
                   level=level, level_in_cells=True, liquid=(1000, 1e-4), gas=(1, 1e-4), particles=beads, dem_step=1e-4, tolerance=1e-9,
                   forces=[{"drag": "schiller_naumann"}, "pressure_gradient", {"added_mass": 0.5}])
    case.sides["z+"] = Open()
    result = case.run(demvof)
    z = particle_states(result.folder)["position"][:, 2]
    # The level that liquid and wet parts make, found with the depths themselves.
    liquid = float(result.history["liquid_volume"][-1])
    volume, height = math.pi / 6 * DIAMETER ** 3, level
    for _ in range(20):
        wet = sum(share_below(height - (at - DIAMETER / 2)) for at in z) * volume
        height = (liquid + wet) / (upper[0] * upper[1])
    return result, (height - (z - DIAMETER / 2)) / DIAMETER


def main():
    arguments = command_line()
    record = Record("floating", "Draft of floating spheres",
                    "Five spheres of 4 mm (100 to 900 kg/m3) on water with the viscosity of an oil, dropped 0.2 diameters "
                    "above or below their rest. Depth of the lowest point under the level against Archimedes, after they "
                    "have come to rest, for bulk cells of 1.25 to 4 diameters and levels anywhere in a bulk cell.",
                    "tests/Alltest -- -R pair.floating")
    rows = [(2, 0.5, 0.43), (2, 1, 0.43)]
    if arguments.long:
        rows = [(spacing, fine, level) for spacing, fine in ((1.25, 0.25), (1.25, 0.625), (2, 0.25), (2, 0.5), (2, 1), (4, 0.25), (4, 0.5), (4, 1))
                for level in (0.43, 0.5, 0.61)]
    exact = numpy.array([depth(density / 1000) for density in DENSITIES])
    worst = {}
    for spacing, fine, part in rows:
        cells = max(3, math.ceil(6 / spacing))
        level = (cells // 2 + part) * spacing * DIAMETER
        result, found = run(scratch("floating") / f"{spacing}_{fine}_{part}", arguments.demvof, spacing, fine, level,
                            0.3)
        error = numpy.abs(found - exact)
        name = f"bulk cells of {spacing} d, fine of {fine} d, surface at {part} of a bulk cell"
        bound = 0.0055 if not arguments.long else 0.02 if fine <= 0.625 else 0.1
        for ratio, e in zip(DENSITIES, error):
            record.at_most(f"{name}: density {ratio}: error of the depth / d", float(e), bound)
        record.at_most(f"{name}: momentum exchange", result.results["conservation"]["exchange"], 4.4e-13)
        worst.setdefault(f"fine cells of {fine} d", []).append((spacing, float(error.max())))
    if arguments.long:
        for series, points in worst.items():
            record.curve("error of the depth", "bulk spacing / d", "error / d", series, *zip(*points), style="o")
    momentum_of_everything(record, 1e-8 if arguments.long else 3.8e-13)
    return record.write()


if __name__ == "__main__":
    sys.exit(main())
