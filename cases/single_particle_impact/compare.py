#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces of several runs in one picture: compare.py [--times T ...] [--picture FILE] [--json FILE] [LABEL=]RUN ...

For each run and time: height z(y) of alpha = 0.5 as seen from above, in the plane x = 0.0275 m through the impact; the
crater's depth (level at rest - lowest point within one bead diameter of the axis) and the highest point there. A time
that a run did not reach is left out of its panel.
"""
import argparse
import json
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parent.parent / "coupler" / "cli"))

from reporting import fields  # noqa: E402
from reporting.figures import COLOURS, pyplot  # noqa: E402
from reporting.run import Run  # noqa: E402

WIDTH, AXIS, LEVEL, DIAMETER = 0.05, 0.0275, 0.051, 4e-3  # m
X, Y, Z = 0, 1, 2


def highest_crossing(heights, liquid):
    """Where the liquid fraction of a column last falls through 0.5, linear between cell centres, m."""
    below = numpy.flatnonzero((liquid[:-1] >= 0.5) & (liquid[1:] < 0.5))
    if not len(below):
        return numpy.nan
    low = below[-1]
    share = (liquid[low] - 0.5) / (liquid[low] - liquid[low + 1])
    return heights[low] + share * (heights[low + 1] - heights[low])


def surface(folder, time):
    """y and z of the surface, one point per finest cell of the plane; None if the run has no fields at that time."""
    fluid = fields.Fluid(pathlib.Path(folder))
    if not fluid.times or min(abs(t - time) for t in fluid.times) > 1e-6:
        return None
    # Slightly off the plane: in some meshes it lies in faces.
    polygons, liquid, _ = fields.cut(fluid.meshes(time), fluid.alpha, (AXIS - 1e-5, 0, 0), X, [Y, Z])
    left = numpy.array([p[:, 0].min() for p in polygons])
    right = numpy.array([p[:, 0].max() for p in polygons])
    middle = numpy.array([0.5 * (p[:, 1].min() + p[:, 1].max()) for p in polygons])
    count = round(WIDTH / (right - left).min())
    y = (numpy.arange(count) + 0.5) * WIDTH / count
    z = []
    for position in y:
        column = numpy.flatnonzero((left <= position) & (position < right))
        column = column[numpy.argsort(middle[column])]
        z.append(highest_crossing(middle[column], liquid[column]))
    return y, numpy.array(z)


def near_axis(y):
    return numpy.abs(y - AXIS) <= DIAMETER


def crater_depth(y, z):
    """Below the level at rest, m; negative if the surface is higher everywhere near the axis."""
    return LEVEL - float(numpy.nanmin(z[near_axis(y)]))


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="[LABEL=]RUN")
    parser.add_argument("--times", type=float, nargs="+", default=[0.18, 0.21], metavar="T", help="s")
    parser.add_argument("--picture", help="default: none")
    parser.add_argument("--json", help="the numbers and curves; default: none")
    arguments = parser.parse_args()

    figure, panels = pyplot.subplots(1, len(arguments.times), figsize=(4.8 * len(arguments.times), 3.6), squeeze=False)
    table = []
    for number, word in enumerate(arguments.runs):
        label, _, folder = word.rpartition("=")
        label = label or pathlib.Path(folder).name
        interchange = Run(folder).setting("coupling.phase_interchange")
        for time, panel in zip(arguments.times, panels[0]):
            points = surface(folder, time)
            if points is None:
                print(f"{label}: no fields at {time:g} s", file=sys.stderr)
                continue
            y, z = points
            panel.plot(1e3 * y, 1e3 * z, label=label, color=COLOURS[number % len(COLOURS)])
            table.append({"run": label, "phase_interchange": interchange, "time": time, "crater_depth": crater_depth(y, z),
                          "highest": float(numpy.nanmax(z[near_axis(y)])), "y": y.round(6).tolist(),
                          "z": z.round(6).tolist()})
            print(f"{label:<24} {time:5.2f} s   crater {1e3 * crater_depth(y, z):6.3f} mm   "
                  f"highest near the axis {1e3 * (table[-1]['highest'] - LEVEL):+.3f} mm")
    for time, panel in zip(arguments.times, panels[0]):
        panel.set(title=f"t = {time:g} s", xlabel="y, mm", ylabel="z of the surface, mm")
        panel.axhline(1e3 * LEVEL, color="#9aa4ad", linewidth=0.8, linestyle="--")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="lower center", ncol=4)
    figure.tight_layout(rect=(0, 0.07, 1, 1))
    if arguments.picture:
        figure.savefig(arguments.picture, dpi=100)
    if arguments.json:
        pathlib.Path(arguments.json).write_text(json.dumps({"command": "./compare.py " + " ".join(sys.argv[1:]),
                                                            "surfaces": table}) + "\n")
    return 0 if table else 1


if __name__ == "__main__":
    sys.exit(main())
