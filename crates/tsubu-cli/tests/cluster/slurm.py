"""A Slurm of its own on this machine: an authentication service, a controller, nodes of one processor each, and one of two in a partition of its own."""

import getpass
import os
import secrets
import shutil
import signal
import socket
import subprocess
import time
from pathlib import Path

NODES = 4
PROGRAMS = ["munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol"]

CONF = """\
ClusterName=tsubu
SlurmctldHost=localhost
SlurmctldPort={ports[0]}
AuthType=auth/munge
# A job that is requeued waits until its credentials are void: two minutes, unless told.
AuthInfo=socket={home}/munge,cred_expire=3
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={home}/state
SlurmdSpoolDir={home}/%n
SlurmctldPidFile={home}/slurmctld.pid
SlurmdPidFile={home}/%n.pid
SlurmctldLogFile={home}/slurmctld.log
SlurmdLogFile={home}/%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
JobAcctGatherType=jobacct_gather/none
SchedulerType=sched/backfill
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
ReturnToService=2
SlurmdParameters=config_overrides
{nodes}
PartitionName=main Nodes={singles} Default=YES MaxTime=INFINITE State=UP
PartitionName=pair Nodes=pair MaxTime=INFINITE State=UP
"""


def missing():
    """Programs of Slurm that are not there."""
    return [name for name in PROGRAMS if find(name) is None]


def find(name):
    return shutil.which(name, path=os.environ["PATH"] + ":/usr/sbin:/sbin")


class Slurm:
    """Runs as long as it is open. `home` has a short name, for sockets cannot have a long one."""

    def __init__(self, home):
        self.home = Path(home)
        # The authentication service wants its socket to be within reach of all.
        self.home.chmod(0o755)
        singles = [f"n{i}" for i in range(NODES)]
        names = [*singles, "pair"]
        ports = free(len(names) + 1)
        nodes = "\n".join(
            f"NodeName={name} NodeHostname=localhost NodeAddr=127.0.0.1 Port={port} CPUs={2 if name == 'pair' else 1} RealMemory=2000"
            for name, port in zip(names, ports[1:])
        )
        conf = self.home / "slurm.conf"
        conf.write_text(CONF.format(home=home, user=getpass.getuser(), ports=ports, nodes=nodes, singles=",".join(singles)))
        for folder in ["state", *names]:
            (self.home / folder).mkdir()
        key = self.home / "key"
        key.write_bytes(secrets.token_bytes(1024))
        key.chmod(0o600)
        self.environment = {**os.environ, "SLURM_CONF": str(conf)}
        self.started = []
        self.start(
            "munged", "--foreground", f"--key-file={key}", f"--socket={home}/munge", f"--pid-file={home}/munged.pid",
            f"--log-file={home}/munged.log", f"--seed-file={home}/seed",
        )  # fmt: skip
        wait((self.home / "munge").exists, "the socket of munged", 60, self.said)
        self.start("slurmctld", "-D", "-c")
        for name in names:
            self.start("slurmd", "-D", "-N", name)
        wait(lambda: self.idle() == len(names), "the nodes", 60, self.said)

    def idle(self):
        """Nodes that wait for work."""
        lines = self.told("sinfo", "--noheader", "--format=%D %t").splitlines()
        return sum(int(count) for count, state in map(str.split, lines) if state == "idle")

    def start(self, *command):
        said = open(self.home / f"{command[0]}{len(self.started)}.said", "w")
        into = {"stdin": subprocess.DEVNULL, "stdout": said, "stderr": subprocess.STDOUT}
        self.started.append(subprocess.Popen([find(command[0]), *command[1:]], env=self.environment, **into))

    def said(self):
        return "\n".join(f"{path.name}: {path.read_text()[-500:]}" for path in sorted(self.home.glob("*.said")))

    def told(self, *command):
        done = subprocess.run(command, env=self.environment, capture_output=True, text=True)
        return done.stdout

    def over(self):
        return not self.told("squeue", "--noheader").strip()

    def close(self):
        self.told("scancel", "--user", getpass.getuser())
        wait(self.over, "the end of all jobs")
        for process in reversed(self.started):
            process.send_signal(signal.SIGTERM)
            process.wait(timeout=60)


def free(number):
    """Ports that nobody listens at."""
    sockets = [socket.socket() for _ in range(number)]
    for each in sockets:
        each.bind(("127.0.0.1", 0))
    ports = [each.getsockname()[1] for each in sockets]
    for each in sockets:
        each.close()
    return ports


def wait(over, what, seconds=600, said=lambda: ""):
    begun = time.monotonic()
    while not over():
        assert time.monotonic() - begun < seconds, f"{what} did not come in {seconds} s\n{said()}"
        time.sleep(0.2)
