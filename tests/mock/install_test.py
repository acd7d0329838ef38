#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""An installed tree, moved, runs a case and makes its report while sources and build folder are out of reach:
install_test.py CMAKE SOURCE BUILD."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

CMAKE, SOURCE, BUILD = sys.argv[1:4]

# Root can hide the two folders from a process; who is not sees at least that nothing points to them.
HIDE = ["unshare", "--mount", "sh", "-c", f'mount -t tmpfs none "{SOURCE}" && exec "$@"', "sh"]
CAN_HIDE = os.geteuid() == 0 and subprocess.run(HIDE + ["true"], capture_output=True).returncode == 0


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.base = pathlib.Path(tempfile.mkdtemp(prefix="demvof-test-"))
        cls.addClassCleanup(shutil.rmtree, cls.base)
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", cls.base / "first"], check=True, capture_output=True)
        cls.tree = (cls.base / "first").rename(cls.base / "moved")

    def demvof(self, *arguments):
        command = [*(HIDE if CAN_HIDE else []), self.tree / "bin/demvof", *arguments]
        done = subprocess.run(command, cwd=self.base, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def test_nothing_points_to_the_sources(self):
        self.assertEqual([path for path in self.tree.rglob("*") if path.is_symlink()], [])
        for program in ("demvof", "demvof_pair", "foam_side", "dem_side"):
            header = subprocess.run(["readelf", "-d", self.tree / "bin" / program], capture_output=True, text=True).stdout
            self.assertNotIn(SOURCE, header)

    def test_it_runs_a_case_and_reports(self):
        shutil.copytree(self.tree / "share/demvof/cases/hydrostatic_bed", self.base / "bed")
        self.demvof("run", "bed/case.yaml", "--set", "coupling.end_time=0.01", "--set", "output.interval=0")
        self.assertIn("report.html", self.demvof("report", "bed/run"))
        self.assertTrue((self.base / "bed/run/report.html").exists())

    def test_a_study_finds_its_parts(self):
        (self.base / "study.yaml").write_text("case: bed.yaml\nquantities: [kinetic_energy]\n")
        done = subprocess.run([self.tree / "bin/demvof", "study", "study.yaml"], cwd=self.base, capture_output=True, text=True)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)  # read by its own parts, and found wanting
        self.assertIn("study.yaml", done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
