"""Block-structured mesh of a plate in a channel, the near field turned to its incidence.

Lines of blocks, in chords from mid-chord; the four inner lines each way are turned with the plate::

    y
    5  +----+--+----+---+--------+    ceiling
    4  +----+--+----+---+--------+    near field above
    3  +----+--#####+---+--------+    upper side of the plate
    2  +----+--#####+---+--------+    lower side
    1  +----+--+----+---+--------+    near field below
    0  +----+--+----+---+--------+    floor
       0    1  2    3   4        5  x

A refinement divides all cells alike: counts grow, the grading of a block stays, so that meshes of
a grid study are similar. How cells are spread over the blocks is a :class:`Spacing`.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.errors import SolverError

#: Reach of the near field ahead of the plate, behind it, and to either side (chords).
AHEAD, BEHIND, ASIDE = 0.7, 1.5, 0.7
#: Part of the half channel that the near field may reach into when it is turned.
_ROOM = 0.85
#: Height of rows 2 to 3 and 1 to 4 where they leave the near field and at inlet and outlet.
_WAKE_AT_OUTLET, _NEAR_AT_OUTLET = 0.4, 0.55  # chords; part of the channel's height
#: Cells of the coarse mesh between the lines, along x and along y.
_COLUMNS, _ROWS = (8, 20, 56, 30, 22), (6, 32, 10, 32, 6)
#: First cells of the coarse mesh (chords): at the walls, at the plate's edges along it, ahead of
#: and behind these, and across the plate's thickness as a part of it.
_AT_WALL, _AT_EDGE, _OFF_EDGE, _ACROSS = 3e-4, 2.5e-3, 1.2e-3, 0.04
_AT_PLATE = 1e-3
#: Part of a length that round-off may take from even cells.
_EVEN = 1e-9

#: Points where the lines cross (6, 6, 2), block, and line of the other direction: the grading.
Grading = Callable[[NDArray[np.float64], int, int], str]


@dataclass(frozen=True)
class Spacing:
    """Number of cells of each block at refinement 1, and the grading of their sizes.

    Attributes
    ----------
    columns, rows
        Cells between the lines along x and along y, even numbers.
    along
        Grading of column i on line j of y, from the points.
    across
        Grading on line i of x of row j, from the points.
    along_span
        Cells along the span of a beam over those that its refinement gives it (-).
    """

    columns: tuple[int, ...]
    rows: tuple[int, ...]
    along: Grading
    across: Grading
    along_span: float = 1.0

    def refined(self, refinement: float) -> tuple[list[int], list[int]]:
        """Return columns and rows, even so that both ends of a side get as many."""
        return _refined(self.columns, refinement), _refined(self.rows, refinement)

    def cells(self, refinement: float = 1.0) -> int:
        """Return the number of cells of a mesh, without any inside the plate."""
        columns, rows = self.refined(refinement)
        return sum(columns) * sum(rows) - columns[2] * rows[2]


@dataclass(frozen=True)
class ChannelBox:
    """Section and channel in chords; ``thickness`` is h/c.

    ``section_height`` is that of mid-chord, where y is 0, above the middle of the channel.
    """

    thickness: float
    height: float
    upstream: float
    downstream: float
    section_height: float = 0.0

    @property
    def floor(self) -> float:
        """Height of the floor (chords)."""
        return -self.height / 2 - self.section_height

    @property
    def ceiling(self) -> float:
        """Height of the ceiling (chords)."""
        return self.height / 2 - self.section_height

    @property
    def words(self) -> str:
        """Place of the section in words; empty in the middle of the channel."""
        height = self.section_height
        side = "above" if height > 0.0 else "below"
        return f" with the section {abs(height):.3g} c {side} its middle" if height else ""

    @property
    def room(self) -> float:
        """Distance from mid-chord to the nearer of floor and ceiling (chords)."""
        return self.height / 2 - abs(self.section_height)


@dataclass(frozen=True)
class Layer:
    """Blocks between two planes of vertices: number, cells along z, and grading of their sizes."""

    number: int = 0
    cells: int = 1
    grading: str = "1"


@dataclass(frozen=True)
class Mesh:
    """Input of ``blockMesh`` for the mesh of a section.

    Attributes
    ----------
    channel
        Section and channel.
    incidence
        Incidence (rad), nose up.
    refinement
        Refinement of each direction.
    spacing
        Spacing that is refined; by default that of the meshes of a grid study.
    """

    channel: ChannelBox
    incidence: float
    refinement: float
    spacing: Spacing = field(default_factory=lambda: SIMILAR)

    @property
    def cells(self) -> int:
        """Number of cells."""
        return self.spacing.cells(self.refinement)

    def reach(self, incidence: float) -> tuple[float, float]:
        """Return the lowest and the highest y of the chord line at an incidence (rad), chords."""
        high = 0.5 * abs(math.sin(incidence))
        return -high, high

    def require_room(self) -> None:
        """Refuse a channel that the turned near field does not fit into.

        Raises
        ------
        SolverError
            With the channel and the incidence.
        """
        self.points()

    def points(self) -> NDArray[np.float64]:
        """Return the crossings of the lines (chords), shape (6, 6, 2), by x and then y.

        Raises
        ------
        SolverError
            The turned near field does not fit into the channel.
        """
        channel, half = self.channel, self.channel.room
        aside = min(ASIDE, 0.4 * half)
        along = (-0.5 - AHEAD, -0.5, 0.5, 0.5 + BEHIND)
        across = (-aside, -channel.thickness / 2, channel.thickness / 2, aside)
        points = np.zeros((6, 6, 2))
        cosine, sine = math.cos(self.incidence), math.sin(self.incidence)
        for i, j in itertools.product(range(4), range(4)):
            xi, eta = along[i], across[j]
            points[i + 1, j + 1] = (xi * cosine + eta * sine, eta * cosine - xi * sine)
        reach = float(np.abs(points[1:5, 1:5, 1]).max())
        inside = -channel.upstream < points[1, 1:5, 0].min() - 0.5
        if reach > _ROOM * half or not inside or points[4, 1:5, 0].max() > channel.downstream - 1:
            raise SolverError(
                f"the near field of the mesh, turned to {math.degrees(self.incidence):.4g} deg, "
                f"does not fit into a channel of {channel.height:g} c from {-channel.upstream:g} c "
                f"to {channel.downstream:g} c{channel.words}; lower the incidence or enlarge "
                "flow.channel"
            )
        wide = _NEAR_AT_OUTLET * half
        narrow = min(_WAKE_AT_OUTLET, 0.2 * half)
        for i, x, inner in ((0, -channel.upstream, 0.5 * narrow), (5, channel.downstream, narrow)):
            points[i, :, 0] = x
            points[i, :, 1] = (channel.floor, -wide, -inner, inner, wide, channel.ceiling)
        for i in range(1, 5):
            points[i, 0] = (points[i, 1, 0], channel.floor)
            points[i, 5] = (points[i, 4, 0], channel.ceiling)
        return points

    def block_mesh_dict(self) -> str:
        """Return the text of ``blockMeshDict``, for one layer of cells of depth 1."""
        points = self.points()
        vertices = [
            f"    ({x:.12g} {y:.12g} {z:g})" for z in (-0.5, 0.5) for x, y in points.reshape(-1, 2)
        ]
        around = list(blocks_around_plate())
        blocks = [self.block(points, i, j, Layer()) for i, j in around]
        patches = [
            patch("inlet", "patch", [face_x(0, j) for j in range(5)]),
            patch("outlet", "patch", [face_x(5, j) for j in range(5)]),
            patch("floor", "symmetryPlane", [face_y(i, 0) for i in range(5)]),
            patch("ceiling", "symmetryPlane", [face_y(i, 5) for i in range(5)]),
            patch("plate", "wall", [face_x(2, 2), face_x(3, 2), face_y(2, 2), face_y(2, 3)]),
            patch("sides", "empty", [face_z(i, j, side) for i, j in around for side in (0, 1)]),
        ]
        return block_mesh_text(vertices, blocks, patches)

    def block(self, points: NDArray[np.float64], i: int, j: int, layer: Layer) -> str:
        """Return the block of column i and row j in a layer of blocks."""
        corners = [corner + 36 * layer.number for corner in _corners(i, j)]
        corners += [corner + 36 for corner in corners]
        along = [self.spacing.along(points, i, line) for line in (j, j + 1)]
        across = [self.spacing.across(points, line, j) for line in (i, i + 1)]
        # the order of blockMesh's edges: x at the four corners (y, z), y at (x, z), then z
        gradings = [along[0], along[1], along[1], along[0]]
        gradings += [across[0], across[1], across[1], across[0]]
        columns, rows = self.spacing.refined(self.refinement)
        return (
            f"    hex ({' '.join(map(str, corners))}) ({columns[i]} {rows[j]} {layer.cells}) "
            f"edgeGrading ({' '.join([*gradings, *[layer.grading] * 4])})"
        )


def _refined(numbers: tuple[int, ...], refinement: float) -> list[int]:
    return [2 * round(number * refinement / 2) for number in numbers]


def expansion(length: float, cells: int, first: float) -> float:
    """Return the size of the last cell over that of the first, for a geometric growth."""
    if first * cells >= length * (1 - _EVEN):
        return 1.0

    def excess(log_growth: float) -> float:
        return first * math.expm1(cells * log_growth) / math.expm1(log_growth) - length

    return math.exp((cells - 1) * float(scipy.optimize.brentq(excess, 1e-9, 3.0)))


def _along(points: NDArray[np.float64], i: int, line: int) -> str:
    """Return the grading of column ``i`` on a line of y."""
    length = math.dist(points[i, line], points[i + 1, line])
    if i == 0:
        near = AHEAD / _COLUMNS[1] * 3.0
        return f"{1 / expansion(length, _COLUMNS[0], near):.8g}"
    if i == 1:
        return f"{1 / expansion(AHEAD, _COLUMNS[1], _OFF_EDGE):.8g}"
    if i == 2:
        return both_ends(expansion(0.5, _COLUMNS[2] // 2, _AT_EDGE))
    if i == 3:
        return f"{expansion(BEHIND, _COLUMNS[3], _OFF_EDGE):.8g}"
    near = BEHIND / _COLUMNS[3] * 3.0
    return f"{expansion(length, _COLUMNS[4], near):.8g}"


def _across(points: NDArray[np.float64], line: int, j: int, at_wall: float = _AT_WALL) -> str:
    """Return the grading of row ``j`` on a line of x: fine at the plate, relaxed away from it."""
    length = math.dist(points[line, j], points[line, j + 1])
    if j in (0, 4):
        ratio = expansion(length, _ROWS[j], 0.12)
        return f"{1 / ratio if j == 0 else ratio:.8g}"
    if j == 2:
        if line in (2, 3):
            return both_ends(expansion(0.5, _ROWS[2] // 2, _ACROSS))
        return "1"
    first = {0: 1.2e-2, 1: 3e-3, 2: at_wall, 3: at_wall, 4: 4e-3, 5: 1.2e-2}[line]
    ratio = expansion(length, _ROWS[j], first)
    return f"{1 / ratio if j == 1 else ratio:.8g}"


def both_ends(ratio: float) -> str:
    """Return the grading that grows by a ratio to the middle of an edge and shrinks again."""
    return f"((0.5 0.5 {ratio:.8g}) (0.5 0.5 {1 / ratio:.8g}))"


#: The spacing of the meshes of a grid study: sizes that grow geometrically over each block.
SIMILAR: Spacing = Spacing(_COLUMNS, _ROWS, _along, _across)
#: The same with thicker cells at the wall, of the plate's meshes: cells that are long along the
#: span and thin as well are what a moving mesh breaks on.
OF_PLATE: Spacing = Spacing(_COLUMNS, _ROWS, _along, partial(_across, at_wall=_AT_PLATE))


def blocks_around_plate() -> Iterator[tuple[int, int]]:
    """Yield column and row of each block; the plate takes the place of the one left out."""
    return ((i, j) for i in range(5) for j in range(5) if (i, j) != (2, 2))


def _vertex(i: int, j: int) -> int:
    return 6 * i + j


def _face(first: int, second: int, layer: int) -> str:
    first, second = first + 36 * layer, second + 36 * layer
    return f"({first} {second} {second + 36} {first + 36})"


def face_x(line: int, j: int, layer: int = 0) -> str:
    """Return the face on a line of x in row j of a layer."""
    return _face(_vertex(line, j), _vertex(line, j + 1), layer)


def face_y(i: int, line: int, layer: int = 0) -> str:
    """Return the face on a line of y in column i of a layer."""
    return _face(_vertex(i, line), _vertex(i + 1, line), layer)


def face_z(i: int, j: int, plane: int) -> str:
    """Return the face of column i and row j in a plane of vertices."""
    return f"({' '.join(str(corner + 36 * plane) for corner in _corners(i, j))})"


def _corners(i: int, j: int) -> list[int]:
    return [_vertex(*at) for at in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]


def patch(name: str, kind: str, faces: list[str]) -> str:
    """Return a patch as blockMesh reads it."""
    return f"    {name}\n    {{\n        type {kind};\n        faces ({' '.join(faces)});\n    }}"


def block_mesh_text(vertices: list[str], blocks: list[str], patches: list[str]) -> str:
    """Return the text of ``blockMeshDict``."""
    return (
        "FoamFile\n{\n    version 2.0;\n    format ascii;\n    class dictionary;\n"
        "    object blockMeshDict;\n}\n\nscale 1;\n\n"
        f"vertices\n(\n{_lines(vertices)}\n);\n\nblocks\n(\n{_lines(blocks)}\n);\n\n"
        f"edges\n(\n);\n\nboundary\n(\n{_lines(patches)}\n);\n"
    )


def _lines(parts: list[str]) -> str:
    return "\n".join(parts)
