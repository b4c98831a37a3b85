"""Mode computation (Fig. 1): natural frequencies and shapes of the beam."""

from equisection.structure.modes import (
    METHODS,
    MeshStudy,
    ModeSet,
    compute_modes,
    frequency_constants,
    mesh_study,
)
from equisection.structure.plate import BOUNDARIES, Plate
from equisection.structure.solid import SOLID_BOUNDARIES

__all__ = [
    "BOUNDARIES",
    "METHODS",
    "SOLID_BOUNDARIES",
    "MeshStudy",
    "ModeSet",
    "Plate",
    "compute_modes",
    "frequency_constants",
    "mesh_study",
]
