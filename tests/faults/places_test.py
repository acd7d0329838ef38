# SPDX-License-Identifier: GPL-3.0-or-later
"""Folders that a run cannot have, and limits that it meets there: places_test.py DEMVOF LIBRARY FOLDER [--long]
[unittest arguments]"""
import ctypes
import errno
import os
import resource
import shutil
import signal
import subprocess
import time

from injected import DEMVOF, LONG, RANDOM, Injected, beads_into_water, demvof, main, status
from pair import Pair, wait_for_signs

ONE_STATE = ("--set", "coupling.end_time=0.004")


def obeys_permissions():
    """Also for root: without the rights to write and read what nobody may."""
    drop_from_bounding_set = 24
    for capability in (1, 2):
        ctypes.CDLL(None).prctl(drop_from_bounding_set, capability, 0, 0, 0)


def set_limit(process, which, number):
    resource.prlimit(process, which, (number, resource.prlimit(process, which)[1]))


class Places(Injected):
    def run_like_a_user(self, *options):
        process = subprocess.Popen([DEMVOF, "run", str(self.case_file), "--out", str(self.out), *options], text=True,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
                                   preexec_fn=obeys_permissions)
        return wait_for_signs(process, self.out, 60)

    def setUp(self):
        super().setUp()
        if self.out.exists():
            self.out.chmod(0o755)
            shutil.rmtree(self.out)

    # ---- what is there already

    def test_a_file_in_the_place_of_a_folder(self):
        code, text = demvof(self.case_file, self.out, *ONE_STATE)
        self.assertEqual(code, 0, text)
        results = (self.out / "results.json").read_bytes()
        for name in ("earlier", "particles", "bulk", "fluid", "restart"):
            with self.subTest(name):
                there, aside = self.out / name, self.folder / "aside"
                if there.exists():
                    there.rename(aside)
                there.write_text("a note of the user\n")
                code, text = demvof(self.case_file, self.out, "--continue")
                self.assertEqual(code, 2, text)
                self.assertIn(f"{there} is no folder", text)
                there.unlink()
                if aside.exists():
                    aside.rename(there)
        self.assertEqual((self.out / "results.json").read_bytes(), results)

    # ---- what may not be written

    def test_a_folder_that_cannot_be_written(self):
        self.out.mkdir(parents=True)
        self.out.chmod(0o555)
        code, text = self.run_like_a_user()
        self.assertEqual(code, 2, text)
        self.assertIn(f"--out {self.out}: nothing can be written to the folder: Permission denied", text)
        self.out.chmod(0o755)
        code, text = self.run_like_a_user(*ONE_STATE)
        self.assertEqual(code, 0, text)
        self.out.chmod(0o555)
        code, text = self.run_like_a_user("--continue")
        self.assertEqual(code, 2, text)
        self.assertIn("nothing can be written to the folder", text)
        self.out.chmod(0o755)

    def test_a_folder_of_the_run_that_cannot_be_written(self):
        whole = self.whole()
        for name in ("restart", "particles", "bulk", "fluid") if LONG else ("restart",):
            with self.subTest(name):
                code, text = demvof(self.case_file, self.out, *ONE_STATE)
                self.assertEqual(code, 0, text)
                (self.out / name).chmod(0o555)
                code, text = self.run_like_a_user("--continue")
                (self.out / name).chmod(0o755)
                self.assertEqual(code, 3, text)
                self.assertIn(f"{self.out / name}/", text)
                self.assertEqual(status(self.out)["status"], "failed")
                self.continues(whole)

    # ---- limits

    def test_a_disk_quota(self):
        """Of all that the run writes, from some write on."""
        whole = self.whole()
        for count in (60, 120, 180, 240, 300, 360) if LONG else (120,):
            shutil.rmtree(self.out, ignore_errors=True)
            code, text = demvof(self.case_file, self.out, fault=f"write {self.out}/ {count} {errno.EDQUOT}")
            self.assertIn(code, (2, 3, 4), f"{count}\n{text}")
            self.assertIn("quota", text.lower())
            if (self.out / "results.json").exists():
                self.assertEqual(status(self.out)["status"], "failed")
            if (self.out / "restart/latest.json").exists():
                self.continues(whole)

    def limited(self, which, number):
        """End of a run of which both sides meet a limit in the middle."""
        self.case_file = beads_into_water(self.folder, fine=(40, 20, 40))
        pair = Pair(DEMVOF, self.case_file, self.out)
        pair.wait_for_window(3)
        for process in pair.pids("foam_side") + pair.pids("dem_side"):
            set_limit(process, which, number)
        return pair.wait_for_signs()

    def test_a_limit_of_file_size(self):
        code, text = self.limited(resource.RLIMIT_FSIZE, 1000)
        self.assertEqual(code, 3, text)
        self.assertIn("File too large", text)
        # Not even this file may be as long as it has to be.
        self.assertIn("results.json", text)
        code, text = demvof(self.case_file, self.out, "--continue")
        self.assertEqual(code, 0, text)

    def test_a_limit_of_cpu_time(self):
        code, text = self.limited(resource.RLIMIT_CPU, 1)
        self.assertEqual(code, 3, text)
        self.assertEqual(status(self.out)["status"], "interrupted")
        code, text = demvof(self.case_file, self.out, "--continue")
        self.assertEqual(code, 0, text)
        self.assertEqual(status(self.out)["status"], "completed")

    # ---- who is first

    def two_runs(self, *options, delay=0.0):
        """Codes and words of two runs in one folder."""
        command = [DEMVOF, "run", str(self.case_file), "--out", str(self.out), *options]
        runs = []
        for _ in range(2):
            runs.append(subprocess.Popen(command, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                         start_new_session=True))
            time.sleep(delay)
        return [wait_for_signs(run, self.out, 60) for run in runs]

    def test_two_runs_at_the_same_instant(self):
        whole = self.whole()
        for number in range(40 if LONG else 4):
            start = number % 4  # a new folder, a prepared one, a run to go on with, one to replace
            shutil.rmtree(self.out, ignore_errors=True)
            if start == 1:
                subprocess.run([DEMVOF, "prepare", str(self.case_file), "--out", str(self.out)], check=True,
                               stdout=subprocess.DEVNULL)
            elif start > 1:
                self.assertEqual(demvof(self.case_file, self.out, *ONE_STATE)[0], 0)
            options = ((), (), ("--continue",), ("--force",))[start]
            ends = sorted(self.two_runs(*options, delay=RANDOM.choice((0, 0.01, RANDOM.uniform(0, 0.5)))))
            what = f"{number}: {ends}"
            self.assertEqual([code for code, _ in ends], [0, 2], what)
            self.assertIn(" works in this folder", ends[1][1], what)
            self.assertEqual(status(self.out)["status"], "completed", what)
            self.assertEqual((self.out / "history.csv").read_text(), whole, what)

    # ---- ranks that nobody waits for

    def test_a_stopped_rank_of_a_fluid_alone(self):
        self.case_file = beads_into_water(self.folder, fine=(40, 20, 40), end_time=2, coupling={"time_out": 3})
        for rank in (0, 1) if LONG else (1,):
            shutil.rmtree(self.out, ignore_errors=True)
            pair = Pair(DEMVOF, self.case_file, self.out, "--fluid-ranks", "2", "--set", "scene.particles=off")
            pair.wait_for_window(2)
            stopped = pair.pids("foam_side")[rank]
            os.kill(stopped, signal.SIGSTOP)
            begin = time.monotonic()
            code, text = pair.wait(60)
            self.assertLess(time.monotonic() - begin, 30)
            self.assertNotEqual(code, 0, text)
            failure = status(self.out)["failure"]["message"]
            self.assertIn("waited 3 s", failure)
            self.assertIn(f"(process {stopped} on ", failure.split("gave up: ")[1])
            self.assertEqual(pair.pids("foam_side"), [])


if __name__ == "__main__":
    main()
