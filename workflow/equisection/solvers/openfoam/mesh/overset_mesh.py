"""Two meshes, one above the other: the channel's, and one around the plate that moves with it.

The background fills the channel as if there were no plate: even cells where the plate and its wake
come, growing towards inlet, outlet, floor and ceiling. The component has the lines of
:mod:`~equisection.solvers.openfoam.mesh.block_mesh` up to its near field, turned to the incidence,
and ends in a patch ``overset``, at which it takes its values from the background. The background
takes its values under the component from there, and is left out where the plate is.

Both are in one ``blockMeshDict``, the background first: its cells have the zone 0, those of the
component 1.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from equisection.errors import SolverError
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox, both_ends, expansion

Floats = NDArray[np.float64]

#: Patch at which the component ends.
OVERSET = "overset"
#: Reach of the component ahead of the plate, behind it, and to either side (chords); the last as a
#: part of the half channel at the most.
_AHEAD, _BEHIND, _ASIDE, _ASIDE_PART = 0.4, 0.7, 0.45, 0.25
#: Even cells of the background, and of the component away from the plate (chords).
_EVEN = 0.06
#: Where the background has them: ahead and behind mid-chord (chords), and across the channel as a
#: part of it.
_EVEN_AHEAD, _EVEN_BEHIND, _EVEN_PART = 1.2, 2.4, 0.6
#: Growth from cell to cell: in the component, and in the background.
_GROWTH, _OUTWARD = 1.2, 1.2
#: First cells (chords): at the walls, at the plate's edges along it, ahead of and behind these, at
#: the ends of the component across, and across the plate's thickness as a part of it.
_AT_WALL, _AT_EDGE, _OFF_EDGE, _AT_END, _ACROSS = 3e-4, 2.5e-3, 1.2e-3, 5e-3, 0.04
#: Cells along the plate and across its thickness.
_ALONG_PLATE, _ACROSS_PLATE = 56, 10

#: Cells, and the grading of a row of them.
Row = tuple[int, str]


@dataclass(frozen=True)
class OversetMesh:
    """Input of ``blockMesh`` for both meshes.

    Attributes
    ----------
    channel
        Section and channel.
    incidence
        Incidence (rad), nose up.
    refinement
        Refinement of each direction of both.
    """

    channel: ChannelBox
    incidence: float
    refinement: float

    @property
    def background_cells(self) -> int:
        """Number of cells of the background."""
        columns, rows = (self._counts(part) for part in self._background())
        return sum(columns) * sum(rows)

    @property
    def component_cells(self) -> int:
        """Number of cells of the component."""
        columns, rows = (self._counts(part) for part in self._component())
        return sum(columns) * sum(rows) - columns[1] * rows[1]

    @property
    def cells(self) -> int:
        """Number of cells of both."""
        return self.background_cells + self.component_cells

    def _counts(self, rows: Sequence[Row]) -> list[int]:
        return [2 * round(cells * self.refinement / 2) for cells, _ in rows]

    @property
    def _aside(self) -> float:
        return min(_ASIDE, _ASIDE_PART * self.channel.room)

    def _background_lines(self) -> tuple[list[float], list[float]]:
        channel, half = self.channel, self.channel.room
        x = [-channel.upstream, -_EVEN_AHEAD, _EVEN_BEHIND, channel.downstream]
        if sorted(x) != x:
            raise SolverError(
                f"flow.channel: the background of an overset mesh reaches from {-_EVEN_AHEAD:g} c "
                f"to {_EVEN_BEHIND:g} c; the channel only from {x[0]:g} c to {x[3]:g} c"
            )
        return x, [channel.floor, -_EVEN_PART * half, _EVEN_PART * half, channel.ceiling]

    def _background(self) -> tuple[list[Row], list[Row]]:
        """Return columns and rows of the background at refinement 1."""
        found = []
        for lines in self._background_lines():
            first, even, last = (b - a for a, b in itertools.pairwise(lines))
            cells = round(even / _EVEN)
            found.append([_reversed(_outward(first)), (cells, "1"), _outward(last)])
        return found[0], found[1]

    def _component(self) -> tuple[list[Row], list[Row]]:
        """Return columns and rows of the component at refinement 1; rows as at the plate."""
        ahead, behind = _off(_OFF_EDGE, _AHEAD), _off(_OFF_EDGE, _BEHIND)
        plate = both_ends(expansion(0.5, _ALONG_PLATE // 2, _AT_EDGE))
        across = both_ends(expansion(0.5, _ACROSS_PLATE // 2, _ACROSS))
        aside = _off(_AT_WALL, self._aside - self.channel.thickness / 2)
        columns = [_reversed(ahead), (_ALONG_PLATE, plate), behind]
        return columns, [_reversed(aside), (_ACROSS_PLATE, across), aside]

    def require_room(self) -> None:
        """Refuse a channel that either mesh does not fit into.

        Raises
        ------
        SolverError
            With the channel.
        """
        self._background_lines()
        channel = self.channel
        _, grown = _growing(_AT_WALL)
        if self._aside - channel.thickness / 2 <= grown:
            raise SolverError(
                f"the overset mesh around the plate does not fit into a channel of "
                f"{channel.height:g} c{channel.words}; enlarge flow.channel"
            )

    def block_mesh_dict(self) -> str:
        """Return the text of ``blockMeshDict``, for one layer of cells of depth 1."""
        x, y = self._background_lines()
        points = [(a, b) for a in x for b in y]
        columns, rows = self._background()
        blocks = [
            self._block(_corners(0, i, j), columns[i], rows[j], [rows[j][1]] * 4)
            for i, j in itertools.product(range(3), range(3))
        ]
        points += self._component_points()
        columns, rows = self._component()
        length = self._aside - self.channel.thickness / 2
        for i, j in _COMPONENT:
            at_end = f"{expansion(length, rows[2][0], _AT_END):.8g}"
            end = {0: _inverse(at_end), 1: "1", 2: at_end}[j]
            low = end if i == 0 else rows[j][1]
            high = end if i == 2 else rows[j][1]
            across = [low, high, high, low]
            blocks.append(self._block(_corners(16, i, j), columns[i], rows[j], across))
        vertices = [f"({a:.12g} {b:.12g} {z:g})" for z in (-0.5, 0.5) for a, b in points]
        patches = [
            _patch(OVERSET, OVERSET, _ends(16)),
            _patch("inlet", "patch", [_side(0, 0, j, 0, j + 1) for j in range(3)]),
            _patch("outlet", "patch", [_side(0, 3, j, 3, j + 1) for j in range(3)]),
            _patch("floor", "symmetryPlane", [_side(0, i, 0, i + 1, 0) for i in range(3)]),
            _patch("ceiling", "symmetryPlane", [_side(0, i, 3, i + 1, 3) for i in range(3)]),
            _patch("plate", "wall", [_side(16, *side) for side in _PLATE]),
            _patch("sides", "empty", _faces()),
        ]
        return (
            "FoamFile\n{\n    version 2.0;\n    format ascii;\n    class dictionary;\n"
            "    object blockMeshDict;\n}\n\n"
            f"scale 1;\n\nvertices\n(\n{_lines(vertices)}\n);\n\nblocks\n(\n{_lines(blocks)}\n);"
            f"\n\nedges ();\n\nboundary\n(\n{_lines(patches)}\n);\n"
        )

    def reach(self, twist: ArrayLike, deflection: ArrayLike) -> Floats:
        """Return the reach of the component from the middle of the channel (chords).

        The section is at twists (rad) and deflections (chords) beyond those of the mesh.
        """
        angle = self.incidence + np.asarray(twist)
        above = self.channel.section_height + np.asarray(deflection)
        heights = [
            above + eta * np.cos(angle) - xi * np.sin(angle) for xi, eta in self._level_points()
        ]
        return np.asarray(np.abs(heights).max(axis=0))

    def ends(self, twist: ArrayLike, along: ArrayLike) -> tuple[Floats, Floats]:
        """Return the foremost and the rearmost x of the component (chords).

        The section is at twists (rad) beyond those of the mesh, mid-chord at places along the
        stream (chords).
        """
        angle = self.incidence + np.asarray(twist)
        places = np.asarray(
            [
                np.asarray(along) + xi * np.cos(angle) + eta * np.sin(angle)
                for xi, eta in self._level_points()
            ]
        )
        return np.asarray(places.min(axis=0)), np.asarray(places.max(axis=0))

    def _component_points(self) -> list[tuple[float, float]]:
        cosine, sine = math.cos(self.incidence), math.sin(self.incidence)
        return [
            (xi * cosine + eta * sine, eta * cosine - xi * sine) for xi, eta in self._level_points()
        ]

    def _level_points(self) -> list[tuple[float, float]]:
        """Return the crossings of the component's lines along and across the plate (chords)."""
        half = self.channel.thickness / 2
        along = (-0.5 - _AHEAD, -0.5, 0.5, 0.5 + _BEHIND)
        return [(xi, eta) for xi in along for eta in (-self._aside, -half, half, self._aside)]

    def _block(self, corners: list[int], column: Row, row: Row, across: Sequence[str]) -> str:
        corners = [*corners, *(corner + _LAYER for corner in corners)]
        columns, rows = self._counts([column, row])
        gradings = [*[column[1]] * 4, *across, *["1"] * 4]
        return (
            f"hex ({' '.join(map(str, corners))}) ({columns} {rows} 1) "
            f"edgeGrading ({' '.join(gradings)})"
        )


