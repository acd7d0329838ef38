#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Messages, bytes and collectives of the coupler per window and rank, on more and more ranks with equal work each:

    messages.py DEMVOF LIBRARY [--ranks 1 2 4 8 16 32] [--edge 4] [--turned] [--folder DIR] [--record]
    messages.py --check

A closed box of blocks, one per rank of each side, in each 4 x 4 x 4 bulk cells (--edge: per direction), twice as many fine ones in
each direction and 27 beads that sink in water. LIBRARY (libcount_messages.so) counts what the programs send on the coupler's own
communicators in a run of 4 windows and in one of 8; a quarter of the difference is a window's. Counts, not times: the ranks may
be many more than cores. --turned: the fluid's ranks have other parts of the mesh than its owners have of the bulk grid, with x for z.
--record: to messages.json beside this, in place of rows with the same options. --check: exit code 1 where messages.json has more
receivers than neighbours, a collective that moves a number per rank, or rows that docs/performance.md does not show.
"""
import argparse
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECORD, PAGE = pathlib.Path(__file__).with_suffix(".json"), ROOT / "docs" / "performance.md"
CELL, BEADS, WINDOW = 0.01, 3, 1e-3  # m; beads of a block each way; s
TO_ONE = ("MPI_Isend", "MPI_Issend", "MPI_Send")
NEIGHBOURS = 26
MOVE_NO_NUMBER_PER_RANK = {"MPI_Allreduce", "MPI_Iallreduce", "MPI_Ibarrier", "MPI_Ibcast", "MPI_Bcast"}


def blocks(ranks):
    """As near to a cube as powers of two allow."""
    sides = [1, 1, 1]
    for n in range(ranks.bit_length() - 1):
        sides[2 - n % 3] *= 2
    return sides


def cut(ranks, edge):
    """Bulk cells of other blocks around the one that has most of them."""
    around = [min(n - 1, 2) for n in blocks(ranks)]
    return (edge + around[0]) * (edge + around[1]) * (edge + around[2]) - edge ** 3


def box(folder, ranks, windows, options):
    sys.path.insert(0, str(ROOT / "tests" / "verification" / "pair"))
    from box_case import BoxCase, Particle
    sides, bulk, edge = blocks(ranks), options.edge, options.edge * CELL
    case = BoxCase(folder, upper=[n * edge for n in sides], fine=[2 * n * bulk for n in sides], bulk=[n * bulk for n in sides],
                   end_time=windows * WINDOW, window=WINDOW, dem_step=WINDOW / 10, contacts=True)
    steps = [(i + 0.5) / BEADS for i in range(BEADS)]
    case.particles = [Particle([(n[a] + at[a]) * edge for a in range(3)], diameter=2e-3, density=2500)
                      for n in ((i, j, k) for i in range(sides[0]) for j in range(sides[1]) for k in range(sides[2]))
                      for at in ((x, y, z) for x in steps for y in steps for z in steps)]
    case_file = case.write()
    parts = sides[::-1] if options.turned else sides
    (folder / "fluid" / "system" / "decomposeParDict").write_text(
        "FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }\n"
        f"numberOfSubdomains {ranks}; method simple; coeffs {{ n ({' '.join(map(str, parts))}); }}\n")
    return case_file


def counted(options, ranks, windows):
    """What each process counted."""
    folder = options.folder / f"{ranks}_{windows}"
    case_file, counts = box(folder, ranks, windows, options), folder / "counts"
    shutil.rmtree(counts, ignore_errors=True)
    counts.mkdir()
    done = subprocess.run([options.demvof, "run", case_file, "--out", folder / "run", "--force", "--fluid-ranks", str(ranks),
                           "--particle-ranks", str(ranks), "--set", "coupling.time_out=1800"],
                          env={**os.environ, "LD_PRELOAD": str(options.library), "DEMVOF_MESSAGE_COUNTS": str(counts)},
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
    if done.returncode:
        sys.exit(done.stdout[-3000:])
    found = [json.loads(file.read_text()) for file in counts.glob("*.json")]
    return [count for count in found if count["program"] in ("foam_side", "dem_side")]


def total(count, key):
    return sum(tally[key] for functions in count["tallies"].values() for name, tally in functions.items() if name in TO_ONE)


def receivers(count):
    return sum(len({rank for name, tally in functions.items() if name in TO_ONE for rank in tally["receivers"]})
               for functions in count["tallies"].values())


def calls(count, name):
    return sum(functions[name]["calls"] for functions in count["tallies"].values() if name in functions)


def per_window(options, ranks):
    """Of the rank with most: messages, bytes, receivers; collectives by name. Each per window."""
    runs = {windows: counted(options, ranks, windows) for windows in (4, 8)}
    row = {"ranks": ranks, "edge": options.edge, "turned": options.turned, "commit": commit(options.demvof), "cut": cut(ranks, options.edge)}
    for side in ("foam_side", "dem_side"):
        of = {windows: [c for c in found if c["program"] == side] for windows, found in runs.items()}
        most = {key: {windows: max(total(c, key) for c in found) for windows, found in of.items()} for key in ("calls", "bytes")}
        names = {name for c in of[8] for functions in c["tallies"].values() for name in functions if name not in TO_ONE}
        collectives = {name: (max(calls(c, name) for c in of[8]) - max(calls(c, name) for c in of[4])) / 4 for name in sorted(names)}
        row[side] = {"messages": (most["calls"][8] - most["calls"][4]) / 4, "bytes": (most["bytes"][8] - most["bytes"][4]) / 4,
                     "receivers": max(map(receivers, of[8])),
                     "collectives": {name: count for name, count in collectives.items() if count}}
    return row


def commit(demvof):
    said = subprocess.run([demvof, "--version"], capture_output=True, text=True, check=True).stdout
    return re.search(r"\((.*)\)", said.splitlines()[0])[1]


def line(row):
    """Of the table in the page."""
    sides = [f"{row[side]['messages']:.0f}, {row[side]['bytes'] / 1000:.3g}, {row[side]['receivers']}"
             for side in ("foam_side", "dem_side")]
    return f"| {row['ranks']} + {row['ranks']} | {row['edge']} | {'yes' if row['turned'] else 'no'} | {row['cut']} | {sides[0]} | {sides[1]} |"


def check():
    page, wrong = PAGE.read_text(), []
    for row in json.loads(RECORD.read_text())["rows"]:
        if line(row) not in page:
            wrong.append(f"{PAGE.name} does not have\n  {line(row)}")
        for side in ("foam_side", "dem_side"):
            # Its neighbours, and its likes of the other program: one, since both have as many ranks.
            if not row["turned"] and row[side]["receivers"] > min(row["ranks"] - 1, NEIGHBOURS) + 1:
                wrong.append(f"{side} of {line(row)} has {row[side]['receivers']} receivers")
            dense = set(row[side]["collectives"]) - MOVE_NO_NUMBER_PER_RANK
            if dense:
                wrong.append(f"{side} of {line(row)}: {dense}")
    print("\n".join(wrong) or f"{RECORD.name} is as it should be, and in {PAGE.name}")
    return 1 if wrong else 0


def key(row):
    return (row["turned"], row["edge"], row["ranks"])


def main():
    if sys.argv[1:] == ["--check"]:
        sys.exit(check())
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("demvof", type=pathlib.Path)
    parser.add_argument("library", type=pathlib.Path)
    parser.add_argument("--ranks", type=int, nargs="+", default=[1, 2, 4, 8, 16, 32], help="of each side")
    parser.add_argument("--edge", type=int, default=4, help="bulk cells of a rank in each direction")
    parser.add_argument("--turned", action="store_true")
    parser.add_argument("--folder", type=pathlib.Path, default=pathlib.Path("messages"))
    parser.add_argument("--record", action="store_true")
    options = parser.parse_args()
    options.demvof, options.library, options.folder = (p.resolve() for p in (options.demvof, options.library, options.folder))
    for ranks in options.ranks:
        row = per_window(options, ranks)
        print(json.dumps(row), flush=True)
        if options.record:
            rows = json.loads(RECORD.read_text())["rows"] if RECORD.exists() else []
            rows = sorted([other for other in rows if key(other) != key(row)] + [row], key=key)
            RECORD.write_text(json.dumps({"command": "tests/benchmarks/messages.py DEMVOF LIBRARY --ranks RANKS --edge EDGE "
                                                     "[--turned] --record", "rows": rows}, indent=1) + "\n")


if __name__ == "__main__":
    main()
