# SPDX-License-Identifier: GPL-3.0-or-later
"""What becomes of a run under injected faults: faults_test.py DEMVOF LIBRARY FOLDER [--long] [unittest arguments]

A state that the run can be continued from is whole or is not there; a run whose files are cut is never `completed`;
whoever fails is named. --long: every file of a run, 200 kills, more flipped bits.
"""
import contextlib
import errno
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

from injected import DEMVOF, LONG, RANDOM, Injected, beads_into_water, demvof, main, status
from histories import differences
from pair import Pair
from reporting.run import Run


SUMS_OVER_RANKS = 2e-7  # in another order, by which the pressure solver stops elsewhere: that of pair.continued


class Faults(Injected):
    # ---- full disks

    def check_full_disk(self, operation, name, count, whole):
        """From the count-th of these operations on, the disk is full for this file."""
        shutil.rmtree(self.out, ignore_errors=True)
        what = f"{operation} {name} {count}"
        code, text = demvof(self.case_file, self.out, fault=f"{what} {errno.ENOSPC}")
        self.assertEqual(code, 3, what + "\n" + text)
        if name != "results.json":
            results = status(self.out)
            self.assertEqual(results["status"], "failed", what)
            self.assertIn(name.rstrip(".").split("/")[-1].split(".")[0], results["failure"]["message"], what)
        if name != "results.json" and (self.out / "restart" / "latest.json").exists():
            self.continues(whole)

    def test_full_disk(self):
        whole = self.whole()
        # At the second output: LIGGGHTS's restart file (behind particles.json), OpenFOAM's fields, VTK's files.
        faults = [("write", "restart/4/particles.", 2), ("open", "fluid/0.004/voidFraction", 1),
                  ("write", "particles_000002.vtp", 1)]
        if LONG:
            fields = ["voidFraction", "U", "phi", "alpha.water", "p_rgh", "velocityFlux", "uniform/time"]
            faults += [(operation, f"fluid/0.004/{field}", 1) for operation in ("open", "write") for field in fields]
            faults += [("open", "restart/4/particles.", 2), ("write", "restart/4/particles.json", 1),
                       ("write", "restart/4/fluid.0.", 1), ("write", "restart/4/state.json", 1),
                       ("write", "latest.json", 2), ("write", "history.csv", 5), ("write", "bulk_000002.vti", 1),
                       ("write", "bulk.pvd", 3), ("write", "particles.pvd", 3), ("write", "results.json", 1)]
        for fault in faults:
            self.check_full_disk(*fault, whole)

    # ---- damage to a state

    def test_flipped_bits(self):
        code, text = demvof(self.case_file, self.out, "--set", "coupling.end_time=0.004")
        self.assertEqual(code, 0, text)
        state = json.loads((self.out / "restart/latest.json").read_text())
        files = sorted(state["files"]) + ["restart/latest.json"]
        before = (self.out / "results.json").read_bytes()
        for _ in range(1000 if LONG else 40):
            file = self.out / RANDOM.choice(files)
            content = file.read_bytes()
            # What stands behind a state in history.csv, and blanks of latest.json, are no part of it.
            end = state["files"].get(str(file.relative_to(self.out)), {}).get("bytes", len(content))
            places = [i for i in range(end) if not (file.suffix == ".json" and content[i:i + 1].isspace())]
            place, bit = RANDOM.choice(places), RANDOM.randrange(8)
            damaged = bytearray(content)
            damaged[place] ^= 1 << bit
            file.write_bytes(damaged)
            code, text = demvof(self.case_file, self.out, "--continue", "--set", "coupling.end_time=0.006")
            self.assertEqual(code, 2, f"{file}, byte {place}, bit {bit}\n{text}")
            self.assertIn(file.name, text)
            file.write_bytes(content)
        self.assertEqual((self.out / "results.json").read_bytes(), before, "a refusal leaves what it finds")

    def test_the_newest_whole_state_is_offered(self):
        whole = self.whole()
        code, text = demvof(self.case_file, self.out)
        self.assertEqual(code, 0, text)
        self.assertEqual(sorted(f.name for f in (self.out / "restart").iterdir()), ["10", "8", "latest.json"])
        (self.out / "restart/10/particles").write_bytes(b"")
        results = (self.out / "results.json").read_bytes()
        code, text = demvof(self.case_file, self.out, "--continue", "--set", "coupling.end_time=0.012")
        self.assertEqual(code, 2, text)
        self.assertIn("restart/10/particles has 0 bytes", text)
        self.assertIn("--continue --from 8", text)
        self.assertEqual((self.out / "results.json").read_bytes(), results)
        code, text = demvof(self.case_file, self.out, "--continue", "--from", "8")
        self.assertEqual(code, 0, text)
        self.assertEqual((self.out / "history.csv").read_text(), whole)

    # ---- kills

    def check_kills(self, count, ranks):
        """Kills at random moments of the run, until so many have been continued."""
        options = ("--fluid-ranks", str(ranks), "--particle-ranks", str(ranks), "--set", "output.interval=0.001")
        whole = self.whole(*options)
        continued = too_early = through = 0
        largest = 0.0
        while continued < count:
            shutil.rmtree(self.out, ignore_errors=True)
            pair = Pair(DEMVOF, self.case_file, self.out, *options)
            reached = self.out / "restart" / str(RANDOM.randrange(11))
            while reached.name != "0" and not reached.exists() and pair.process.poll() is None:
                time.sleep(0.005)
            time.sleep(RANDOM.uniform(0, 0.5 if reached.name == "0" else 0.1))
            victims = pair.pids("foam_side") + pair.pids("dem_side")
            with contextlib.suppress(ProcessLookupError):
                if victims:
                    os.kill(RANDOM.choice(victims), signal.SIGKILL)
            code, text = pair.wait_for_signs()
            what = f"kill {continued + too_early + through}\n{text}"
            if code == 0:
                through += 1
                continue
            self.assertEqual(code, 4, what)
            if status(self.out)["status"] == "completed":  # killed when all was written
                through += 1
                continue
            self.assertEqual(status(self.out)["status"], "failed", what)
            if not (self.out / "restart/latest.json").exists():
                too_early += 1
                continue
            code, text = demvof(self.case_file, self.out, "--continue", *options)
            if code == 2 and "is at 0.01 s already" in text:  # killed between the last state and results.json
                through += 1
            else:
                self.assertEqual(code, 0, what + text)
                continued += 1
            if ranks == 1:
                self.assertEqual((self.out / "history.csv").read_text(), whole, what)
            part, all_of_it = Run(self.out), Run(self.folder / "whole")
            self.assertEqual(list(part.times), list(all_of_it.times), what)
            largest = max(largest, *differences(part, all_of_it).values())
            self.assertLess(largest, SUMS_OVER_RANKS, what)
            if code == 0 and continued % 10 == 0:
                print(f"{continued} killed and continued, {too_early} killed before the first state, {through} were through; "
                      f"largest difference {largest:.1e}", flush=True)

    def test_kills(self):
        self.check_kills(100 if LONG else 2, 1)

    @unittest.skipUnless(LONG, "minutes: with --long")
    def test_kills_of_several_ranks(self):
        self.check_kills(100, 2)

    @unittest.skipUnless(LONG, "minutes: with --long")
    def test_killed_while_a_state_is_divided(self):
        """For another number of fluid ranks."""
        code, text = demvof(self.case_file, self.out, "--set", "coupling.end_time=0.004")
        self.assertEqual(code, 0, text)
        for number in range(20):
            ranks = str(2 - number % 2)
            command = [DEMVOF, "run", str(self.case_file), "--out", str(self.out), "--continue", "--fluid-ranks", ranks]
            run = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
            time.sleep(RANDOM.uniform(0.02, 1.2))
            os.killpg(run.pid, signal.SIGKILL)
            run.wait()
            end = time.monotonic() + 20
            while self.left_over() and time.monotonic() < end:
                time.sleep(0.1)
            state = json.loads((self.out / "restart/latest.json").read_text())
            code, text = demvof(self.case_file, self.out, "--continue", "--set",
                                f"coupling.end_time={state['time'] + 0.001:.3f}", "--fluid-ranks", "1")
            self.assertEqual(code, 0, f"kill {number}\n{text}")

    def left_over(self):
        return [p for p in ("foam_side", "dem_side", "mpirun") if Pair.pids(self, p)]

    def test_killed_at_the_start(self):
        pair = Pair(DEMVOF, self.case_file, self.out, "--quiet")
        while not pair.pids("foam_side") and pair.process.poll() is None:
            time.sleep(0.01)
        os.kill(pair.pids("foam_side")[0], signal.SIGKILL)
        code, text = pair.wait(60)
        self.assertIn(code, (3, 4), text)
        self.assertEqual(status(self.out)["status"], "failed")

    def test_mpirun_killed(self):
        self.case_file = beads_into_water(self.folder, fine=(40, 20, 40), end_time=1)  # the ranks live on for about 1 s
        pair = Pair(DEMVOF, self.case_file, self.out)
        pair.wait_for_window(2)
        os.kill(pair.pids("mpirun")[0], signal.SIGKILL)
        code, text = pair.wait(60)
        self.assertIn(code, (3, 4), text)
        self.assertIn(status(self.out)["status"], ("failed", "interrupted"))
        self.assertEqual(pair.pids("foam_side") + pair.pids("dem_side"), [])

    # ---- crashes

    def check_crash(self, victim, number, side):
        self.case_file = beads_into_water(self.folder, fine=(40, 20, 40), end_time=1)
        pair = Pair(DEMVOF, self.case_file, self.out, "--fluid-ranks", "2")
        pair.wait_for_window(2)
        os.kill(pair.pids(victim)[-1], number)
        code, text = pair.wait(60)
        self.assertEqual(code, 3, text)
        failure = status(self.out)["failure"]
        self.assertEqual(failure["side"], side, failure)
        self.assertGreater(failure["time"], 0, failure)
        self.assertIn(signal.Signals(number).name, failure["message"])

    def test_a_fluid_rank_crashes(self):
        self.check_crash("foam_side", signal.SIGFPE, "fluid")

    def test_the_particles_crash(self):
        self.check_crash("dem_side", signal.SIGSEGV, "particles")

    # ---- one run, one folder

    def test_a_second_run_is_told_who_is_there(self):
        self.case_file = beads_into_water(self.folder, fine=(40, 20, 40), end_time=0.03)
        pair = Pair(DEMVOF, self.case_file, self.out)
        pair.wait_for_window(2)
        for options in (("--continue",), ()):
            code, text = demvof(self.case_file, self.out, *options)
            self.assertEqual(code, 2, text)
            self.assertIn(f"process {pair.process.pid} on ", text)
        code, text = pair.wait(120)
        self.assertEqual(code, 0, text)

    # ---- starting

    def test_a_partner_that_is_no_program_of_ours(self):
        case_file = beads_into_water(self.folder, coupling={"time_out": 3})
        subprocess.run([DEMVOF, "prepare", str(case_file), "--out", str(self.out)], check=True, stdout=subprocess.DEVNULL)
        programs = pathlib.Path(DEMVOF).parent
        strangers = [["sleep", "60"], ["true"]] + [[str(programs / "stranger"), what] for what in ("begin", "meet", "end")]
        for stranger in strangers:
            with self.subTest(stranger):
                begin = time.monotonic()
                done = subprocess.run(["mpirun", "--oversubscribe", "-np", "1", str(programs / "foam_side"), str(case_file),
                                       "--out", str(self.out), ":", "-np", "1", *stranger], text=True, capture_output=True,
                                      timeout=50, check=False)
                self.assertNotEqual(done.returncode, 0)
                self.assertLess(time.monotonic() - begin, 30)
                self.assertIn("waited 3 s for the other processes of the run to start", done.stderr)

    def test_a_partner_stopped_at_its_start(self):
        case_file = beads_into_water(self.folder, coupling={"time_out": 3})
        pair = Pair(DEMVOF, case_file, self.out)
        while not pair.pids("dem_side") and pair.process.poll() is None:
            time.sleep(0.005)
        os.kill(pair.pids("dem_side")[0], signal.SIGSTOP)
        code, text = pair.wait(40)
        self.assertIn(code, (3, 4), text)

    def test_a_script_longer_than_the_time_out(self):
        case_file = beads_into_water(self.folder, coupling={"time_out": 3}, script_tail="shell sleep 1\nrun 0\n" +
                                     "variable i loop 900000\nlabel again\nnext i\njump SELF again\n")
        begin = time.monotonic()
        code, text = demvof(case_file, self.out)
        self.assertEqual(code, 0, text)
        print(f"{time.monotonic() - begin:.1f} s with a script that takes long")


if __name__ == "__main__":
    main()
