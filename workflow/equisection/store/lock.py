"""Lock on a working directory: one job at a time, on this machine or on another.

Two workflows in one store, or a job that a killed workflow left running and the one that is
submitted in its place, must not run a solver in the same directory. So each job that is to run
there takes the next number of a row of small files, ``owners/1.json``, ``owners/2.json``, …. The
job with the highest number owns the directory until it has ended or is found to be gone. Others
wait. The files are few, and stay: they record by which job a case was run, when and where.

``flock`` and ``fcntl`` are not used: on the shared file systems of clusters these locks are often
switched off, or known to one node alone. All such file systems, also NFS from version 3 on, let a
single process create a name (``O_EXCL``). Numbers are never used twice, so an owner that is gone is
succeeded by the same means: of several jobs that wait, one creates the next number. No file is
removed to take a lock, since two jobs could then believe that they have it.

An owner shows that it lives by touching its file. A job that waits watches the time of the file,
and measures by its own clock for how long it has not changed: clocks of machines need not agree.
"""

from __future__ import annotations

import contextlib
import json
import logging
import os
import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, field, replace
from pathlib import Path

from equisection.errors import SolverError
from equisection.files import write_text
from equisection.store.progress import Process, clock, require_times

logger = logging.getLogger(__name__)

FOLDER = "owners"
#: Seconds from one sign of life of an owner to the next.
BEAT = 10.0
#: Seconds without one after which an owner on another machine counts as gone: several of the
#: longest times (60 s) for which NFS shows a file as it was.
SILENCE = 200.0
#: Seconds between two looks of a job that waits.
LOOK = 0.5


