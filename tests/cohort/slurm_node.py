"""A Slurm cluster of one node on this machine: munged, slurmctld and slurmd in a folder of their own."""

import os
import shutil
import socket
import subprocess
import time
from pathlib import Path

CONFIGURATION = """
ClusterName=hexwall
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={port}
SlurmdPort={other_port}
AuthType=auth/munge
AuthInfo=socket={munge}/socket
CredType=cred/munge
SlurmUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SchedulerType=sched/builtin
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
MpiDefault=none
ReturnToService=2
SlurmdParameters=config_overrides
NodeName={host} NodeAddr=127.0.0.1 CPUs=4 RealMemory=16000 State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def free_port():
    with socket.socket() as s:
        s.bind(("127.0.0.1", 0))
        return s.getsockname()[1]


class SlurmNode:
    def __init__(self, folder):
        self.folder = Path(folder)
        self.processes = []

    def environment(self):
        return {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}

    def run(self, *command):
        return subprocess.run(
            command, env=self.environment(), capture_output=True, text=True, check=False
        )

    def start(self):
        """Starts the daemons. Returns why that is impossible, or nothing."""
        if os.geteuid() != 0:
            return "slurmd needs root"
        for program in ("munged", "slurmctld", "slurmd", "sbatch"):
            if not shutil.which(program, path=f"{os.environ['PATH']}:/usr/sbin"):
                return f"there is no {program}"
        self.configure()
        self.launch(
            "/usr/sbin/munged",
            "--foreground",
            "--force",
            f"--key-file={self.munge}/key",
            f"--socket={self.munge}/socket",
            f"--pid-file={self.munge}/pid",
            f"--seed-file={self.munge}/seed",
            f"--log-file={self.munge}/log",
        )
        if not self.wait_until((self.munge / "socket").exists):
            return "munged does not start"
        self.launch("/usr/sbin/slurmctld", "-D")
        self.launch("/usr/sbin/slurmd", "-D", "-N", self.host)
        if not self.wait_until(lambda: "idle" in self.run("sinfo", "-h", "-o", "%T").stdout):
            return f"the node does not become idle: {self.run('sinfo', '-h', '-o', '%T %E').stdout}"
        return ""

    def stop(self):
        for process in reversed(self.processes):  # they need munged until their end
            process.terminate()
            try:
                process.wait(timeout=10)
            except subprocess.TimeoutExpired:
                process.kill()
                process.wait()

    def configure(self):
        self.host = socket.gethostname().split(".")[0]
        self.munge = self.folder / "munge"
        for part in ("munge", "state", "spool"):
            (self.folder / part).mkdir(parents=True)
        key = self.munge / "key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o400)
        (self.folder / "slurm.conf").write_text(
            CONFIGURATION.format(
                host=self.host,
                folder=self.folder,
                munge=self.munge,
                port=free_port(),
                other_port=free_port(),
            )
        )

    def launch(self, *command):
        log = open(self.folder / f"{Path(command[0]).name}.out", "w", encoding="utf-8")
        with log:
            self.processes.append(
                subprocess.Popen(
                    command, env=self.environment(), stdout=log, stderr=subprocess.STDOUT
                )
            )

    @staticmethod
    def wait_until(condition, seconds=20):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            if condition():
                return True
            time.sleep(0.1)
        return False
