"""Progress of a job: in its log and in a progress file always, and on a terminal as a bar.

The progress file is a small JSON file next to the log, which ``equisection status`` reads. It has
the cases of the job, the part that is done, start and estimated end, and the process. A process may
be killed and leave its file behind, so a file counts only while its process lives.
"""

from __future__ import annotations

import json
import logging
import math
import os
import socket
import sys
import time
from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace
from datetime import datetime
from pathlib import Path
from types import TracebackType

from equisection.files import write_text
from equisection.store.progress_bar import Bar, bar_of_terminal

logger = logging.getLogger(__name__)

SUFFIX = ".progress.json"
#: Seconds between two states of the progress file and of the terminal.
INTERVAL = 1.0
#: Seconds between two entries of the log if a hundredth was done meanwhile, and at the most.
LOG_INTERVAL, LOG_INTERVAL_OF_SLOW_RUN = 10.0, 600.0
#: Seconds without a word after which a job on another machine counts as gone.
SILENCE = 1800.0


#: Latest time that is one (seconds since the epoch): the year 5138.
_LAST_TIME = 1e11


def require_times(*times: float) -> None:
    """Refuse times that are none.

    Raises
    ------
    ValueError
        One is outside of what a clock can say (seconds since the epoch).
    """
    if not all(0.0 <= time <= _LAST_TIME for time in times):
        raise ValueError("a time is none")


@dataclass(frozen=True)
class Process:
    """A process, distinguished from a later one with the same number by its time of birth."""

    host: str
    pid: int
    birth: str  # start time in the system's ticks, empty where the system does not tell

    def __post_init__(self) -> None:
        """Refuse what a broken file says of a process (TypeError, ValueError)."""
        if not (isinstance(self.host, str) and isinstance(self.birth, str)):
            raise TypeError("host and birth are texts")
        if not 0 <= self.pid < 2**31:
            raise ValueError(f"no process has the number {self.pid}")

    @classmethod
    def this(cls) -> Process:
        """Return the process that runs."""
        return cls(socket.gethostname(), os.getpid(), _birth(os.getpid()) or "")

    def lives(self) -> bool | None:
        """Tell whether the process runs; None for one on another machine."""
        if self.host != socket.gethostname() or sys.platform == "win32":
            return None
        try:
            os.kill(self.pid, 0)  # asks, and sends nothing
        except ProcessLookupError:
            return False
        except PermissionError:  # it runs as another user, and the system may hide it
            birth = _birth(self.pid)
            return not birth or not self.birth or birth == self.birth
        birth = _birth(self.pid)
        return birth is not None and (birth == self.birth or not self.birth)


@dataclass(frozen=True)
class Snapshot:
    """Contents of a progress file.

    Attributes
    ----------
    cases
        Hashes of the cases that the job computes.
    done, total
        Amounts in ``unit``, summed over the cases.
    started, updated
        Seconds since the epoch.
    first_done, first_time
        First state that the solver reported. A job that goes on from an earlier one does not begin
        at 0, and the estimate of its end must not count the part that it found.
    """

    cases: tuple[str, ...]
    title: str
    unit: str
    done: float
    total: float
    started: float
    updated: float
    first_done: float
    first_time: float
    process: Process

    def __post_init__(self) -> None:
        """Refuse what a broken file says of a job (TypeError, ValueError)."""
        require_times(self.started, self.updated, self.first_time)
        if not all(map(math.isfinite, (self.done, self.total, self.first_done))):
            raise ValueError("an amount is no number")
        if not all(isinstance(text, str) for text in (*self.cases, self.title, self.unit)):
            raise TypeError("cases, title and unit are texts")

    @property
    def fraction(self) -> float:
        """Part that is done, from 0 to 1."""
        return min(max(self.done / self.total, 0.0), 1.0) if self.total > 0 else 0.0

    @property
    def estimated_end(self) -> float | None:
        """Estimated end of the job at its present rate (seconds since the epoch).

        None before there is a rate. A run may end earlier, with its verdict.
        """
        gained, took = self.done - self.first_done, self.updated - self.first_time
        if gained <= 0 or took <= 0:
            return None
        return self.updated + (self.total - self.done) * took / gained

    def lives(self, now: float | None = None) -> bool:
        """Tell whether the job still runs, as far as this machine can tell."""
        lives = self.process.lives()
        if lives is None:
            return (time.time() if now is None else now) - self.updated < SILENCE
        return lives

    def words(self) -> str:
        """Return the progress in the words of a log."""
        return (
            f"{self.done:.0f} of {self.total:.0f} {self.unit} ({100 * self.fraction:.0f} %), "
            f"since {clock(self.started)}, {self._end()}"
        )

    def few_words(self) -> str:
        """Return the progress in few words, which fit next to a bar on 80 columns."""
        return f"{100 * self.fraction:.0f} % of {self.total:.0f} {self.unit}, {self._end()}"

    def _end(self) -> str:
        end = self.estimated_end
        return "end not yet known" if end is None else f"ends about {clock(end)}"


