# SPDX-License-Identifier: GPL-3.0-or-later
"""Slurm on hosts made of namespaces: slurmctld on head, a slurmd each on node1 and node2, a munged on each, with a key and
folders of their own. They end with the hosts."""
import os
import re
import subprocess
import time

from hosts import Hosts

CONFIGURATION = """ClusterName=of_a_test
SlurmctldHost=head
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/%n/spool
TmpFS={folder}/%n
SlurmctldPidFile=/run/slurmctld.pid
SlurmdPidFile=/run/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/%n/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
ReturnToService=2
NodeName=node[1-2] CPUs=2 State=UNKNOWN
PartitionName=all Nodes=node[1-2] Default=YES State=UP
"""


class Slurm:
    def __init__(self, folder):
        self.hosts = Hosts(folder, "head", "node1", "node2")
        self.folder = self.hosts.folder
        (self.folder / "state").mkdir()
        self.configuration = self.folder / "slurm.conf"
        self.configuration.write_text(CONFIGURATION.format(folder=self.folder))
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(128))
        key.chmod(0o400)
        for host in self.hosts.addresses:
            own = self.folder / host
            self.hosts.run(host, "mkdir", "--mode=755", "/run/munge")
            self.hosts.run(host, "munged", "--force", f"--key-file={key}", f"--log-file={own}/munged.log",
                           f"--seed-file={own}/munged.seed", "--pid-file=/run/munge/munged.pid",
                           stderr=subprocess.DEVNULL)
        self.on("head", "slurmctld")
        for host in ("node1", "node2"):
            (self.folder / host / "spool").mkdir()
            self.on(host, "slurmd", "-N", host)
        self._wait_until(lambda: self.on("head", "sinfo", "-h", "-t", "idle", "-o", "%D").stdout.strip() == "2",
                         30, "two idle nodes")

    def close(self):
        self.hosts.close()

    def on(self, host, *command, **options):
        options = {"check": True, "text": True, "stdout": subprocess.PIPE, **options}
        return self.hosts.run(host, "env", f"SLURM_CONF={self.configuration}", *command, **options)

    @staticmethod
    def _wait_until(true, seconds, what):
        end = time.monotonic() + seconds
        while not true():
            if time.monotonic() > end:
                raise RuntimeError(f"{what}: not within {seconds} s")
            time.sleep(0.2)

    # ---- jobs

    def submit(self, script, *options):
        """The job's number."""
        return self.on("head", "sbatch", "--parsable", *options, script).stdout.strip()

    def facts(self, job):
        """What scontrol says of it."""
        return dict(re.findall(r"(\S+?)=(\S*)", self.on("head", "scontrol", "show", "job", job).stdout))

    def cancel(self, job, *options):
        self.on("head", "scancel", *options, job)

    def wait(self, job, seconds):
        """Its state and exit code once it has ended, and nothing of it runs any more."""
        done = ("COMPLETED", "FAILED", "CANCELLED", "TIMEOUT", "NODE_FAIL")
        self._wait_until(lambda: self.facts(job)["JobState"] in done, seconds, f"end of job {job}")
        facts = self.facts(job)
        return facts["JobState"], int(facts["ExitCode"].split(":")[0])
