#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Fig. 28 of the paper from study.json of study_fig28.yaml: cost_figure.py STUDY_JSON [--picture FILE].

Prints a table: time of a step of the fluid (all parts, without start and end of the run), relative to the mesh that
is as coarse as the bulk grid, and its parts. The picture has both axes as the paper's: time and fine cells over those
of the single-scale run of the same number of beads.
"""
import argparse
import json
import pathlib
import sys

here = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(here.parents[1] / "coupler" / "cli"))

from reporting.figures import COLOURS, SIZE, pyplot  # noqa: E402

PARTS = ("fluid", "particles", "exchange")
STEPS = 20
BULK_CELLS = 625


def read(path):
    """{beads: [(fine cells, {part: seconds per step}, peak memory of both sides in bytes)]}, the single-scale run first."""
    found = {}
    for row in json.loads(path.read_text())["rows"]:
        if row["status"] != "completed":
            print(f"{row['name']}: {row['status']}", file=sys.stderr)
            continue
        beads = int(row["name"].split("_")[0])
        parts = {part: row["parts_seconds"][part] / STEPS for part in PARTS}
        found.setdefault(beads, []).append((row["cells"]["fine_max"], parts, row["peak_memory_bytes"]))
    for beads, runs in found.items():
        runs.sort(key=lambda run: run[0])
        if runs[0][0] != BULK_CELLS:
            sys.exit(f"{beads} beads: no single-scale run ({BULK_CELLS} cells) to relate the others to")
    return found


def total(parts):
    return sum(parts.values())


def table(found):
    lines = ["| beads | fine cells | fluid | particles | exchange | step | over single-scale | memory, both sides |",
             "| --- | --- | --- | --- | --- | --- | --- | --- |"]
    for beads, runs in found.items():
        for cells, parts, memory in runs:
            each = " | ".join(f"{1e3 * parts[part]:.3g} ms" for part in PARTS)
            lines.append(f"| {beads} | {cells} | {each} | {1e3 * total(parts):.3g} ms | "
                         f"{total(parts) / total(runs[0][1]):.2f} | {memory / 1e6:.0f} MB |")
    return "\n".join(lines)


def draw(found, file):
    figure, axes = pyplot.subplots(figsize=SIZE, layout="constrained")
    for (beads, runs), colour in zip(found.items(), COLOURS):
        axes.plot([cells / runs[0][0] for cells, _, _ in runs], [total(parts) / total(runs[0][1]) for _, parts, _ in runs],
                  "o-", color=colour, markersize=4, label=f"{beads} bead{'s' if beads > 1 else ''}")
    axes.set(xscale="log", yscale="log", xlabel="fine cells / those of the single-scale run",
             ylabel="time / that of the single-scale run")
    axes.legend()
    figure.savefig(file)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=pathlib.Path)
    parser.add_argument("--picture", type=pathlib.Path)
    arguments = parser.parse_args()
    found = read(arguments.study)
    print(table(found))
    if arguments.picture:
        draw(found, arguments.picture)
    return 0 if found else 1


if __name__ == "__main__":
    sys.exit(main())
