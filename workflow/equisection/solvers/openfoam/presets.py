"""The meshes that a configuration can name."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

from equisection.solvers.openfoam.mesh import SIMILAR, Spacing
from equisection.solvers.openfoam.paper_spacing import PAPER


@dataclass(frozen=True)
class Preset:
    """A mesh by name: what is refined, and how much in each direction."""

    refinement: float
    spacing: Spacing = SIMILAR

    @property
    def cells(self) -> int:
        """Number of cells."""
        return self.spacing.cells(self.refinement)

    @property
    def is_similar(self) -> bool:
        """Whether it differs from the others alike by its refinement alone."""
        return self.spacing is SIMILAR


#: About 1e4, 2e4 and 6e4 cells, and the paper's cell sizes.
PRESETS: Mapping[str, Preset] = {
    "coarse": Preset(1.0),
    "medium": Preset(math.sqrt(2.0)),
    "fine": Preset(math.sqrt(5.0)),
    "paper": Preset(1.0, PAPER),
}
