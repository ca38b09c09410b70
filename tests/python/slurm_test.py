"""A campaign as a job array of a real Slurm of one node, which this test starts and ends; its daemon is killed in between."""

import os
import secrets
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

NEEDED = ("munged", "slurmctld", "slurmd", "sbatch", "scancel", "sinfo")
MISSING = [name for name in NEEDED if shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin:/sbin") is None]
if MISSING:
    print(f"SKIPPED: no {', '.join(MISSING)} here (slurmctld, slurmd, slurm-client, munge)")
    sys.exit(77)
if os.geteuid() != 0:
    print("SKIPPED: the daemons of Slurm want root here")
    sys.exit(77)

import campaign_case as case


def free_ports(count):
    listeners = [socket.socket() for _ in range(count)]
    for listener in listeners:
        listener.bind(("127.0.0.1", 0))
    ports = [listener.getsockname()[1] for listener in listeners]
    for listener in listeners:
        listener.close()
    return ports


CONFIGURATION = """ClusterName=jawari
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=2 RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes={host} Default=YES State=UP
"""


def slurm_version():
    """(24, 11), of `slurm-wlm 24.11.5`."""
    words = subprocess.run(["slurmd", "-V"], capture_output=True, text=True,
                           env={**os.environ, "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"}).stdout.split()  # fmt: skip
    return tuple(int(number) for number in words[-1].split(".")[:2]) if words else (0, 0)


# Nothing here limits what a job may take; a container may have no control groups at all. Slurm 22 does not know the word.
CGROUPS = "CgroupPlugin=disabled\n" if slurm_version() >= (23, 11) else ""


class Slurm(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="slurm")
        os.chmod(self.folder, 0o755)
        for name in ("state", "spool"):
            os.mkdir(os.path.join(self.folder, name))
        key = os.path.join(self.folder, "munge.key")
        with open(key, "wb") as file:
            file.write(secrets.token_bytes(1024))
        os.chmod(key, 0o400)
        configuration = os.path.join(self.folder, "slurm.conf")
        with open(configuration, "w") as file:
            host = socket.gethostname().split(".")[0]
            file.write(CONFIGURATION.format(host=host, ports=free_ports(2), folder=self.folder))
        with open(os.path.join(self.folder, "cgroup.conf"), "w") as file:
            file.write(CGROUPS)
        self.environment = {**os.environ, "SLURM_CONF": configuration, "PATH": os.environ["PATH"] + ":/usr/sbin:/sbin"}
        munge = [f"--{name}={self.folder}/munge.{name}" for name in ("socket",)]
        munge += [f"--{name}-file={self.folder}/munge.{name}" for name in ("key", "pid", "log", "seed")]
        for command in (("munged", "--force", *munge), ("slurmctld", "-f", configuration), ("slurmd", "-f", configuration)):
            self.call(*command, check=False)  # whether they run shows below
        for _ in range(100):
            if "idle" in self.call("sinfo", "-h", "-o", "%t", check=False).stdout:
                return
            time.sleep(0.2)
        print("SKIPPED: Slurm's daemons do not come up in this system: " + self.call("sinfo", check=False).stdout, flush=True)
        self.tearDown()
        os._exit(77)

    def call(self, *words, check=True):
        return subprocess.run(words, capture_output=True, text=True, check=check, env=self.environment)

    def end(self, daemon, how=signal.SIGTERM):
        try:
            with open(os.path.join(self.folder, daemon + ".pid")) as file:
                pid = int(file.read())
            os.kill(pid, how)
            while os.path.exists(f"/proc/{pid}"):
                time.sleep(0.05)
        except (OSError, ValueError):
            pass

    def tearDown(self):
        self.call("scancel", "--user=root", check=False)
        for daemon in ("slurmd", "slurmctld", "munge"):
            self.end(daemon)
        shutil.rmtree(self.folder, ignore_errors=True)

    def test_a_job_array_has_the_table_of_this_machine(self):
        whole = os.path.join(self.folder, "whole")
        cluster = os.path.join(self.folder, "cluster")
        os.mkdir(whole)
        os.mkdir(cluster)
        settings = dict(scene=case.scene(0.2))
        self.assertEqual(case.run(case.write(whole, **settings)).returncode, 0)
        path = case.write(cluster, **settings)
        running = subprocess.Popen(case.command(path, "--slurm", "--tasks", "4"), env=self.environment,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)  # fmt: skip
        runs = os.path.join(cluster, "campaign", "runs")
        while running.poll() is None and (not os.path.exists(runs) or len(os.listdir(runs)) < 3):
            time.sleep(0.05)
        before = len(os.listdir(runs))
        self.call("scancel", "--user=root", "--signal=KILL", "--full")  # tasks that run now are killed
        said = running.communicate(timeout=300)
        self.assertIn(before, range(3, 45), "nothing was killed in between")
        self.assertEqual(running.returncode, 1, said)
        self.assertRegex(said[0], r"[1-9]\d* are missing")
        stamps = {f: os.stat(os.path.join(runs, f)).st_mtime_ns for f in os.listdir(runs) if f.endswith(".npz")}
        again = case.run(path, "--slurm", "--tasks", "4", env=self.environment)
        self.assertEqual(again.returncode, 0, again.stderr + again.stdout)
        self.assertEqual(case.table(cluster), case.table(whole))
        for file, stamp in stamps.items():  # nothing is run twice
            self.assertEqual(os.stat(os.path.join(runs, file)).st_mtime_ns, stamp)

    def test_what_sbatch_refuses_is_said(self):
        folder = os.path.join(self.folder, "refused")
        os.mkdir(folder)
        said = case.run(case.write(folder), "--slurm", "--sbatch=--partition=nowhere", env=self.environment)
        self.assertEqual(said.returncode, 2)
        self.assertRegex(said.stderr, "^sbatch: .*partition")


if __name__ == "__main__":
    unittest.main()
