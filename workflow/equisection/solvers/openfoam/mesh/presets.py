"""The meshes that a configuration can name."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from equisection.config.groups.openfoam_keys import ON_CELLS_OF_PLATE
from equisection.solvers.openfoam.mesh.beam_mesh import layers_of_beam, plate_cells
from equisection.solvers.openfoam.mesh.block_mesh import OF_PLATE, SIMILAR, Spacing
from equisection.solvers.openfoam.mesh.near_wall_spacing import (
    BY_CELL_SIZE,
    FIVE_LAYERS,
    FIVE_LAYERS_OF_PLATE,
)
from equisection.solvers.openfoam.mesh.outline_sizes import TYPICAL_CELLS


@dataclass(frozen=True)
class Preset:
    """A mesh with a name: its spacing, and the refinement of each direction."""

    refinement: float
    spacing: Spacing = SIMILAR
    plate: float = 1.0  # refinement of the plate's mesh
    plate_spacing: Spacing = OF_PLATE

    @property
    def cells(self) -> int:
        """Number of cells."""
        return self.spacing.cells(self.refinement)

    @property
    def plate_cells(self) -> int:
        """Number of cells of the plate's mesh, with a gap between tip and wall."""
        return plate_cells(self.plate_spacing, self.plate)

    @property
    def plate_layers(self) -> int:
        """Number of layers along the plate's span and across the gap between tip and wall."""
        return sum(layers_of_beam(self.plate * self.plate_spacing.along_span))

    @property
    def outline_cells(self) -> int:
        """Number of cells around an outline, roughly."""
        return round(TYPICAL_CELLS * self.refinement**2)

    @property
    def outline_beam_cells(self) -> int:
        """Number of cells around a beam of an outline, with a gap beyond its tip, roughly."""
        return round(TYPICAL_CELLS * self.plate**2 * self.plate_layers)

    @property
    def is_similar(self) -> bool:
        """Tell whether it is similar to others: they differ by their refinement alone."""
        return self.spacing is SIMILAR and self.plate_spacing is OF_PLATE

    def along_span_of(self, other: Preset) -> Preset:
        """Return this mesh with as many cells along the plate's span as another one has."""
        along_span = other.plate * other.plate_spacing.along_span / self.plate
        return replace(self, plate_spacing=replace(self.plate_spacing, along_span=along_span))


#: About 1e4, 2e4, 6e4 and 1e5 cells, and cells of given sizes; of the plate 8e4, 3e5, 1e6, 3e6 and
#: 5e6; and five layers at the wall, of section and plate.
_OWN: Mapping[str, Preset] = {
    "coarse": Preset(1.0, plate=0.52),
    "medium": Preset(math.sqrt(2.0), plate=0.81),
    "fine": Preset(math.sqrt(5.0), plate=1.19),
    "extra-fine": Preset(math.sqrt(10.0), plate=1.75),
    "finest": Preset(1.0, BY_CELL_SIZE, plate=2.05),
    "five-layers": Preset(1.0, FIVE_LAYERS, plate_spacing=FIVE_LAYERS_OF_PLATE),
}
#: Sparse has half of the layers along the plate's span that ``coarse`` has.
_SPANS: Mapping[str, Preset] = {**_OWN, "sparse": Preset(1.0, plate=0.26)}
#: Meshes that are refined in the plane or along the span alone, by the meshes of both.
_BY_DIRECTION = {
    f"{plane}-{span}-span": _OWN[plane].along_span_of(_SPANS[span])
    for plane, span in (
        ("coarse", "medium"),
        ("coarse", "fine"),
        ("coarse", "sparse"),
        ("medium", "coarse"),
        ("fine", "coarse"),
    )
}
_OF_PLATE = {
    ON_CELLS_OF_PLATE + name: Preset(own.plate, own.plate_spacing, own.plate, own.plate_spacing)
    for name, own in _OWN.items()
}
PRESETS: Mapping[str, Preset] = {**_OWN, **_BY_DIRECTION, **_OF_PLATE}
