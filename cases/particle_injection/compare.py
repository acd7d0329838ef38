#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Levels and velocity integrals of several runs: compare.py [--picture FILE] [--json FILE] [LABEL=]RUN ...

Left the mean level against time, right the integral of u.u over the box, which the paper calls the L2 norm of the
velocity; a colour for each fine mesh, the column dashed. Printed: the level in the end against 0.3 m + volume of the beads over the floor, the largest integral, and the
mean of the last 0.2 s.
"""
import argparse
import json
import math
import pathlib
import sys

here = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(here), str(here.parent.parent / "coupler" / "cli")]

from check import BEADS, FLOOR, LEVEL  # noqa: E402
from reporting.figures import COLOURS, pyplot  # noqa: E402
from reporting.run import Run  # noqa: E402


def facts(label, run):
    count, diameter = BEADS[pathlib.Path(run.setting("particles.script")).name]
    level, integral, times = run.history["mean_level"], run.history["velocity_squared_integral"], run.times
    late = times >= times[-1] - 0.2
    return {"run": label, "fine_cells": run.number("cells.fine_max"), "script": run.setting("particles.script"),
            "end": float(times[-1]), "level": float(level[-1]), "highest_level": float(level.max()),
            "exact_level": LEVEL + count * math.pi / 6 * diameter**3 / FLOOR,
            "largest_integral": float(integral.max()), "largest_at": float(times[integral.argmax()]),
            "late_integral": float(integral[late].mean()), "wall_seconds": run.number("wall_seconds.total"),
            "conservation": run.results.get("conservation"), "lost": run.number("particles.lost")}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="[LABEL=]RUN")
    parser.add_argument("--picture", help="default: none")
    parser.add_argument("--json", help="the numbers; default: none")
    arguments = parser.parse_args()

    figure, (levels, integrals) = pyplot.subplots(1, 2, figsize=(9.6, 3.6))
    table, meshes = [], []
    for word in arguments.runs:
        label, _, folder = word.rpartition("=")
        run = Run(folder)
        row = facts(label or run.name, run)
        table.append(row)
        if row["fine_cells"] not in meshes:
            meshes.append(row["fine_cells"])
        look = {"label": row["run"], "color": COLOURS[meshes.index(row["fine_cells"]) % len(COLOURS)],
                "linestyle": "--" if row["script"].endswith("column") else "-"}
        levels.plot(run.times, 1e3 * run.history["mean_level"], **look)
        integrals.semilogy(run.times[1:], run.history["velocity_squared_integral"][1:], **look)
        print(f"{row['run']:<16} level at {row['end']:.2f} s {row['level']:.6f} m (exact {row['exact_level']:.6f}, highest "
              f"{row['highest_level']:.6f})   integral: largest {row['largest_integral']:.2e} at {row['largest_at']:.2f} s, "
              f"last 0.2 s {row['late_integral']:.2e} m5/s2")
    for exact in sorted({row["exact_level"] for row in table}):
        levels.axhline(1e3 * exact, color="#9aa4ad", linewidth=0.8, linestyle="--")
    levels.set(xlabel="t, s", ylabel="mean level, mm")
    integrals.set(xlabel="t, s", ylabel="integral of u.u, m5/s2")
    levels.legend(fontsize=8)
    figure.tight_layout()
    if arguments.picture:
        figure.savefig(arguments.picture, dpi=100)
    if arguments.json:
        pathlib.Path(arguments.json).write_text(json.dumps(table, indent=1) + "\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
