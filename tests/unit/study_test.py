#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""demvof study on a stand-in for demvof, whose runs have known errors and wall times."""
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import textwrap
import time
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "coupler" / "cli" / "study.py"
sys.path.insert(0, str(SCRIPT.parent))

from studying.plan import BadStudy, assignment, read_plan  # noqa: E402

# Writes q(t) = t (1 + error) for t = 0.1 .. 1; coupling.window is the error, wall time 1 / window.
STAND_IN = """#!/usr/bin/python3
import json, pathlib, sys, time, yaml
words = sys.argv[1:]
if words == ["--version"]:
    print("demvof stand-in"); sys.exit(0)
with open(pathlib.Path(__file__).parent / "calls", "a") as calls:
    calls.write(" ".join(words) + "\\n")
if (pathlib.Path(__file__).parent / "slow").exists():
    time.sleep(60)
out = pathlib.Path(words[words.index("--out") + 1]); out.mkdir(parents=True, exist_ok=True)
settings = dict(w.split("=", 1) for w in words if "=" in w)
error = float(yaml.safe_load(settings["coupling.window"]))
if error > 1:
    (out / "results.json").write_text(json.dumps({"status": "failed", "failure": {"message": "too long"}}))
    print("window too long"); sys.exit(3)
(out / "results.json").write_text(json.dumps({"status": "completed", "wall_seconds": {"total": 1 / max(error, 1e-3),
    "fluid": 1}, "peak_memory_bytes": {"fluid": 5, "particles": 7}, "configuration": settings}))
rows = ["time,q"] + [f"{0.1 * i},{0.1 * i * (1 + error)}" for i in range(1, 11)]
(out / "history.csv").write_text("\\n".join(rows) + "\\n")
"""

STUDY = """
case: case.yaml
quantities: [q]
reference: {row: finest}
rows:
  coarse: {single_scale: yes, set: {coupling.window: 0.5}}
  fine: {single_scale: yes, set: {coupling.window: 0.1}}
  multi: {set: {coupling.window: 0.2}}
  better: {set: {coupling.window: 0.01}}
  broken: {set: {coupling.window: 2}}
  finest: {set: {coupling.window: 0}}
"""


