"""Progress of the cases of a run, read from the files that it leaves behind.

It comes from cases, results, progress files and logs alone. So it can be read while a sweep runs,
after a crash, and on a copy of the folder.
"""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from enum import StrEnum
from pathlib import Path
from typing import Any

import numpy as np

from equisection.cases import Kind
from equisection.errors import EquisectionError, ResultFileError
from equisection.keys.shown import printable
from equisection.results.failures import failure_of
from equisection.results.loads_zigzag import warning_of_zigzag
from equisection.results.netcdf import read_attributes
from equisection.results.whole import is_whole
from equisection.run.listing import Listed, cases_of_run, config_of_run
from equisection.run.status_cost import CostOfRun
from equisection.run.status_logs import LINES, JobsOfRun, last_lines, last_warning
from equisection.store.index import indices_of_run, read_with_missing
from equisection.store.lock import Owner, living_owner
from equisection.store.made_from import recorded, require_as_made
from equisection.store.progress import Snapshot
from equisection.store.result_store import ResultStore, runs_batches, task_of


class StatusError(EquisectionError):
    """A folder to tell the status of does not exist."""


class State(StrEnum):
    """State of one case."""

    DONE = "done"
    FAILED = "failed"  # ran and has no result, or its job ended with an error
    RUNNING = "running"
    STOPPED = "stopped"  # its job is gone without a word
    STALE = "stale"  # its result is that of another case
    BROKEN = "broken"  # a file that cannot be used
    WAITING = "waiting"


@dataclass(frozen=True)
class CaseStatus:
    """One case of a run.

    Attributes
    ----------
    kind
        Kind of the case.
    model
        Model of the sweep, or kind and dimension, as in ``steady 2d``.
    case
        Name of the case, for instance ``k6.44``.
    regime
        Verdict on a finished run, where its kind has one.
    job
        Progress of the job that runs it, or ran it last.
    owner
        Job that runs it, where one says so in its working directory.
    text
        Reason of a verdict or failure, or the remedy.
    last_lines
        Last lines of the log of a case that failed or stopped.
    simulated, duration
        Length of its history, and the longest allowed (c/V); None for a case without a history.
    core_seconds_used, core_seconds_to_come
        Time that it took of all its processors, and that of the rest at most by the cost model;
        None where it is unknown.
    """

    kind: Kind
    model: str
    case: str
    state: State
    regime: str = ""
    job: Snapshot | None = None
    owner: Owner | None = None
    text: str = ""
    last_lines: tuple[str, ...] = ()
    simulated: float | None = None
    duration: float | None = None
    core_seconds_used: float | None = None
    core_seconds_to_come: float | None = None


@dataclass(frozen=True)
class RunStatus:
    """Status of a run: its cases, and the errors of jobs that run no case."""

    name: str
    entries: tuple[CaseStatus, ...]
    troubles: tuple[str, ...] = ()

    def count(self, kind: Kind) -> Counter[State]:
        """Return the number of cases of a kind in each state."""
        return Counter(entry.state for entry in self.entries if entry.kind == kind)

    def core_seconds_used(self) -> float:
        """Return the time of all processors (s) that the results took."""
        return sum(entry.core_seconds_used or 0.0 for entry in self.entries)

    def core_seconds_to_come(self) -> float | None:
        """Return the time of processors still to come (s), at most; None where it is unknown."""
        to_come = [entry.core_seconds_to_come for entry in self.entries]
        return None if None in to_come else sum(value or 0.0 for value in to_come)


def find_runs(folder: Path) -> list[Path]:
    """Return the folder itself if it is that of a run, or else the runs in it.

    Raises
    ------
    StatusError
        There is no such folder.
    """
    if not folder.is_dir():
        raise StatusError(
            f"{folder}: no such folder; give that of a run, for instance 'results/paper-plate', "
            "or start one with 'equisection run CONFIGFILE'"
        )
    if _is_run(folder):
        return [folder]
    return sorted(path for path in folder.iterdir() if path.is_dir() and _is_run(path))


def run_status(run: Path) -> RunStatus:
    """Read the status of a run."""
    reader = _Reader(run)
    entries = tuple(reader.entry(listed) for listed in cases_of_run(run))
    return RunStatus(run.name, entries, tuple(reader.jobs.troubles()))


