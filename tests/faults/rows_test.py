# SPDX-License-Identifier: GPL-3.0-or-later
"""Faults of a user, of a machine and of a moment, one test for each kind: rows_test.py DEMVOF LIBRARY FOLDER [--long]
[unittest arguments]"""
import os
import pathlib
import resource
import shutil
import signal
import subprocess
import time
import unittest

from injected import DEMVOF, LONG, RANDOM, Injected, beads_into_water, demvof, main, status
from pair import Pair

BIN = pathlib.Path(DEMVOF).parent
slow = unittest.skipUnless(LONG, "with --long")


def by_hand(case_file, outs, options=((), ()), ranks=1, **process):
    """Both programs started without demvof: exit code, what they said, seconds."""
    words = ["mpirun", "--oversubscribe", "-np", str(ranks + 1), str(BIN / "demvof_pair"), "-np", str(ranks)]
    words += [str(BIN / "foam_side"), str(case_file), "--out", str(outs[0]), *options[0], "+", "-np", "1"]
    words += [str(BIN / "dem_side"), str(case_file), "--out", str(outs[1]), *options[1]]
    begin = time.monotonic()
    done = subprocess.run(words, text=True, errors="replace", stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=60,
                          check=False, **process)
    return done.returncode, done.stdout, time.monotonic() - begin


def prepare(case_file, out):
    subprocess.run([DEMVOF, "prepare", str(case_file), "--out", str(out), "--force"], check=True, stdout=subprocess.DEVNULL)


def many_short_windows(folder):
    """A run of seconds that hears from all its ranks within 10 s on a busy machine, too."""
    return beads_into_water(folder, end_time=1, output_interval=0.5, coupling={"time_out": 10})


