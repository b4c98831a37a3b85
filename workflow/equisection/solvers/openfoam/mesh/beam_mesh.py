"""The plate and its channel: the section's mesh extruded over the span, and closed beyond the tip.

Along z, the root is on one side wall and the tip faces the other across the gap, where a block
takes the plate's place::

    z = 0                              L/c      L/c + gap
    root wall  |  cells finer to the tip  |  gap  |  far wall

All four walls of the channel are planes of symmetry: slip walls for the flow, and the only ones
that keep their points in their plane where the mesh moves.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.solvers.openfoam.mesh.block_mesh import (
    Layer,
    Mesh,
    Spacing,
    block_mesh_text,
    blocks_around_plate,
    expansion,
    face_x,
    face_y,
    face_z,
    patch,
)

#: The channel's walls, with the patch type of each; in the plane there is ``sides`` instead.
SIDE_WALLS = {"root_wall": "symmetryPlane", "far_wall": "symmetryPlane"}
#: Cells along the plate and across the gap at refinement 1, and the size of those at the tip.
_ALONG, _GAP, _AT_TIP = 44, 8, 1 / 16  # chords
#: Growth from cell to cell beyond the tip, at refinement 1, where the gap is wide.
_GROWTH = 1.25


@dataclass(frozen=True)
class PlateMesh:
    """Input of ``blockMesh`` for the mesh of a plate.

    Attributes
    ----------
    section
        The mesh in the plane of the section.
    span, gap
        L/c, and the gap between tip and wall (chords); 0 for a plate from wall to wall.
    """

    section: Mesh
    span: float
    gap: float

    @property
    def cells(self) -> int:
        """Number of cells."""
        return plate_cells(self.section.spacing, self.section.refinement, gap=bool(self.gap))

    @property
    def layers(self) -> int:
        """Number of layers of cells from wall to wall."""
        along, beyond = layers_of_beam(self._along_span)
        return along + (beyond if self.gap else 0)

    def edges(self) -> NDArray[np.float64]:
        """Return z/c of the planes between the cells along the plate, shape (n + 1,)."""
        return planes_along(self.span, self._along_span)

    @property
    def _along_span(self) -> float:
        """Refinement along the span."""
        return self.section.refinement * self.section.spacing.along_span

    def block_mesh_dict(self) -> str:
        """Return the text of ``blockMeshDict``.

        Raises
        ------
        SolverError
            The turned near field does not fit into the channel.
        """
        section, points = self.section, self.section.points()
        along, beyond = layers_of_beam(self._along_span)
        planes = [0.0, self.span]
        around, everywhere = list(blocks_around_plate()), [(i, j) for i in _FIVE for j in _FIVE]
        layers = [(around, Layer(0, along, f"{_ratio(self.span, along, self._along_span):.8g}"))]
        plate = [face_x(2, 2), face_x(3, 2), face_y(2, 2), face_y(2, 3)]
        far = around
        if self.gap:
            planes.append(self.span + self.gap)
            layers.append((everywhere, Layer(1, beyond)))
            plate.append(face_z(2, 2, 1))
            far = everywhere
        numbers = range(len(layers))
        vertices = [
            f"    ({x:.12g} {y:.12g} {z:.12g})" for z in planes for x, y in points.reshape(-1, 2)
        ]
        blocks = [section.block(points, i, j, layer) for where, layer in layers for i, j in where]
        patches = [
            patch("inlet", "patch", [face_x(0, j, n) for n in numbers for j in _FIVE]),
            patch("outlet", "patch", [face_x(5, j, n) for n in numbers for j in _FIVE]),
            patch("floor", "symmetryPlane", [face_y(i, 0, n) for n in numbers for i in _FIVE]),
            patch("ceiling", "symmetryPlane", [face_y(i, 5, n) for n in numbers for i in _FIVE]),
            patch("plate", "wall", plate),
            patch("root_wall", "symmetryPlane", [face_z(i, j, 0) for i, j in around]),
            patch("far_wall", "symmetryPlane", [face_z(i, j, len(layers)) for i, j in far]),
        ]
        return block_mesh_text(vertices, blocks, patches)


_FIVE = range(5)


def plate_cells(spacing: Spacing, refinement: float, *, gap: bool = True) -> int:
    """Return the number of cells, which does not depend on the size of plate and channel.

    The layers of the gap, if there is one, also have cells in the place of the plate.
    """
    along, beyond = layers_of_beam(refinement * spacing.along_span)
    columns, rows = spacing.refined(refinement)
    return spacing.cells(refinement) * along + sum(columns) * sum(rows) * beyond * gap


def planes_along(span: float, refinement: float, times: float = 1.0) -> NDArray[np.float64]:
    """Return z/c of the planes between the cells along a beam of a span (chords).

    There are ``times`` as many as along the plate.
    """
    along = round(times * layers_of_beam(refinement)[0])
    sizes = _ratio(span, along, refinement) ** (np.arange(along) / (along - 1))
    ends = np.concatenate([[0.0], np.cumsum(sizes)])
    return np.asarray(span * ends / ends[-1], dtype=np.float64)


def planes_beyond(gap: float, refinement: float, longest: float = math.inf) -> NDArray[np.float64]:
    """Return the distance from the tip (chords) of the planes between the cells beyond it.

    Even ones, or in a wide gap cells that grow from those at the tip up to a longest one.
    """
    first, (_, fewest) = _AT_TIP / refinement, layers_of_beam(refinement)
    if gap <= first * fewest:
        return np.linspace(0.0, gap, fewest + 1)
    growth, sizes = _GROWTH ** (1 / refinement), [first]
    while sum(sizes) < gap:
        sizes.append(min(sizes[-1] * growth, longest))
    ends = np.concatenate([[0.0], np.cumsum(sizes)])
    return np.asarray(gap * ends / ends[-1])


def _ratio(span: float, along: int, refinement: float) -> float:
    """Return the size of the last of the cells along the beam over that of the first."""
    return 1 / expansion(span, along, _AT_TIP / refinement)


def layers_of_beam(refinement: float) -> tuple[int, int]:
    """Return the layers of cells along a beam, and across a gap that is not wide."""
    return max(4, round(_ALONG * refinement)), max(2, round(_GAP * refinement))
