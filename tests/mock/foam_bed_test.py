#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""foam_side beside a bed with prescribed rows (mock_particles), without LIGGGHTS.

Usage: foam_bed_test.py MPIRUN DEMVOF DEMVOF_PAIR FOAM_SIDE MOCK_PARTICLES FOLDER
"""
import json
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "verification" / "pair"))
from box_case import BoxCase, Inlet, Open, Outlet, Particle, Slip, Wall, SIDES, side_means  # noqa: E402
from reporting.run import Run  # noqa: E402

MPIRUN, DEMVOF, PAIR, FOAM_SIDE, MOCK = sys.argv[1:6]
FOLDER = pathlib.Path(sys.argv[6])
WINDOW, FRACTION = 1e-3, 0.4
BED = (0.02, 0.06)


class Bed(unittest.TestCase):
    def case(self, **keys):
        """A channel of 0.02 x 0.02 x 0.08 m. The particle is there for the case file's sake."""
        settings = {"end_time": 10 * WINDOW, "window": WINDOW, "particles": [Particle((0.01, 0.01, 0.01), 1e-3, 2500)],
                    "forces": [{"drag": "gidaspow"}, "pressure_gradient"], "gravity": (0, 0, 0), **keys}
        case = BoxCase(FOLDER / self._testMethodName, (0.02, 0.02, 0.08), (4, 2, 16), (2, 1, 8), **settings)
        self.case_file = case.write()

    def run_bed(self, name, *options, bed=(), ranks=(1, 1)):
        """options: of foam_side; bed: of the stand-in. Returns the Run."""
        out = FOLDER / self._testMethodName / name
        if "--continue" not in options:
            subprocess.run([DEMVOF, "prepare", str(self.case_file), "--out", str(out), "--force",
                            "--set", f"fluid.ranks={ranks[0]}"], check=True, stdout=subprocess.DEVNULL)
        options = [*options, "--set", f"fluid.ranks={ranks[0]}"]
        settings = [word for word in options if word != "--continue"]
        if "--continue" in options:
            settings += ["--continue", str(out)]
        done = subprocess.run(
            [MPIRUN, "--timeout", "100", "-np", str(sum(ranks)), PAIR,
             "-np", str(ranks[0]), FOAM_SIDE, str(self.case_file), "--out", str(out), *options,
             "+", "-np", str(ranks[1]), MOCK, str(self.case_file),
             *([] if "--bed" in bed else ["--bed", *map(str, BED)]),
             "--solid-fraction", str(FRACTION), *map(str, bed), *settings],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout)
        run = Run(out)
        for quantity in ("exchange", "momentum", "solid_volume", "liquid_volume"):
            self.assertLess(run.results["conservation"][quantity], 1e-11, quantity)
        momentum = run.results["momentum"]
        print(f"{self._testMethodName}, {name}: momentum error {momentum['error']}, "
              f"lag {momentum['impulses']['pressure_lag']}")
        self.assertEqual(momentum["windows"], momentum["windows_judged"])
        return run

    def compare(self, a, b, bound):
        """Every row of history.csv."""
        self.assertEqual(list(a.times), list(b.times))
        for name, values in a.history.items():
            if name.startswith("max_speed_"):
                continue  # a place may change from one cell to another of the same speed
            # A component is compared with the largest one: there is no flow across the channel.
            family = [other for other in a.history if other.startswith(name[:-2])]
            scale = max(abs(v) for other in family for v in a.history[other]) or 1
            worst = max(abs(v - w) for v, w in zip(values, b.history[name])) / scale
            self.assertLess(worst, bound, name)

    def stream(self, schedule):
        """Pressure drop of a bed held in a stream: eps grad p = -K u, u = U/eps."""
        velocity, drag = 0.005, 2e6
        sides = {side: Slip() for side in SIDES}
        sides.update({"z-": Inlet((0, 0, velocity)), "z+": Outlet()})
        self.case(sides=sides, velocity=(0, 0, velocity), coupling={"schedule": schedule}, watched={"z-": "p_rgh"})
        runs = [self.run_bed(f"ranks_{ranks[0]}_{ranks[1]}", bed=("--drag", drag), ranks=ranks)
                for ranks in ((1, 1), (2, 1), (2, 2))]
        drop = side_means(runs[0].folder, "z-", "p_rgh")[1][-1]
        expected = drag * velocity / (1 - FRACTION)**2 * (BED[1] - BED[0])
        print(f"{schedule}: pressure drop over expected, less 1: {drop / expected - 1:.2e}")
        self.assertLess(abs(drop / expected - 1), 3e-4)
        for run in runs[1:]:
            self.compare(runs[0], run, 8e-9)  # the pressure solver stops at 1e-10

    def test_stream_staggered(self):
        self.stream("staggered")

    def test_stream_concurrent(self):
        self.stream("concurrent")

    def test_entering_bed_pushes_liquid_out(self):
        """Liquid that the books see leave is that which the bed displaces."""
        sides = {side: Slip() if side[0] != "z" else Wall() for side in SIDES}
        sides["z+"] = Open(alpha=1)
        self.case(sides=sides)
        run = self.run_bed("run", bed=("--velocity", 0.5, "--bed", -0.04, 0.013))
        liquid = run.history["liquid_volume"]
        pushed_out = FRACTION * 0.5 * 10 * WINDOW * 0.02**2
        self.assertLess(abs((liquid[0] - liquid[-1]) / pushed_out - 1), 1e-9)

    def test_still_bed_under_water(self):
        """Weights, the pressure of the floor and the force that holds the bed: nothing moves, and all is balanced."""
        sides = {side: Slip() if side[0] != "z" else Wall() for side in SIDES}
        sides["z+"] = Open()
        self.case(sides=sides, gravity=(0, 0, -9.81), level=0.07)
        run = self.run_bed("run", bed=("--drag", 2e5, "--gravity", 0, 0, -9.81))
        for error in run.results["momentum"]["error"]:
            self.assertLess(error, 1e-8)

    def test_rising_bed_goes_on(self):
        """A bed that rises through the surface of water; the run that stops and goes on is the one that does not. The stand-in books
        the liquid's pressure only: momentum closes where its bed stays below the surface."""
        sides = {side: Slip() if side[0] != "z" else Wall() for side in SIDES}
        sides["z+"] = Open()
        self.case(sides=sides, gravity=(0, 0, -9.81), level=0.055, output_interval=5 * WINDOW)
        bed = ("--drag", 2e4, "--velocity", 0.3, "--gravity", 0, 0, -9.81)
        for schedule in ("staggered", "concurrent"):
            setting = ("--set", f"coupling.schedule={schedule}")
            whole = self.run_bed(f"{schedule}_whole", *setting, bed=bed)
            self.run_bed(f"{schedule}_parts", *setting, "--set", f"coupling.end_time={5 * WINDOW}", bed=bed)
            parts = self.run_bed(f"{schedule}_parts", *setting, "--continue", bed=bed)
            self.assertEqual(parts.results["continued_from"], 5 * WINDOW)
            self.compare(whole, parts, 1e-7)
            earlier = json.loads((parts.folder / "earlier" / "results_1.json").read_text())
            self.assertEqual(earlier["steps"]["windows"], 5)
        self.case(sides=sides, gravity=(0, 0, -9.81), level=0.07, output_interval=5 * WINDOW)
        for error in self.run_bed("below", bed=bed).results["momentum"]["error"]:
            self.assertLess(error, 2e-13)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1], verbosity=2)
