# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs of the real pair for the tests of this folder: a case folder of their own and `demvof run` on it."""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
SMALL_MESH = "nx 20; ny 10; nz 30;"  # 6000 cells of 10 mm: as fine as the bulk grid


def dam_break(folder):
    """A copy of the dam break with a mesh of 6000 cells; returns its case file."""
    case = pathlib.Path(folder) / "case"
    shutil.rmtree(folder, ignore_errors=True)
    source = ROOT / "cases" / "three_phase_dam_break"
    case.mkdir(parents=True)
    for part in ("fluid", "particles"):
        shutil.copytree(source / part, case / part)
    shutil.copy(source / "case.yaml", case)
    mesh = case / "fluid" / "system" / "blockMeshDict"
    head, tail = mesh.read_text().split("nx 40;")
    mesh.write_text(head + SMALL_MESH + tail.split("nz 60;")[1])
    return case / "case.yaml"


def replace(file, old, new):
    """Replaces a text that must be there."""
    text = pathlib.Path(file).read_text()
    assert old in text, f"{old!r} is not in {file}"
    pathlib.Path(file).write_text(text.replace(old, new))


def traces(folder):
    """What changes in a folder while a run writes there: its files, their sizes and times."""
    found = {}
    for root, _, files in os.walk(folder):
        for file in files:
            try:
                facts = os.stat(os.path.join(root, file))
            except OSError:
                continue
            found[os.path.join(root, file)] = (facts.st_size, facts.st_mtime_ns)
    return found


def activity(session):
    """Seconds of CPU time that the processes of a session have used, and whether one of them wants a core or the disk."""
    seconds, wants = 0, False
    for entry in pathlib.Path("/proc").glob("[0-9]*"):
        try:
            fields = (entry / "stat").read_text().rpartition(")")[2].split()
        except OSError:
            continue
        if int(fields[3]) == session:
            seconds += (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")
            wants = wants or fields[0] in "RD"
    return seconds, wants


def wait_for_signs(process, folder, silence):
    """Exit code and everything printed, however long it takes. A run that leaves no trace in its folder for so many
    seconds is killed, and the test fails: a busy machine makes a run slow, a fault makes it silent. While it wants a core,
    the seconds are those that it has got. The process is the first of its session."""
    seen, silent, looked, used = None, 0, time.monotonic(), 0
    while True:
        try:
            text, _ = process.communicate(timeout=1)
            return process.returncode, text
        except subprocess.TimeoutExpired:
            pass
        now, (seconds, wants) = time.monotonic(), activity(process.pid)
        silent += max(0, seconds - used) if wants else now - looked
        looked, used = now, seconds
        if (there := traces(folder)) != seen:
            seen, silent = there, 0
        if silent > silence:
            os.killpg(process.pid, signal.SIGKILL)
            text, _ = process.communicate()
            raise AssertionError(f"the run has left no trace in {folder} for {silence} s:\n{text}")


class Pair:
    """One `demvof run` in a session of its own."""

    def __init__(self, demvof, case_file, out, *options):
        self.out = pathlib.Path(out)
        self.process = subprocess.Popen(
            [demvof, "run", str(case_file), "--out", str(out), "--force", *options],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, start_new_session=True)

    def wait(self, seconds=300):
        """Exit code and everything printed; kills the run and fails when it takes longer."""
        try:
            text, _ = self.process.communicate(timeout=seconds)
        except subprocess.TimeoutExpired:
            os.killpg(self.process.pid, signal.SIGKILL)
            text, _ = self.process.communicate()
            raise AssertionError(f"the run did not end within {seconds} s:\n{text}") from None
        return self.process.returncode, text

    def wait_for_signs(self, silence=60):
        return wait_for_signs(self.process, self.out, silence)

    def wait_for_window(self, number, seconds=120):
        """Until the run has done a number of windows."""
        end = time.monotonic() + seconds
        while time.monotonic() < end and self.process.poll() is None:
            try:
                if json.loads((self.out / "progress.json").read_text())["window"] >= number:
                    return
            except (OSError, ValueError):
                pass
            time.sleep(0.05)
        _, text = self.wait(1) if self.process.poll() is not None else (None, "")
        raise AssertionError(f"the run did not reach window {number}:\n{text}")

    def pids(self, program):
        """Process numbers of this run's program."""
        found = []
        for entry in pathlib.Path("/proc").iterdir():
            try:
                words = (entry / "cmdline").read_bytes().split(b"\0")
            except OSError:
                continue
            if (entry.name.isdigit() and pathlib.Path(os.fsdecode(words[0])).name == program
                    and os.fsencode(str(self.out)) in words):
                found.append(int(entry.name))
        return sorted(found)

    def results(self):
        return json.loads((self.out / "results.json").read_text())