class Rows(Injected):
    def refused(self, message, *options, code=2):
        said, text = demvof(self.case_file, self.out, *options)
        self.assertEqual(said, code, text)
        self.assertIn(message, text)
        return text

    # ---- what is refused leaves what it finds

    def test_what_a_refusal_finds_stays(self):
        code, text = demvof(self.case_file, self.out, "--set", "coupling.end_time=0.004")
        self.assertEqual(code, 0, text)
        before = {f: f.read_bytes() for f in self.out.rglob("*") if f.is_file() and f.name not in (".lock", "fluid.log")}
        for file in ("particles/in.particles", "fluid/constant/transportProperties"):
            os.utime(self.case_file.parent / file)
        for message, setting in (("fluid.refinement was not given in the run", "fluid.refinement={levels: 1}"),
                                 ("bulk_grid.upper was [0.04, 0.02, 0.04]", "bulk_grid.upper=[0.04, 0.02, 0.05]")):
            with self.subTest(setting):
                said, text = demvof(self.case_file, self.out, "--continue", "--set", "coupling.end_time=0.006", "--set", setting)
                self.assertEqual(said, 2, text)
                self.assertIn(message, text)
                if "refinement" in setting:
                    self.assertIn("particles.script: ", text)
                    self.assertIn("fluid.case: files have changed", text)
        mesh = self.out / "fluid/constant/polyMesh/points"
        points = mesh.read_bytes()
        mesh.write_bytes(points[:-40] + bytes([points[-40] ^ 1]) + points[-39:])
        self.refused("fluid/constant/polyMesh/points is not what was written", "--continue", "--set", "coupling.end_time=0.006")
        mesh.write_bytes(points)
        after = {f: f.read_bytes() for f in before if f.exists()}
        missing = [str(f) for f in before if f not in after and "particles.log" not in f.name]
        self.assertEqual(missing, [])
        for file in ("results.json", "history.csv", "restart/latest.json"):
            self.assertEqual(before[self.out / file], after[self.out / file], file)
        self.assertEqual({f for f in self.out.rglob("*") if f.is_file() and "log" not in f.name} - {*before, self.out / ".lock"}, set())

    # ---- programs started by hand that do not fit each other

    def test_one_side_continues_the_other_starts(self):
        code, text = demvof(self.case_file, self.out, "--set", "coupling.end_time=0.004")
        self.assertEqual(code, 0, text)
        for options in ((("--continue",), ()), ((), ("--continue",))):
            code, text, seconds = by_hand(self.case_file, (self.out, self.out), options)
            self.assertEqual(code, 2, text)
            self.assertIn("--continue (checksum of the state)", text)
            self.assertLess(seconds, 30)

    def test_two_folders(self):
        prepare(self.case_file, self.out)
        code, text, _ = by_hand(self.case_file, (self.out, self.folder / "other"))
        self.assertEqual(code, 2, text)
        self.assertIn("--out: foam_side has", text)

    def test_a_fluid_alone_beside_particles(self):
        prepare(self.case_file, self.out)
        off = ("--set", "scene.particles=off")
        code, text, seconds = by_hand(self.case_file, (self.out, self.out), (off, ()))
        self.assertNotEqual(code, 0, text)
        self.assertIn("made without particles, but dem_side was started", text)
        self.assertLess(seconds, 30)

    def test_a_case_that_is_not_decomposed(self):
        prepare(self.case_file, self.out)
        code, text, _ = by_hand(self.case_file, (self.out, self.out), ranks=2)
        self.assertEqual(code, 2, text)
        self.assertIn("is not decomposed, but foam_side runs on 2 ranks", text)

    @slow
    def test_a_side_without_memory(self):
        prepare(self.case_file, self.out)

        def little():
            resource.setrlimit(resource.RLIMIT_AS, (230000000, 230000000))
        code, text, seconds = by_hand(self.case_file, (self.out, self.out), (("--set", "coupling.time_out=5"),) * 2,
                                      preexec_fn=little)
        self.assertNotEqual(code, 0, text)
        self.assertLess(seconds, 40)

    @slow
    def test_no_more_memory_for_a_rank(self):
        """In the middle of the run: what it has is all that it may have."""
        self.case_file = beads_into_water(self.folder, fine=(40, 20, 40), end_time=1)
        for ranks in (1, 2):
            shutil.rmtree(self.out, ignore_errors=True)
            pair = Pair(DEMVOF, self.case_file, self.out, "--fluid-ranks", str(ranks))
            pair.wait_for_window(2)
            victim = pair.pids("foam_side")[-1]
            [size] = [line.split()[1] for line in pathlib.Path(f"/proc/{victim}/status").read_text().splitlines()
                      if line.startswith("VmSize:")]
            resource.prlimit(victim, resource.RLIMIT_AS, (1024 * int(size),) * 2)
            code, text = pair.wait(60)
            self.assertEqual(code, 3, text)
            failure = status(self.out)["failure"]
            self.assertEqual(failure["side"], "fluid")
            self.assertGreater(failure["time"], 0)
            self.assertIn("no more memory", failure["message"])

    @slow
    def test_a_flow_that_blows_up(self):
        """SIGFPE in the solver itself."""
        self.case_file = beads_into_water(self.folder, end_time=0.2, coupling={"window": 0.05})
        control = self.case_file.parent / "fluid/system/controlDict"
        control.write_text(control.read_text() + "\nmaxCo 500;\nmaxAlphaCo 500;\ndeltaT 0.05;\n")
        for ranks in ("1", "2"):
            code, text = demvof(self.case_file, self.out, "--fluid-ranks", ranks, "--particle-ranks", ranks)
            self.assertEqual(code, 3, text)
            failure = status(self.out)["failure"]
            self.assertEqual((failure["side"], failure["stage"]), ("fluid", "fluid step"))
            self.assertGreater(failure["time"], 0)
            self.assertIn("SIGFPE", failure["message"])

    # ---- particles that cannot be

    def with_beads(self, *beads):
        data = self.case_file.parent / "particles/particles.data"
        text = data.read_text()
        for old, new in beads:
            self.assertIn(old, text)
            text = text.replace(old, new, 1)
        data.write_text(text)

    def test_a_bead_that_is_no_number(self):
        self.with_beads(("\n3 0 0 -0.2", "\n3 0 nan -0.2"))
        self.refused("particle 3", "--quiet")

    def test_two_beads_at_one_place(self):
        lines = (self.case_file.parent / "particles/particles.data").read_text().splitlines()
        [second] = [line for line in lines if line.startswith("2 1 ")]
        [first] = [line for line in lines if line.startswith("1 1 ")]
        self.with_beads((second, "2" + first[1:]))
        text = self.refused("at one place", "--quiet")
        self.assertIn("particles 1 and 2", text)

    def test_beads_through_walls(self):
        """At 1000 m/s, 10 m in a DEM step of 1e-5 s: 1 cm."""
        self.with_beads(*[(f"\n{i} 0 0 -0.2", f"\n{i} 1000 0 -0.2") for i in range(1, 13)])
        code, text = demvof(self.case_file, self.out)
        self.assertEqual(code, 3, text)
        self.assertEqual(status(self.out)["status"], "failed")

    # ---- fluids that cannot be

    def test_fluids_that_cannot_be(self):
        properties = self.case_file.parent / "fluid/constant/transportProperties"
        good = properties.read_text()
        for old, new, named in (("nu 9.9999999999999995e-07", "nu -1e-6", "nu"), ("rho 1000", "rho 0", "rho"),
                                ("sigma 0", "sigma -0.07", "sigma"), ("rho 1;", "rho nan;", "rho")):
            with self.subTest(new):
                self.assertIn(old, good)
                properties.write_text(good.replace(old, new, 1))
                text = self.refused(named, "--quiet")
                self.assertIn("transportProperties", text)

    # ---- names

    def test_folders_that_the_solvers_cannot_name(self):
        for name in ("a b", "a*b", "a%b", "a;b", "a'b", "a\\b", "a\tb", "a\nb"):
            with self.subTest(name):
                code, text = demvof(self.case_file, self.folder / name)
                self.assertEqual(code, 2, text)
                self.assertIn("take no folder with", text)
                self.assertFalse((self.folder / name).exists())
        (self.folder / "nowhere").symlink_to(self.folder / "not there" / "at all")
        code, text = demvof(self.case_file, self.folder / "nowhere")
        self.assertEqual(code, 2, text)
        self.assertIn("nowhere", text)

    # ---- strangers

    def test_commands_are_refused(self):
        code, text = demvof(self.case_file, self.out, "--no-commands", "--set", "coupling.end_time=0.001")
        self.assertEqual(code, 0, text)
        script = self.case_file.parent / "particles/in.particles"
        control = self.case_file.parent / "fluid/system/controlDict"
        good = script.read_text(), control.read_text()
        for file, line, what in ((script, f"shell touch {self.folder}/done\n", "a command of the shell"),
                                 (script, 'if "1 == 1" then "${continued} touch"\n', "a command whose name is made up"),
                                 (control, f'libs ("{self.folder}/x.so");\n', "a library by its path"),
                                 (control, '#calc "1"\n', "code that is compiled and run")):
            for command in ("check", "prepare", "run"):
                with self.subTest(f"{command}: {line}"):
                    file.write_text(line + (good[0] if file == script else good[1]))
                    done = subprocess.run([DEMVOF, command, str(self.case_file), "--no-commands"], text=True,
                                          capture_output=True, check=False, cwd=self.folder)
                    self.assertEqual(done.returncode, 2, done.stderr)
                    self.assertIn(f"{file}:1: {what}", done.stderr)
            script.write_text(good[0])
            control.write_text(good[1])
        self.assertFalse((self.folder / "done").exists())
        done = subprocess.run([DEMVOF, "check", str(self.case_file), "--no-commands", "--set",
                               f"fluid.prepare=[blockMesh, 'touch {self.folder}/done']"], text=True, capture_output=True, check=False)
        self.assertEqual(done.returncode, 2)
        self.assertIn("fluid.prepare: a command of the shell: touch", done.stderr)

    # ---- signals

    def interrupted(self, when, number=signal.SIGINT, program=None):
        shutil.rmtree(self.out, ignore_errors=True)
        pair = Pair(DEMVOF, self.case_file, self.out, "--quiet")
        when(pair)
        os.kill(pair.pids(program)[0] if program else pair.process.pid, number)
        begin = time.monotonic()
        code, text = pair.wait(60)
        self.assertLess(time.monotonic() - begin, 20)
        end = status(self.out)["status"]
        self.assertIn((code, end), {(3, "interrupted"), (0, "completed"), (3, "failed"), (4, "failed")}, text)
        return code, end

    def test_control_c_at_the_start(self):
        def when(pair):
            while not pair.pids("dem_side") and pair.process.poll() is None:
                time.sleep(0.005)
            time.sleep(RANDOM.uniform(0, 0.3))
        for number in 5 * (signal.SIGINT, signal.SIGTERM, signal.SIGHUP) if LONG else (signal.SIGINT, signal.SIGHUP):
            self.interrupted(when, number)

    @slow
    def test_control_c_in_the_last_window(self):
        self.case_file = beads_into_water(self.folder, fine=(40, 20, 40))
        for _ in range(3):
            code, end = self.interrupted(lambda pair: pair.wait_for_window(9))
            if end == "interrupted":
                self.assertEqual(demvof(self.case_file, self.out, "--continue")[0], 0)
                self.assertEqual(status(self.out)["status"], "completed")

    def test_control_c_when_all_is_done(self):
        """Between the last window and the last word of demvof."""
        for delay in (0, *(0.02 * i for i in range(30))) if LONG else (0, 0.05):
            def when(pair, delay=delay):
                while not (self.out / "results.json").exists() and pair.process.poll() is None:
                    time.sleep(0.002)
                time.sleep(delay)
            self.assertEqual(self.interrupted(when), (0, "completed"), f"after {delay} s")

    @slow
    def test_signals_to_mpirun(self):
        self.case_file = beads_into_water(self.folder, fine=(40, 20, 40), end_time=1)
        for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
            code, end = self.interrupted(lambda pair: pair.wait_for_window(2), number, "mpirun")
            self.assertNotEqual(end, "completed")

    @slow
    def test_a_side_stopped_for_longer_than_the_time_out(self):
        self.case_file = many_short_windows(self.folder)
        for program, side, rank in (("foam_side", "fluid", 0), ("foam_side", "fluid", 1),
                                    ("dem_side", "particles", 0), ("dem_side", "particles", 1)):
            shutil.rmtree(self.out, ignore_errors=True)
            pair = Pair(DEMVOF, self.case_file, self.out, "--fluid-ranks", "2", "--particle-ranks", "2")
            pair.wait_for_window(2)
            stopped = pair.pids(program)[rank]
            os.kill(stopped, signal.SIGSTOP)
            code, text = pair.wait(90)
            self.assertEqual(code, 4, text)
            failure = status(self.out)["failure"]
            self.assertIn("waited 10 s", failure["message"])
            self.assertIn(f"(process {stopped} on ", failure["message"].split("gave up: ")[1])
            self.assertIn("is stopped", failure["message"])
            self.assertEqual(failure["side"], side)
            self.assertEqual(pair.pids("foam_side") + pair.pids("dem_side"), [])

    @slow
    def test_all_stopped_for_longer_than_the_time_out(self):
        """Nobody has waited while nobody could."""
        self.case_file = many_short_windows(self.folder)
        pair = Pair(DEMVOF, self.case_file, self.out)
        pair.wait_for_window(2)
        programs = pair.pids("foam_side") + pair.pids("dem_side")
        for number, seconds in ((signal.SIGSTOP, 13), (signal.SIGCONT, 0)):
            for program in programs:
                os.kill(program, number)
            time.sleep(seconds)
        code, text = pair.wait(120)
        self.assertEqual(code, 0, text)

    # ---- messages

    def test_control_characters_of_the_solvers_files(self):
        for file, old, new in (("fluid/constant/transportProperties", "rho 1000", "rho \x1b[31mred\x1b[0m"),
                               ("fluid/system/fvSchemes", "Euler", "\x1b]0;title\x07"),
                               ("particles/in.particles", "newton off", "newton \x1b[2Joff")):
            with self.subTest(file):
                path = self.case_file.parent / file
                good = path.read_text()
                self.assertIn(old, good)
                path.write_text(good.replace(old, new, 1))
                code, text = demvof(self.case_file, self.out)
                path.write_text(good)
                self.assertEqual(code, 2, text)
                self.assertNotIn("\x1b", text)

    def test_a_log_on_a_full_disk(self):
        for log in ("fluid.log", "particles.log"):
            prepare(self.case_file, self.out)
            (self.out / log).symlink_to("/dev/full")
            code, text, _ = by_hand(self.case_file, (self.out, self.out))
            self.assertNotEqual(code, 0, text)
            self.assertIn(f"cannot write {self.out / log}: No space left on device", text)
            if (self.out / "results.json").exists():
                self.assertEqual(status(self.out)["status"], "failed")

    # ---- files that go while the run goes on

    @slow
    def test_a_history_that_was_deleted(self):
        self.case_file = beads_into_water(self.folder, fine=(40, 20, 40), end_time=0.02)
        pair = Pair(DEMVOF, self.case_file, self.out)
        pair.wait_for_window(3)
        (self.out / "history.csv").unlink()
        code, text = pair.wait(120)
        self.assertEqual(code, 3, text)
        self.assertIn("history.csv", status(self.out)["failure"]["message"])


if __name__ == "__main__":
    main()
