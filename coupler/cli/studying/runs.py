# SPDX-License-Identifier: GPL-3.0-or-later
"""The runs of a study, one after the other; a finished one is not repeated."""
import ctypes
import hashlib
import json
import pathlib
import signal
import statistics
import subprocess
import time

from reporting.run import NoRun, Run
from studying.plan import assignment

MARK = "study_row.json"  # in a row's folder: what its finished runs were made from


class Interrupted(Exception):
    """Ctrl-C or a stop signal ended a run."""


def inputs_hash(case, extra):
    """Of everything a run is made from: the files beside the case file that are not outputs of runs, and extra."""
    digest = hashlib.sha256(extra.encode())
    for file in sorted(case.parent.rglob("*")):
        outside = file.relative_to(case.parent).parts[0]
        if file.is_file() and outside in ("fluid", "particles", case.name):
            digest.update(str(file.relative_to(case.parent)).encode() + b"\0" + file.read_bytes())
    return digest.hexdigest()


def busy_share():
    """Share of the processors' time that other programs take, measured while none of this study runs."""
    def times():  # user, nice, system, idle, waiting for disks, ... since the machine started
        with open("/proc/stat", encoding="ascii") as stat:
            return [int(word) for word in stat.readline().split()[1:]]
    before = times()
    time.sleep(0.2)
    passed = [now - then for now, then in zip(times(), before)]
    return 1 - (passed[3] + passed[4]) / max(sum(passed), 1)


def end_with_parent():
    """In a child: SIGTERM when the parent dies, by whatever it dies."""
    set_parent_death_signal = 1
    ctypes.CDLL(None).prctl(set_parent_death_signal, signal.SIGTERM)


class Runs:
    lock = None  # a file that the runs hold open until they end

    def __init__(self, plan, out, demvof, say):
        self.plan, self.out, self.demvof, self.say = plan, pathlib.Path(out), demvof, say
        version = subprocess.run([demvof, "--version"], capture_output=True, text=True, check=True).stdout
        self.made_from = {row.name: inputs_hash(plan.case, version + json.dumps(row.settings, sort_keys=True))
                          for row in plan.rows}

    def folder(self, row, turn=0):
        return self.out / row.name / (f"run_{turn}" if turn else "run")

    def finished(self, row):
        """Wall times of the runs of a row that are done, s."""
        try:
            mark = json.loads((self.out / row.name / MARK).read_text())
        except (OSError, ValueError):
            return []
        return mark["wall_seconds"] if mark.get("made_from") == self.made_from[row.name] else []

    def make(self, row):
        """Makes what is missing of a row. Throws Interrupted."""
        times = self.finished(row)
        if len(times) >= self.plan.repeat:
            self.say(f"{row.name}: done before")
            return
        (self.out / row.name).mkdir(parents=True, exist_ok=True)
        while len(times) < self.plan.repeat:
            folder = self.folder(row, len(times))
            busy = busy_share()
            self.say(f"{row.name}: run {len(times) + 1} of {self.plan.repeat}"
                     + (f" (other programs take {100 * busy:.0f} % of the machine)" if busy > 0.1 else ""))
            command = [self.demvof, "run", str(self.plan.case), "--out", str(folder), "--force", "--quiet"]
            for key, value in row.settings.items():
                command += ["--set", assignment(key, value)]
            done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False,
                                  pass_fds=[self.lock.fileno()] if self.lock else [], preexec_fn=end_with_parent)
            (self.out / row.name / "said.txt").write_text(done.stdout)
            run = self.run(row, len(times))
            if run is not None and run.status == "interrupted":
                raise Interrupted(row.name)
            if done.returncode != 0:
                last = [line for line in done.stdout.splitlines() if line.strip()][-1:] or ["no message"]
                self.say(f"{row.name}: failed with code {done.returncode}: {last[0]}")
                return
            times = times + [run.number("wall_seconds.total")]
            mark = {"made_from": self.made_from[row.name], "wall_seconds": times, "busy_before": busy}
            (self.out / row.name / MARK).write_text(json.dumps(mark) + "\n")

    def run(self, row, turn=0):
        try:
            return Run(self.folder(row, turn))
        except NoRun:
            return None

    def described(self, row, errors, errors_in_time):
        """The row of study.json."""
        run, times = self.run(row), self.finished(row)
        status = "completed" if times else "not run" if run is None else run.status
        if run is not None and run.completed and not times:
            status = "out of date"  # made from other inputs, or killed before it was entered
        memory = [run.number(f"peak_memory_bytes.{side}") for side in ("fluid", "particles")] if run else []
        return {"name": row.name, "single_scale": row.single_scale, "settings": row.settings,
                "configuration": run.configuration if run else {}, "status": status,
                "failure": (run.results.get("failure") or {}).get("message") if run else None,
                "wall_seconds": statistics.median(times) if times else None, "wall_seconds_of_runs": times,
                "parts_seconds": run.results.get("wall_seconds", {}) if run else {},
                "peak_memory_bytes": sum(m for m in memory if m) or None,
                "cells": run.results.get("cells", {}) if run else {}, "errors": errors,
                "converged_in_time": row.converged_in_time, "errors_in_time": errors_in_time,
                "conservation": run.results.get("conservation", {}) if run else {}}
