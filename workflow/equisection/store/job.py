"""Run the cases of one job: take the results that are known, compute the rest, publish all."""

from __future__ import annotations

import logging
import time
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import xarray as xr

from equisection.cases import Case, kind_of, point_of
from equisection.errors import SolverError
from equisection.files import second_name
from equisection.results.case_result import CaseResult
from equisection.results.spent import Spent, cpu_seconds_so_far
from equisection.solvers.protocol import ONE_THREAD, Allocation, Solver
from equisection.solvers.registry import solver_from_case
from equisection.solvers.verdicts import refused
from equisection.store.kept import kept_results
from equisection.store.lock import claimed
from equisection.store.progress import JobProgress
from equisection.store.result_store import ResultStore, Task, runs_batches, task_of

logger = logging.getLogger(__name__)


def run_cases(
    cases: Mapping[str, Case],
    folder: Path,
    store: Path,
    progress_file: Path,
    reuse: Path | None = None,
    *,
    allocation: Allocation = ONE_THREAD,
) -> dict[str, dict[str, Any]]:
    """Run the cases that the store does not have, and publish the results of all.

    Where another job runs one of them in this store, it waits and takes the result.

    Parameters
    ----------
    cases
        Cases by name.
    folder
        Folder for the results ``<name>.nc``.
    store
        Folder of the results by hash.
    progress_file
        File with the progress of the job.
    reuse
        Folder with results of earlier runs, which are taken into the store.
    allocation
        Resources that the job has been given; they decide no result.

    Returns
    -------
    dict
        The attributes of each result by name: its point in the study, verdict, hash, provenance
        and cost.

    Raises
    ------
    CaseFileError
        A case asks for a solver, or a version of it, that is not here.
    SolverError
        The solver could not run, or left a case without a result; or this process was stopped for
        so long that another job took its place.
    """
    results = ResultStore(store)
    tasks = {name: task_of(case) for name, case in cases.items()}
    different = {task.hash: task for task in tasks.values()}
    known = {name: results.known(task) for name, task in different.items()}
    kept = kept_results(reuse) if reuse is not None and None in known.values() else []
    for name, task in different.items():
        known[name] = known[name] or results.take(task, kept) or results.judge_again(task, kept)
    missing = [task for name, task in different.items() if known[name] is None]
    logger.info("%d cases, %d of them to be computed", len(tasks), len(missing))
    for group in _alike(missing):
        known |= _compute(group, results, progress_file, allocation)
    for name, task in tasks.items():
        second_name(results.result(task), folder / f"{name}.nc")
    return {name: point_of(task.case) | (known[task.hash] or {}) for name, task in tasks.items()}


def _alike(tasks: list[Task]) -> list[list[Task]]:
    """Group the tasks by solver and its settings; a solver without batches has one in each."""
    groups: dict[str, list[Task]] = {}
    for task in tasks:
        batch = runs_batches(task.case)
        name = task.case.solver.model_dump_json() if batch else task.hash
        groups.setdefault(name, []).append(task)
    return list(groups.values())


def _compute(
    tasks: list[Task], store: ResultStore, progress_file: Path, allocation: Allocation
) -> dict[str, dict[str, Any]]:
    """Have cases of one solver in the store; return the attributes of each result by hash."""
    with claimed(store.work(tasks[0])) as claim:
        # another job may have had the directory until now
        known = {task.hash: store.known(task) or store.judge_again(task, ()) for task in tasks}
        missing = [task for task in tasks if known[task.hash] is None]
        if missing:
            found = _results(missing, store.work(tasks[0]), progress_file, allocation)
            claim.require()
            known |= {task.hash: store.put(task, found[task.hash]) for task in missing}
    return {name: attributes or {} for name, attributes in known.items()}


def _results(
    tasks: list[Task], work: Path, progress_file: Path, allocation: Allocation
) -> dict[str, xr.Dataset]:
    """Run cases of one solver; return the result of each by hash."""
    solver = solver_from_case(tasks[0].case.solver, allocation)
    wall, cpu = time.perf_counter(), cpu_seconds_so_far()
    hashes = [task.hash for task in tasks]
    description = solver.describe(tasks[0].case.dimension)
    with JobProgress(progress_file, hashes, description, kind_of(tasks[0].case).unit) as progress:
        results = _run(solver, [task.case for task in tasks], work, progress)
    shared = Spent(
        cpu_seconds=(cpu_seconds_so_far() - cpu) / len(tasks),
        wall_seconds=(time.perf_counter() - wall) / len(tasks),
    )
    return {
        task.hash: result.of_case(task.case).assign_attrs(
            point_of(task.case),
            solver=solver.name,
            solver_version=solver.version,
            solver_description=solver.describe(task.case.dimension),
            resolution=task.case.resolution,
            batch_cases=len(tasks),
            **asdict(result.spent or shared),
        )
        for task, result in zip(tasks, results, strict=True)
    }


def _run(
    solver: Solver, cases: Sequence[Case], work: Path, progress: JobProgress
) -> list[CaseResult]:
    """Run cases of one kind, but for those that no solver runs."""
    kinds = sorted({case.kind for case in cases})
    if len(kinds) > 1:
        raise SolverError(f"a job holds {' and '.join(kinds)} cases; one kind is allowed")
    run = getattr(solver, kind_of(cases[0]).run_method, None)
    if run is None:
        raise SolverError(
            f"solver '{solver.name}' runs no {kinds[0]} cases; take a solver that does"
        )
    possible = [case for case in cases if not case.not_run]
    results = run(possible, work, progress.update) if possible else []
    if len(results) != len(possible):
        raise SolverError(
            f"solver '{solver.name}' returned {len(results)} results for {len(possible)} cases"
        )
    ran = iter(results)
    return [refused(case) if case.not_run else next(ran) for case in cases]
