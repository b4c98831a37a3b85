"""Results by the hash of their case, for all runs.

Each is in ``<store>/<hash>/result.nc``. It is no declared output of a rule, so it survives a kill
and a change of the sweep: a case that was ever finished is not computed again, but one that has
failed is. Whatever the store holds is validated before it is used.

A solver that runs its cases one by one has its working directory in ``<store>/<hash>`` too, that of
a case with a history under the hash of that, with the longest result so far as ``history.nc``.
Other criteria, or another duration, are answered from there if it is long enough.
"""

from __future__ import annotations

import logging
import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import xarray as xr

from equisection.cases import Case, canonical, case_hash, history_hash, kind_of
from equisection.errors import ResultFileError
from equisection.files import second_name, written_whole
from equisection.provenance import made_by
from equisection.results.failures import failure_of
from equisection.results.netcdf import read_attributes, read_dataset, write_dataset
from equisection.solvers.protocol import Capability
from equisection.solvers.registry import SOLVERS
from equisection.store.judged_again import judged_again
from equisection.store.kept import Kept, kept_of, with_history_of

logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class Task:
    """One case of a job.

    Attributes
    ----------
    case
        The case.
    hash
        Its hash.
    history
        Hash of its history; empty if that is not kept apart from the result.
    """

    case: Case
    hash: str
    history: str = ""


def task_of(case: Case) -> Task:
    """Return a case under its hashes."""
    if kind_of(case).ends and not case.not_run and not runs_batches(case):
        return Task(case, case_hash(case), history_hash(case))
    return Task(case, case_hash(case))


def runs_batches(case: Case) -> bool:
    """Tell whether the solver of a case runs many of them in one job."""
    solver = SOLVERS.get(case.solver.name)
    return solver is not None and Capability.BATCH in solver.provides


@dataclass(frozen=True)
class ResultStore:
    """The folder of the results by hash."""

    folder: Path

    def result(self, task: Task) -> Path:
        """Return the file of the result of a case."""
        return self.folder / task.hash / "result.nc"

    def work(self, task: Task) -> Path:
        """Return the working directory of a solver that runs the case."""
        return self.folder / (task.history or task.hash)

    def _history(self, task: Task) -> Path:
        return self.work(task) / "history.nc"

    def known(self, task: Task) -> dict[str, Any] | None:
        """Return the attributes of a result that the store has, if its case has not failed."""
        path = self.result(task)
        if not path.exists():
            return None
        try:
            attributes = read_attributes(path, task.hash)
        except ResultFileError as error:
            logger.warning("%s; it is computed again", error)
            return None
        failure = failure_of(attributes)
        if failure:
            logger.info("it failed before and is tried again: %s", failure)
            return None
        return attributes

    def put(
        self, task: Task, dataset: xr.Dataset, made_by: Mapping[str, str] | None = None
    ) -> dict[str, Any]:
        """Write a result and return its attributes; of a history the longest result is kept.

        ``made_by`` is the origin of a result that was not computed now.
        """
        path = self.result(task)
        own = {"case_hash": task.hash}
        if not runs_batches(task.case):
            own["case"] = canonical(task.case)
        attributes = write_dataset(path, dataset.assign_attrs(own), made_by)
        self._put_history(task, attributes)
        return attributes

    def _put_history(self, task: Task, attributes: Mapping[str, Any]) -> None:
        """Have the result of a case as its history, if that is the longest."""
        if task.history and not failure_of(attributes):
            longest = self._history(task)
            if float(attributes["end_time"]) > _length(longest):
                second_name(self.result(task), longest)

    def take(self, task: Task, kept: Sequence[Kept]) -> dict[str, Any] | None:
        """Take a kept result of a case, or of one that is alike; return its attributes."""
        for one in kept:
            if one.attributes["case_hash"] == task.hash:
                logger.info("taken from %s, where it is kept", one.path)
                stored = self.result(task)
                with written_whole(stored) as aside:
                    shutil.copyfile(one.path, aside)
                attributes = read_attributes(stored, task.hash)
                self._put_history(task, attributes)
                return attributes
        if not runs_batches(task.case):
            alike = next(kept_of(kept, task.case), None)
            if alike is not None:
                logger.info("taken from %s, whose case is alike", alike.path)
                return self._put_known(task, read_dataset(alike.path), alike.attributes)
        return None

    def judge_again(
        self, task: Task, kept: Sequence[Kept], *, kept_alone: bool = False
    ) -> dict[str, Any] | None:
        """Answer a case from its history, if that is long enough; return the attributes.

        ``kept_alone`` leaves out the history that the store has from before.
        """
        if not task.history:
            return None
        own = self._history(task)
        histories = [own] if not kept_alone and _length(own) else []
        histories += [one.path for one in with_history_of(kept, task.case)]
        for path in histories:
            history = read_dataset(path)
            result = judged_again(task.case, history)
            if result is not None:
                logger.info("judged again by the history in %s", path)
                return self._put_known(task, result, history.attrs)
        return None

    def _put_known(
        self, task: Task, dataset: xr.Dataset, source: Mapping[str, Any]
    ) -> dict[str, Any]:
        """Write what the result of another case answers; it says which, and what made that."""
        taken = dataset.assign_attrs(taken_from=str(source["case_hash"]))
        return self.put(task, taken, made_by(source))


def _length(history: Path) -> float:
    """Return how long a history is (c/V); 0 of one that is not there or is broken."""
    try:
        return float(read_attributes(history)["end_time"]) if history.exists() else 0.0
    except ResultFileError as error:
        logger.warning("%s; it is computed again", error)
        return 0.0
