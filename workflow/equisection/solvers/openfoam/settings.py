"""Settings of OpenFOAM that decide a result, in addition to the physics of the case."""

from __future__ import annotations

from dataclasses import dataclass, fields, replace
from typing import Any

from equisection.config.groups.openfoam_keys import (
    MORPH,
    ON_CELLS_OF_PLATE,
    SST,
    TURBULENCE_INTENSITY,
    VISCOSITY_RATIO,
)
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.stream_turbulence import StreamTurbulence


@dataclass(frozen=True)
class Settings:
    """Mesh and coupling, without paths, version and number of ranks, which decide nothing.

    Attributes
    ----------
    mesh
        Name of the mesh.
    outer_correctors
        Iterations of flow, loads and motion in each time step, at most.
    velocity_relaxation
        Under-relaxation of the velocity in these iterations; 1 is none.
    mesh_motion
        Way in which the mesh follows the free section.
    mesher
        Mesher of outlines with its version; empty for the mesh of blocks.
    far_field
        Distance of the far field (chords) in free air; 0 in a channel.
    turbulence
        Model of the turbulence.
    turbulence_intensity, viscosity_ratio
        Turbulence of the stream at the inlet: rms velocity over V, eddy viscosity over viscosity.
    """

    mesh: str
    outer_correctors: int
    velocity_relaxation: float = Coupling.velocity_relaxation
    mesh_motion: str = MORPH
    mesher: str = ""
    far_field: float = 0.0
    turbulence: str = SST
    turbulence_intensity: float = TURBULENCE_INTENSITY
    viscosity_ratio: float = VISCOSITY_RATIO

    @property
    def coupling(self) -> Coupling:
        """Coupling of flow, loads and motion in a time step."""
        return Coupling(self.outer_correctors, self.velocity_relaxation)

    @property
    def stream(self) -> StreamTurbulence:
        """Turbulence of the stream."""
        return StreamTurbulence(self.turbulence, self.turbulence_intensity, self.viscosity_ratio)

    def of_dimension(self, dimension: str) -> Settings:
        """Return the settings without the choices that do not exist in a dimension.

        A section on the cells of its plate, and the motion of its mesh, do not concern the plate.
        """
        if dimension == "2d":
            return self
        mesh = self.mesh.removeprefix(ON_CELLS_OF_PLATE)
        return replace(self, mesh=mesh, mesh_motion=MORPH, turbulence=SST)

    def of_case(self) -> dict[str, Any]:
        """Return the settings as a case holds them, without those at their defaults.

        So a new setting leaves the hash of every case that does not use it.
        """
        return {
            field.name: getattr(self, field.name)
            for field in fields(self)
            if getattr(self, field.name) != field.default
        }
