# SPDX-License-Identifier: GPL-3.0-or-later
"""A pair over three hosts, and what befalls them: three_hosts_test.py DEMVOF FOLDER [unittest arguments]

foam_side on alpha and beta, dem_side on gamma; mpirun and demvof on alpha.
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
from hosts import REMOTE_SHELL, Hosts
from small_pair import beads_into_water

DEMVOF, FOLDER = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
NAMES = ("alpha", "beta", "gamma")
RANKS = ("--fluid-ranks", "2")
TIME_OUT = 10  # s, of the pair
# Until all is over: both sides wait so long, mpirun for hosts that do not answer half of it, demvof for mpirun 10 s, beside what
# a busy machine takes.
LONGEST = 60


class ThreeHosts(unittest.TestCase):
    def setUp(self):
        self.folder = FOLDER / self._testMethodName
        shutil.rmtree(self.folder, ignore_errors=True)
        self.hosts = Hosts(self.folder / "hosts", *NAMES)
        self.addCleanup(self.hosts.close)
        self.out = self.folder / "run"

    # ---- runs

    def write(self, **keys):
        self.case_file = beads_into_water(self.folder / "case", coupling={"time_out": TIME_OUT}, **keys)

    def start(self, *options):
        words = ["--host", ",".join(NAMES), "--mca", "plm_rsh_agent", REMOTE_SHELL, "--mca", "mpi_yield_when_idle", "1"]
        command = [DEMVOF, "run", self.case_file, "--out", self.out, *RANKS,
                   *[f"--mpirun-option={word}" for word in words], *options]
        return subprocess.Popen(self.hosts.inside("alpha", *command), stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                                text=True)

    def running(self):
        return {host: names for host in NAMES if (names := self.hosts.command_lines(host))}

    def end(self, process, seconds):
        """Exit code and words of a run, which ends within so many seconds."""
        begin = time.monotonic()
        try:
            text, _ = process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            there = self.running()
            for host in NAMES:
                self.hosts.kill_all(host)
            self.fail(f"no end within {seconds} s; there run {there}:\n{process.communicate()[0]}")
        print(f"{text[-3000:]}\n---- code {process.returncode} after {time.monotonic() - begin:.1f} s", flush=True)
        return process.returncode, text

    def results(self):
        return json.loads((self.out / "results.json").read_text())

    def wait_for_window(self, number, process, seconds=100):
        end = time.monotonic() + seconds
        while time.monotonic() < end and process.poll() is None:
            with contextlib.suppress(OSError, ValueError):
                if json.loads((self.out / "progress.json").read_text())["window"] >= number:
                    return
            time.sleep(0.05)
        process.kill()
        self.fail(f"the run did not reach window {number}:\n{process.communicate()[0]}")

    def as_on_one_host(self, *options):
        require_as_on_one_host(self, DEMVOF, self.case_file, self.out, *RANKS, *options)

    # ---- what befalls a run in its middle

    def befall(self, what, mend, seconds, mend_first=False):
        """Does it to a run, which fails within the seconds, leaves nothing on any host, and goes on from its state once that
        is mended. What it said and its results.json are returned."""
        self.write(fine=(40, 20, 40), end_time=9)
        process = self.start()
        self.wait_for_window(5, process)
        for host, program in zip(NAMES, ("foam_side", "foam_side", "dem_side")):
            self.assertEqual(len(self.hosts.processes(host, program)), 1, f"{program} on {host}")
        what()
        code, text_of_the_end = self.end(process, seconds)
        self.assertEqual(code, 4, text_of_the_end)
        if mend_first:
            mend()
        begin = time.monotonic()
        while (there := self.running()) and time.monotonic() < begin + seconds:
            time.sleep(0.1)
        self.assertEqual(there, {}, f"after {seconds} s more")
        print(f"---- the last process ended {time.monotonic() - begin:.1f} s later", flush=True)
        results = self.results()
        self.assertEqual(results["status"], "failed")
        print(f"---- {results['status']}: {results['failure']}", flush=True)
        if not mend_first:
            mend()
        state = json.loads((self.out / "restart/latest.json").read_text())
        until = ("--set", f"coupling.end_time={state['time'] + 2e-3:.3f}")
        continued, text = self.end(self.start("--continue", *until), 100)
        self.assertEqual(continued, 0, text)
        self.as_on_one_host(*until)
        return text_of_the_end, results

    def test_nothing(self):
        self.write()
        code, text = self.end(self.start(), 100)
        self.assertEqual(code, 0, text)
        self.as_on_one_host()

    def test_a_slow_link(self):
        self.write()
        self.hosts.slow_down("gamma", 1)
        code, text = self.end(self.start(), 200)
        self.assertEqual(code, 0, text)
        self.as_on_one_host()

    def test_a_cable_that_is_out_for_a_moment(self):
        self.write(fine=(40, 20, 40))
        process = self.start()
        self.wait_for_window(3, process)
        self.hosts.plug("gamma", False)
        time.sleep(2)
        self.hosts.plug("gamma")
        code, text = self.end(process, 100)
        self.assertEqual(code, 0, text)
        self.as_on_one_host()

    def check_cut_off(self, host):
        text, _ = self.befall(lambda: self.hosts.plug(host, False), lambda: self.hosts.plug(host), LONGEST)
        self.assertIn(f"mpirun lost host {host}", text)

    def test_the_host_of_the_particles_cut_off(self):
        self.check_cut_off("gamma")

    def test_a_host_of_the_fluid_cut_off(self):
        self.check_cut_off("beta")

    def check_killed(self, host):
        text, _ = self.befall(lambda: self.hosts.kill_all(host), lambda: None, LONGEST)
        self.assertIn(f"mpirun lost host {host}", text)

    def test_all_killed_on_the_host_of_the_particles(self):
        self.check_killed("gamma")

    def test_all_killed_on_a_host_of_the_fluid(self):
        self.check_killed("beta")

    def signal(self, host, number, program=None):
        for process in self.hosts.processes(host, program):
            os.kill(process, number)

    def test_particles_stopped(self):
        self.befall(lambda: self.signal("gamma", signal.SIGSTOP, "dem_side"), lambda: None, LONGEST)

    def test_a_rank_of_the_fluid_stopped(self):
        self.befall(lambda: self.signal("beta", signal.SIGSTOP, "foam_side"), lambda: None, LONGEST)

    def test_a_host_that_stands_still(self):
        self.befall(lambda: self.signal("gamma", signal.SIGSTOP), lambda: self.signal("gamma", signal.SIGCONT), LONGEST,
                    mend_first=True)


if __name__ == "__main__":
    if os.geteuid() != 0:
        os.execvp("sudo", ["sudo", sys.executable, *sys.argv])
    unittest.main(argv=sys.argv[:1] + sys.argv[3:], verbosity=2)
