#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""A run that stopped and goes on is the run that did not stop: continued_test.py DEMVOF FOLDER [--long]

Water sloshes in a slanted field of gravity and twelve beads fall through its surface.
"""
import json
import os
import pathlib
import signal
import subprocess
import sys
import unittest

from box_case import BoxCase, Cyclic, Open, Particle, Wall, SIDES
from histories import differences
from pair import Pair, wait_for_signs
from reporting.run import Run

BOUND = 2e-7  # of a quantity's largest value; the pressure solver stops at 1e-10
# Sums over ranks differ in their last digit, and with that the pressure solver may stop an iteration earlier: what it
# leaves has to be less than what is compared.
SOLVED = {"tolerance": 1e-13, "relative_tolerance": 1e-6}
DRIVEN = ("FoamFile { version 2.0; format ascii; class dictionary; object fvOptions; }\n"
          "drive { type meanVelocityForce; selectionMode all; fields (U); Ubar (0 0.1 0); relaxation 0.1; }\n")
DEMVOF, FOLDER = sys.argv[1], pathlib.Path(sys.argv[2])


class Continued(unittest.TestCase):
    def case(self, fine=(8, 4, 8), **keys):
        beads = [Particle((0.01 + 0.02 * (i % 2), 0.006 + 0.008 * (i // 2 % 2), 0.024 + 0.004 * (i // 4)), 2e-3, 2500,
                          velocity=(0, 0, -0.3)) for i in range(12)]
        keys = {"particles": beads, "sides": {side: Open() if side == "z+" else Wall() for side in SIDES}, **keys}
        case = BoxCase(FOLDER / self._testMethodName, (0.04, 0.02, 0.04), fine, (8, 4, 8), 0.03, window=1e-3,
                       level=0.0174, gravity=(5, 0, -8.4), contacts=True, dem_step=1e-5, output_interval=5e-3, **keys)
        self.case_file = case.write()

    def run_case(self, name, *options):
        """Exit code and what was printed."""
        out = FOLDER / self._testMethodName / name
        force = [] if "--continue" in options else ["--force"]
        process = subprocess.Popen([DEMVOF, "run", str(self.case_file), "--out", str(out), *force, *options], text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
        return *wait_for_signs(process, out, 60), out

    def run_to(self, name, end_time, *options):
        code, text, out = self.run_case(name, "--set", f"coupling.end_time={end_time}", *options)
        self.assertEqual(code, 0, text)
        return out

    def compare(self, whole, parts, bound=BOUND, times=True):
        """Every row of history.csv, and what ParaView finds."""
        a, b = Run(whole), Run(parts)
        self.assertEqual(list(a.times), list(b.times))
        worst = differences(b, a)
        name = max(worst, key=worst.get)
        print(f"{self._testMethodName}: largest difference {worst[name]:.1e}, of {name}")
        self.assertLess(worst[name], bound)
        for series in ("particles/particles.pvd", "bulk/bulk.pvd"):
            self.assertEqual((whole / series).read_text(), (parts / series).read_text())
        if not times:
            return
        times = [sorted(f.name for f in (out / "fluid").iterdir() if f.name[0].isdigit()) for out in (whole, parts)]
        self.assertEqual(*times)

    def check_same(self, *options, bound=BOUND, windows=15):
        whole = self.run_to("whole", 0.03, *options)
        parts = self.run_to("parts", 0.015, *options)
        self.run_to("parts", 0.03, "--continue", *options)
        results = json.loads((parts / "results.json").read_text())
        self.assertEqual(results["continued_from"], 0.015)
        if windows:
            self.assertEqual(results["steps"]["windows"], windows)
        for quantity, error in results["conservation"].items():
            self.assertLess(error, 1e-11, quantity)
        earlier = json.loads((parts / "earlier" / "results_1.json").read_text())["steps"]["windows"]
        self.assertEqual(earlier, windows or len(Run(whole).times) - 1 - results["steps"]["windows"])
        self.compare(whole, parts, bound)

    def test_refining_mesh(self):
        self.case(sections={"fluid": {"refinement": {"levels": 2}}})
        self.check_same()

    def test_four_ranks(self):
        self.case(**SOLVED)
        self.check_same("--fluid-ranks", "2", "--particle-ranks", "2", bound=1.2e-11)

    def test_beads_on_a_periodic_end(self):
        """When the state is written some are beyond the end, where LIGGGHTS leaves them until its next neighbour list."""
        beads = [Particle((0.01 + 0.02 * (i % 2), 0.0183 + 1e-4 * i, 0.024 + 0.004 * (i // 2)), 2e-3, 2500,
                          velocity=(0, 0.1, -0.1)) for i in range(6)]
        sides = {side: Cyclic() if side[0] == "y" else Open() if side == "z+" else Wall() for side in SIDES}
        self.case(particles=beads, sides=sides, script_tail="neighbor 2e-3 bin\n", **SOLVED)
        self.check_same(bound=2e-13)

    def test_other_fluid_ranks(self):
        """On one rank, on two, on one again."""
        self.case(forces=[{"drag": "schiller_naumann"}, "pressure_gradient", {"added_mass": 0.5}], **SOLVED)
        whole = self.run_to("whole", 0.03)
        parts = self.run_to("parts", 0.01)
        self.run_to("parts", 0.02, "--continue", "--fluid-ranks", "2")
        self.assertEqual(sum(f.is_dir() for f in (parts / "earlier").iterdir()), 1)
        code, text, _ = self.run_case("parts", "--continue")
        self.assertEqual(code, 0, text)
        self.assertIn("dividing the state for 1 in place of 2 fluid ranks", text)
        self.compare(whole, parts, bound=1.4e-10, times=False)

    def test_other_fluid_ranks_on_a_refining_mesh(self):
        self.case(sections={"fluid": {"refinement": {"levels": 1}}})
        part = self.run_to("parts", 0.005)
        self.check_refused(part, "on a mesh that changes it has to stay", "--fluid-ranks", "2")

    def test_driven(self):
        """A mean velocity force has its gradient from the steps before; on one rank, and on one, two, one."""
        sides = {side: Cyclic() if side[0] == "y" else Open() if side == "z+" else Wall() for side in SIDES}
        self.case(sides=sides, extra_files={"fluid/constant/fvOptions": DRIVEN}, **SOLVED)
        self.check_same(bound=1e-300)
        whole, name = FOLDER / self._testMethodName / "whole", "uniform/driveProperties"
        files = json.loads((whole / "restart" / "latest.json").read_text())["files"]
        self.assertIn(f"fluid/0.03/{name}", files)
        self.run_to("two", 0.01)
        self.run_to("two", 0.02, "--continue", "--fluid-ranks", "2")
        parts = FOLDER / self._testMethodName / "two"
        files = json.loads((parts / "restart" / "latest.json").read_text())["files"]
        for rank in range(2):
            self.assertIn(f"fluid/processor{rank}/0.02/{name}", files)
        self.run_to("two", 0.03, "--continue")
        self.compare(whole, parts, bound=9e-8, times=False)  # as much as one and two ranks differ that do not stop

    def test_insertion(self):
        """Places, sizes and times of what the script puts in."""
        self.case(script_tail="""region source block 0.004 0.036 0.004 0.016 0.030 0.038 units box
