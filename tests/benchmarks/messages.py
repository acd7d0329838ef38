#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Messages, bytes and collectives of the coupler per window and rank, on more and more ranks with equal work each:
messages.py DEMVOF LIBRARY [--ranks 1 2 4 8 16 32] [--folder DIR] [--json FILE]

A closed box of blocks, one per rank of each side, in each 4 x 4 x 4 bulk cells, 8 x 8 x 8 fine ones and 27 beads that sink in
water. LIBRARY (libcount_messages.so) counts what the programs send on the coupler's own communicators in a run of
4 windows and in one of 8; a quarter of the difference is a window's. Counts, not times: the ranks may be many more than cores.
"""
import argparse
import json
import os
import pathlib
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "verification" / "pair"))

from box_case import BoxCase, Particle  # noqa: E402

CELL, BULK, FINE, BEADS = 0.01, 4, 8, 3  # m; cells of a block each way; beads
WINDOW = 1e-3


def blocks(ranks):
    """As near to a cube as powers of two allow, z first: the bulk grid is shared out in layers of z."""
    sides = [1, 1, 1]
    for n in range(ranks.bit_length() - 1):
        sides[2 - n % 3] *= 2
    return sides


def box(folder, ranks, windows):
    sides, edge = blocks(ranks), BULK * CELL
    case = BoxCase(folder, upper=[n * edge for n in sides], fine=[n * FINE for n in sides], bulk=[n * BULK for n in sides],
                   end_time=windows * WINDOW, window=WINDOW, dem_step=WINDOW / 10, contacts=True)
    steps = [(i + 0.5) / BEADS for i in range(BEADS)]
    case.particles = [Particle([(n[a] + at[a]) * edge for a in range(3)], diameter=2e-3, density=2500)
                      for n in ((i, j, k) for i in range(sides[0]) for j in range(sides[1]) for k in range(sides[2]))
                      for at in ((x, y, z) for x in steps for y in steps for z in steps)]
    case_file = case.write()
    (folder / "fluid" / "system" / "decomposeParDict").write_text(
        "FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }\n"
        f"numberOfSubdomains {ranks}; method simple; coeffs {{ n ({' '.join(map(str, sides))}); }}\n")
    return case_file


def counted(options, ranks, windows):
    """What each process counted."""
    folder = options.folder / f"{ranks}_{windows}"
    case_file, counts = box(folder, ranks, windows), folder / "counts"
    shutil.rmtree(counts, ignore_errors=True)
    counts.mkdir()
    done = subprocess.run([options.demvof, "run", case_file, "--out", folder / "run", "--force", "--fluid-ranks", str(ranks),
                           "--particle-ranks", str(ranks), "--set", "coupling.time_out=600"],
                          env={**os.environ, "LD_PRELOAD": str(options.library), "DEMVOF_MESSAGE_COUNTS": str(counts)},
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        sys.exit(done.stdout[-3000:])
    found = [json.loads(file.read_text()) for file in counts.glob("*.json")]
    return [count for count in found if count["program"] in ("foam_side", "dem_side")]


def total(count, what, key):
    return sum(tally[key] for functions in count["tallies"].values() for name, tally in functions.items() if what(name))


def per_window(options, ranks):
    """Of the rank with most: messages, bytes, receivers; collectives by name. Each per window."""
    runs = {windows: counted(options, ranks, windows) for windows in (4, 8)}
    row = {"ranks": ranks}
    for side in ("foam_side", "dem_side"):
        of = {windows: [c for c in found if c["program"] == side] for windows, found in runs.items()}
        to_one = lambda name: name in ("MPI_Isend", "MPI_Issend", "MPI_Send")
        most = {key: {windows: max(total(c, to_one, key) for c in found) for windows, found in of.items()}
                for key in ("calls", "bytes", "receivers")}
        names = {name for c in of[8] for functions in c["tallies"].values() for name in functions if not to_one(name)}
        collectives = {name: max((total(c, name.__eq__, "calls") for c in of[8])) - max(total(c, name.__eq__, "calls") for c in of[4])
                       for name in sorted(names)}
        row[side] = {"messages": (most["calls"][8] - most["calls"][4]) / 4, "bytes": (most["bytes"][8] - most["bytes"][4]) / 4,
                     "receivers": most["receivers"][8],
                     "collectives": {name: calls / 4 for name, calls in collectives.items() if calls}}
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("demvof", type=pathlib.Path)
    parser.add_argument("library", type=pathlib.Path)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 4, 8, 16, 32], help="of each side")
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("messages"))
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args()
    options.demvof, options.library, options.folder = (p.resolve() for p in (options.demvof, options.library, options.folder))
    rows = []
    for ranks in options.ranks:
        rows.append(per_window(options, ranks))
        print(json.dumps(rows[-1]), flush=True)
    if options.json:
        options.json.write_text(json.dumps(rows, indent=1) + "\n")


if __name__ == "__main__":
    main()
