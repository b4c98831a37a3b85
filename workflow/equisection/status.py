"""How far the sweep of a run is, read from the files that it leaves behind.

Nothing is asked of the workflow: cases, results, progress files and logs say it all, so it can
be read while a sweep runs, after a crash, and on a copy of the folder.
"""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

import yaml

from equisection import plan
from equisection.cases import case_hash, read_cases
from equisection.config import load_config
from equisection.errors import CaseFileError, ConfigError, EquisectionError, ResultFileError
from equisection.progress import SUFFIX, Snapshot, read_snapshot
from equisection.results.failures import failure_of
from equisection.results.netcdf import read_attributes


class StatusError(EquisectionError):
    """There is no such folder to tell the status of."""


class State(StrEnum):
    """How far one case is."""

    DONE = "done"
    FAILED = "failed"  # ran and has no result, or its job ended with an error
    RUNNING = "running"
    STOPPED = "stopped"  # its job is gone without a word
    BROKEN = "broken"  # a file that cannot be used
    WAITING = "waiting"


@dataclass(frozen=True)
class Entry:
    """One case of a run.

    Attributes
    ----------
    model
        Model of the sweep, or ``steady 2d`` and ``steady 3d``.
    case
        Name of the case, for instance ``k6.44``.
    regime
        What a finished unsteady run turned out to be.
    job
        Progress of the job that runs it, or ran it last.
    text
        The reason of a verdict or failure, or what to do.
    """

    model: str
    case: str
    state: State
    regime: str = ""
    job: Snapshot | None = None
    text: str = ""

    @property
    def steady(self) -> bool:
        """Whether it is a steady case."""
        return self.model.startswith("steady")


@dataclass(frozen=True)
class RunStatus:
    """How far a run is: its cases, and what went wrong outside of them."""

    name: str
    entries: tuple[Entry, ...]
    troubles: tuple[str, ...] = ()

    def count(self, *, steady: bool) -> Counter[State]:
        """Return how many cases are in each state."""
        return Counter(entry.state for entry in self.entries if entry.steady is steady)


@dataclass(frozen=True)
class _Listed:
    """A case of a case file, or what is wrong with the file."""

    file: Path
    name: str
    hash: str
    problem: str = ""


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
            "or start one with 'snakemake --cores 2'"
        )
    if _is_run(folder):
        return [folder]
    return sorted(path for path in folder.iterdir() if path.is_dir() and _is_run(path))


def run_status(run: Path) -> RunStatus:
    """Read how far a run is."""
    jobs = _Jobs(run)
    earlier = _earlier_sweep(run)
    entries = []
    for dimension in ("2d", "3d"):
        place = f"steady/{dimension}"
        for listed in _cases_in(run / "cases" / place, _by_angle):
            entries.append(_entry(run, f"steady {dimension}", place, listed, jobs))
    for model in sorted((run / "cases" / "unsteady").glob("*/")):
        place = f"unsteady/{model.name}"
        for listed in _cases_in(model, _by_k_star):
            if not earlier(listed.file, listed.name):
                entries.append(_entry(run, model.name, place, listed, jobs))
    return RunStatus(run.name, tuple(entries), tuple(jobs.troubles()))


class _Jobs:
    """Progress files and logs of a run."""

    def __init__(self, run: Path) -> None:
        self._folder = run / "logs"
        self._errors: dict[Path, str] = {}
        self._asked: set[Path] = set()
        self._of_case: dict[str, Snapshot] = {}
        for path in self._folder.glob("*" + SUFFIX):
            snapshot = read_snapshot(path)
            for case in snapshot.cases if snapshot else ():
                before = self._of_case.get(case)
                if snapshot and (before is None or before.updated < snapshot.updated):
                    self._of_case[case] = snapshot

    def of(self, hash_of_case: str) -> Snapshot | None:
        """Return the progress of the job that last said it runs a case."""
        return self._of_case.get(hash_of_case)

    def error(self, place: str, case: Path) -> str:
        """Return the error with which a case's last job ended, if it did.

        A log older than the case file is that of an earlier case of the same name.
        """
        job = place.replace("/", "_")
        logs = [self._folder / f"{job}_{case.stem}.log", self._folder / f"{job}.log"]
        there = [path for path in logs if path.is_file()]
        self._asked.update(there)
        if not there:
            return ""
        log = max(there, key=lambda path: path.stat().st_mtime)
        return self._error_of(log) if log.stat().st_mtime >= case.stat().st_mtime else ""

    def troubles(self) -> list[str]:
        """Return the errors of the jobs that run no case, each with its log."""
        logs = sorted(set(self._folder.glob("*.log")) - self._asked)
        found = ((path, self._error_of(path)) for path in logs)
        return [f"{path}: {error}" for path, error in found if error]

    def _error_of(self, log: Path) -> str:
        if log not in self._errors:
            self._errors[log] = last_error(log)
        return self._errors[log]