class _Indices:
    """Attributes of the results that the indices of a run name, so that none need be opened."""

    def __init__(self, run: Path) -> None:
        self._run = run
        self._of: dict[str, tuple[dict[str, Any], int]] = {}
        self._missing: dict[str, str] = {}
        made = recorded(run)
        for index in indices_of_run(run):
            try:
                require_as_made(run, index, made)
                written = index.stat().st_mtime_ns
                entries, missing = read_with_missing(index)
            except (OSError, ResultFileError):
                continue
            place = index.parent.relative_to(run).as_posix()
            for name, attributes in entries.items():
                self._of[f"{place}/{name}.nc"] = attributes, written
            self._missing |= {f"{place}/{name}.nc": reason for name, reason in missing.items()}

    def why_missing(self, result: str) -> str:
        """Return the reason why a run from kept results alone has none of a case, if it says so."""
        return self._missing.get(result, "")

    def attributes(self, result: str, wanted: str) -> dict[str, Any]:
        """Return the attributes of the result of a case.

        Raises
        ------
        ResultFileError
            It cannot be read. Its case is for the caller to look at.
        """
        path = self._run / result
        attributes, written = self._of.get(result, ({}, 0))
        sound = attributes.get("case_hash") == wanted and path.stat().st_mtime_ns <= written
        return attributes if sound and is_whole(path) else read_attributes(path)


class _Reader:
    """Reads how far the cases of a run are."""

    def __init__(self, run: Path) -> None:
        self._run = run
        self._store = ResultStore(run.parent / ".store")
        self._indices = _Indices(run)
        self._cost = CostOfRun(config_of_run(run))
        self.jobs = JobsOfRun(run)

    def entry(self, listed: Listed) -> CaseStatus:
        """Return how far one case is."""
        error, log = self.jobs.error(listed.place, listed.file)
        entry = CaseStatus(
            listed.kind, listed.model, listed.name, State.BROKEN, text=printable(listed.problem)
        )
        if listed.case is None:
            return entry
        entry = replace(entry, duration=listed.case.longest)
        fault = State.BROKEN, ""
        if (self._run / listed.result).exists():
            try:
                attributes = self._indices.attributes(listed.result, listed.hash)
            except ResultFileError as problem:
                path = self._run / listed.result
                fault = State.BROKEN, str(problem).removeprefix(f"{path}: ")
            else:
                if attributes.get("case_hash") == listed.hash:
                    return _finished(entry, attributes)
                fault = State.STALE, "its result is that of another case; run again"
        return self._unfinished(entry, listed, fault, error, log)

    def _unfinished(
        self,
        entry: CaseStatus,
        listed: Listed,
        fault: tuple[State, str],
        error: str,
        log: Path | None,
    ) -> CaseStatus:
        """Return how far a case without a usable result is."""
        assert listed.case is not None
        task = task_of(listed.case)
        job = self.jobs.of(listed.hash)
        owner = None if runs_batches(listed.case) else living_owner(self._store.work(task))
        expected = self._cost.core_seconds(listed)
        done = job.fraction if job else 0.0
        entry = replace(
            entry,
            job=job,
            owner=owner,
            simulated=done * entry.duration if job and entry.duration is not None else None,
            core_seconds_to_come=None if expected is None else (1 - done) * expected,
        )
        runs_here = job is not None and job.lives()
        if runs_here or owner is not None:
            text = last_warning(log) if runs_here else "by another workflow in this store"
            return replace(entry, state=State.RUNNING, text=printable(text))
        if fault[1]:
            return replace(entry, state=fault[0], text=printable(fault[1]))
        lines = last_lines(self._store.work(task), log)
        if error:
            return replace(entry, state=State.FAILED, text=printable(error), last_lines=lines)
        waits_for = self._indices.why_missing(listed.result)
        if not waits_for and self._store.result(task).exists():
            waits_for = "its result is in the store"
        if job is not None and not waits_for:
            text = f"its process ended at {100 * done:.0f} % without a word; run again"
            return replace(entry, state=State.STOPPED, text=text, last_lines=lines)
        return replace(entry, state=State.WAITING, text=printable(waits_for))


def _finished(entry: CaseStatus, attributes: dict[str, Any]) -> CaseStatus:
    """Return the entry of a result; one without a verdict has perhaps a failure."""
    failure = failure_of(attributes)
    reason = failure or str(attributes.get("reason", ""))
    doubt = warning_of_zigzag(_number(attributes.get("loads_zigzag")) or 0.0)
    if doubt:
        reason = f"{reason}; {doubt}"
    return replace(
        entry,
        state=State.FAILED if failure else State.DONE,
        regime=str(attributes.get("regime", "")),
        text=printable(reason),
        last_lines=tuple(map(printable, reason.splitlines()[-LINES:])) if failure else (),
        simulated=_number(attributes.get("end_time")),
        core_seconds_used=_number(attributes.get("cpu_seconds")),
        core_seconds_to_come=0.0,
    )


def _number(value: Any) -> float | None:
    return float(value) if isinstance(value, (int, float, np.floating)) else None


def _is_run(folder: Path) -> bool:
    if folder.name.startswith("."):
        return False
    return any((folder / name).exists() for name in ("cases", "logs", "config.resolved.yaml"))
