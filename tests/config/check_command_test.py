#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`demvof check` with both real programs: check_command_test.py DEMVOF [unittest arguments]."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

DEMVOF = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else None
HERE = pathlib.Path(__file__).resolve().parent
SETTLING = HERE.parents[1] / "cases" / "settling_particle"


def check(case_file, *settings):
    """Exit code and output of `demvof check`."""
    options = [word for setting in settings for word in ("--set", setting)]
    done = subprocess.run([DEMVOF, "check", case_file, *options], stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                          text=True, timeout=120)
    return done.returncode, done.stdout


class WrongCaseFiles(unittest.TestCase):
    """What needs neither solver is said before one is started."""

    def test_every_bad_case_file_is_refused_with_the_expected_message(self):
        files = sorted((HERE / "bad").glob("*.yaml"))
        self.assertGreaterEqual(len(files), 40)
        for file in files:
            text = file.read_text()
            expected = re.findall("^# expect: (.*)$", text, re.MULTILINE)
            lines = [line.replace("case.yaml", str(file), 1).replace("BAD", str(HERE / "bad"), 1) for line in expected]
            pattern = "\n".join(re.escape(line).replace(r"\*", ".*") for line in lines) + "\n"
            with self.subTest(file.stem):
                code, output = check(file, *re.findall("^# set: (.*)$", text, re.MULTILINE))
                self.assertEqual(code, 2)
                self.assertRegex(output, f"^{pattern}$")


class BothPrograms(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="demvof-test-")) / "case"
        self.addCleanup(shutil.rmtree, self.folder.parent)
        shutil.copytree(SETTLING, self.folder, ignore=shutil.ignore_patterns("run*"))
        self.case = self.folder / "case.yaml"

    def edit(self, file, old, new):
        text = (self.folder / file).read_text()
        self.assertIn(old, text)
        (self.folder / file).write_text(text.replace(old, new))

    def test_a_folder_that_the_solvers_cannot_name(self):
        folder = self.folder.rename(self.folder.parent / "a case")
        code, output = check(folder / "case.yaml")
        self.assertEqual(code, 0, output)
        self.assertIn("beware: beside the case file `demvof run` has no folder to run in", output)
        self.assertIn("take no folder with ' ' in its path", output)

    def refused(self, code, *parts, settings=()):
        said_code, output = check(self.case, *settings)
        self.assertEqual(said_code, code, output)
        for part in parts:
            self.assertIn(part, output)
        self.assertNotIn("ready to run", output)

    def test_a_right_case_shows_its_scene_and_is_left_as_it_is(self):
        before = sorted(self.folder.rglob("*"))
        code, output = check(self.case)
        self.assertEqual(code, 0, output)
        for reason in ("The script gives 1 particles at the start.", "The fluid case's coefficient is 0",
                       "The fluid case is laminar.", "They are always left out", "The case is ready to run."):
            self.assertIn(reason, output)
        self.assertEqual(before, sorted(self.folder.rglob("*")))

    def test_without_particles_it_is_plain_vof(self):
        code, output = check(self.case, "scene.particles=off")
        self.assertEqual(code, 0, output)
        for reason in ("The case file says scene.particles: off.", "There are no particles."):
            self.assertIn(reason, output)

    def test_a_window_between_dem_steps(self):
        self.refused(2, "0.000125 s is not a whole number of DEM steps of 0.0001 s", settings=["coupling.window=1.25e-4", "coupling.end_time=0.5"])

    def test_a_bulk_grid_smaller_than_the_mesh(self):
        self.refused(2, "bulk_grid", "0.1", "0.108", settings=["bulk_grid.upper=[0.1, 0.108, 0.3456]"])

    def test_surface_tension_forced_in_vain(self):
        self.refused(2, "scene.surface_tension: on is impossible: the fluid case's coefficient is 0",
                     settings=["scene.surface_tension=on"])

    def test_two_gravities(self):
        self.edit("fluid/constant/g", "-9.81", "-1.62")
        self.refused(2, "gravity", "-1.62", "-9.81")

    def test_a_table_without_gravity_in_it(self):
        code, output = check(self.case, "gravity.table=[[0, 2, 0, 0]]")
        self.assertEqual(code, 0, output)
        self.assertIn("beware: gravity.table begins with [2, 0, 0] m/s2, constant/g and fix gravity have [0, 0, -9.81]", output)
        code, output = check(self.case, "gravity.table=[[0, 0, 0, -9.81], [1, 2, 0, -9.81]]")
        self.assertNotIn("gravity.table begins", output)

    def test_a_table_that_no_particle_feels(self):
        self.edit("particles/in.settling_particle", "fix             gravity", "#")
        self.refused(2, "in.settling_particle: gravity.table needs a 'fix gravity'", settings=["gravity.table=[[0, 0, 0, -9.81]]"])

    def test_a_mesh_that_cannot_be_made(self):
        self.edit("fluid/system/blockMeshDict", "(10 10 32)", "(10 10 thirty)")
        self.refused(2, "blockMesh failed", "blockMeshDict")

    def test_a_command_that_is_not_there(self):
        self.refused(2, "no_such_mesher failed (exit code 127)", settings=["fluid.prepare=[no_such_mesher]"])

    def test_a_script_that_liggghts_does_not_understand(self):
        self.edit("particles/in.settling_particle", "create_atoms ", "create_beads ")
        self.refused(2, "create_beads")

    def test_a_fluid_case_without_schemes(self):
        (self.folder / "fluid/system/fvSchemes").unlink()
        self.refused(2, "fvSchemes")


if __name__ == "__main__":
    unittest.main()
