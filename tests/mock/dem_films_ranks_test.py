#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A cloud of spheres with films between them has the same velocities on 1, 2 and 4 ranks, to the last bit.

Usage: dem_films_ranks_test.py MPIRUN MOCK_DEM_LUBRICATION FOLDER
"""
import os
import pathlib
import subprocess
import sys

mpirun, program = sys.argv[1:3]
folder = pathlib.Path(sys.argv[3])
folder.mkdir(parents=True, exist_ok=True)


def velocities(ranks):
    file = folder / f"velocities_{ranks}"
    file.unlink(missing_ok=True)
    subprocess.run([mpirun, "--timeout", "120", "-np", str(ranks), program, "--gtest_filter=*KeepsTheMomentumOfACloud"],
                   check=True, env={**os.environ, "DEMVOF_CLOUD_FILE": str(file)}, stdout=subprocess.DEVNULL)
    return [[float(v) for v in line.split()] for line in file.read_text().splitlines()]


reference = velocities(1)
assert len(reference) == 800 and any(v != w for v, w in zip(reference, reference[400:]))
for ranks in (2, 4):
    worst = max(abs(v - w) for row, other in zip(reference, velocities(ranks)) for v, w in zip(row, other))
    print(f"{ranks} ranks: largest difference {worst:.1e} m/s")
    assert worst == 0, worst
