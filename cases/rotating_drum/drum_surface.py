#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes particles/drum.stl: the drum's wall in 48 flat strips, corners on the circle, normals to the axis."""
import math
import pathlib

RADIUS, LENGTH, STRIPS = 0.05, 0.02, 48  # m, m

lines = ["solid drum"]
for strip in range(STRIPS):
    one, other, middle = (2 * math.pi * (strip + part) / STRIPS for part in (0, 1, 0.5))
    a, b = ((RADIUS * math.cos(angle), RADIUS * math.sin(angle)) for angle in (one, other))
    for corners in (((*a, 0), (*a, LENGTH), (*b, LENGTH)), ((*a, 0), (*b, LENGTH), (*b, 0))):
        lines += [f"facet normal {-math.cos(middle):.9f} {-math.sin(middle):.9f} 0", " outer loop"]
        lines += [f"  vertex {x:.9f} {y:.9f} {z:g}" for x, y, z in corners] + [" endloop", "endfacet"]
lines.append("endsolid drum")
(pathlib.Path(__file__).resolve().parent / "particles" / "drum.stl").write_text("\n".join(lines) + "\n")
