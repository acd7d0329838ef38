#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`demvof new`: new_command_test.py DEMVOF [unittest arguments].

The inputs are those of a tutorial: a dam of water whose Allrun makes the mesh, and a script for liggghts alone."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

DEMVOF = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else None
FLUID = pathlib.Path(__file__).resolve().parents[2] / "cases" / "hydrostatic_bed" / "fluid"
ALLRUN = """#!/bin/sh
. $WM_PROJECT_DIR/bin/tools/RunFunctions
restore0Dir
runApplication blockMesh
runApplication setFields          # the dam
runApplication $(getApplication)
"""
SCRIPT = """# beads that fall into a box
units si
atom_style granular
atom_modify map array
boundary f f f
newton off
communicate single vel yes
processors 2 1 1
read_data beads.data
neighbor 1e-3 bin
neigh_modify delay 0
fix kn all property/global kn peratomtypepair 1 1000.
fix kt all property/global kt peratomtypepair 1 285.7
fix gamman all property/global gamman peratomtypepair 1 590.3
fix gammat all property/global gammat peratomtypepair 1 295.1
fix mu all property/global coefficientFriction peratomtypepair 1 0.3
pair_style gran model hooke/stiffness tangential history
pair_coeff * *
timestep 1.3e-5
fix gravity all gravity 9.81 vector 0 0 -1
fix integrate all nve/sphere
thermo 1000
run 100000 upto      # two hours
"""
DATA = """
2 atoms
1 atom types
0 0.0612345678 xlo xhi
0 0.06 ylo yhi
0 0.12 zlo zhi

Atoms

1 1 0.003 {density} 0.03 0.03 0.03
2 1 0.004 {density} 0.02 0.03 0.05
"""


class NewCase(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="demvof-test-"))
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copytree(FLUID, self.folder / "dam")
        mesh = self.folder / "dam" / "system" / "blockMeshDict"
        mesh.write_text(mesh.read_text().replace("(6 0 ", "(6.12345678 0 ").replace("(6 6 ", "(6.12345678 6 "))
        control = self.folder / "dam" / "system" / "controlDict"
        control.write_text(control.read_text().replace("writePrecision  10;", "writePrecision  6;")
                           .replace("stopAt          endTime;\n", "stopAt endTime; "))
        (self.folder / "dam" / "Allrun").write_text(ALLRUN)
        (self.folder / "beads").mkdir()
        (self.folder / "beads" / "in.beads").write_text(SCRIPT)
        self.beads(2500)

    def beads(self, density):
        (self.folder / "beads" / "beads.data").write_text(DATA.format(density=density))

    def new(self, *words):
        words = words or ("tank", "--fluid", "dam", "--particles", "beads/in.beads")
        done = subprocess.run([DEMVOF, "new", *words], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, timeout=120)
        return done.returncode, done.stdout

    def setting(self, key):
        found = re.search(rf"^ *(?:- )?{key}: *\[?([^\]#\n]*)", (self.folder / "tank" / "case.yaml").read_text(), re.MULTILINE)
        return found[1].strip() if found else None

    def numbers(self, key):
        return [float(word) for word in self.setting(key).split(",")]

    def test_the_case_is_ready_to_run(self):
        before = {file: file.read_bytes() for file in self.folder.rglob("*") if file.is_file()}
        code, said = self.new()
        self.assertEqual(code, 0, said)
        self.assertIn("The case is ready to run.", said)
        self.assertIn("line 8: 'processors 2 1 1'", said)
        self.assertIn("'run 100000 upto      # two hours': taken out", said)
        self.assertEqual({file: file.read_bytes() for file in before}, before)
        self.assertEqual(self.setting("prepare"), "blockMesh, setFields")
        self.assertEqual(self.numbers("lower"), [0, 0, 0])
        self.assertEqual(self.numbers("upper"), [0.0612345678, 0.06, 0.12])
        self.assertEqual(self.numbers("cells"), [5, 5, 10])  # 12 mm: three times the larger bead
        window = self.numbers("window")[0]
        self.assertAlmostEqual(window / 1.3e-5, round(window / 1.3e-5), places=6)
        self.assertLessEqual(window, 0.1 * 0.012 / (2 * 9.81 * 0.12)**0.5 * (1 + 1e-9))
        self.assertAlmostEqual(self.numbers("end_time")[0] / window, round(self.numbers("end_time")[0] / window), places=6)
        self.assertLess(abs(self.numbers("end_time")[0] / 0.1 - 1), 0.01)
        self.assertNotIn("  - added_mass", (self.folder / "tank" / "case.yaml").read_text())
        run = subprocess.run([DEMVOF, "run", "tank/case.yaml", "--set", f"coupling.end_time={2 * window:.12g}", "--quiet"],
                             cwd=self.folder, capture_output=True, text=True, timeout=120)
        self.assertEqual(run.returncode, 0, run.stdout + run.stderr)

    def test_light_beads_get_their_added_mass(self):
        self.beads(300)
        code, said = self.new()
        self.assertEqual(code, 0, said)
        self.assertIn("  - added_mass: 0.5", (self.folder / "tank" / "case.yaml").read_text())
        self.assertNotIn("without added_mass", said)

    def test_what_is_left_to_do_is_said(self):
        g = self.folder / "dam" / "constant" / "g"
        g.write_text(g.read_text().replace("-9.81", "-9.7"))
        code, said = self.new()
        self.assertEqual(code, 2, said)
        self.assertIn("gravity, m/s2 (constant/g, fix gravity): foam_side has '0 0 -9.7'", said)
        self.assertIn("tank/case.yaml is written; what stands in its way is said above", said)

    def test_mistakes(self):
        (self.folder / "there").mkdir()
        for words, message in ((("there", "--fluid", "dam", "--particles", "beads/in.beads"), "there: is there already"),
                               (("tank", "--fluid", "beads", "--particles", "beads/in.beads"), "no OpenFOAM case"),
                               (("tank", "--fluid", "dam", "--particles", "in.beads"), "there is no file in.beads"),
                               (("tank", "--fluid", "dam"), "--particles")):
            with self.subTest(message):
                code, said = self.new(*words)
                self.assertEqual(code, 2, said)
                self.assertIn(message, said)
                self.assertFalse((self.folder / "tank").exists())


if __name__ == "__main__":
    unittest.main()
