# SPDX-License-Identifier: GPL-3.0-or-later
"""Hosts made of namespaces on this machine.

Each host has a name, an address, a cable to a switch, processes of its own (it sees no others), and its own TMPDIR, /run
and /dev/shm. The rest of the file system is the machine's, as a cluster shares it. Needs root. Nothing outside of the
namespaces is changed, and all of it, whatever runs there included, goes with the process that made it.
"""
import contextlib
import ctypes
import os
import pathlib
import shutil
import signal
import subprocess
import time

REMOTE_SHELL = pathlib.Path(__file__).resolve().parent / "remote_shell.py"

# What runs first: in a host the other end of the remote shell.
FIRST_PROCESS = """
hostname "$1" && mount --bind "$2/etc_hosts" /etc/hosts && mount -t tmpfs none /run && mount -t tmpfs none /dev/shm &&
    ip link set lo up && : >"$2/$1/ready" &&
    exec env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin LANG=C.UTF-8 HOME="$HOME" TMPDIR="$2/$1" "$3" --serve >/dev/null
"""
SWITCH = """
ip link add bridge type bridge && ip link set bridge up && : >"$2/$1/ready" && exec sleep infinity
"""


def dies_with_its_parent():
    set_death_signal = 1
    ctypes.CDLL(None).prctl(set_death_signal, signal.SIGKILL, 0, 0, 0)


class Hosts:
    def __init__(self, folder, *names):
        self.folder = pathlib.Path(folder).resolve()
        shutil.rmtree(self.folder, ignore_errors=True)
        self.folder.mkdir(parents=True)
        self.addresses = {name: f"10.77.0.{number}" for number, name in enumerate(names, 1)}
        (self.folder / "etc_hosts").write_text(
            "127.0.0.1 localhost\n" + "".join(f"{address} {name}\n" for name, address in self.addresses.items()))
        self.makers, self.first = {}, {}
        self._make("switch", SWITCH, "--net")
        for name, address in self.addresses.items():
            self._make(name, FIRST_PROCESS, "--net", "--uts", "--ipc", "--mount", "--pid", "--mount-proc")
            self._on_switch("ip", "link", "add", name, "type", "veth", "peer", "name", "eth0", "netns",
                            str(self.first[name]))
            self._on_switch("ip", "link", "set", name, "master", "bridge", "up")
            self.run(name, "ip", "address", "add", f"{address}/24", "dev", "eth0")
            self.run(name, "ip", "link", "set", "eth0", "up")

    def _make(self, name, script, *namespaces):
        (self.folder / name).mkdir()
        maker = subprocess.Popen(["unshare", *namespaces, "--fork", "--kill-child=KILL", "sh", "-c", script, "sh", name,
                                  str(self.folder), str(REMOTE_SHELL)], start_new_session=True, preexec_fn=dies_with_its_parent)
        self.makers[name] = maker
        end = time.monotonic() + 10
        while not (self.folder / name / "ready").exists():
            if maker.poll() is not None or time.monotonic() > end:
                raise RuntimeError(f"no namespaces for {name}: this wants root (or sudo)")
            time.sleep(0.02)
        self.first[name] = int(pathlib.Path(f"/proc/{maker.pid}/task/{maker.pid}/children").read_text())

    def _on_switch(self, *command):
        subprocess.run(["nsenter", "-t", str(self.first["switch"]), "-n", *command], check=True)

    def inside(self, host, *command):
        """The command line that runs a command in a host."""
        return ["nsenter", "-t", str(self.first[host]), "-m", "-u", "-i", "-n", "-p", f"--wd={os.getcwd()}", "env",
                f"TMPDIR={self.folder / host}", *map(str, command)]

    def run(self, host, *command, **options):
        return subprocess.run(self.inside(host, *command), **{"check": True, **options})

    # ---- what befalls a host

    def plug(self, host, there=True):
        """Its cable, in or out."""
        self._on_switch("ip", "link", "set", host, "up" if there else "down")

    def slow_down(self, host, megabit):
        """What it sends and what it gets, Mbit/s."""
        limit = ("tbf", "rate", f"{megabit}mbit", "burst", "8kb", "latency", "200ms")
        self._on_switch("tc", "qdisc", "add", "dev", host, "root", *limit)
        self.run(host, "tc", "qdisc", "add", "dev", "eth0", "root", *limit)

    def processes(self, host, program=None):
        """Numbers, as the machine counts them, of what runs in a host, or of a program there."""
        space = os.readlink(f"/proc/{self.first[host]}/ns/pid")
        found = []
        for entry in pathlib.Path("/proc").glob("[0-9]*"):
            try:
                words = (entry / "cmdline").read_bytes().split(b"\0")
                there = os.readlink(entry / "ns/pid") == space and int(entry.name) != self.first[host]
            except OSError:
                continue
            if there and words[0] and program in (None, pathlib.Path(os.fsdecode(words[0])).name):
                found.append(int(entry.name))
        return sorted(found)

    def command_lines(self, host):
        found = []
        for process in self.processes(host):
            with contextlib.suppress(OSError):
                found.append(pathlib.Path(f"/proc/{process}/cmdline").read_bytes().replace(b"\0", b" ").decode()[:100])
        return found

    def kill_all(self, host):
        for process in self.processes(host):
            os.kill(process, signal.SIGKILL)

    def close(self):
        for maker in self.makers.values():
            maker.kill()
            maker.wait()