#: Points of both meshes in one plane.
_LAYER = 32
#: Columns and rows of the component; the plate stands where one is left out.
_COMPONENT = [at for at in itertools.product(range(3), range(3)) if at != (1, 1)]
#: Lines between which the sides of the plate are.
_PLATE = [(1, 1, 1, 2), (2, 1, 2, 2), (1, 1, 2, 1), (1, 2, 2, 2)]


def _off(first: float, length: float) -> Row:
    """Return cells that grow from the plate to the even size and stay there."""
    cells, reach = _growing(first)
    even = max(1, round((length - reach) / _EVEN))
    ratio = _GROWTH ** (cells - 1)
    text = f"(({reach:.8g} {cells} {ratio:.8g}) ({length - reach:.8g} {even} 1))"
    return _even(cells + even), text


def _growing(first: float) -> tuple[int, float]:
    """Return the cells from a first one to the even size, and their length (chords)."""
    cells = round(math.log(_EVEN / first) / math.log(_GROWTH))
    return cells, first * (_GROWTH**cells - 1) / (_GROWTH - 1)


def _outward(length: float) -> Row:
    """Return cells that grow from the even size outwards."""
    cells = _even(math.ceil(math.log1p(length / _EVEN * (_OUTWARD - 1)) / math.log(_OUTWARD)))
    return cells, f"{expansion(length, cells, _EVEN):.8g}"