class JobProgress:
    """Progress of one job; a context manager that removes its file when the job ends well.

    Parameters
    ----------
    path
        The progress file, ``<log without suffix>.progress.json``.
    cases
        Hashes of the cases.
    title
        Solver that runs them, in words.
    unit
        Unit of the progress.
    """

    def __init__(self, path: Path, cases: Sequence[str], title: str, unit: str = "c/V") -> None:
        now = time.time()
        self._path = path
        self._now = Snapshot(
            tuple(cases), title, unit, 0.0, 0.0, now, now, 0.0, 0.0, Process.this()
        )
        self._written = 0.0
        self._logged_time, self._logged_fraction = 0.0, 0.0
        self._bar: Bar | None = None

    def __enter__(self) -> JobProgress:
        self._write()
        logger.info("%s: starts on %d cases", self._now.title, len(self._now.cases))
        self._logged_time = time.time()
        self._bar = bar_of_terminal(label_of(self._path))
        return self

    def update(self, done: float, total: float) -> None:
        """Report that ``done`` of ``total`` (of the unit, summed over the cases) is done."""
        now = time.time()
        if self._now.total == 0.0:
            self._now = replace(self._now, first_done=done, first_time=now)
        elif now - self._written < INTERVAL and done < total:
            return
        self._now = replace(self._now, done=done, total=total, updated=now)
        self._write()
        since = now - self._logged_time
        gained = self._now.fraction - self._logged_fraction
        if (since >= LOG_INTERVAL and gained >= 0.01) or since >= LOG_INTERVAL_OF_SLOW_RUN:
            logger.info("%s", self._now.words())
            self._logged_time, self._logged_fraction = now, self._now.fraction
        if self._bar is not None:
            self._bar.show(self._now.fraction, self._now.few_words(), alone=self._is_alone())

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self._bar is not None:
            self._bar.close()
        took = time.time() - self._now.started
        if kind is None:
            self._path.unlink(missing_ok=True)
            logger.info("%s: ended well after %.0f s", self._now.title, took)
        elif self._now.total:
            logger.info("ended early: %s", self._now.words())

    def _write(self) -> None:
        write_text(self._path, json.dumps(asdict(self._now)))
        self._written = time.time()

    def _is_alone(self) -> bool:
        """Tell whether no other job of the run shows its progress on the same terminal."""
        others = (path for path in self._path.parent.glob("*" + SUFFIX) if path != self._path)
        return not any(there.lives() for there in map(read_snapshot, others) if there)


def read_snapshot(path: Path) -> Snapshot | None:
    """Read a progress file; None if it is missing or not a progress file."""
    try:
        raw = json.loads(path.read_text(encoding="utf-8"))
        process = Process(**raw.pop("process"))
        return Snapshot(tuple(raw.pop("cases")), process=process, **raw)
    except (OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError):
        return None


def label_of(path: Path) -> str:
    """Return a job's name from its progress file: ``unsteady_3d_k6.44`` is unsteady 3d k6.44."""
    return path.name.removesuffix(SUFFIX).replace("_", " ")


def clock(seconds: float) -> str:
    """Return a time in words, with its day if that is not today."""
    then = datetime.fromtimestamp(seconds).astimezone()
    today = then.date() == datetime.now().astimezone().date()
    return then.strftime("%H:%M:%S" if today else "%Y-%m-%d %H:%M")


def _birth(pid: int) -> str | None:
    """Return when a process started, empty if the system does not tell; None if it is dead."""
    try:
        text = Path(f"/proc/{pid}/stat").read_text(encoding="utf-8", errors="replace")
    except FileNotFoundError:
        return None if Path("/proc/self/stat").exists() else ""
    except OSError:
        return ""
    fields = text.rpartition(")")[2].split()  # state is field 3 of proc(5), start time field 22
    return None if fields[0] in ("Z", "X") else fields[19]
