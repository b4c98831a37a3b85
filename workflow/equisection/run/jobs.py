"""The jobs of a configuration that run a solver: their number, and the resources of each.

Like the graph, this comes from the configuration alone, so only its file has to be there.
Results that are kept or in the store already are not subtracted.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from rich import box
from rich.table import Table

from equisection.cases import FREE, Kind
from equisection.config import Config
from equisection.run import cost
from equisection.run.cost import CostModel
from equisection.solvers.protocol import Capability
from equisection.solvers.registry import SOLVERS
from equisection.solvers.work import Work
from equisection.study import plan

#: Work of a job that runs no case but takes those that are kept (``compute: false``).
LOOKING_UP = Work(cells=0.0)


@dataclass(frozen=True)
class Jobs:
    """Jobs that are alike.

    Attributes
    ----------
    what
        Model of the sweep, or dimension and resolution of rigid cases.
    number
        Number of jobs, at most where the onset is refined.
    cells
        Cells of the mesh of one job; for the embedded solver sections of all of its cases.
    ranks
        Ranks of MPI of one job.
    megabytes, minutes
        Memory (MB) and time by the clock (minutes) that one job asks for.
    core_hours
        Processor time (h) of all of them, at most.
    """

    what: str
    number: int
    cells: float
    ranks: int
    megabytes: int
    minutes: int
    core_hours: float


def solver_jobs(config: Config, model: CostModel) -> list[Jobs]:
    """Return the jobs that run a solver, rigid cases first; none where results are looked up.

    Raises
    ------
    ConfigError
        The cost model has no entry for the solver.
    """
    if not config.compute or Capability.RECORDS in SOLVERS[config.solver].provides:
        return []
    batches = Capability.BATCH in SOLVERS[config.solver].provides
    found = []
    for what, dimension, number, work in _batches(config) if batches else _one_by_one(config):
        per_cell, ranks = (
            model.of(config.solver, dimension),
            config.solver_section.threads(dimension),
        )
        asked = cost.megabytes(work, per_cell, ranks), cost.minutes(work, per_cell, ranks)
        hours = number * cost.seconds(work, per_cell) / 3600
        found.append(Jobs(what, number, work.cells, ranks, *asked, hours))
    return found


def batch_work(config: Config, kind: Kind, *models: str) -> Work:
    """Return the work of the job that runs a batch of a kind and models, or looks it up.

    A batch is all rigid cases of a dimension, or the sweep of a model or a round of its refinement,
    or the sweeps of several sections.
    """
    if not config.compute or Capability.RECORDS in SOLVERS[config.solver].provides:
        return LOOKING_UP
    chosen = [one for one in plan.planned_cases(config) if one.kind == kind and one.model in models]
    number = sum(len(one.names) for one in chosen)
    most = max(number, config.sweep.onset_points) if kind.of_sweep else number
    dimension = chosen[0].dimension
    return cost.work_of(config, kind, dimension, chosen[0].resolution, most)


def table(jobs: list[Jobs]) -> Table:
    """Return the jobs as a table, with the sum of the core hours."""
    shown = Table(box=box.SIMPLE_HEAD, show_footer=True)
    shown.add_column("cases", "all", no_wrap=True)
    for heading in ("jobs", "cells", "ranks", "MB each", "min each"):
        shown.add_column(heading, justify="right", no_wrap=True)
    total = _hours(sum(one.core_hours for one in jobs))
    shown.add_column("core hours", total, justify="right", no_wrap=True)
    for one in jobs:
        whole = (one.number, round(one.cells), one.ranks, one.megabytes, one.minutes)
        shown.add_row(one.what, *(f"{value:,}" for value in whole), _hours(one.core_hours))
    return shown


def _hours(value: float) -> str:
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}"


def _one_by_one(config: Config) -> Iterator[tuple[str, str, int, Work]]:
    """Give name, dimension, number and work of jobs of one case each."""
    for one in plan.planned_cases(config):
        work = cost.work_of(config, one.kind, one.dimension, one.resolution)
        name = one.kind.model_of(one.model)
        name = name if one.kind.of_sweep else f"{name}, {one.resolution}"
        yield name, one.dimension, len(one.names) + one.refined, work


def _batches(config: Config) -> Iterator[tuple[str, str, int, Work]]:
    """Give name, dimension, number and work of jobs of many cases each."""
    together = plan.sections_together(config)
    groups = {(one.kind, one.model): one.dimension for one in plan.planned_cases(config)}
    for (kind, model), dimension in groups.items():
        number = len(plan.batches(config)) if kind.of_sweep else 1
        if kind.of_sweep and model in together:
            number -= 1  # the rounds of its refinement
        if number:
            yield kind.model_of(model), dimension, number, batch_work(config, kind, model)
    if together:
        yield ", ".join(together), "2d", 1, batch_work(config, FREE, *together)
