#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""`demvof prepare` cuts a case for any number of ranks, whatever its decomposeParDict was written for:
decompose_test.py DEMVOF [unittest arguments]."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

DEMVOF = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else None

HEADER = "FoamFile {{ version 2.0; format ascii; class {}; object {}; }}\n"
# A box whose longest side is z, then y.
BLOCK_MESH = HEADER.format("dictionary", "blockMeshDict") + """
vertices ((0 0 0) (1 0 0) (1 2 0) (0 2 0) (0 0 3) (1 0 3) (1 2 3) (0 2 3));
blocks (hex (0 1 2 3 4 5 6 7) (4 8 12) simpleGrading (1 1 1));
edges (); boundary (walls { type wall; faces ((0 4 7 3) (1 2 6 5) (0 1 5 4) (3 7 6 2) (0 3 2 1) (4 5 6 7)); });
"""
CONTROL = HEADER.format("dictionary", "controlDict") + """
application foam_side; startFrom startTime; startTime 0; stopAt endTime; endTime 1; deltaT 1; writeInterval 1;
"""
SCHEMES = ("ddtSchemes { default none; } gradSchemes { default none; } divSchemes { default none; } "
           "laplacianSchemes { default none; } interpolationSchemes { default none; } snGradSchemes { default none; }")


class Decompose(unittest.TestCase):
    def setUp(self):
        self.base = pathlib.Path(tempfile.mkdtemp(prefix="demvof-test-"))
        self.addCleanup(shutil.rmtree, self.base)
        for file, text in {"constant/g": "", "0/keep": "", "system/blockMeshDict": BLOCK_MESH, "system/controlDict": CONTROL,
                           "system/fvSchemes": HEADER.format("dictionary", "fvSchemes") + SCHEMES,
                           "system/fvSolution": HEADER.format("dictionary", "fvSolution")}.items():
            (self.base / "fluid" / file).parent.mkdir(parents=True, exist_ok=True)
            (self.base / "fluid" / file).write_text(text)
        (self.base / "case.yaml").write_text(
            "fluid: {case: fluid, prepare: [blockMesh]}\nbulk_grid: {lower: [0, 0, 0], upper: [1, 2, 3], cells: [1, 2, 3]}\n"
            "coupling: {end_time: 1, window: 0.1}\n")

    def prepared(self, ranks, dictionary):
        """What demvof says, and (cells along x, y, z) of the box of each part."""
        file = self.base / "fluid/system/decomposeParDict"
        if dictionary is not None:
            file.write_text(HEADER.format("dictionary", "decomposeParDict") + dictionary)
        done = subprocess.run([DEMVOF, "prepare", "case.yaml", "--set", f"fluid.ranks={ranks}"], cwd=self.base,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=120)
        self.assertEqual(done.returncode, 0, done.stdout)
        if dictionary is not None:
            self.assertIn(dictionary, file.read_text(), "the user's own dictionary was changed")
        parts = sorted((self.base / "run/fluid").glob("processor*"))
        self.assertEqual(len(parts), ranks, done.stdout)
        return done.stdout, {self.shape(part) for part in parts}

    def shape(self, part):
        text = (part / "constant/polyMesh/points").read_text()
        points = re.findall(r"^\(([\d.e+-]+) ([\d.e+-]+) ([\d.e+-]+)\)$", text, re.MULTILINE)
        ends = [[float(point[d]) for point in points] for d in range(3)]
        return tuple(round(4 * (max(along) - min(along))) for along in ends)

    def test_without_a_dictionary_the_longest_side_is_cut(self):
        said, shapes = self.prepared(2, None)
        self.assertIn("there is none; made with method simple", said)
        self.assertEqual(shapes, {(4, 8, 6)})

    def test_a_cut_for_another_number_keeps_its_direction(self):
        said, shapes = self.prepared(4, "numberOfSubdomains 2; method simple; coeffs { n (1 2 1); }\n")
        self.assertIn("n (1 2 1) is not for 4 ranks; changed to (1 4 1) in the copy", said)
        self.assertEqual(shapes, {(4, 2, 12)})

    def test_a_cut_in_two_directions_keeps_both(self):
        said, shapes = self.prepared(8, "numberOfSubdomains 4; method hierarchical;\n"
                                        "hierarchicalCoeffs { n (2 2 1); delta 0.001; order xyz; }\n")
        self.assertIn("changed to (2 4 1)", said)  # y is longer than x
        self.assertEqual(shapes, {(2, 2, 12)})

    def test_a_cut_for_this_number_is_left_alone(self):
        said, shapes = self.prepared(2, "numberOfSubdomains 7; method simple; simpleCoeffs { n (2 1 1); }\n")
        self.assertNotIn("decomposeParDict", said)
        self.assertEqual(shapes, {(2, 8, 12)})

    def test_a_method_without_its_cut_gets_one(self):
        said, shapes = self.prepared(3, "numberOfSubdomains 2; method simple;\n")
        self.assertIn("changed to (1 1 3)", said)
        self.assertEqual(shapes, {(4, 8, 4)})

    def test_a_stub_is_replaced(self):
        said, shapes = self.prepared(2, "numberOfSubdomains 2; method scotch;\n")
        if "stub" in said:  # not where OpenFOAM comes with the real one
            self.assertIn("method scotch is a stub in this OpenFOAM; changed in the copy to method simple", said)
            self.assertEqual(shapes, {(4, 8, 6)})


if __name__ == "__main__":
    unittest.main()