@dataclass(frozen=True)
class Owner:
    """A job that runs, or ran, in a working directory.

    Attributes
    ----------
    process
        Its process.
    since, ended
        Seconds since the epoch; ``ended`` is 0 until it has ended.
    job
        Its number with SLURM; empty without SLURM.
    """

    process: Process
    since: float
    job: str = ""
    ended: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what a broken file says of a job (TypeError, ValueError)."""
        require_times(self.since, self.ended)
        if not isinstance(self.job, str):
            raise TypeError("the number of a SLURM job is a text")

    @classmethod
    def this(cls) -> Owner:
        """Return the job that runs."""
        return cls(Process.this(), time.time(), os.environ.get("SLURM_JOB_ID", ""))

    def words(self) -> str:
        """Return its process, machine and SLURM job in words."""
        job = f"SLURM job {self.job}, " if self.job else ""
        return f"{job}process {self.process.pid} on {self.process.host}, since {clock(self.since)}"

    def is_gone(self, this: Owner, silent: float) -> bool:
        """Tell whether it has ended, or can no longer be running.

        A job of SLURM's is in one place at a time: one that runs elsewhere under the same number
        is from before a preemption or the loss of its node.

        Parameters
        ----------
        this
            The job that asks.
        silent
            Time (s) for which it has given no sign of life.
        """
        moved = self.job and self.job == this.job and self.process.host != this.process.host
        if self.ended or moved:
            return True
        lives = self.process.lives()
        return silent > SILENCE if lives is None else not lives


@dataclass
class HeldLock:
    """A working directory that this job owns."""

    folder: Path
    number: int
    owner: Owner
    _over: threading.Event = field(default_factory=threading.Event)

    @property
    def file(self) -> Path:
        """File of the lock."""
        return _file(self.folder, self.number)

    def require(self) -> None:
        """Make sure that no other job has taken this one for gone, and succeeded it.

        Raises
        ------
        SolverError
            One has: this process was stopped for longer than :data:`SILENCE`.
        """
        successor = _file(self.folder, self.number + 1)
        if successor.exists():
            other = _read(successor)
            raise SolverError(
                f"{self.folder.parent}: this job was silent for more than {SILENCE:g} s and was "
                f"taken for gone; {other.words() if other else 'another job'} runs the case now"
            )

    def show_life(self) -> None:
        """Touch the file until the claim is over; interrupt the job if it was succeeded."""
        while not self._over.wait(BEAT):
            with contextlib.suppress(OSError):  # the file system may be back at the next beat
                os.utime(self.file)
            if _file(self.folder, self.number + 1).exists():
                signal.pthread_kill(threading.main_thread().ident or 0, signal.SIGINT)
                return

    def end(self) -> None:
        """Write that the job has ended, if the disk has room for it."""
        self._over.set()
        with contextlib.suppress(OSError):
            ended = replace(self.owner, ended=time.time())
            write_text(self.file, json.dumps(asdict(ended)))


@contextmanager
def claimed(work: Path) -> Iterator[HeldLock]:
    """Own a working directory for the length of the block; wait for it as long as it takes.

    Raises
    ------
    SolverError
        This process was stopped in the block for so long that another took it for gone.
    """
    folder = work / FOLDER
    folder.mkdir(parents=True, exist_ok=True)
    claim = _wait(folder, Owner.this())
    # a job that a shell has started in the background ignores interrupts
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Thread(target=claim.show_life, daemon=True).start()
    try:
        yield claim
    except KeyboardInterrupt:
        claim.require()
        raise
    finally:
        claim.end()
        signal.signal(signal.SIGINT, before)


def living_owner(work: Path) -> Owner | None:
    """Return the job that runs in a working directory; None if no job is known to run there."""
    folder = work / FOLDER
    last = _last(folder)
    owner = _read(_file(folder, last)) if last else None
    try:
        silent = time.time() - _file(folder, last).stat().st_mtime if owner else 0.0
    except OSError:
        return None
    nobody = Owner(Process("", 0, ""), 0.0)
    return None if owner is None or owner.is_gone(nobody, silent) else owner


def _last(folder: Path) -> int:
    """Return the highest number that was taken; 0 for none."""
    names = (path.stem for path in folder.glob("[0-9]*.json"))
    return max((int(name) for name in names if name.isdecimal() and name.isascii()), default=0)


def _wait(folder: Path, this: Owner) -> HeldLock:
    """Take the next number as soon as whoever has the last one is gone."""
    watched, changed, heard = 0, 0, time.monotonic()
    while True:
        last = _last(folder)
        beat = _file(folder, last).stat().st_mtime_ns if last else 0
        if (last, beat) != (watched, changed):
            heard = time.monotonic()
        owner = _read(_file(folder, last)) if last else None
        silent = time.monotonic() - heard
        if last == 0 or (owner.is_gone(this, silent) if owner else silent > SILENCE):
            with contextlib.suppress(FileExistsError):
                claim = HeldLock(folder, last + 1, this)
                _create(claim)
                if owner and not owner.ended:
                    logger.info("%s is gone without a word", owner.words())
                return claim
        elif last != watched:
            who = owner.words() if owner else "a job that is just beginning"
            told = f"{folder.parent}: {who}, runs this case; waiting for its result"
            logger.info("%s", told)
            print(told, file=sys.stderr, flush=True)
        watched, changed = last, beat
        time.sleep(LOOK)


def _create(claim: HeldLock) -> None:
    """Create the file of a claim.

    Raises
    ------
    FileExistsError
        Another job did.
    """
    text = json.dumps(asdict(claim.owner))
    try:
        with claim.file.open("x", encoding="utf-8") as stream:
            stream.write(text)
    except FileExistsError:
        raise
    except OSError:  # a full disk: nobody is to wait for a job that does not come to run
        claim.file.unlink(missing_ok=True)
        raise


def _read(path: Path) -> Owner | None:
    """Read who an owner is; None if the file is not written yet."""
    try:
        raw = json.loads(path.read_text(encoding="utf-8"))
        return Owner(process=Process(**raw.pop("process")), **raw)
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None


def _file(folder: Path, number: int) -> Path:
    return folder / f"{number}.json"
