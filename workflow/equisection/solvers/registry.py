"""The solvers that a configuration can name, loaded only when they are used.

The workflow reads the capabilities of a solver while it builds its graph, where importing numerics
for each job would cost more than the job. So they are listed here.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib import import_module
from typing import TYPE_CHECKING, Any

from equisection.cases import Case, SolverBlock
from equisection.errors import CaseFileError, ConfigError
from equisection.keys.checks import Problem
from equisection.solvers.protocol import ONE_THREAD, Allocation, Capability, Solver

if TYPE_CHECKING:  # jobs need not build the models of the configuration
    from equisection.config import Config


@dataclass(frozen=True)
class SolverEntry:
    """Module of an adapter, its capabilities, and the ``dimensions`` of its cases.

    ``work`` is the module with the work of its jobs (:class:`.work.Estimate`); without it they ask
    for the memory and time that starting them takes. ``check`` is one whose function ``problems``
    yields the parts of a configuration that it has no cases for. ``basis`` is what its runs are,
    where they are neither those of a mesh nor of equations in time. ``has_vortices`` tells whether
    its flow may shed vortices, which beat with a motion.
    """

    module: str
    provides: frozenset[Capability]
    dimensions: tuple[str, ...] = ("2d", "3d")
    work: str = ""
    check: str = ""
    basis: str = ""
    has_vortices: bool = True


SOLVERS: dict[str, SolverEntry] = {
    "embedded": SolverEntry(
        "equisection.solvers.embedded.adapter",
        frozenset({Capability.BATCH, Capability.STATES}),
        work="equisection.solvers.embedded.job_work",
        has_vortices=False,
    ),
    "openfoam": SolverEntry(
        "equisection.solvers.openfoam.adapter",
        frozenset({Capability.MESH, Capability.SURFACE, Capability.FIELDS}),
        work="equisection.solvers.openfoam.job_work",
        check="equisection.solvers.openfoam.mesh.room",
    ),
    "given": SolverEntry(
        "equisection.solvers.given.adapter",
        frozenset({Capability.BATCH, Capability.RECORDS}),
        dimensions=("2d",),
        basis="given",
    ),
}


def check_provided(config: Config) -> None:
    """Refuse models and other values that the configured solver has no cases for.

    Raises
    ------
    ConfigError
        With one line for each of them.
    """
    entry = SOLVERS[config.solver]
    problems = [] if "3d" in entry.dimensions else list(_models_of_the_beam(config))
    if entry.check:
        problems += import_module(entry.check).problems(config)
    if problems:
        raise ConfigError("\n".join(problem.line for problem in problems))


def _models_of_the_beam(config: Config) -> Iterator[Problem]:
    given = bool(config.steady.beam_polar)
    advice = (
        "it has no 3D cases"
        if given
        else "it has no 3D cases; the corrected models need steady.beam_polar, the rigid beam's"
    )
    for place, model in enumerate(config.sweep.models):
        if model == "3d" or ("corrected" in model and not given):
            yield Problem(
                f"sweep.models.{place}",
                model,
                f"allowed with solver '{config.solver}' are models of dimension 2d"
                f"{'' if given else ' without correction'}: {advice}",
            )


def solver_from_config(config: Config, resolution: str) -> Solver:
    """Return the configured solver at a resolution."""
    return _adapter(config.solver).from_config(config, resolution)  # type: ignore[no-any-return]


def solver_from_case(block: SolverBlock, allocation: Allocation = ONE_THREAD) -> Solver:
    """Return the solver of a case, to run on the resources that its job has been given.

    Raises
    ------
    CaseFileError
        The solver is unknown here, or the case was written for another version of it.
    """
    if block.name not in SOLVERS:
        raise CaseFileError(
            f"solver '{block.name}' is not known; allowed are {', '.join(sorted(SOLVERS))}"
        )
    solver: Solver = _adapter(block.name).from_settings(block.settings, allocation)
    if solver.version != block.version:
        raise CaseFileError(
            f"the case is for version {block.version} of solver '{block.name}', installed is "
            f"{solver.version}; delete the run's folder 'cases' and run again"
        )
    return solver


def missing_records(cases: Mapping[str, Case]) -> dict[str, str]:
    """Return why cases have no record, by their names, of solvers that read releases from files."""
    return {
        name: reason
        for name, case in cases.items()
        if Capability.RECORDS in SOLVERS[case.solver.name].provides
        and (reason := solver_from_case(case.solver).missing(case))  # type: ignore[attr-defined]
    }


def _adapter(name: str) -> Any:
    """Return the class named ``Adapter`` of the solver's module."""
    return import_module(SOLVERS[name].module).Adapter
