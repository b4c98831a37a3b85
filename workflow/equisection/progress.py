"""How far a job is: in its log and a progress file always, as a bar on a terminal.

The progress file is a small JSON file that ``equisection status`` reads: which cases the job
runs, time simulated of how much, since when, and the estimated end.
"""

from __future__ import annotations

import json
import logging
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from types import TracebackType

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeRemainingColumn

from equisection.files import write_text

logger = logging.getLogger(__name__)

#: Seconds between two entries of the log and of the progress file.
INTERVAL = 2.0


@dataclass(frozen=True)
class Snapshot:
    """What a progress file says."""

    cases: tuple[str, ...]
    done: float  # c/V
    total: float  # c/V
    started: float  # seconds since the epoch
    updated: float

    @property
    def estimated_end(self) -> float | None:
        """Seconds since the epoch at which the job ends if it goes on as it did."""
        if self.done <= 0:
            return None
        return self.started + (self.updated - self.started) * self.total / self.done


class JobProgress:
    """Progress of one job; a context manager that removes its file when the job ends well."""

    def __init__(self, path: Path, cases: Sequence[str], title: str) -> None:
        self._path = path
        self._cases = tuple(cases)
        self._started = time.time()
        self._last = 0.0
        self._bar: Progress | None = None
        self._title = title

    def __enter__(self) -> JobProgress:
        console = Console(file=sys.__stderr__)
        if console.is_terminal:
            self._bar = Progress(
                TextColumn("{task.description}"),
                BarColumn(),
                TextColumn("{task.percentage:3.0f} %"),
                TimeRemainingColumn(),
                console=console,
                transient=True,
            )
            self._task = self._bar.add_task(f"{self._title}, {len(self._cases)} cases", total=1.0)
            self._bar.start()
        self.update(0.0, 1.0)
        return self

    def update(self, done: float, total: float) -> None:
        """Say that ``done`` of ``total`` (c/V, summed over the cases) is simulated."""
        if self._bar is not None:
            self._bar.update(self._task, completed=done / total)
        now = time.time()
        if now - self._last < INTERVAL:
            return
        self._last = now
        snapshot = Snapshot(self._cases, done, total, self._started, now)
        write_text(self._path, json.dumps(snapshot.__dict__))
        end = snapshot.estimated_end
        logger.info(
            "%.0f of %.0f c/V simulated (%.0f %%), since %s, estimated end %s",
            done,
            total,
            100 * done / total,
            _clock(self._started),
            _clock(end) if end else "unknown",
        )

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        traceback: TracebackType | None,
    ) -> None:
        if self._bar is not None:
            self._bar.stop()
        if kind is None:
            self._path.unlink(missing_ok=True)


def read_snapshot(path: Path) -> Snapshot | None:
    """Read a progress file; None if there is none or it is not one."""
    try:
        raw = json.loads(path.read_text(encoding="utf-8"))
        return Snapshot(tuple(raw.pop("cases")), **raw)
    except (OSError, ValueError, KeyError, TypeError):
        return None


def _clock(seconds: float) -> str:
    return datetime.fromtimestamp(seconds).astimezone().strftime("%H:%M:%S")
