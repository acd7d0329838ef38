# SPDX-License-Identifier: GPL-3.0-or-later
"""How runs of the real pair end: exit codes, messages, results.json. Usage: endings_test.py DEMVOF FOLDER"""
import os
import pathlib
import signal
import sys
import time
import unittest

from pair import Pair, dam_break, replace

DEMVOF, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
LONG_RUN = ("--set", "coupling.end_time=0.5")  # minutes: every test here ends it long before


class Endings(unittest.TestCase):
    def setUp(self):
        self.folder = FOLDER / self._testMethodName
        self.case_file = dam_break(self.folder)

    def run_pair(self, *options):
        return Pair(DEMVOF, self.case_file, self.folder / "run", *options)

    def check_killed(self, victim, fallback_results):
        pair = self.run_pair(*LONG_RUN)
        pair.wait_for_window(3)
        killed = time.monotonic()
        os.kill(pair.pids(victim)[0], signal.SIGKILL)
        code, text = pair.wait(30)
        self.assertLess(time.monotonic() - killed, 10)
        self.assertEqual(code, 4, text)
        self.assertIn(f"{victim} rank 0", text)
        self.assertEqual(pair.pids(fallback_results), [], "the fallback_results must be gone")
        results = pair.results()
        self.assertEqual(results["status"], "failed")
        self.assertIn(victim, results["failure"]["message"])

    def test_fluid_killed(self):
        self.check_killed("foam_side", "dem_side")

    def test_particles_killed(self):
        self.check_killed("dem_side", "foam_side")

    def check_interrupted(self, number):
        pair = self.run_pair(*LONG_RUN)
        pair.wait_for_window(3)
        os.kill(pair.process.pid, number)
        code, text = pair.wait(30)
        self.assertEqual(code, 3, text)
        results = pair.results()
        self.assertEqual(results["status"], "interrupted")
        self.assertGreaterEqual(results["steps"]["windows"], 3)
        rows = (pair.out / "history.csv").read_text().splitlines()
        self.assertEqual(len(rows[-1].split(",")), len(rows[0].split(",")), "the last row is whole")

    def test_control_c(self):
        self.check_interrupted(signal.SIGINT)

    def test_sigterm(self):
        self.check_interrupted(signal.SIGTERM)

    def test_particle_script_with_an_error(self):
        replace(self.case_file.parent / "particles" / "in.dam_break", "fix             gravity all gravity 9.81",
                "fix             gravity all gravitation 9.81")
        code, text = self.run_pair(*LONG_RUN).wait(60)
        self.assertIn(code, (2, 3), text)
        self.assertIn("dem_side", text)
        self.assertIn("ERROR", text)

    def test_fluid_case_with_an_error(self):
        replace(self.case_file.parent / "fluid" / "system" / "fvSchemes", "div(rhoPhi,U)", "div(rhoPhi,V)")
        code, text = self.run_pair(*LONG_RUN).wait(60)
        self.assertIn(code, (2, 3), text)
        self.assertIn("foam_side", text)
        self.assertIn("div(rhoPhi,U)", text)

    def test_gravity_of_the_two_sides_differs(self):
        replace(self.case_file.parent / "particles" / "in.dam_break", "gravity 9.81 vector", "gravity 1.62 vector")
        code, text = self.run_pair(*LONG_RUN).wait(60)
        self.assertEqual(code, 2, text)
        self.assertIn("gravity", text)
        self.assertIn("9.81", text)
        self.assertIn("1.62", text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
