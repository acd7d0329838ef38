# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of a pair for the tests of this folder, and what befalls them: PROGRAM DEMVOF LIBRARY FOLDER [--long] [unittest arguments]"""
import json
import os
import pathlib
import random
import subprocess
import sys
import unittest

TESTS = pathlib.Path(__file__).resolve().parents[1]
sys.path[:0] = [str(TESTS / "support"), str(TESTS / "verification" / "pair")]
from pair import wait_for_signs  # noqa: E402
from small_pair import beads_into_water  # noqa: E402

LONG = "--long" in sys.argv
DEMVOF, LIBRARY = map(os.path.abspath, sys.argv[1:3])
FOLDER = pathlib.Path(sys.argv[3])
RANDOM = random.Random(14)


def main():
    unittest.main(argv=sys.argv[:1] + [word for word in sys.argv[4:] if word != "--long"], verbosity=2)


def demvof(case_file, out, *options, fault=None, silence=60):
    """Exit code and what was printed; silence: s in which a run that lives leaves a trace."""
    environment = dict(os.environ)
    if fault:
        environment.update(LD_PRELOAD=f"{LIBRARY}:{environment.get('LD_PRELOAD', '')}", DEMVOF_FAULT=fault)
    force = [] if "--continue" in options else ["--force"]
    process = subprocess.Popen([DEMVOF, "run", str(case_file), "--out", str(out), *force, *options], env=environment, text=True,
                               errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
    return wait_for_signs(process, out, silence)


def status(out):
    return json.loads((out / "results.json").read_text())


class Injected(unittest.TestCase):
    def setUp(self):
        self.folder = FOLDER / self._testMethodName
        self.case_file = beads_into_water(self.folder)
        self.out = self.folder / "run"

    def whole(self, *options):
        """history.csv of the run that nothing befell."""
        out = self.folder / "whole"
        code, text = demvof(self.case_file, out, *options)
        self.assertEqual(code, 0, text)
        return (out / "history.csv").read_text()

    def continues(self, whole):
        code, text = demvof(self.case_file, self.out, "--continue")
        self.assertEqual(code, 0, text)
        self.assertEqual((self.out / "history.csv").read_text(), whole)