def _even(cells: int) -> int:
    return 2 * round(cells / 2)


def _reversed(row: Row) -> Row:
    return row[0], _inverse(row[1])


def _inverse(grading: str) -> str:
    """Return the grading of an edge seen from its other end."""
    if not grading.startswith("("):
        return f"{1 / float(grading):.8g}"
    parts = [part.split() for part in grading.strip("()").split(") (")]
    turned = [f"({length} {cells} {1 / float(ratio):.8g})" for length, cells, ratio in parts[::-1]]
    return f"({' '.join(turned)})"


def _vertex(first: int, i: int, j: int) -> int:
    return first + 4 * i + j


def _corners(first: int, i: int, j: int) -> list[int]:
    """Return the corners of a block in the first plane."""
    return [_vertex(first, *at) for at in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))]


def _side(first: int, i: int, j: int, to_i: int, to_j: int) -> str:
    one, other = _vertex(first, i, j), _vertex(first, to_i, to_j)
    return f"({one} {other} {other + _LAYER} {one + _LAYER})"


def _ends(first: int) -> list[str]:
    """Return the outer sides of the component."""
    return [
        _side(first, *side)
        for n in range(3)
        for side in ((0, n, 0, n + 1), (3, n, 3, n + 1), (n, 0, n + 1, 0), (n, 3, n + 1, 3))
    ]


def _faces() -> list[str]:
    """Return the faces of all blocks in both planes."""
    found = []
    for first, blocks in ((0, list(itertools.product(range(3), range(3)))), (16, _COMPONENT)):
        for i, j in blocks:
            for shift in (0, _LAYER):
                corners = (str(corner + shift) for corner in _corners(first, i, j))
                found.append(f"({' '.join(corners)})")
    return found


def _patch(name: str, kind: str, faces: list[str]) -> str:
    return f"{name}\n    {{\n        type {kind};\n        faces ({' '.join(faces)});\n    }}"


def _lines(parts: list[str]) -> str:
    return "\n".join(f"    {part}" for part in parts)