class Study(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)
        (self.folder / "case.yaml").write_text("fluid: {case: fluid}\n")
        self.demvof = self.folder / "demvof"
        self.demvof.write_text(STAND_IN)
        self.demvof.chmod(0o755)
        self.study = self.folder / "errors.yaml"
        self.study.write_text(STUDY)

    def tearDown(self):
        self.temporary.cleanup()

    def make(self, *options):
        done = subprocess.run([sys.executable, str(SCRIPT), str(self.study), "--demvof", str(self.demvof), *options],
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                              env={**os.environ, "MPLCONFIGDIR": str(self.folder)})
        path = self.folder / "run_errors" / "study.json"
        return done, json.loads(path.read_text()) if path.exists() else None

    def calls(self):
        return len((self.folder / "calls").read_text().splitlines())

    def test_errors_times_and_sentences(self):
        done, found = self.make()
        self.assertEqual(done.returncode, 3, done.stdout)  # one row fails
        rows = {row["name"]: row for row in found["rows"]}
        for name, error in (("coarse", 0.5), ("fine", 0.1), ("multi", 0.2), ("better", 0.01), ("finest", 0)):
            self.assertAlmostEqual(rows[name]["errors"]["q"], error, places=9)
        self.assertEqual(rows["fine"]["wall_seconds"], 10)
        self.assertEqual(rows["fine"]["peak_memory_bytes"], 12)
        self.assertEqual(rows["broken"]["status"], "failed")
        self.assertIn("too long", rows["broken"]["failure"])
        self.assertIn("0.50 times the time of the cheapest single-scale run that does, fine",
                      " ".join(found["statements"]))
        self.assertTrue(any("better" in line and "no single-scale run reaches that" in line
                            for line in found["statements"]))
        page = (self.folder / "run_errors" / "study.html").read_text()
        self.assertIn("data:image/png;base64", page)
        self.assertNotIn("http://", page)

    def test_the_part_of_the_time_is_told_apart(self):
        self.study.write_text(STUDY.replace("{set: {coupling.window: 0.2}}",
                                            "{set: {coupling.window: 0.2}, converged_in_time: fine}"))
        done, found = self.make()
        rows = {row["name"]: row for row in found["rows"]}
        self.assertAlmostEqual(rows["multi"]["errors_in_time"]["q"], 1.2 / 1.1 - 1, places=9)
        self.assertEqual(rows["coarse"]["errors_in_time"], {})
        self.assertRegex(done.stdout, r"multi .* 20 % \(time 9.09 %\)")

    def test_goes_on_where_it_was(self):
        self.make()
        first = self.calls()
        self.make()
        self.assertEqual(self.calls(), first + 1)  # the row that failed
        self.study.write_text(STUDY.replace("window: 0.1", "window: 0.11"))
        self.make()
        self.assertEqual(self.calls(), first + 3)  # the changed row and the failed one

    def begin(self):
        return subprocess.Popen([sys.executable, str(SCRIPT), str(self.study), "--demvof", str(self.demvof)],
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                                # as a shell starts what runs in the background
                                preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_IGN))

    def wait_for_a_run(self):
        until = time.monotonic() + 120
        while not (self.folder / "calls").exists() and time.monotonic() < until:
            time.sleep(0.05)
        self.assertEqual(self.calls(), 1)

    def test_killed_and_started_again(self):
        (self.folder / "slow").touch()
        killed = self.begin()
        self.wait_for_a_run()
        killed.kill()
        (self.folder / "slow").unlink()
        killed.communicate(timeout=30)  # nobody holds its output any more: the run has ended, too
        _, found = self.make()
        self.assertEqual({row["status"] for row in found["rows"]}, {"completed", "failed"})
        self.assertEqual(self.calls(), 1 + 6)  # the killed run and all rows

    def test_two_at_a_time_wait_for_each_other(self):
        (self.folder / "slow").touch()
        first = self.begin()
        self.wait_for_a_run()
        second = self.begin()
        line = second.stdout.readline()
        (self.folder / "slow").unlink()
        self.assertIn("waiting", line)
        first.terminate()
        first.communicate(timeout=30)
        second.communicate(timeout=60)
        self.assertEqual(self.calls(), 1 + 6)

    def test_no_runs_and_only(self):
        done, found = self.make("--no-runs")
        self.assertEqual({row["status"] for row in found["rows"]}, {"not run"})
        done, found = self.make("--only", "fine")
        self.assertEqual(self.calls(), 1)
        done, _ = self.make("--only", "fin")
        self.assertEqual(done.returncode, 2)

    def test_median_of_repeats(self):
        self.study.write_text(STUDY + "repeat: 3\n")
        _, found = self.make("--only", "fine")
        self.assertEqual(len({row["name"]: row for row in found["rows"]}["fine"]["wall_seconds_of_runs"]), 3)

    def test_mistakes_are_named(self):
        for text, said in ((STUDY.replace("quantities", "quantitys"), "did you mean quantities"),
                           (STUDY.replace("row: finest", "row: finset"), "there is no row finset"),
                           (STUDY.replace("{set: {coupling.window: 0.2}}", "{converged_in_time: fin}"),
                            "multi.converged_in_time: there is no row fin"),
                           (STUDY.replace("case.yaml", "cas.yaml"), "there is no file"),
                           (STUDY.replace("{row: finest}", "{rows: finest}"), "is not allowed; give"),
                           ("case: case.yaml\nquantities: [q]\nreference: {exact: {q: 1}}\n", "rows: missing")):
            with self.subTest(said):
                self.study.write_text(text)
                with self.assertRaisesRegex(BadStudy, said):
                    read_plan(self.study)

    def test_sweep_makes_every_combination(self):
        self.study.write_text(textwrap.dedent("""
            case: case.yaml
            quantities: [q]
            reference: {exact: {q: 1}}
            set: {coupling.end_time: 1}
            sweep: {coupling.window: [0.1, 0.2], coupling.averaging.kernel: [linear, gaussian]}
            """))
        plan = read_plan(self.study)
        self.assertEqual([row.name for row in plan.rows],
                         ["window_0.1+kernel_linear", "window_0.1+kernel_gaussian", "window_0.2+kernel_linear",
                          "window_0.2+kernel_gaussian"])
        self.assertEqual(plan.rows[0].settings["coupling.end_time"], 1)

    def test_settings_as_yaml(self):
        self.assertEqual(assignment("a.b", [1, 2]), "a.b=[1, 2]")
        self.assertEqual(assignment("a", "on"), "a='on'")
        self.assertEqual(assignment("a", {"levels": 2}), "a={levels: 2}")
        self.assertEqual(assignment("a", 0.0005), "a=0.0005")


if __name__ == "__main__":
    unittest.main()
