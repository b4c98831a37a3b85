"""A free run of section or plate: its case, mesh, coupling and folders."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Generic, TypeVar

from equisection.cases import UnsteadyCase
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.rigid_flow import Tell

#: Interval of the states that a run is resumed from (c/V).
STATE_INTERVAL = 2.0

#: What ``blockMesh`` makes the mesh of, of the section or of the plate.
MeshT = TypeVar("MeshT")


@dataclass(frozen=True)
class FreeRun(Generic[MeshT]):
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
    """

    installation: Installation
    case: UnsteadyCase
    mesh: MeshT
    coupling: flow.Coupling
    work: Path

    @property
    def folder(self) -> Path:
        """Folder of the free run, next to that of the steady flow that it starts from."""
        return self.work / "free"

    def before_release(self, tell: Tell) -> Tell:
        """Return the progress callback of the steady flow, during which the free run is at 0."""

        def nothing_yet(done: float, total: float) -> None:
            del done, total
            tell(0.0, self.case.duration)

        return nothing_yet
