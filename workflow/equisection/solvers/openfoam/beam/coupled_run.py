"""A run of the plate whose mesh follows lumped points, free or forced: its start, and its files.

It starts from the rigid steady flow, or that around the plate held deformed, and is resumed from
its last whole state, if its folder has one.
"""

from __future__ import annotations

import logging
from abc import ABC, abstractmethod
from collections.abc import Callable
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.errors import SolverError
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.beam.deformed_mesh import deform_mesh
from equisection.solvers.openfoam.beam.exchange_trial import try_exchange
from equisection.solvers.openfoam.beam.lumped_points import (
    LumpedPoints,
    motion_schemes,
    motion_solvers,
    write_lumped_motion,
)
from equisection.solvers.openfoam.beam.pipes import Alive, Pipes, names
from equisection.solvers.openfoam.beam.rigid_beam import BeamCells, PlateFlow, plate_control
from equisection.solvers.openfoam.case_folder import (
    drop_broken_states,
    drop_histories_after,
    drop_states_after,
    emptied,
    is_ready,
    mark_ready,
)
from equisection.solvers.openfoam.dictionaries import write_system
from equisection.solvers.openfoam.free_run import STATE_INTERVAL, CaseT, MovingRun
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.outline_beam_mesh import OutlineBeamMesh
from equisection.solvers.openfoam.process import SILENCE, run_beside
from equisection.solvers.openfoam.ranks import copy_flow_of_all, parts
from equisection.solvers.openfoam.reading.loads import read_loads
from equisection.solvers.openfoam.rigid_flow import Tell

logger = logging.getLogger(__name__)

Floats = NDArray[np.float64]
#: The structure's side of an exchange, as :func:`..process.run_beside` calls it.
Side = Callable[[Alive, Callable[[], None]], None]

#: The version that the coupled beam was run on, and later ones, known by their sources.
_RUN, _READ = "v1912", range(2306, 2607)


@dataclass(frozen=True)
class CoupledRun(MovingRun[CaseT, BeamCells], ABC):
    """The run of one case of the plate.

    Attributes
    ----------
    ranks
        Ranks of MPI that a program runs on.
    """

    ranks: int

    @property
    @abstractmethod
    def points(self) -> LumpedPoints:
        """The plate's modes at its lumped points."""

    @property
    @abstractmethod
    def first_position(self) -> Floats:
        """Position of the modes at time 0."""

    @property
    def is_held(self) -> bool:
        """Tell whether the plate is held deformed until time 0."""
        return bool(np.any(self.first_position))

    def start(self, tell: Tell) -> float:
        """Return the time that the run goes on from (c/V), and make its folder if there is none.

        With a version that the coupled beam was not run on, the exchange is tried first.

        Raises
        ------
        BlowUpError
            The flow or the mesh broke down.
        SolverError
            A program or the trial failed, or nothing is known of the version of OpenFOAM.
        """
        require_version(self.installation)
        if not is_ready(self.folder):
            self._set_up(tell)
        start = last_common_state(self.folder)
        if not start and self.installation.version() != _RUN:
            self._try_exchange()
        return start

    def _set_up(self, tell: Tell) -> None:
        """Make the folder of the run from the rigid steady flow, converged or not."""
        rigid = PlateFlow(
            self.installation,
            self.case,
            self.mesh,
            self.coupling,
            self.ranks,
            self.work,
            self.turbulence,
        )
        deform = self._deform if self.is_held else None
        source, _, converged = rigid.steady(self.before_release(tell), deform, starts_motion=True)
        if not converged:
            logger.info("the steady flow has not converged; the motion begins in its last state")
        self.start_from(source)

    def start_from(self, source: Path) -> None:
        """Make the folder of the run from the last state of a steady run of the same mesh."""
        folder = emptied(self.folder)
        copy_flow_of_all(source, folder)
        write_lumped_motion(folder, self.points, names(), is_deformed=self.is_held)
        mark_ready(folder)

    @property
    def _is_of_outline(self) -> bool:
        return isinstance(self.mesh, OutlineBeamMesh)

    def _deform(self, folder: Path) -> None:
        """Move the mesh of a folder to that of the plate as it is held."""
        deform_mesh(
            self.installation,
            folder,
            self.points,
            self.first_position,
            self.work / "held",
            of_outline=self._is_of_outline,
        )

    def _try_exchange(self) -> None:
        loads, step = read_loads(self.work / "steady"), self.case.time_step
        try_exchange(
            self.installation,
            self.folder,
            self.points,
            self.first_position,
            steady=(float(loads.lift[-1]), float(loads.moment[-1])),
            write_system=lambda folder: self._write_system(folder, step, step),
        )

    def _write_system(self, folder: Path, end: float, write_every: float) -> None:
        """Write what controls a run up to an end (c/V), into a folder.

        Parameters
        ----------
        folder
            Folder of the case.
        end, write_every
            End, and interval of the states (c/V).
        """
        entries = plate_control("pimpleFoam", end, self.case.time_step, write_every, self.mesh.span)
        entries["libs"] = ['"liblumpedPointMotion.so"']
        solution = flow.unsteady_solution(self.coupling)
        solution["solvers"] |= motion_solvers(of_outline=self._is_of_outline)
        schemes = flow.schemes(steady=False)
        schemes["laplacianSchemes"] |= motion_schemes()
        write_system(folder, entries, schemes, solution)

    def exchange(self, start: float, side: Callable[[Pipes], Side]) -> None:
        """Run the flow beside the structure's side, from a start (c/V) to the end of the case."""
        # the end may differ from that of an earlier start
        self._write_system(self.folder, self.case.duration, STATE_INTERVAL)
        # a case that was divided stays so, on however many ranks its job runs now
        ranks = len(parts(self.folder))
        if ranks != self.ranks:
            logger.info("%d ranks: the run was begun on as many", ranks)
        if start:
            logger.info("goes on from %g c/V", start)
        with closing(Pipes(self.folder, SILENCE)) as pipes:
            run_beside(self.installation, "pimpleFoam", self.folder, side(pipes), ranks=ranks)


def require_version(installation: Installation) -> None:
    """Refuse a version of OpenFOAM of whose ``lumpedPointMovement`` nothing is known.

    Raises
    ------
    SolverError
        It is neither the one that was run nor one whose sources are known.
    """
    version = installation.version()
    if version != _RUN and version not in {f"v{number}" for number in _READ}:
        raise SolverError(
            f"OpenFOAM {version}: the coupled beam runs on {_RUN} and, with a trial of its first "
            f"step, on v{_READ[0]} to v{_READ[-1]}; lumpedPointMovement of others may read other "
            "dictionaries; run it there, or leave the model 3d out of sweep.models and "
            "forced.beam_modes at 0"
        )


def last_common_state(folder: Path) -> float:
    """Return the time of the last state that is whole on all ranks; drop what is later."""
    start = min(drop_broken_states(part) for part in parts(folder))
    for part in parts(folder):
        drop_states_after(part, start)
    drop_histories_after(folder, start)
    return start