fix bead all particletemplate/sphere 15485863 atom_type 1 density constant 2500 radius constant 1e-3
fix small all particletemplate/sphere 32452867 atom_type 1 density constant 2500 radius constant 0.8e-3
fix beads all particledistribution/discrete 15485867 2 bead 0.5 small 0.5
fix inject all insert/rate/region seed 32452843 distributiontemplate beads nparticles 60 particlerate 2000 &
    insert_every 200 overlapcheck yes vel uniform 0. 0. -0.1 0.02 0.02 0.02 region source ntry_mc 10000
""")
        whole, parts = self.run_to("whole", 0.03), self.run_to("parts", 0.015)
        self.run_to("parts", 0.03, "--continue")
        inserted = [json.loads((run / "results.json").read_text())["particles"]["inserted"] for run in (whole, parts)]
        self.assertGreater(inserted[1], 20)
        self.assertGreater(inserted[0], inserted[1] + 20)
        self.compare(whole, parts)

    def test_concurrent(self):
        self.case()
        self.check_same("--set", "coupling.schedule=concurrent")

    def test_windows_of_their_own_lengths(self):
        self.case(first_step=1e-4)
        self.check_same("--set", "coupling.window={tolerance: 5e-3, shortest: 1e-4, longest: 4e-3}", bound=1e-300, windows=None)
        windows = Run(FOLDER / self._testMethodName / "parts").history["window"][1:]
        self.assertGreater(max(windows), 4 * min(windows))
        self.check_refused(FOLDER / self._testMethodName / "parts", "coupling.window was a map: windows of their own lengths",
                           "--set", "coupling.end_time=0.04")

    def test_shaken(self):
        self.case(first_step=1e-4, sections={"gravity": {"table": [[0, 5, 0, -8.4], [0.0063, -5, 1, -9], [0.0152, 4, 0, -6],
                                                                   [0.0249, -3, 0, -12]]}})
        self.check_same("--set", "coupling.window={tolerance: 5e-3, shortest: 1e-4, longest: 4e-3}", bound=1e-300, windows=None)

    def test_order_two(self):
        self.case(first_step=1e-4, forces=[{"drag": "schiller_naumann"}, "pressure_gradient", {"added_mass": 0.5}])
        self.check_same("--set", "coupling.order=2", "--set",
                        "coupling.window={tolerance: 5e-3, shortest: 1e-4, longest: 4e-3}", bound=1e-300, windows=None)

    def test_volume_adding(self):
        self.case()
        self.check_same("--set", "coupling.phase_interchange=volume_adding")
        self.check_refused(FOLDER / self._testMethodName / "parts", "the flow had no void fraction",
                           "--set", "coupling.end_time=0.035")

    @unittest.skipUnless("--long" in sys.argv, "a minute: with --long")
    def test_replacement(self):
        self.case(fine=(32, 16, 32), sections={"fluid": {"refinement": {"levels": 1, "particles": True}}})
        self.check_same("--set", "coupling.phase_interchange=replacement", bound=1e-5)

    def test_without_porosity(self):
        self.case()
        self.check_same("--set", "scene.porosity=off")

    def test_added_mass_and_other_kernel(self):
        self.case(forces=[{"drag": "schiller_naumann"}, "pressure_gradient", "viscous_stress", {"added_mass": 0.5}])
        self.check_same("--set", "coupling.averaging.kernel=linear")

    def test_other_forces(self):
        """What particles carry differs with the forces: what both have goes on, the rest begins, or goes. Of the beads' energy
        that is 2.2e-4 in ten windows."""
        few = "[{drag: schiller_naumann}, pressure_gradient]"
        many = "[{drag: schiller_naumann}, pressure_gradient, viscous_stress]"
        beads = [Particle((0.01 + 0.02 * (i % 2), 0.006 + 0.008 * (i // 2 % 2), 0.004 + 0.004 * (i // 4)), 2e-3, 2500,
                          velocity=(0, 0, 0.1)) for i in range(12)]  # in the water
        self.case(particles=beads, **SOLVED)
        whole = self.run_to("whole", 0.02, "--particle-ranks", "2", "--set", "forces=" + few)
        for first, then in ((few, many), (many, few)):
            parts = self.run_to("parts", 0.01, "--particle-ranks", "2", "--set", "forces=" + first)
            code, text, _ = self.run_case("parts", "--continue", "--set", "coupling.end_time=0.02", "--set", "forces=" + then)
            self.assertEqual(code, 0, text)
            difference = differences(Run(parts), Run(whole))["particle_kinetic_energy"]
            print(f"test_other_forces: {difference:.1e}")
            self.assertLess(difference, 6e-4)
            for quantity, error in Run(parts).results["conservation"].items():
                self.assertLess(error, 1e-11, quantity)

    def check_stopped(self, stop):
        """stop: what to do to the run; returns what it ended with."""
        self.case(fine=(40, 20, 40))
        pair = Pair(DEMVOF, self.case_file, FOLDER / self._testMethodName / "parts")
        pair.wait_for_window(12, 1200)  # under a sanitizer, too
        stop(pair)
        code, text = pair.wait(60)
        self.assertNotEqual(code, 0, text)
        parts = self.run_to("parts", 0.03, "--continue")
        return self.run_to("whole", 0.03), parts

    def test_after_a_kill(self):
        def kill(pair):
            for number in pair.pids("foam_side") + pair.pids("dem_side"):
                os.kill(number, signal.SIGKILL)
        self.compare(*self.check_stopped(kill))

    def test_after_control_c(self):
        whole, parts = self.check_stopped(lambda pair: os.kill(pair.process.pid, signal.SIGINT))
        extra = [f for f in (parts / "fluid").iterdir() if not (whole / "fluid" / f.name).exists()]
        stopped = round(Run(parts).results["continued_from"] / 1e-3)
        self.assertGreaterEqual(stopped, 12)
        self.assertEqual(len(extra), 0 if stopped % 5 == 0 else 1, "the window in which it was stopped is an output more")
        self.assertEqual((whole / "history.csv").read_text(), (parts / "history.csv").read_text())

    def check_refused(self, part, message, *options):
        code, text, _ = self.run_case("parts", "--continue", *options)
        self.assertEqual(code, 2, text)
        self.assertIn(message, text)
        self.assertTrue((part / "results.json").exists(), "what was there is there")

    def test_refusals(self):
        self.case()
        code, text, _ = self.run_case("nothing", "--continue")
        self.assertEqual(code, 2, text)
        self.assertIn("latest.json; a run of a pair leaves one", text)
        part = self.run_to("parts", 0.01)
        self.check_refused(part, "coupling.window was 0.001 s", "--set", "coupling.window=5e-4")
        self.check_refused(part, "coupling.schedule was staggered", "--set", "coupling.schedule=concurrent")
        self.check_refused(part, "bulk_grid.cells was [8, 4, 8]", "--set", "bulk_grid.cells=[4,4,8]")
        self.check_refused(part, "is at 0.01 s already", "--set", "coupling.end_time=0.01")
        self.check_refused(part, "is of another fluid case", "--set", "fluid.prepare=[blockMesh]")
        self.check_refused(part, "give one", "--force")
        script = self.case_file.parent / "particles" / "in.particles"
        script.write_text(script.read_text().replace("${continued} == 1", "${continued} == 2"))
        self.check_refused(part, "has to read ${restart_file}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1] + [word for word in sys.argv[3:] if word != "--long"])
