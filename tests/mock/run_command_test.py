#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The real `demvof` beside stand-ins for foam_side and dem_side: run_command_test.py DEMVOF [unittest arguments].

The stand-ins are shell scripts that do what the environment variables FLUID and PARTICLES say; mpirun and the
commands that prepare the case are real.
"""
import json
import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

DEMVOF = pathlib.Path(sys.argv.pop(1)).resolve() if len(sys.argv) > 1 else None

RESULTS = {"status": "completed", "steps": {"windows": 10}, "particles": {"initial": 7, "lost": 0}, "quantities": {"liquid_front": 0.125}}

# $1: the case file; --out DIR comes somewhere behind it.
STAND_IN = r"""#!/bin/bash
me=$(basename "$0")
echo "$@" >> "$(dirname "$0")/$me.arguments"
while [ $# -gt 0 ]; do [ "$1" = --out ] && out=$2; shift; done
results() { sed "s/completed/$1/" "$(dirname "$0")/results.json" > "$out/results.json"; }
progress() {
    echo '{"begin_time": 0, "time": '$1', "end_time": 1.0, "window": 1, "windows": 10, "speed": 0.5, "remaining_seconds": 65,
           "worst_courant": 0.25, "particles": 7, "fine_cells": 8}' > "$out/progress.part"
    mv "$out/progress.part" "$out/progress.json"
}
[ $me = foam_side ] && do=$FLUID || do=$PARTICLES
trap 'results interrupted; exit 3' USR1
trap 'echo $me got SIGINT' INT
case $do in
    complete) [ $me = dem_side ] || { progress 1.0; results completed; } ;;
    slow)     for t in 0.0 0.31 1.0; do progress $t; sleep 1; done; results completed ;;
    silent)   ;;
    fail*)    echo "$me: this is why" >&2; [ $me = dem_side ] || results failed; exit ${do#fail} ;;
    killed)   sleep 0.5; kill -9 $$ ;;
    wait)     progress 0.1; touch "$out/$me.waits"; for i in {1..300}; do sleep 0.1; done ;;
    follow)   for i in {1..300}; do [ -e "$out/results.json" ] && sleep 1 && exit 3; sleep 0.1; done ;;
