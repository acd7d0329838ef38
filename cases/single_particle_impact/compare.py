#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces of several runs in one picture: compare.py [--times T ...] [--picture FILE] [--json FILE] [LABEL=]RUN ...

For each run and time: height z(y) of alpha = 0.5 as seen from above, in the plane x = 0.0275 m through the impact, over
that at the start (linear between cell centres, it is up to 0.4 mm off the level of 0.051 m where that is no face of the
mesh); the crater's depth (lowest point within one bead diameter of the axis) and the height on the axis. A time that a
run did not reach is left out of its panel.
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

WIDTH, AXIS, DIAMETER = 0.05, 0.0275, 4e-3  # m
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
    """y and z of the surface, one point per finest cell of the plane; None if the run has no fields at that time.
    Without a time: at the start."""
    fluid = fields.Fluid(pathlib.Path(folder))
    time = fluid.times[0] if time is None and fluid.times else time
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


def heights(folder, time):
    """y of the surface and its height over that at the start; None if the run has no fields at that time."""
    points = surface(folder, time)
    return points and (points[0], points[1] - numpy.nanmedian(surface(folder, None)[1]))


def crater_depth(y, height):
    """Within one bead diameter of the axis, m; negative if the surface is higher everywhere there."""
    return -float(numpy.nanmin(height[numpy.abs(y - AXIS) <= DIAMETER]))


def on_axis(y, height):
    """Mean of the columns next to the axis (one, or one on each side), m."""
    distance = numpy.abs(y - AXIS)
    return float(numpy.nanmean(height[distance < distance.min() + 1e-9]))


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
            points = heights(folder, time)
            if points is None:
                print(f"{label}: no fields at {time:g} s", file=sys.stderr)
                continue
            y, height = points
            panel.plot(1e3 * y, 1e3 * height, label=label, color=COLOURS[number % len(COLOURS)])
            table.append({"run": label, "phase_interchange": interchange, "time": time,
                          "crater_depth": crater_depth(y, height), "on_axis": on_axis(y, height),
                          "y": y.round(6).tolist(), "height": height.round(6).tolist()})
            print(f"{label:<28} {time:5.2f} s   crater {1e3 * crater_depth(y, height):6.3f} mm   "
                  f"on the axis {1e3 * on_axis(y, height):+.3f} mm")
    for time, panel in zip(arguments.times, panels[0]):
        panel.set(title=f"t = {time:g} s", xlabel="y, mm", ylabel="surface over its start, mm")
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="lower center", ncol=6)
    figure.tight_layout(rect=(0, 0.08, 1, 1))
    if arguments.picture:
        figure.savefig(arguments.picture, dpi=100)
    if arguments.json:
        pathlib.Path(arguments.json).write_text(json.dumps({"command": "./compare.py " + " ".join(sys.argv[1:]),
                                                            "surfaces": table}) + "\n")
    return 0 if table else 1


if __name__ == "__main__":
    sys.exit(main())
