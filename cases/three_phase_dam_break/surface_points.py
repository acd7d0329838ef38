#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Points A, B, C of the surface at 0.4 s (Fig. 8 of the paper): surface_points.py [--picture FILE] [LABEL=]RUN ...

The rule, stated before anything was measured. In the middle plane, x(z) is where the liquid that is attached to the far
wall ends: the outermost crossing of alpha = 0.5 at that height, no value where the cell at the wall is gas. Heights are
0.25 mm apart. The returning wave leaves a notch over the layer on the floor and a bulge above it:

    A   tip of the notch: the first local maximum of x(z) above the layer on the floor, the layer being where the liquid
        reaches x < 0.1 m
    B   head of the bulge: the smallest x above A, below the height where the film at the wall is first thinner
        than at A
    C   the greatest height up to which the liquid above B stays attached to the wall without a break; "free" says the
        height of the highest liquid at the wall instead, breaks or not

A turn counts when x changes by a millimetre behind it. Coordinates are over 0.2 m. A run without a notch has no A, B.
"""
import argparse
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parents[1] / "coupler" / "cli"))

from reporting import fields  # noqa: E402
from reporting.figures import COLOURS, pyplot  # noqa: E402

TIME, LENGTH = 0.4, 0.2  # s, m
STEP, TURN, FLOOR_LAYER = 0.25e-3, 1e-3, 0.1  # m
FULL = 0.99  # liquid fraction
NAMES = ("xA", "xB", "yA", "yB", "yC")


def attached(section):
    """Heights, x(z) with NaN where the wall is dry, m."""
    wall = section.upper[0]
    at_wall, at_other_wall = (
        [(polygon[:, 1].min(), polygon[:, 1].max(), liquid) for polygon, liquid in zip(section.polygons, section.liquid)
         if numpy.abs(polygon[:, 0] - x).min() < 1e-9] for x in (wall, section.lower[0]))
    lines = numpy.array([line[[0, -1]] for line in section.surface])
    low, high = lines[:, :, 1].min(axis=1), lines[:, :, 1].max(axis=1)
    heights = numpy.arange(section.lower[1] + 0.5 * STEP, section.upper[1], STEP)
    ends = numpy.full(len(heights), numpy.nan)
    for i, z in enumerate(heights):
        here = [liquid for bottom, top, liquid in at_wall if bottom <= z < top]
        if not here or max(here) <= 0.5:
            continue
        crossed = lines[(low <= z) & (z < high)]
        if len(crossed):
            (x0, z0), (x1, z1) = crossed[:, 0].T, crossed[:, 1].T
            ends[i] = (x0 + (z - z0) / (z1 - z0) * (x1 - x0)).max()
        elif any(b <= z < t and liquid > 0.5 for b, t, liquid in at_other_wall):  # liquid from wall to wall
            ends[i] = section.lower[0]
        elif max(here) > FULL and i > 0:  # level surface of the layer: no line crosses this height
            ends[i] = ends[i - 1]
        else:  # a film thinner than the cell at the wall
            ends[i] = wall
    return heights, ends


def points(heights, ends):
    """The five numbers over LENGTH, and the free height; NaN for what is not there."""
    found = dict.fromkeys((*NAMES, "free"), numpy.nan)
    wet = numpy.flatnonzero(~numpy.isnan(ends))
    if len(wet):
        found["free"] = heights[wet[-1]] / LENGTH
    above = numpy.flatnonzero(ends > FLOOR_LAYER)
    if not len(above):
        return found
    start, broken = above[0], numpy.flatnonzero(numpy.isnan(ends[above[0]:]))
    end = start + broken[0] if len(broken) else len(ends)
    film = ends[start:end]
    notch = None
    for i in range(len(film)):  # the first maximum behind which x falls by TURN
        if film[i] == film[:i + 1].max() and len(film[i:]) > 1 and film[i] - running_minimum(film, i) >= TURN:
            notch = i
            break
    found["yC"] = heights[end - 1] / LENGTH
    if notch is None:
        return found
    thinner = numpy.flatnonzero(film[notch + 1:] > film[notch])
    bulge = film[notch:notch + 1 + (thinner[0] if len(thinner) else len(film))]
    head = notch + int(numpy.argmin(bulge))
    found.update(xA=film[notch] / LENGTH, yA=heights[start + notch] / LENGTH, xB=film[head] / LENGTH,
                 yB=heights[start + head] / LENGTH)
    return found


def running_minimum(film, i):
    """The smallest x behind i before x exceeds film[i] again."""
    higher = numpy.flatnonzero(film[i + 1:] > film[i])
    return film[i:i + 1 + (higher[0] if len(higher) else len(film))].min()


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="[LABEL=]RUN")
    parser.add_argument("--picture", type=pathlib.Path)
    arguments = parser.parse_args()
    lines = (here / "reference" / "pozzetti_peters_2018_fig8_points.csv").read_text().splitlines()
    rows = [line.split(",") for line in lines if not line.startswith("#")][1:]
    experiment = {row[0]: float(row[1]) for row in rows}
    print("| run | " + " | ".join(NAMES) + " | free |\n| --- |" + " --- |" * (len(NAMES) + 1))
    for label, column in (("experiment (Sun and Sakai 2015)", 1), ("single-scale, Sun and Sakai", 2), ("multiscale, the paper", 4)):
        print(f"| {label} | " + " | ".join(written(float(row[column]), experiment[row[0]], column > 1) for row in rows) + " | |")
    figure, axes = pyplot.subplots(figsize=(4.2, 5), layout="constrained")
    for number, word in enumerate(arguments.runs):
        label, _, folder = word.rpartition("=")
        section = fields.read(pathlib.Path(folder), TIME)
        heights, ends = attached(section)
        found = points(heights, ends)
        print(f"| {label or pathlib.Path(folder).name} | "
              + " | ".join(written(found[name], experiment[name], True) for name in NAMES) + f" | {found['free']:.3f} |")
        colour = COLOURS[number % len(COLOURS)]
        axes.plot(ends / LENGTH, heights / LENGTH, color=colour, linewidth=1, label=label or pathlib.Path(folder).name,
                  linestyle="-" if number < len(COLOURS) else "--")
    for x, y, name in (("xA", "yA", "A"), ("xB", "yB", "B")):
        axes.plot(experiment[x], experiment[y], "ks", markersize=5, markerfacecolor="none")
        axes.annotate(name, (experiment[x], experiment[y]), xytext=(6, 2), textcoords="offset points")
    axes.plot(1, experiment["yC"], "ks", markersize=5, markerfacecolor="none", label="experiment", clip_on=False)
    axes.set(xlim=(0.6, 1.0), ylim=(0, 1), xlabel="x / 0.2 m", ylabel="z / 0.2 m")
    axes.legend(fontsize=8, loc="upper left")
    if arguments.picture:
        figure.savefig(arguments.picture, dpi=150)
    return 0


def written(value, experiment, with_error):
    if numpy.isnan(value):
        return "-"
    return f"{value:.3f}" + (f" ({100 * (value / experiment - 1):+.1f} %)" if with_error else "")


if __name__ == "__main__":
    sys.exit(main())
