#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Cells that move between the ranks of the fluid change nothing: balanced_ranks_test.py DEMVOF FOLDER

A cloud of beads flies along a closed box that is cut across its way, and the fine part of the mesh goes with it. The cloud is
below a surface of water, through which it comes out at the end.
"""
import pathlib
import subprocess
import sys
import unittest

from box_case import BoxCase, Particle
from histories import differences
from pair import wait_for_signs
from reporting.run import Run

DEMVOF, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])
CUT = ("FoamFile { version 2.0; format ascii; class dictionary; object decomposeParDict; }\n"
       "numberOfSubdomains 2;\nmethod simple;\ncoeffs { n (2 1 1); }\n")
END = 0.03


class BalancedRanks(unittest.TestCase):
    def setUp(self):
        beads = [Particle((0.012 + 0.004 * (i % 3), 0.006 + 0.008 * (i // 3 % 2), 0.012 + 0.008 * (i // 6)), 2e-3, 4000,
                          velocity=(2.5, 0, 0.3)) for i in range(12)]
        # Sums over ranks differ in their last digit: what the solver leaves has to be less than what is compared.
        self.case = BoxCase(FOLDER / self._testMethodName, (0.1, 0.02, 0.04), (20, 4, 8), (20, 4, 8), END, window=1e-3, level=0.03,
                            contacts=True, dem_step=1e-5, output_interval=5e-3, particles=beads,
                            tolerance=1e-13, relative_tolerance=1e-6, extra_files={"fluid/system/decomposeParDict": CUT},
                            sections={"fluid": {"refinement": {"levels": 2, "particles": True}}})
        self.case_file = self.case.write()

    def run_case(self, name, *options):
        out = FOLDER / self._testMethodName / name
        process = subprocess.Popen([DEMVOF, "run", str(self.case_file), "--out", str(out), "--fluid-ranks", "2", *options],
                                   text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
        code, text = wait_for_signs(process, out, 60)
        self.assertEqual(code, 0, text)
        run = Run(out)
        cells = run.results["cells"]
        print(f"{self._testMethodName}, {name}: most cells on a rank over the mean {cells['imbalance']:.3f}, moved "
              f"{cells['rank_changes']} times in {cells['mesh_changes']} changes, {run.results['conservation']}, "
              f"momentum {run.results['momentum']['error']}")
        return run

    def check_books(self, run):
        for quantity, error in run.results["conservation"].items():
            self.assertLess(error, 1e-12, quantity)

    def compare(self, a, b, bound, *quantities):
        self.assertEqual(list(a.times), list(b.times))
        worst = {name: value for name, value in differences(b, a).items() if name in (quantities or a.history)}
        name = max(worst, key=worst.get)
        print(f"{self._testMethodName}: largest difference {worst[name]:.1e}, of {name}")
        self.assertLess(worst[name], bound)

    def test_cloud_across_the_cut(self):
        """The run that stops and goes on has its cells on other ranks than those that decomposePar gave them to."""
        kept = self.run_case("kept", "--set", "fluid.refinement.max_imbalance=100")
        self.assertEqual(kept.results["cells"]["rank_changes"], 0)
        self.assertGreater(kept.results["cells"]["imbalance"], 1.4)
        moved = self.run_case("moved")
        self.assertGreater(moved.results["cells"]["rank_changes"], 3)
        self.assertLess(moved.results["cells"]["imbalance"], 1.15)
        self.check_books(moved)
        self.compare(kept, moved, 6e-7, "particle_kinetic_energy")
        self.compare(kept, moved, 3e-5, "kinetic_energy")
        self.compare(kept, moved, 1.1e-3, "max_speed")  # of the air
        self.assertEqual(kept.results["cells"]["mesh_changes"], moved.results["cells"]["mesh_changes"])
        self.run_case("parts", "--set", f"coupling.end_time={END / 2}")
        parts = self.run_case("parts", "--continue")
        self.assertEqual(parts.results["continued_from"], END / 2)
        self.assertGreater(parts.results["cells"]["rank_changes"], 0)
        self.check_books(parts)
        self.compare(moved, parts, 1.8e-8)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
