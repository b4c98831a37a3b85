"""Mesh of a beam of any outline: that of its section extruded, and closed beyond a free tip.

Along z it has the layers of the rectangle's mesh (:mod:`~.beam_mesh`): cells that become finer to
the tip, and beyond it a gap up to the other wall. There cells fill the outline as well, from the
points of its wall on.
"""

from __future__ import annotations

import math
from dataclasses import asdict, dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.solvers.openfoam.mesh.beam_mesh import planes_along, planes_beyond
from equisection.solvers.openfoam.mesh.outline_layers import layers_of
from equisection.solvers.openfoam.mesh.outline_mesh import TIME_LIMIT, OutlineMesh, made_by
from equisection.solvers.openfoam.mesh.outline_sizes import OutlineSizes
from equisection.solvers.openfoam.mesh.outline_wall import wall_of
from equisection.solvers.openfoam.process import BlowUpError

#: Sizes in the plane: first cells as thick as those of the rectangle's mesh, since what is long
#: along the span and thin as well is what a moving mesh breaks on, in as many layers as make them
#: thicker than a separation bubble. Fewer rays fan out at a corner, and
#: short sides have fewer cells, for the same reason.
OF_BEAM = OutlineSizes(first=1e-3, layers=20, fan_step_deg=30.0, side_over_corner=4.0)
#: Length of a beam (chords) above which it has more layers, so that they are no longer; and length
#: of a layer over the thickness of its cells from which they are more as well: checkMesh finds
#: fault from 1000 on.
_LONG, _SLENDER = 4.0, 800.0
#: Module that makes the mesh.
_MESHER = "outline_beam_mesher"


@dataclass(frozen=True)
class OutlineBeamMesh:
    """Input of the mesh of a beam.

    Attributes
    ----------
    section
        The mesh in the plane of the section.
    span, gap
        L/c, and the gap between tip and wall (chords); 0 for a beam from wall to wall.
    along_span
        Layers along the span over those that the refinement gives (-).
    """

    section: OutlineMesh
    span: float
    gap: float
    along_span: float = 1.0

    def edges(self) -> NDArray[np.float64]:
        """Return z/c of the planes between the cells along the beam, shape (n + 1,)."""
        return self._edges

    @cached_property
    def _edges(self) -> NDArray[np.float64]:
        times, refinement = max(1.0, self.span / _LONG), self._refinement_along_span
        edges = planes_along(self.span, refinement, times)
        too_long = float(np.diff(edges).max()) / self._longest
        return planes_along(self.span, refinement, times * max(1.0, too_long))

    @property
    def _refinement_along_span(self) -> float:
        return self.section.refinement * self.along_span

    @cached_property
    def _longest(self) -> float:
        """Length of the longest layer (chords)."""
        return _SLENDER * _thinnest(self.section)

    def levels(self) -> NDArray[np.float64]:
        """Return z/c of all planes between the layers of cells, from wall to wall."""
        if not self.gap:
            return self.edges()
        beyond = self.span + planes_beyond(self.gap, self._refinement_along_span, self._longest)
        return np.concatenate([self.edges(), beyond[1:]])

    @property
    def layers(self) -> int:
        """Number of layers of cells from wall to wall."""
        return self.levels().size - 1

    def write(self, folder: Path, time_limit: float = TIME_LIMIT) -> None:
        """Make the mesh and write ``constant/polyMesh``, in a process of its own.

        Raises
        ------
        BlowUpError
            The outline has no mesh.
        SolverError
            The channel has no room for it; or gmsh is missing, crashed, or did not end within the
            time limit (processor s).
        """
        self.section.require_room()
        made_by(_MESHER, folder, asdict(self), time_limit)


def _thinnest(section: OutlineMesh) -> float:
    """Return the least thickness of a cell at the wall in the plane (chords); infinite for none.

    It is the area over the larger extent, as checkMesh has it. An outline without layers has no
    mesh, which is told where that is made.
    """
    sizes, refinement = section.sizes, section.refinement
    try:
        cells = layers_of(wall_of(np.array(section.outline), sizes, refinement), sizes, refinement)
    except BlowUpError:
        return math.inf
    corners = cells.cells.points[cells.cells.corners]
    extent = np.abs(np.roll(corners, -1, axis=1) - corners).sum(axis=1).max(axis=1) / 2
    (ax, ay), (bx, by) = ((corners[:, i + 2] - corners[:, i]).T for i in (0, 1))
    area = 0.5 * np.abs(ax * by - ay * bx)
    return float((area / extent).min())
