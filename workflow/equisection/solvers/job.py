"""Run the cases of one job: take what the store has, compute the rest, publish all.

The store keeps each result under the hash of its case, in ``<store>/<hash>/result.nc``, beside
the solver's own working directory. It is no declared output of a rule, so it survives a kill
and a change of the sweep: a case that was ever finished is not computed again. Whatever it
holds is validated before it is published.
"""

from __future__ import annotations

import logging
import os
import shutil
import time
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import xarray as xr

from equisection.cases import Case, SteadyCase, UnsteadyCase, case_hash
from equisection.errors import ResultFileError, SolverError
from equisection.files import written_whole
from equisection.progress import JobProgress
from equisection.results.kept import kept_results
from equisection.results.netcdf import read_attributes, write_dataset
from equisection.results.steady import SteadyResult
from equisection.results.unsteady import UnsteadyResult
from equisection.solvers.protocol import Solver
from equisection.solvers.registry import solver_from_case
from equisection.solvers.verdicts import refused

logger = logging.getLogger(__name__)


@dataclass(frozen=True)
class Task:
    """One case of a job under its hash."""

    case: Case
    hash: str


def run_cases(
    cases: Mapping[str, Case],
    folder: Path,
    store: Path,
    progress_file: Path,
    reuse: Path | None = None,
) -> dict[str, dict[str, Any]]:
    """Run the cases that the store does not have, and publish the results of all.

    Parameters
    ----------
    cases
        Cases by name.
    folder
        Where the results go, as ``<name>.nc``.
    store
        Folder of the results by hash.
    progress_file
        Where the job says how far it is.
    reuse
        Folder with results of earlier runs, which are taken into the store.

    Returns
    -------
    dict
        The attributes of each result by name: verdict, hash, provenance and cost.

    Raises
    ------
    CaseFileError
        A case asks for a solver, or a version of it, that is not here.
    SolverError
        The solver could not run, or left a case without a result.
    """
    tasks = {name: Task(case, case_hash(case)) for name, case in cases.items()}
    known = {task.hash: _in_store(store, task.hash) for task in tasks.values()}
    if reuse is not None and None in known.values():
        known |= _reused(reuse, [wanted for wanted, found in known.items() if not found], store)
    missing = {task.hash: task for task in tasks.values() if known[task.hash] is None}
    logger.info("%d cases, %d of them to be computed", len(tasks), len(missing))
    for group in _alike(list(missing.values())):
        known |= _compute(group, store, progress_file)
    attributes = {}
    for name, task in tasks.items():
        attributes[name] = known[task.hash] or {}
        _publish(_result(store, task.hash), folder / f"{name}.nc")
    return attributes


def _result(store: Path, case_hash: str) -> Path:
    return store / case_hash / "result.nc"


def _in_store(store: Path, wanted: str) -> dict[str, Any] | None:
    """Return the attributes of a result that the store has."""
    path = _result(store, wanted)
    if not path.exists():
        return None
    try:
        return read_attributes(path, wanted)
    except ResultFileError as error:
        logger.warning("%s; it is computed again", error)
        return None


def _reused(folder: Path, wanted: list[str], store: Path) -> dict[str, dict[str, Any]]:
    """Copy kept results into the store; return their attributes by hash."""
    kept, found = kept_results(folder), {}
    for name in wanted:
        if name not in kept:
            continue
        logger.info("taken from %s, where it is kept", kept[name])
        stored = _result(store, name)
        stored.parent.mkdir(parents=True, exist_ok=True)
        with written_whole(stored) as aside:
            shutil.copyfile(kept[name], aside)
        found[name] = read_attributes(stored, name)
    return found


def _alike(tasks: list[Task]) -> list[list[Task]]:
    """Group the tasks by solver and its settings: one adapter runs one group."""
    groups: dict[str, list[Task]] = {}
    for task in tasks:
        groups.setdefault(task.case.solver.model_dump_json(), []).append(task)
    return list(groups.values())


def _compute(tasks: list[Task], store: Path, progress_file: Path) -> dict[str, dict[str, Any]]:
    """Run cases of one solver into the store; return the attributes of each result by hash."""
    solver = solver_from_case(tasks[0].case.solver)
    work = store / tasks[0].hash
    work.mkdir(parents=True, exist_ok=True)
    wall, cpu = time.perf_counter(), _cpu_seconds()
    unit = "cases" if isinstance(tasks[0].case, SteadyCase) else "c/V"
    hashes = [task.hash for task in tasks]
    with JobProgress(progress_file, hashes, solver.describe(), unit) as progress:
        results = _run(solver, [task.case for task in tasks], work, progress)
    if len(results) != len(tasks):
        raise SolverError(
            f"solver '{solver.name}' returned {len(results)} results for {len(tasks)} cases"
        )
    cost = {
        "wall_seconds": (time.perf_counter() - wall) / len(tasks),
        "cpu_seconds": (_cpu_seconds() - cpu) / len(tasks),
        "batch_cases": len(tasks),
    }
    attributes = {}
    for task, result in zip(tasks, results, strict=True):
        dataset = _dataset(task.case, result).assign_attrs(
            case_hash=task.hash,
            solver=solver.name,
            solver_version=solver.version,
            solver_description=solver.describe(),
            resolution=task.case.resolution,
            **cost,
        )
        attributes[task.hash] = write_dataset(_result(store, task.hash), dataset)
    return attributes


def _run(
    solver: Solver, cases: list[Case], work: Path, progress: JobProgress
) -> Sequence[SteadyResult | UnsteadyResult]:
    steady = [case for case in cases if isinstance(case, SteadyCase)]
    unsteady = [case for case in cases if isinstance(case, UnsteadyCase)]
    if steady and unsteady:
        raise SolverError("a job holds steady and unsteady cases; one kind is allowed")
    if steady:
        return solver.run_steady(steady, work, progress.update)
    possible = [case for case in unsteady if not case.refusal]
    ran = iter(solver.run_unsteady(possible, work, progress.update) if possible else [])
    return [refused(case) if case.refusal else next(ran) for case in unsteady]


def _cpu_seconds() -> float:
    """Return the CPU time of this process and of the programs that it ran."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system


def _dataset(case: Case, result: SteadyResult | UnsteadyResult) -> xr.Dataset:
    if isinstance(result, SteadyResult):
        return result.to_dataset().assign_attrs(incidence_deg=case.incidence_deg)
    return result.to_dataset(case.geometry.chord).assign_attrs(
        k_star=getattr(case, "k_star", float("nan"))
    )


def _publish(stored: Path, output: Path) -> None:
    """Put a result where the workflow wants it: a second name of the file, or a copy."""
    output.parent.mkdir(parents=True, exist_ok=True)
    with written_whole(output) as aside:
        aside.unlink()
        try:
            os.link(stored, aside)
        except OSError:
            shutil.copyfile(stored, aside)
