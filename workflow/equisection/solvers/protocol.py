"""The protocol that a solver fulfils to run a case of this workflow."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

if TYPE_CHECKING:  # the graph is built from what solvers provide, without numerics
    from equisection.aerodynamics.polar import Polar
    from equisection.aerodynamics.separation import SeparationLags
    from equisection.cases import Case, SteadyCase, UnsteadyCase
    from equisection.config import Config
    from equisection.motion.body_in_flow import BodyInFlow
    from equisection.results.plate_grid import PlateGrid
    from equisection.results.section_mesh import SectionMesh
    from equisection.results.steady_result import SteadyResult
    from equisection.results.unsteady_result import UnsteadyResult
    from equisection.solvers.known_error import KnownError
    from equisection.solvers.known_spread import KnownSpread


class Capability(StrEnum):
    """Capability of a solver in addition to coefficients and histories."""

    BATCH = "batch"  # many cases in one job cost less than one by one
    SURFACE = "surface"  # pressure and friction along the section and over the beam
    FIELDS = "fields"  # the flow near the tip of the beam
    MESH = "mesh"  # a mesh of section and beam, which can be shown and refined
    STATES = "states"  # motions are equations, so that eigenvalues tell their stability
    RECORDS = "records"  # histories are read from files, of which some may be missing


#: What starts the ranks of MPI where no scheduler says otherwise.
MPIRUN = "mpirun"


@dataclass(frozen=True)
class Allocation:
    """Resources of the machine that a job has been given; they decide no result.

    Attributes
    ----------
    threads
        Threads, or ranks of MPI, that it may use.
    launcher
        Command that starts ranks of MPI, for instance ``mpirun`` or ``srun --mpi=pmix``; their
        number follows as ``-n``.
    """

    threads: int = 1
    launcher: str = MPIRUN


ONE_THREAD = Allocation()

#: Setting of a release whose flow sheds no vortices of its own, false; without it the solver's
#: entry says so.
HAS_VORTICES = "has_vortices"

#: Called with time simulated and longest time (c/V), summed over the cases of the job.
Progress = Callable[[float, float], None]


class Solver(Protocol):
    """Runs cases at one resolution.

    ``version`` is that of the numerics: it changes whenever the same case would give another
    result, and is part of the case.
    """

    name: str
    version: str
    provides: frozenset[Capability]

    def settings(self, dimension: str) -> dict[str, Any]:
        """Return all of the solver's set-up that decides a dimension's results, in builtin types.

        Anything else is left out, so that cases with the same result have the same hash.
        """
        ...

    def describe(self, dimension: str) -> str:
        """Return solver and resolution of its cases in words, for every figure."""
        ...

    def run_steady(
        self, cases: Sequence[SteadyCase], work: Path, progress: Progress
    ) -> list[SteadyResult]:
        """Run rigid cases; a case that has no result has a ``failure``, and the others go on.

        Raises
        ------
        SolverError
            The solver itself could not run (a fault of the machine or of the set-up).
        """
        ...

    def run_unsteady(
        self, cases: Sequence[UnsteadyCase], work: Path, progress: Progress
    ) -> list[UnsteadyResult]:
        """Run free cases until their verdict is in; a failed one has the regime ``failed``.

        ``work`` is the job's own directory. It survives a kill, and a solver may resume from the
        files in it.

        Raises
        ------
        SolverError
            The solver itself could not run.
        """
        ...


class MeshingSolver(Solver, Protocol):
    """A solver with the capability ``mesh``."""

    @property
    def similar_cells(self) -> int | None:
        """Number of cells; None for a mesh that is not similar to those of other resolutions."""
        ...

    def section_mesh(self, case: SteadyCase, time_step: float, work: Path) -> SectionMesh:
        """Return the mesh of a rigid section, with its Courant number at a time step (c/V).

        Raises
        ------
        SolverError
            The mesh is not sound, or the solver could not run.
        """
        ...

    def plate_grid(self, case: SteadyCase, work: Path) -> PlateGrid:
        """Return the mesh of a rigid beam.

        Raises
        ------
        SolverError
            The mesh is not sound, or the solver could not run.
        """
        ...


@runtime_checkable
class HasSectionLoads(Protocol):
    """Solver whose loads of the section are equations, so that eigenvalues tell its stability."""

    @property
    def section_loads(self) -> tuple[Polar, SeparationLags]:
        """Polar of the section, and lags of its separation."""
        ...


@runtime_checkable
class HasKnownError(Protocol):
    """Solver of whose growth it is known how far it is from that of a flow solver."""

    def known_error(self, dimension: str, basis: str) -> KnownError | None:
        """Return the error of runs of a dimension and basis, or None where nobody knows it."""
        ...


@runtime_checkable
class HasKnownSpread(Protocol):
    """Solver of whose lags and polar it is known how far they may be off."""

    def known_spread(self, parameter: str, incidence_deg: float) -> KnownSpread | None:
        """Return the half-range of a parameter at an incidence, or None where nobody knows it."""
        ...


@runtime_checkable
class HasStates(Protocol):
    """A solver with the capability ``states``."""

    def body(self, case: UnsteadyCase) -> BodyInFlow:
        """Return section or beam of a case in a flow of any speed, without its correction."""
        ...


@runtime_checkable
class OfFlow(Protocol):
    """Solver whose set-up goes with the flow of a case, as that of a mesh does with its speed."""

    def in_flow(self, config: Config) -> Solver:
        """Return the solver as it is set up in the flow of a configuration."""
        ...


@runtime_checkable
class HasRecords(Protocol):
    """A solver with the capability ``records``."""

    def record_of(self, model: str, case: str, point: Mapping[str, float]) -> dict[str, Any]:
        """Return the settings of a release of a model, by its case's name and point."""
        ...

    def motion_record_of(self, case: str, known: Mapping[str, str]) -> dict[str, Any]:
        """Return the settings of a forced motion, by its case's name and what a path may name."""
        ...

    def missing(self, case: Case) -> str:
        """Return why a case has no record; empty if it has one."""
        ...
