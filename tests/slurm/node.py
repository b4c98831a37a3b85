"""A SLURM of one node, started and stopped by the tests: its own ports, key, spool and logs.

It needs no systemd and no accounting, and gives out more processors than the machine has, so that
jobs run side by side on a small one. Its daemons have long to answer, since a busy machine is no
lost node. The one thing outside of its folder is a link at the place of
SLURM's configuration: Snakemake removes every variable from a job's environment that could name
another one.
"""

import contextlib
import getpass
import os
import secrets
import shutil
import socket
import subprocess
from pathlib import Path

import psutil

from tests.processes import wait_until

LINK = Path("/etc/slurm/slurm.conf")
PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "squeue", "scontrol", "scancel", "srun")
AS_ROOT = [] if os.geteuid() == 0 else ["sudo", "-n"]

CONFIGURATION = """
ClusterName={name}
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller_port}
SlurmdPort={node_port}
SlurmUser={user}
SlurmdUser={user}
AuthType=auth/munge
AuthInfo=socket={folder}/munge/socket,cred_expire=5
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=pmix
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU_Memory
SchedulerParameters=sched_min_interval=0,batch_sched_delay=0,sched_interval=1,bf_interval=1
SlurmdParameters=config_overrides
SlurmdTimeout=0
MessageTimeout=100
TCPTimeout=60
BatchStartTimeout=600
UnkillableStepTimeout=600
KillWait=1
ReturnToService=2
MinJobAge=3600
PreemptType=preempt/partition_prio
PreemptMode=REQUEUE
JobCompType=jobcomp/none
AccountingStorageType=accounting_storage/none
JobAcctGatherType=jobacct_gather/none
NodeName={host} NodeAddr=127.0.0.1 CPUs=8 RealMemory=64000 State=UNKNOWN
PartitionName=main Nodes={host} Default=YES MaxTime=INFINITE State=UP PriorityTier=1
PartitionName=urgent Nodes={host} MaxTime=INFINITE State=UP PriorityTier=2
"""


def missing() -> str:
    """Return what keeps SLURM from being started here; nothing if it can be."""
    programs = [name for name in PROGRAMS if shutil.which(name, path=_path()) is None]
    if programs:
        return f"no {', '.join(programs)} on the path; `make slurm` installs them"
    if AS_ROOT and subprocess.run([*AS_ROOT, "true"], capture_output=True, check=False).returncode:
        return f"only root can put a configuration to {LINK}"
    if LINK.exists():
        return f"{LINK} is there: this machine is part of a cluster"
    return ""


def _path() -> str:
    return f"{os.environ['PATH']}:/usr/sbin:/sbin"


class Node:
    """The scheduler and its one node."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.host = socket.gethostname().partition(".")[0]
        self.name = f"test{os.getpid()}"
        self._munged: subprocess.Popen[bytes] | None = None
        self._controller: subprocess.Popen[bytes] | None = None
        self._node: subprocess.Popen[bytes] | None = None

    def start(self) -> None:
        """Start everything and wait until the node is idle."""
        for name in ("munge", "state", "spool"):
            (self.folder / name).mkdir(parents=True)
        (self.folder / "munge").chmod(0o755)
        ports = dict(zip(("controller_port", "node_port"), _free_ports(2), strict=True))
        text = CONFIGURATION.format(
            name=self.name,
            host=self.host,
            folder=self.folder,
            user=getpass.getuser(),
            **ports,
        )
        (self.folder / "slurm.conf").write_text(text)
        self._munged = self._start_munge()
        subprocess.run([*AS_ROOT, "mkdir", "-p", LINK.parent], check=True)
        subprocess.run([*AS_ROOT, "ln", "-s", self.folder / "slurm.conf", LINK], check=True)
        self._controller = self._daemon("slurmctld", "-D", "-c")
        self.start_node()

    def _start_munge(self) -> subprocess.Popen[bytes]:
        place = self.folder / "munge"
        (place / "key").write_bytes(secrets.token_bytes(128))
        (place / "key").chmod(0o600)
        options = {
            "key-file": place / "key",
            "socket": place / "socket",
            "pid-file": place / "pid",
            "log-file": place / "log",
            "seed-file": place / "seed",
        }
        munged = self._daemon(
            "munged", "--foreground", "--force", *(f"--{k}={v}" for k, v in options.items())
        )
        wait_until((place / "socket").exists)
        return munged

    def _daemon(self, *command: str) -> subprocess.Popen[bytes]:
        with (self.folder / f"{command[0]}.out").open("ab") as output:
            return subprocess.Popen(
                command,
                env={**os.environ, "PATH": _path()},
                stdout=output,
                stderr=output,
                start_new_session=True,
            )

    def start_node(self) -> None:
        """Start the node and wait until it takes jobs."""
        self._node = self._daemon("slurmd", "-D", "-N", self.host)
        wait_until(lambda: self._state() in {"idle", "mixed", "allocated"})

    def lose_node(self) -> None:
        """Take the power from the node: its daemon is gone, and all processes of its jobs.

        A controller finds that out by itself, in a minute or so; this one is told.
        """
        assert self._node is not None
        self._node.kill()
        self._node.wait()
        self._kill_jobs()
        said("scontrol", "update", f"NodeName={self.host}", "State=DOWN", "Reason=power")

    def _kill_jobs(self) -> None:
        for process in self._processes_of_jobs():
            with contextlib.suppress(psutil.NoSuchProcess):
                process.kill()

    def _processes_of_jobs(self) -> list[psutil.Process]:
        """Return the processes of all jobs, those of SLURM that watch over them first."""
        of_jobs, watching = [], {}
        for process in psutil.process_iter():
            with contextlib.suppress(psutil.Error):
                if process.environ().get("SLURM_CLUSTER_NAME") == self.name:
                    of_jobs.append(process)
                    parent = process.parent()
                    if parent is not None and parent.name() == "slurmstepd":
                        watching[parent.pid] = parent
        return [*watching.values(), *of_jobs]

    def stop(self) -> None:
        """End everything and leave nothing behind."""
        self._kill_jobs()
        for daemon in (self._node, self._controller, self._munged):
            if daemon is not None:
                daemon.kill()
                daemon.wait()
        if LINK.is_symlink() and LINK.readlink() == self.folder / "slurm.conf":
            subprocess.run([*AS_ROOT, "rm", LINK], check=True)

    def _state(self) -> str:
        return said("sinfo", "--noheader", "--format=%T").rstrip("*\n ")

    def jobs(self, state: str = "all") -> dict[str, str]:
        """Return the states of jobs by their numbers."""
        lines = said("squeue", "--noheader", f"--states={state}", "--format=%i %T").splitlines()
        return dict(line.split() for line in lines)  # type: ignore[arg-type]

    def running(self) -> str:
        """Wait for a job that runs; return its number."""
        found: dict[str, str] = {}
        wait_until(lambda: found.update(self.jobs("running")) or found)
        return next(iter(found))


def said(*command: str) -> str:
    """Return what a command of SLURM says; it is given again until the controller answers."""
    answers: list[str] = []

    def is_answered() -> bool:
        ended = subprocess.run(command, stdout=subprocess.PIPE, text=True, check=False)
        if ended.returncode == 0:
            answers.append(ended.stdout)
        return bool(answers)

    wait_until(is_answered)
    return answers[0]


def _free_ports(number: int) -> list[int]:
    sockets = [socket.socket() for _ in range(number)]
    for one in sockets:
        one.bind(("127.0.0.1", 0))
    ports = [int(one.getsockname()[1]) for one in sockets]
    for one in sockets:
        one.close()
    return ports
