#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The check.py of each case, on runs made here: inside every bound, and outside each one in turn."""
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

CASES = pathlib.Path(__file__).resolve().parents[2] / "cases"
MASS = 2500 * math.pi / 6 * 2.7e-3**3  # of a bead, kg


def results(**changes):
    good = {"status": "completed", "particles": {"initial": 3883, "lost": 0}, "cells": {"fine_max": 48000},
            "steps": {"fluid": 500}, "configuration": {"bulk_grid": {"lower": [0, 0, 0], "upper": [1, 1, 0.3456],
                                                                    "cells": [1, 1, 16]}},
            "conservation": {"exchange": 1e-14, "momentum": 0, "solid_volume": 1e-14, "liquid_volume": 1e-14}}
    for path, value in changes.items():
        place, _, key = path.rpartition("__")
        (good[place] if place else good)[key] = value
    return good


def history(**columns):
    """The text of history.csv, times 0, 0.1, 0.2, ..."""
    length = max(len(column) for column in columns.values())
    columns = {"time": [0.1 * n for n in range(length)], **columns}
    rows = [",".join(map(str, row)) for row in zip(*columns.values())]
    return "\n".join([",".join(columns), "# " + ",".join("-" for _ in columns), *rows]) + "\n"


class CaseChecks(unittest.TestCase):
    def verdict(self, case, facts, table):
        folder = pathlib.Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, folder)
        (folder / "results.json").write_text(json.dumps(facts))
        (folder / "history.csv").write_text(table)
        done = subprocess.run([sys.executable, CASES / case / "check.py", folder], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout + done.stderr

    def expect(self, case, facts, table, refused):
        """refused: a word of the one line that must say NOT; empty: none may."""
        code, printed = self.verdict(case, facts, table)
        lines = [line for line in printed.splitlines() if line.startswith("NOT")]
        self.assertEqual((code, len(lines)), (1, 1) if refused else (0, 0), printed)
        self.assertTrue(not refused or refused in lines[0], printed)

    def test_dam_break_with_beads(self):
        def table(energy=(0.25, 0.2502, 0.2), speed=(0, 6.1, 2)):  # 1.5 times the clear-water peak is 6.15 m/s
            return history(mechanical_energy=energy, max_speed=speed, max_speed_x=(0, 0, 0), max_speed_y=(0, 0, 0),
                           max_speed_z=(0, 0, 0))

        case = "three_phase_dam_break"
        self.expect(case, results(), table(), "")
        self.expect(case, results(status="interrupted"), table(), "status")
        self.expect(case, results(particles__lost=1), table(), "lost")
        self.expect(case, results(conservation__exchange=1e-11), table(), "exchange")
        self.expect(case, results(conservation__solid_volume=1e-11), table(), "solid volume")
        self.expect(case, results(conservation__liquid_volume=1e-4), table(), "liquid volume")
        self.expect(case, results(conservation__exchange=None), table(), "exchange")
        self.expect(case, results(), table(energy=(0.25, 0.2504, 0.2)), "energy")
        self.expect(case, results(), table(speed=(0, 6.2, 2)), "speed")

    def test_dam_break_without_beads_follows_the_measured_front(self):
        measured = [tuple(map(float, line.split(","))) for line in
                    (CASES / "three_phase_dam_break" / "reference" / "martin_moyce_1952_n2_front.csv").read_text().splitlines()
                    if line[0].isdigit()]
        scale = math.sqrt(0.05 / (2 * 9.81))  # s per unit of T
        clear = results(particles__initial=0)

        def table(stretch, shift):
            rows = [(0, 0.05)] + [((t + shift) * scale, 0.05 * z * stretch) for t, z in measured]
            text = "time,liquid_front,max_speed,max_speed_x,max_speed_y,max_speed_z\n# -,-,-,-,-,-\n"
            return text + "".join(f"{t},{x},1,0,0,0\n" for t, x in rows)

        self.expect("three_phase_dam_break", clear, table(1.0, -0.15), "")
        self.expect("three_phase_dam_break", clear, table(0.5, 0.0), "front")
        self.expect("three_phase_dam_break", clear, table(1.0, -0.15).rsplit("\n", 6)[0] + "\n", "front")  # too short

    def test_settling_particle(self):
        def table(speed):
            return history(particle_kinetic_energy=[0.5 * MASS * v * v for v in (0, 0.2, 0.3, speed, speed, speed)])

        self.expect("settling_particle", results(), table(0.3430), "")
        self.expect("settling_particle", results(), table(0.3460), "")
        self.expect("settling_particle", results(), table(0.3470), "terminal")
        self.expect("settling_particle", results(), table(0.3390), "terminal")

    def test_hydrostatic_bed(self):
        self.expect("hydrostatic_bed", results(), history(max_speed=(0, 9e-7)), "")
        self.expect("hydrostatic_bed", results(), history(max_speed=(0, 2e-6, 0)), "speed")
        self.expect("hydrostatic_bed", results(steps__fluid=99), history(max_speed=(0, 0)), "steps")

    def test_no_run_is_no_verdict(self):
        done = subprocess.run([sys.executable, CASES / "hydrostatic_bed" / "check.py", "/nowhere"], capture_output=True,
                              text=True, check=False)
        self.assertEqual(done.returncode, 2)


if __name__ == "__main__":
    unittest.main()
