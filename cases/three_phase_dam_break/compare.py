#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Histories of several runs beside each other (Fig. 6, 9 to 14 of the paper).

compare.py [--picture FILE] [--until SECONDS] --reference RUN [LABEL=]RUN ...: curves of kinetic energy, velocity
integrals, liquid in interface cells, pressure integral and fronts, and two tables: root mean square of the difference
to the reference run over that of the reference run itself, at the times both have; and the largest difference of the
fronts over the length of the box.
"""
import argparse
import math
import pathlib
import sys

import numpy

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parents[1] / "coupler" / "cli"))

from reporting.figures import COLOURS, pyplot  # noqa: E402
from reporting.run import Run  # noqa: E402
from studying.errors import against_history  # noqa: E402

BOX, WIDTH, GRAVITY = 0.2, 0.05, 9.81  # m, m, m/s2
QUANTITIES = {"kinetic_energy_ratio": "kinetic energy / initial potential [-]",
              "velocity_squared_integral": "integral of u.u [m5/s2]",
              "velocity_squared_integral_x": "integral of u_x^2 [m5/s2]",
              "velocity_squared_integral_liquid": "of the liquid [m5/s2]",
              "velocity_squared_integral_gas": "of the gas [m5/s2]",
              "liquid_in_interface_cells": "liquid in interface cells [m3]",
              "pressure_squared_integral": "integral of p^2 [Pa2 m3]",
              "solid_volume_mesh": "solid volume [m3]",
              "fronts": "fronts / 0.05 m [-]"}
FRONTS = ("liquid_front", "solid_front")


def until(run, end):
    kept = run.times <= end * (1 + 1e-9)
    return {name: values[kept] for name, values in run.history.items()}


def tables(runs, reference):
    names = [name for name in QUANTITIES if name != "fronts"]
    lines = ["| run | " + " | ".join(name.replace("_", " ") for name in names) + " | liquid front | solid front |",
             "| --- |" + " --- |" * (len(names) + 2)]
    for label, history in runs.items():
        row = [against_history(history["time"], history[name], reference["time"], reference[name]) for name in names]
        fronts = [numpy.abs(numpy.interp(reference["time"], history["time"], history[name]) - reference[name])
                  [reference["time"] <= history["time"][-1]].max() / BOX for name in FRONTS]
        lines.append(f"| {label} | " + " | ".join(f"{100 * value:.3g} %" for value in row + fronts) + " |")
    return "\n".join(lines)


def draw(runs, file):
    figure, panels = pyplot.subplots(3, 3, figsize=(11, 8.4), layout="constrained")
    for axes, (name, title) in zip(panels.flat, QUANTITIES.items()):
        for colour, (label, history) in zip(COLOURS, runs.items()):
            time = history["time"] * math.sqrt(2 * GRAVITY / WIDTH)
            if name == "fronts":
                for front, style in zip(FRONTS, ("-", "--")):
                    axes.plot(time, history[front] / WIDTH, style, color=colour, linewidth=1)
            else:
                axes.plot(time, history[name], color=colour, linewidth=1, label=label)
        axes.set_title(title, fontsize=10)
        axes.set_xlim(0, None)
    panels[0, 0].legend()
    for axes in panels[-1]:
        axes.set_xlabel("t sqrt(2 g / a)")
    figure.savefig(file, dpi=85)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", nargs="+", metavar="[LABEL=]RUN")
    parser.add_argument("--reference", required=True)
    parser.add_argument("--until", type=float, default=math.inf)
    parser.add_argument("--picture", type=pathlib.Path)
    arguments = parser.parse_args()
    runs = {}
    for word in arguments.runs:
        label, _, folder = word.rpartition("=")
        run = Run(folder)
        runs[label or run.name] = until(run, arguments.until)
    print(tables(runs, until(Run(arguments.reference), arguments.until)))
    if arguments.picture:
        draw(runs, arguments.picture)
    return 0


if __name__ == "__main__":
    sys.exit(main())
