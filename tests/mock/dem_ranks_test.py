#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A heap of colliding beads gives the same bulk fields on 1, 2 and 3 ranks of dem_side.

Usage: dem_ranks_test.py MPIRUN DEMVOF_PAIR DEM_SIDE MOCK_FLUID CASE FOLDER
"""
import pathlib
import subprocess
import sys

mpirun, pair, dem_side, mock_fluid, case = sys.argv[1:6]
folder = pathlib.Path(sys.argv[6])
folder.mkdir(parents=True, exist_ok=True)


def bulk_fields(dem_ranks, fluid_ranks):
    """Cell -> solid volume, drag factor, drag response, drag impulse, drag-weighted velocity."""
    name = f"bulk_{dem_ranks}_{fluid_ranks}"
    subprocess.run(
        [mpirun, "--timeout", "60", "-np", str(dem_ranks + fluid_ranks), pair,
         "-np", str(dem_ranks), dem_side, case, "--out", str(folder / name), "+",
         "-np", str(fluid_ranks), mock_fluid, case, "--left-over", "1e-9", "--bulk-file", str(folder / name)],
        check=True)
    fields = {}
    for path in folder.glob(f"{name}.*"):
        for line in path.read_text().splitlines():
            cell, *values = line.split()
            fields[int(cell)] = [float(value) for value in values]
        path.unlink()
    return fields


reference = bulk_fields(1, 1)
assert len(reference) > 100, f"only {len(reference)} active cells"
scale = [max(abs(row[m]) for row in reference.values()) for m in range(5)]
for ranks in [(2, 1), (3, 1), (2, 2)]:
    fields = bulk_fields(*ranks)
    assert fields.keys() == reference.keys(), f"{ranks}: other active cells"
    worst = max(abs(fields[cell][m] - row[m]) / scale[m] for cell, row in reference.items() for m in range(5))
    print(f"dem_side on {ranks[0]}, fluid on {ranks[1]} ranks: largest difference {worst:.1e}")
    assert worst < 1e-9, f"{ranks}: {worst:.3e}"
