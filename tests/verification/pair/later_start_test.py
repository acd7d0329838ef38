# SPDX-License-Identifier: GPL-3.0-or-later
"""A run whose fluid starts at a later time (controlDict: startFrom, startTime) is the run from 0 at later times: rows of
history.csv, outputs, states to go on from, gravity by a table, windows of one length and of their own, both schedules.

Usage: later_start_test.py DEMVOF FOLDER"""
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from box_case import BoxCase, Open, Particle, SIDES, Wall
from histories import differences
from reporting.run import Run

DEMVOF, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
START, END = 0.25, 0.02  # s
BOUND = 6e-13            # of a quantity's largest value


class LaterStart(unittest.TestCase):
    def case(self, name, begin, start_from="startTime", **coupling):
        beads = [Particle((0.01 + 0.02 * (i % 2), 0.006 + 0.008 * (i // 2 % 2), 0.024 + 0.004 * (i // 4)), 2e-3, 2500, velocity=(0, 0, -0.3))
                 for i in range(12)]
        gravity = [[begin, 0, 0, -9.81], [begin + END, 9, 0, -9.81]]
        case = BoxCase(FOLDER / self._testMethodName / name, (0.04, 0.02, 0.04), (8, 4, 8), (8, 4, 8), begin + END, window=1e-3, level=0.0174,
                       contacts=True, dem_step=1e-5, output_interval=5e-3, tolerance=1e-13, relative_tolerance=1e-6, particles=beads,
                       sides={side: Open() if side == "z+" else Wall() for side in SIDES}, coupling=coupling, sections={"gravity": {"table": gravity}})
        case.write()
        case.write = lambda: case.folder / "case.yaml"  # run() is not to write it anew
        control = case.folder / "fluid" / "system" / "controlDict"
        control.write_text(control.read_text().replace("startFrom startTime; startTime 0;", f"\nstartFrom {start_from};\nstartTime {begin};\n"))
        if begin > 0:
            shutil.copytree(case.folder / "fluid" / "0.orig", case.folder / "fluid" / f"{begin}")  # both are there
        return case

    def compare(self, at_zero, later):
        shift = [time - START for time in later.times]
        self.assertEqual(len(shift), len(at_zero.times))
        for time, other in zip(shift, at_zero.times):
            self.assertAlmostEqual(time, other, delta=1e-12)
        worst = differences(later, at_zero)
        name = max(worst, key=worst.get)
        print(f"{self._testMethodName}: largest difference {worst[name]:.1e}, of {name}")
        self.assertLess(worst[name], BOUND)
        for key in ("exchange", "momentum", "liquid_volume"):
            self.assertLess(later.results["conservation"][key], 1e-11, key)
        self.assertEqual(later.results["steps"]["windows"], at_zero.results["steps"]["windows"])

    def both(self, **coupling):
        return self.case("zero", 0, **coupling).run(DEMVOF), self.case("later", START, **coupling).run(DEMVOF)

    def test_staggered(self):
        self.compare(*self.both())

    def test_concurrent(self):
        self.compare(*self.both(schedule="concurrent"))

    def test_windows_of_their_own(self):
        self.compare(*self.both(window={"tolerance": 0.005, "shortest": 1e-4, "longest": 2e-3}))

    def test_latest_time_and_going_on(self):
        whole = self.case("zero", 0).run(DEMVOF)
        case = self.case("later", START, start_from="latestTime")
        case.run(DEMVOF, "--set", f"coupling.end_time={START + END / 2}")
        out = case.folder / "run"
        done = subprocess.run([DEMVOF, "run", str(case.folder / "case.yaml"), "--out", str(out), "--continue"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        gone_on = Run(out)
        worst = differences(gone_on, whole)
        print(f"{self._testMethodName}: largest difference {max(worst.values()):.1e}")
        self.assertLess(max(worst.values()), BOUND)
        self.assertEqual([f"{float(line.split('timestep=')[1].split(chr(34))[1]) - START:.4f}"
                          for line in (out / "particles" / "particles.pvd").read_text().splitlines() if "timestep=" in line],
                         ["0.0000", "0.0050", "0.0100", "0.0150", "0.0200"])

    def test_folders_of_their_own(self):
        begin = 100000
        case = self.case("digits", begin)
        control = case.folder / "fluid" / "system" / "controlDict"
        text = re.sub("timePrecision [0-9]+;", "timePrecision 6;", control.read_text())
        self.assertIn("timePrecision 6;", text)
        control.write_text(text)
        case.run(DEMVOF)
        names = [folder.name for folder in (case.folder / "run" / "fluid").iterdir() if folder.name[0].isdigit() and "." in folder.name]
        self.assertEqual(sorted(f"{float(name) - begin:.4f}" for name in names), ["0.0050", "0.0100", "0.0150", "0.0200"])

    def test_refused(self):
        for begin, setting, said in ((0.2505, "coupling.end_time=0.271", "startTime: 0.2505 s is not a whole number of windows"),
                                     (START, f"coupling.end_time={START}", "the fluid starts at 0.25 s")):
            case = self.case("refused", begin)
            done = subprocess.run([DEMVOF, "check", str(case.folder / "case.yaml"), "--set", setting], capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 2, done.stdout)
            self.assertIn(said, done.stdout + done.stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