def last_error(log: Path) -> str:
    """Return the message of the last error in a log; for a fault of the program its last line."""
    try:
        lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return ""
    numbers = [number for number, line in enumerate(lines) if " ERROR " in line[:40]]
    if not numbers:
        return ""
    after = [line for line in lines[numbers[-1] :] if line.strip()]
    if any(line.startswith("Traceback") for line in after):
        return f"a fault of the program: {after[-1].strip()} (see {log})"
    return after[0].split(" ERROR ", 1)[1]


def _earlier_sweep(run: Path) -> Callable[[Path, str], bool]:
    """Return what tells whether a case file was left behind by an earlier sweep of the run.

    The run's configuration says which are wanted; of a case file that is newer it knows nothing.
    """
    resolved = run / "config.resolved.yaml"
    try:
        config = load_config(yaml.safe_load(resolved.read_text(encoding="utf-8")))
        written = resolved.stat().st_mtime
        rounds = (run / "comparison" / "refine").glob("*.json")
        refined = [name for chosen in rounds for name in plan.read_refinement(chosen)]
    except (OSError, ValueError, KeyError, yaml.YAMLError, ConfigError):
        return lambda file, name: False
    wanted = {*plan.sweep_cases(config), *refined}
    return lambda file, name: name not in wanted and file.stat().st_mtime < written


def _entry(run: Path, model: str, place: str, listed: _Listed, jobs: _Jobs) -> Entry:
    """Return how far one case is."""
    name, wanted = listed.name, listed.hash
    error = jobs.error(place, listed.file)
    if listed.problem:
        return Entry(model, name, State.BROKEN, text=listed.problem)
    job = jobs.of(wanted)
    broken = ""
    result = run / place / f"{name}.nc"
    if result.exists():
        try:
            return _finished(model, name, read_attributes(result, wanted))
        except ResultFileError as problem:
            broken = str(problem).removeprefix(f"{result}: ")
    in_store = (run.parent / ".store" / wanted / "result.nc").exists()
    state, text = _unfinished(job, broken, error, in_store)
    return Entry(model, name, state, job=job, text=text)


def _unfinished(job: Snapshot | None, broken: str, error: str, in_store: bool) -> tuple[State, str]:
    """Return how far a case without a usable result is, and what to say of it."""
    if job is not None and job.lives():
        return State.RUNNING, ""
    if broken:
        return State.BROKEN, broken
    if error:
        return State.FAILED, error
    if in_store:
        return State.WAITING, "its result is in the store"
    if job is not None:
        share = f"{100 * job.fraction:.0f} %"
        return State.STOPPED, f"its process ended at {share} without a word; run again"
    return State.WAITING, ""


def _finished(model: str, case: str, attributes: dict[str, Any]) -> Entry:
    """Return the entry of a result; a steady one has no regime, only perhaps a failure."""
    regime = str(attributes.get("regime", ""))
    failure = failure_of(attributes)
    if failure:
        return Entry(model, case, State.FAILED, regime, text=failure)
    return Entry(model, case, State.DONE, regime, text=str(attributes.get("reason", "")))


def _is_run(folder: Path) -> bool:
    if folder.name.startswith("."):
        return False
    return any((folder / name).exists() for name in ("cases", "logs", "config.resolved.yaml"))


def _cases_in(folder: Path, order: Callable[[str], tuple[Any, ...]]) -> list[_Listed]:
    """Return the cases of a folder's case files.

    A case that stands in several files, of a batch and of its own, is listed once.
    """
    found: dict[str, _Listed] = {}
    for file in sorted(folder.glob("*.json")):
        if file.name.startswith("."):
            continue
        try:
            for name, case in read_cases(file).items():
                found[name] = _Listed(file, name, case_hash(case))
        except CaseFileError as problem:
            found[file.stem] = _Listed(file, file.stem, "", str(problem))
    return [found[name] for name in sorted(found, key=order)]


def _by_k_star(name: str) -> tuple[float, str]:
    try:
        return plan.k_star_of(name), name
    except ValueError:
        return math.inf, name


def _by_angle(name: str) -> tuple[str, float]:
    try:
        return plan.angle_of(name)
    except ValueError:
        return name, math.inf
