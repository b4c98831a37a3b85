"""What decides a result of OpenFOAM beside the case's own physics."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any

from equisection.config.groups.openfoam_keys import MORPH, ON_CELLS_OF_PLATE
from equisection.solvers.openfoam.flow_setup import Coupling


@dataclass(frozen=True)
class Settings:
    """Mesh and coupling; no path, version or number of ranks, which decide nothing.

    Attributes
    ----------
    mesh
        Name of the mesh.
    outer_correctors
        Iterations of flow, loads and motion in each time step, at most.
    velocity_relaxation
        Under-relaxation of the velocity in these iterations; 1 is none.
    mesh_motion
        How the mesh follows the free section.
    """

    mesh: str
    outer_correctors: int
    velocity_relaxation: float = Coupling.velocity_relaxation
    mesh_motion: str = MORPH

    @property
    def coupling(self) -> Coupling:
        """How flow, loads and motion come together in a time step."""
        return Coupling(self.outer_correctors, self.velocity_relaxation)

    def of_dimension(self, dimension: str) -> Settings:
        """Return the settings without the choices that are none in a dimension.

        Which cells the section has, and how its mesh follows it, says nothing of the plate.
        """
        if dimension == "2d":
            return self
        return replace(self, mesh=self.mesh.removeprefix(ON_CELLS_OF_PLATE), mesh_motion=MORPH)

    def of_case(self) -> dict[str, Any]:
        """Return what stands in a case: without what is as in cases from before there was a choice.

        So a new choice leaves the hash of every case that does not take it.
        """
        return {
            field.name: getattr(self, field.name)
            for field in fields(self)
            if getattr(self, field.name) != field.default
        }
