"""A run of section or plate in motion, free or forced: its case, mesh, coupling and folders."""

from __future__ import annotations

import logging
from dataclasses import dataclass, field
from pathlib import Path
from typing import Generic, TypeVar

import numpy as np
from numpy.typing import NDArray

from equisection.cases import ForcedCase, UnsteadyCase
from equisection.results.loads_zigzag import warning_of_zigzag
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.rigid_flow import Tell
from equisection.solvers.openfoam.stream_turbulence import STREAM, StreamTurbulence
from equisection.verdict.zigzag import zigzag_of

Floats = NDArray[np.float64]

logger = logging.getLogger(__name__)

#: Time (c/V) from which the iterations are checked: a shorter record varies too little to tell.
CHECKED_FROM = 10.0
#: Interval of the states that a run is resumed from (c/V).
STATE_INTERVAL = 2.0


class IterationsCheck:
    """Check of the iterations in a time step while the run goes on, by the loads of every step.

    What is found at the end is in the result (:mod:`equisection.verdict.zigzag`). Most of a run of
    hours is still to come when it is first seen, some 10 c/V after the release.
    """

    def __init__(self) -> None:
        self._is_told = False

    def look(self, time: Floats, lift: Floats, moment: Floats) -> None:
        """Log a warning, once, if the loads so far zigzag from step to step.

        Parameters
        ----------
        time, lift, moment
            s (c/V), c_l and c_m of every step so far, shape (n,).
        """
        if self._is_told or not time.size or time[-1] < CHECKED_FROM:
            return
        warning = warning_of_zigzag(zigzag_of(time, lift, moment))
        if warning:
            self._is_told = True
            logger.warning("at %g c/V of the run that goes on: %s", time[-1], warning)


#: Kind of the case, and the mesh, of the section or of the plate.
CaseT = TypeVar("CaseT", bound=UnsteadyCase | ForcedCase)
MeshT = TypeVar("MeshT")


@dataclass(frozen=True)
class MovingRun(Generic[CaseT, MeshT]):
    """The run of one case.

    Attributes
    ----------
    installation
        OpenFOAM.
    case
        The case.
    mesh
        Its mesh.
    coupling
        Coupling of flow, loads and motion in a time step.
    work
        Folder that holds its folders.
    turbulence
        Turbulence of the stream, with its model.
    """

    installation: Installation
    case: CaseT
    mesh: MeshT
    coupling: flow.Coupling
    work: Path
    turbulence: StreamTurbulence = field(default=STREAM, kw_only=True)

    @property
    def folder(self) -> Path:
        """Folder of the moving run, next to that of the steady flow that it starts from."""
        return self.work / "forced"

    def before_release(self, tell: Tell) -> Tell:
        """Return the progress callback of the steady flow, during which the run is at 0."""

        def nothing_yet(done: float, total: float) -> None:
            del done, total
            tell(0.0, self.case.duration)

        return nothing_yet


@dataclass(frozen=True)
class FreeRun(MovingRun[UnsteadyCase, MeshT]):
    """The run of one free case."""

    @property
    def folder(self) -> Path:
        """Folder of the free run, next to that of the steady flow that it starts from."""
        return self.work / "free"
