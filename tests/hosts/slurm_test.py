# SPDX-License-Identifier: GPL-3.0-or-later
"""`demvof run --slurm` and a real Slurm with two nodes: slurm_test.py DEMVOF FOLDER [unittest arguments]

Installs the packages slurm-wlm and munge where they are missing. As root, or with sudo.
"""
import contextlib
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import time
import unittest

from as_on_one_host import require_as_on_one_host
from slurm import Slurm
from small_pair import beads_into_water

DEMVOF, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
PROGRAMS = ("mpirun", "orted", "demvof", "foam_side", "dem_side")
ON_TWO_NODES = ("--slurm-option=--nodes=2", "--slurm-option=--ntasks-per-node=1")


def install(*packages):
    missing = [p for p in packages if subprocess.run(["dpkg", "-s", p], capture_output=True, check=False).returncode]
    if missing:
        subprocess.run(["apt-get", "update", "-q"], stdout=subprocess.DEVNULL, check=False)
        subprocess.run(["env", "DEBIAN_FRONTEND=noninteractive", "apt-get", "install", "-y", "-q",
                        "--no-install-recommends", *missing], stdout=subprocess.DEVNULL, check=True)


class Jobs(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.slurm = Slurm(FOLDER / "slurm")
        cls.addClassCleanup(cls.slurm.close)

    def setUp(self):
        self.folder = FOLDER / self._testMethodName
        shutil.rmtree(self.folder, ignore_errors=True)
        self.out = self.folder / "run"

    # ---- runs

    def write(self, **keys):
        self.case_file = beads_into_water(self.folder / "case", **keys)

    def demvof(self, *options):
        done = subprocess.run([DEMVOF, "run", self.case_file, "--out", self.out, *options], text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def script(self, *options):
        text = self.demvof("--slurm", *ON_TWO_NODES, *options)
        file = self.folder / "run.sbatch"
        self.assertIn(f"sbatch {file}\n", text)
        return file

    def job(self, script, *options):
        job = self.slurm.submit(script, *options)
        self.addCleanup(self.show, job)
        return job

    def show(self, job):
        log = self.folder / f"run.{job}.log"
        print(f"---- job {job}\n{log.read_text() if log.exists() else ''}", flush=True)

    def wait_for_window(self, number, seconds=100):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                if json.loads((self.out / "progress.json").read_text())["window"] >= number:
                    return
            except (OSError, ValueError):
                pass
            time.sleep(0.1)
        self.fail(f"the run did not reach window {number}")

    def require_nothing_left(self):
        for host in ("node1", "node2"):
            for program in PROGRAMS:
                self.assertEqual(self.slurm.hosts.processes(host, program), [], f"{program} on {host}")

    def results(self):
        return json.loads((self.out / "results.json").read_text())

    def as_on_one_host(self, *options):
        require_as_on_one_host(self, DEMVOF, self.case_file, self.out, *options)

    def state(self):
        """After how many windows the last one is."""
        return json.loads((self.out / "restart/latest.json").read_text())["window"]

    def goes_on(self):
        """The next job ends the run two windows after its last state, as if nothing had befallen it."""
        until = ("--set", f"coupling.end_time={(self.state() + 2) * 1e-3:.3f}")
        job = self.job(self.script("--continue", *until))
        self.assertEqual(self.slurm.wait(job, 120), ("COMPLETED", 0))
        self.assertEqual(self.results()["status"], "completed")
        self.as_on_one_host(*until)

    # ---- tests

    def test_a_pair_on_two_nodes(self):
        self.write()
        job = self.job(self.script())
        self.assertEqual(self.slurm.wait(job, 120), ("COMPLETED", 0))
        self.assertEqual(self.results()["status"], "completed")
        self.as_on_one_host()
        self.require_nothing_left()

    def test_ranks_from_srun(self):
        """The pair by hand, without mpirun."""
        self.write()
        subprocess.run([DEMVOF, "prepare", self.case_file, "--out", self.out], check=True, stdout=subprocess.DEVNULL)
        command = ["srun", "-n2", "-N2", "--mpi=pmix", DEMVOF.parent / "demvof_pair", "-np", "1", "foam_side", self.case_file, "--out",
                   self.out, "+", "-np", "1", "dem_side", self.case_file, "--out", self.out]
        done = self.slurm.on("head", *command, check=False, stderr=subprocess.STDOUT, timeout=100)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual(self.results()["status"], "completed")
        self.as_on_one_host()

    def test_a_cancelled_job(self):
        self.write(fine=(40, 20, 40), end_time=9)
        job = self.job(self.script())
        self.wait_for_window(5)
        for host, program in (("node1", "foam_side"), ("node2", "dem_side")):
            self.assertEqual(len(self.slurm.hosts.processes(host, program)), 1, f"{program} on {host}")
        self.slurm.cancel(job)
        self.assertEqual(self.slurm.wait(job, 60)[0], "CANCELLED")
        self.assertEqual(self.results()["status"], "interrupted")
        self.assertEqual(self.state(), self.results()["steps"]["windows"])
        self.require_nothing_left()
        self.goes_on()

    def test_a_cancelled_job_whose_window_takes_too_long(self):
        self.write(fine=(40, 20, 40), end_time=9)
        job = self.job(self.script())
        self.wait_for_window(5)
        foam_side = self.slurm.hosts.processes("node1", "foam_side")[0]
        os.kill(foam_side, signal.SIGSTOP)
        self.slurm.cancel(job)
        with contextlib.suppress(ProcessLookupError):
            while True:  # Slurm lets it go on
                os.kill(foam_side, signal.SIGSTOP)
                time.sleep(0.01)
        self.assertEqual(self.slurm.wait(job, 60)[0], "CANCELLED")
        self.assertEqual(self.results()["status"], "failed")
        self.assertIn("asked to stop at the end of the window, and killed before", self.results()["failure"]["message"])
        self.require_nothing_left()
        self.goes_on()

    def test_a_time_limit(self):
        self.write(fine=(40, 20, 40), end_time=9)
        script = self.script("--slurm-option=--time=1", "--slurm-option=--signal=B:TERM@10")
        job = self.job(script)
        self.assertEqual(self.slurm.wait(job, 120), ("FAILED", 3))
        self.assertEqual(self.results()["status"], "interrupted")
        first = self.state()
        self.assertEqual(first, self.results()["steps"]["windows"])
        self.require_nothing_left()

        job = self.job(script)  # as it is
        self.wait_for_window(first + 2)
        self.slurm.cancel(job, "--batch", "--signal=TERM")
        self.assertEqual(self.slurm.wait(job, 60), ("FAILED", 3))
        self.assertEqual(self.results()["status"], "interrupted")
        print(f"{first} windows until the limit, {self.state()} until the second stop", flush=True)
        self.assertGreater(self.state(), first)
        self.goes_on()


if __name__ == "__main__":
    if os.geteuid() != 0:
        os.execvp("sudo", ["sudo", sys.executable, *sys.argv])
    install("slurm-wlm", "munge", "iproute2")
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