esac
"""


class RunCommand(unittest.TestCase):
    def setUp(self):
        self.base = pathlib.Path(tempfile.mkdtemp(prefix="demvof-test-"))
        self.addCleanup(shutil.rmtree, self.base)
        programs = self.base / "bin"
        programs.mkdir()
        for name in ("demvof", "demvof_pair"):
            shutil.copy(DEMVOF.parent / name, programs / name)
        for name in ("foam_side", "dem_side"):
            (programs / name).write_text(STAND_IN)
            (programs / name).chmod(0o755)
        (programs / "results.json").write_text(json.dumps(RESULTS))
        for file in ("fluid/constant/g", "fluid/system/controlDict", "fluid/0.orig/U", "fluid/0/U", "in.script"):
            (self.base / file).parent.mkdir(parents=True, exist_ok=True)
            (self.base / file).write_text(file)
        self.write_case("particles: {script: in.script}")

    def write_case(self, particles, prepare="touch constant/mesh"):
        (self.base / "case.yaml").write_text(
            f"fluid: {{case: fluid, prepare: [{prepare}]}}\n{particles}\n"
            "bulk_grid: {lower: [0, 0, 0], upper: [1, 1, 1], cells: [2, 2, 2]}\n"
            "coupling: {end_time: 1, window: 0.1}\n")

    def start(self, *arguments, fluid="complete", particles="complete", **options):
        environment = {**options.pop("env", os.environ), "FLUID": fluid, "PARTICLES": particles}
        return subprocess.Popen([self.base / "bin/demvof", *arguments], cwd=self.base, env=environment, text=True,
                                start_new_session=True,
                                **{"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, **options})

    def demvof(self, *arguments, **options):
        process = self.start(*arguments, **options)
        output, _ = process.communicate(timeout=60)
        return process.returncode, output

    def arguments_of(self, program):
        return (self.base / f"bin/{program}.arguments").read_text()

    # ---- a run that goes well

    def test_a_completed_run_ends_with_a_table(self):
        code, output = self.demvof("run", "case.yaml", "--set", "coupling.window=0.05")
        self.assertEqual(code, 0, output)
        self.assertIn("touch constant/mesh", output)
        for part in ("status                 completed", "7 at the start", "liquid front           0.125 m",
                     "In run:\n  results.json"):
            self.assertIn(part, output)
        for program in ("foam_side", "dem_side"):
            self.assertEqual(self.arguments_of(program), "case.yaml --out run --set coupling.window=0.05\n")

    def test_progress_is_a_line_per_tenth_without_a_terminal(self):
        _, output = self.demvof("run", "case.yaml", fluid="slow")
        shown = [line for line in output.splitlines() if "Co 0.25" in line]
        self.assertEqual([line.split("%")[0].strip() for line in shown], ["0", "31", "100"])
        self.assertNotIn("\r", output)

    def test_progress_is_a_bar_on_a_terminal(self):
        master, terminal = pty.openpty()
        process = self.start("run", "case.yaml", fluid="slow", stdout=terminal, stderr=terminal)
        os.close(terminal)
        shown = b""
        while True:  # the terminal closes with its last writer
            try:
                shown += os.read(master, 4096)
            except OSError:
                break
        self.assertEqual(process.wait(timeout=60), 0)
        self.assertRegex(shown.decode(), r"\r\[=+ +\]  31 %  t 0\.31 of 1 s  0\.5 s/s  1:05 left  Co 0\.25")

    def test_quiet_says_nothing_when_all_is_well(self):
        self.assertEqual(self.demvof("run", "case.yaml", "--quiet"), (0, ""))

    def test_preparation_copies_the_case_and_leaves_the_original(self):
        before = sorted(path.relative_to(self.base) for path in (self.base / "fluid").rglob("*"))
        self.assertEqual(self.demvof("prepare", "case.yaml", "--out", "a/b")[0], 0)
        copy = self.base / "a/b/fluid"
        self.assertEqual((copy / "0/U").read_text(), "fluid/0.orig/U")
        self.assertTrue((copy / "constant/mesh").exists())
        self.assertEqual(before, sorted(path.relative_to(self.base) for path in (self.base / "fluid").rglob("*")))

    def test_a_prepared_case_is_not_prepared_again(self):
        self.demvof("prepare", "case.yaml")
        (self.base / "run/fluid/edited").touch()
        code, output = self.demvof("run", "case.yaml")
        self.assertEqual(code, 0, output)
        self.assertNotIn("preparing", output)
        self.assertTrue((self.base / "run/fluid/edited").exists())

    def test_results_are_kept_until_forced(self):
        self.demvof("run", "case.yaml")
        code, output = self.demvof("run", "case.yaml")
        self.assertEqual(code, 2)
        self.assertEqual(output, "--out run: the folder holds the results of an earlier run; give --force to "
                                 "replace it, or another --out\n")
        self.assertEqual(self.demvof("run", "case.yaml", "--force")[0], 0)

    # ---- the command itself

    def test_print_command_shows_the_pair_and_does_nothing(self):
        code, output = self.demvof("run", "case.yaml", "--print-command", "--fluid-ranks", "2", "--out", "a b")
        self.assertEqual(code, 0)
        programs = self.base / "bin"
        options = "--out 'a b' --set fluid.ranks=2"
        self.assertRegex(output, rf"^.*mpirun .*-np 3 {programs}/demvof_pair -np 2 {programs}/foam_side case.yaml "
                                 rf"{options} \+ -np 1 {programs}/dem_side case.yaml {options}\n$")
        self.assertFalse((self.base / "a b").exists())

    def test_mpirun_gets_the_users_own_words(self):
        words = ("--mpirun-option=-x", "--mpirun-option=GREETING=good day")
        code, output = self.demvof("run", "case.yaml", "--print-command", *words)
        self.assertIn(" -x 'GREETING=good day' -np 2 ", output)
        code, output = self.demvof("run", "case.yaml", *words)
        self.assertEqual(code, 0, output)
        self.write_case("")
        code, output = self.demvof("run", "case.yaml", "--force", *words)
        self.assertEqual(code, 2)
        self.assertIn("is started without mpirun", output)

    def put_mpirun_first_in_path(self, script):
        """What the real mpirun says of its version, and the script for all else."""
        folder = self.base / "mpirun"
        folder.mkdir()
        version = subprocess.run(["mpirun", "--version"], capture_output=True, text=True).stdout.splitlines()[0]
        (folder / "mpirun").write_text(f"#!/bin/sh\n[ $1 != --version ] || {{ echo '{version}'; exit; }}\n{script}\n")
        (folder / "mpirun").chmod(0o755)
        return {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}

    def test_an_mpirun_that_dies_is_named(self):
        for script, said in (("kill -SEGV $$", r"mpirun itself was killed by signal 11 \(Segmentation fault\) before"),
                             ("exit 1", "mpirun itself ended with exit code 1 before the programs said a word"),
                             ("echo a side speaks; kill -9 $$", r"killed by signal 9 \(Killed\); the programs ended")):
            with self.subTest(script):
                shutil.rmtree(self.base / "mpirun", ignore_errors=True)
                environment = self.put_mpirun_first_in_path(script)
                code, output = self.demvof("run", "case.yaml", "--force", env=environment)
                self.assertNotEqual(code, 0)
                self.assertRegex(output, said)
                self.assertEqual("What to try: the same mpirun" in output, "speaks" not in script, output)

    def test_what_mpirun_says_of_a_lost_host_is_in_the_results(self):
        environment = self.put_mpirun_first_in_path(f"printf '%s\\n' {'-' * 70} 'no word' 'Remote daemon: [[1,0],2] on node beta' "
                                                   f"{'-' * 70}; exit 205")
        code, output = self.demvof("run", "case.yaml", env=environment)
        self.assertEqual(code, 4, output)
        self.assertIn("\nmpirun lost host beta: it does", output)
        self.assertIn("\nno word\nRemote daemon: [[1,0],2] on node beta\n", output)
        self.assertNotIn("mpirun itself", output)
        self.assertIn("no word\nRemote daemon", json.loads((self.base / "run/results.json").read_text())["failure"]["message"])

    def test_an_mpirun_of_another_mpi_is_refused(self):
        environment = self.put_mpirun_first_in_path("exit 1")
        (self.base / "mpirun/mpirun").write_text("#!/bin/sh\necho HYDRA build details:\n")
        code, output = self.demvof("run", "case.yaml", env=environment)
        self.assertEqual(code, 3)
        self.assertIn("the first mpirun in PATH is of HYDRA build details:, but demvof runs with Open MPI", output)
        self.assertFalse((self.base / "run").exists())

    def test_printed_command_runs_as_it_is(self):
        self.demvof("prepare", "case.yaml")
        _, line = self.demvof("run", "case.yaml", "--print-command")
        environment = {**os.environ, "FLUID": "complete", "PARTICLES": "complete"}
        subprocess.run(["sh", "-c", line], cwd=self.base, env=environment, check=True, timeout=60,
                       capture_output=True)
        self.assertTrue((self.base / "run/results.json").exists())

    def test_a_job_for_slurm_is_written_and_nothing_run(self):
        options = ("--out", "runs/a", "--particle-ranks", "2", "--mpirun-option=--display-map", "--slurm-option=--time=2:00:00")
        code, shown = self.demvof("run", "case.yaml", "--slurm", "--print-command", *options)
        self.assertEqual(code, 0, shown)
        self.assertFalse((self.base / "runs").exists())
        self.assertEqual(self.demvof("run", "case.yaml", "--slurm", *options),
                         (0, "runs/a.sbatch is written; submit it with\n    sbatch runs/a.sbatch\n"))
        script = (self.base / "runs/a.sbatch").read_text()
        self.assertEqual(script, shown)
        self.assertIn("\n#SBATCH --ntasks=3\n", script)
        self.assertIn("\n#SBATCH --time=2:00:00\n", script)
        self.assertFalse((self.base / "bin/foam_side.arguments").exists())
        # What Slurm does with it: once, and again as if the first had ended without a state.
        environment = {**os.environ, "FLUID": "complete", "PARTICLES": "complete"}
        for _ in range(2):
            done = subprocess.run(["bash", "runs/a.sbatch"], cwd=self.base, env=environment, capture_output=True, text=True,
                                  timeout=60, check=False)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertTrue((self.base / "runs/a/results.json").exists())
        self.assertIn("--out runs/a --set particles.ranks=2\n", self.arguments_of("dem_side"))

    def test_a_job_that_would_be_refused_is_refused_at_once(self):
        self.demvof("run", "case.yaml")
        for options, said in ((("--slurm",), "give --force to replace it"),
                              (("--slurm", "--continue"), "--continue"),
                              (("--slurm", "--out", "b", "--slurm-option=partition=long"), "'partition=long' is no option"),
                              (("--slurm-option=--time=1",), "give --slurm with it"),
                              (("--slurm", "--continue", "--from", "1"), "leave --from out")):
            code, output = self.demvof("run", "case.yaml", *options)
            self.assertEqual(code, 2, output)
            self.assertIn(said, output)
        self.assertEqual(list(self.base.glob("*.sbatch")), [])
        self.assertTrue((self.base / "run/results.json").exists())
        self.assertEqual(self.demvof("run", "case.yaml", "--slurm", "--force")[0], 0)
        self.assertFalse((self.base / "run/results.json").exists())

    def test_without_particles_foam_side_runs_alone(self):
        self.write_case("")
        code, output = self.demvof("run", "case.yaml", "--print-command")
        self.assertNotIn("mpirun", output)
        self.assertNotIn("dem_side", output)
        code, output = self.demvof("run", "case.yaml")
        self.assertEqual(code, 0, output)
        self.assertFalse((self.base / "bin/dem_side.arguments").exists())

    def test_the_version_names_all_parts(self):
        code, output = self.demvof("--version")
        self.assertEqual(code, 0)
        number = r"\d+\.\d+(\.\d+)?"
        self.assertRegex(output, rf"^demvof {number}( \(.+\))?\nOpenFOAM (v\d{{4}}|not built in)\n"
                                 rf"LIGGGHTS ({number}|not built in)\nOpen MPI {number}\S*\nyaml-cpp {number}\nVTK {number}\n$")

    def test_a_program_that_is_not_there_is_named(self):
        (self.base / "bin/dem_side").unlink()
        code, output = self.demvof("run", "case.yaml")
        self.assertEqual(code, 3)
        self.assertIn("dem_side is not there", output)

    def test_wrong_commands_and_options_are_code_2(self):
        for arguments in ([], ["rnu", "case.yaml"], ["run"], ["run", "case.yaml", "--fast"], ["run", "a", "b"],
                          ["run", "case.yaml", "--fluid-ranks", "0"], ["run", "case.yaml", "--fluid-ranks", "two"],
                          ["run", "nothing.yaml"], ["report", "."]):
            code, output = self.demvof(*arguments)
            self.assertEqual((code, bool(output)), (2, True), arguments)
        self.assertIn("did you mean 'run'?", self.demvof("rnu")[1])

    # ---- runs that end badly

    def test_exit_codes_of_the_programs_are_passed_on(self):
        for wanted in (2, 3, 4):
            code, output = self.demvof("run", "case.yaml", "--force", fluid=f"fail{wanted}", particles="follow")
            self.assertEqual(code, wanted, output)
            self.assertIn("foam_side: this is why", output)

    def test_a_killed_side_is_a_lost_partner(self):
        code, output = self.demvof("run", "case.yaml", fluid="wait", particles="killed")
        self.assertEqual(code, 4, output)

    def test_done_without_results_is_no_success(self):
        code, output = self.demvof("run", "case.yaml", fluid="silent", particles="silent")
        self.assertEqual(code, 3)
        self.assertIn("left no run/results.json", output)

    def test_a_failing_preparation_shows_the_end_of_its_log(self):
        self.write_case("particles: {script: in.script}", prepare="'echo no mesh today; exit 5'")
        code, output = self.demvof("run", "case.yaml")
        self.assertEqual(code, 2)
        self.assertIn("failed (exit code 5) in run/fluid; the end of run/prepare.log:", output)
        self.assertIn("\n    no mesh today", output)
        self.write_case("particles: {script: in.script}")
        self.assertEqual(self.demvof("run", "case.yaml")[0], 0, "a failed preparation is replaced without --force")

    def wait_for(self, file):
        for _ in range(200):
            if (self.base / file).exists():
                return
            time.sleep(0.05)
        self.fail(f"{file} never came")

    def test_ctrl_c_stops_at_the_end_of_the_window(self):
        process = self.start("run", "case.yaml", fluid="wait", particles="follow")
        self.wait_for("run/foam_side.waits")
        os.killpg(process.pid, signal.SIGINT)  # as a terminal does it: to the whole process group
        output, _ = process.communicate(timeout=30)
        self.assertEqual(process.returncode, 3, output)
        self.assertIn("stopping at the end of the window", output)
        self.assertIn("interrupted", output)
        self.assertNotIn("got SIGINT", output)
        self.assertNotIn("mpirun", output)

    def test_nothing_is_left_running_when_demvof_is_killed(self):
        process = self.start("run", "case.yaml", fluid="wait", particles="wait")
        self.wait_for("run/foam_side.waits")
        self.wait_for("run/dem_side.waits")
        process.kill()
        process.communicate(timeout=30)
        for _ in range(300):
            if not subprocess.run(["pgrep", "-f", str(self.base / "bin")], capture_output=True).stdout:
                return
            time.sleep(0.1)
        self.fail("stand-ins are still running")

    # ---- check

    def test_check_asks_both_sides_in_a_folder_that_goes(self):
        code, output = self.demvof("check", "case.yaml", "--set", "coupling.window=0.05")
        self.assertEqual(code, 0, output)
        for program in ("foam_side", "dem_side"):
            self.assertRegex(self.arguments_of(program), r"^case.yaml --check --out \S+ --set coupling.window=0.05\n$")
        out = re.search(r"--out (\S+)", self.arguments_of("foam_side")).group(1)
        self.assertFalse(pathlib.Path(out).exists())
        self.assertFalse((self.base / "run").exists())

    def test_check_passes_on_what_a_side_refuses(self):
        code, output = self.demvof("check", "case.yaml", fluid="fail2", particles="silent")
        self.assertEqual(code, 2)
        self.assertIn("foam_side: this is why", output)


if __name__ == "__main__":
    unittest.main()
