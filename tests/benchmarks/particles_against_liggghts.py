#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""What demvof adds to LIGGGHTS: 500 000 beads that fall through air (cases/many_particles), beside plain LIGGGHTS with the
same script and the same number of steps.

    particles_against_liggghts.py DEMVOF [--repeats 3] [--windows 20] [--out FILE.json]

Runs both in turn, and reports medians: the time of the DEM steps over that of plain LIGGGHTS; averaging, mapping and
exchange, microseconds per bead and window; memory of dem_side above that of LIGGGHTS, bytes per bead. One rank on each side;
needs two cores that do nothing else."""
import argparse
import json
import os
import pathlib
import re
import shutil
import statistics
import subprocess
import tempfile

CASE = pathlib.Path(__file__).resolve().parents[2] / "cases" / "many_particles"
STEPS_PER_WINDOW, WINDOW = 40, 2e-4  # of the case; s


def run(command, folder):
    """Output and peak memory, bytes, of a program that has to succeed."""
    with tempfile.TemporaryFile("w+") as said:
        process = subprocess.Popen(command, cwd=folder, stdout=said, stderr=subprocess.STDOUT, text=True)
        _, status, usage = os.wait4(process.pid, 0)
        said.seek(0)
        text = said.read()
    if os.waitstatus_to_exitcode(status) != 0:
        raise SystemExit(f"{' '.join(map(str, command))} failed:\n{text[-2000:]}")
    return text, usage.ru_maxrss * 1024


def plain(folder, steps):
    """Loop time, s, and memory of LIGGGHTS alone."""
    script = folder / "particles" / "in.plain"
    script.write_text((folder / "particles" / "in.500000").read_text() + f"\nrun {steps}\n")
    said, memory = run(["liggghts", "-in", script.name, "-log", "none"], script.parent)
    return float(re.findall(r"Loop time of ([\d.e+-]+)", said)[-1]), memory


def coupled(demvof, folder, windows):
    out = folder / "run"
    shutil.rmtree(out, ignore_errors=True)
    run([demvof, "run", "case.yaml", "--out", str(out), "--set", f"coupling.end_time={windows * WINDOW:g}",
         "--set", "output.pictures=[]"], folder)
    results = json.loads((out / "results.json").read_text())
    return results["wall_seconds"], results["peak_memory_bytes"]["particles"], results["particles"]["final"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("demvof", type=pathlib.Path)
    parser.add_argument("--repeats", type=int, default=3)
    parser.add_argument("--windows", type=int, default=20)
    parser.add_argument("--out", type=pathlib.Path)
    options = parser.parse_args()
    demvof = options.demvof.resolve()
    rows = []
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch) / "case"
        shutil.copytree(CASE, folder)
        for _ in range(options.repeats):
            loop, memory = plain(folder, options.windows * STEPS_PER_WINDOW)
            seconds, peak, beads = coupled(demvof, folder, options.windows)
            rows.append({"plain_seconds": loop, "dem_seconds": seconds["particles"], "exchange_seconds": seconds["exchange"],
                         "dem_over_plain": seconds["particles"] / loop,
                         "exchange_microseconds": 1e6 * seconds["exchange"] / beads / options.windows,
                         "bytes_per_bead": (peak - memory) / beads})
            print(json.dumps(rows[-1]), flush=True)
    medians = {key: statistics.median(row[key] for row in rows) for key in rows[0]}
    version = subprocess.run([demvof, "--version"], stdout=subprocess.PIPE, text=True, check=True).stdout.splitlines()[0]
    result = {"version": version, "windows": options.windows, "repeats": options.repeats, "medians": medians, "runs": rows}
    print(json.dumps(medians, indent=2))
    if options.out:
        options.out.write_text(json.dumps(result, indent=2) + "\n")


if __name__ == "__main__":
    main()
