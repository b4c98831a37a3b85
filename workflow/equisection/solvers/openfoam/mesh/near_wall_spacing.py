"""Cells of given sizes on the block mesh: along the wall, near it, in the wake and elsewhere.

The sizes are those of Section 4.1 of the paper (docs/openfoam-polar.md). From the wall they grow
geometrically to that of a region, and stay there. The counts are those that the sizes ask for in a
channel 4 c high. In another channel, or around another thickness, the uniform part of each block
takes up the difference. Length of the wake region and growth away from the near field are this
project's, and so are growth and first cell (y+ below 1) at the wall of :data:`BY_CELL_SIZE`.
:data:`FIVE_LAYERS` has five layers at the wall, as Section 4.1 has them.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial

import numpy as np
from numpy.typing import NDArray

from equisection.solvers.openfoam.mesh.block_mesh import (
    AHEAD,
    ASIDE,
    BEHIND,
    Spacing,
    both_ends,
    expansion,
)

#: Sizes (chords).
WALL, NEAR_FIELD, WAKE, DOMAIN = 0.004, 0.020, 0.040, 0.200
#: First cells (chords): off the upper and lower side, off the edges, along the plate at its edges,
#: and across its thickness.
OFF_WALL, OFF_EDGE, _AT_EDGE, _ACROSS = 1e-4, 3e-4, 1e-3, 4e-4
#: Growth from cell to cell: off the plate, into the wake, and towards inlet, floor and ceiling.
_GROWTH, _INTO_WAKE, _OUTWARD = 1.2, 1.05, 1.15
#: Layers of prisms of Section 4.1: number, thickness and, of this project's choice, the first of
#: them (chords), which is about as thin as y+ below 1 asks for.
LAYERS, LAYERS_THICK, FIRST_LAYER = 5, 0.075, 3e-4
#: Sizes of the plate's mesh in three dimensions (chords; Section 4.2): at the walls, and far off.
WALL_OF_PLATE, DOMAIN_OF_PLATE = 0.010, 0.400
#: The near field's size behind the plate, up to the growth into the wake (chords).
_NEAR_BEHIND = 0.38
#: First cells of the rows beside the plate on the other lines of x (chords), as there is room.
_BESIDE = {0: 1.2e-2, 1: 3e-3, 4: 4e-3, 5: 1.2e-2}
#: Plate and channel that the counts are for (chords).
_THICK, _HALF_HEIGHT, _UPSTREAM, _DOWNSTREAM = 0.04, 2.0, 5.0, 15.0

#: Length, cells, and size of the last cell over that of the first.
Part = tuple[float, int, float]


def growing(first: float, last: float, growth: float) -> Part:
    """Return the part in which the sizes (chords) grow from one to the other by a growth (-)."""
    cells = round(math.log(last / first) / math.log(growth))
    return first * (growth**cells - 1) / (growth - 1), cells, growth ** (cells - 1)


def layers(first: float, number: int = LAYERS, thickness: float = LAYERS_THICK) -> Part:
    """Return the part of layers of a thickness (chords) in all, whose first has a size (chords)."""
    return thickness, number, expansion(thickness, number, first)


_OFF_SIDES, _OFF_EDGES = (growing(first, NEAR_FIELD, _GROWTH) for first in (OFF_WALL, OFF_EDGE))


@dataclass(frozen=True)
class WallCells:
    """Cells at the walls of the plate, from which on they have the size of the near field.

    Attributes
    ----------
    off_sides
        Cells off the upper and lower side.
    off_edges
        Cells off leading and trailing edge.
    along
        Size along the sides (chords), from ``at_edge`` at their ends.
    at_edge
        Size along the sides at the edges (chords).
    across
        First size (chords) and number of cells across the thickness.
    """

    off_sides: Part = _OFF_SIDES
    off_edges: Part = _OFF_EDGES
    along: float = WALL
    at_edge: float = _AT_EDGE
    across: tuple[float, int] = (_ACROSS, 16)

    @property
    def from_edge(self) -> list[Part]:
        """Growth along the sides, none where the sizes are even."""
        return [growing(self.at_edge, self.along, _GROWTH)] if self.at_edge < self.along else []

    @property
    def behind(self) -> list[Part]:
        """Cells behind the plate up to those of the wake."""
        near = (_NEAR_BEHIND, round(_NEAR_BEHIND / NEAR_FIELD), 1.0)
        return [self.off_edges, near, growing(NEAR_FIELD, WAKE, _INTO_WAKE)]


def by_size(wall: WallCells, domain: float = DOMAIN, along_span: float = 1.0) -> Spacing:
    """Return the spacing of given sizes.

    Parameters
    ----------
    wall
        Cells at the walls.
    domain
        Size far from the plate (chords).
    along_span
        Cells along the span of a beam over those that its refinement gives it (-).
    """
    out = growing(NEAR_FIELD, domain, _OUTWARD)
    columns = (
        _even(_UPSTREAM - 0.5 - AHEAD, [out], domain),
        _even(AHEAD, [wall.off_edges], NEAR_FIELD),
        2 * round(_number(0.5, wall.from_edge, wall.along)),
        _even(BEHIND, wall.behind, WAKE),
        _even(_DOWNSTREAM - 0.5 - BEHIND, [growing(WAKE, domain, _INTO_WAKE)], domain),
    )
    beside = _even(ASIDE - _THICK / 2, [wall.off_sides], NEAR_FIELD)
    outer = _even(_HALF_HEIGHT - ASIDE, [out], domain)
    rows = (outer, beside, wall.across[1], beside, outer)
    return Spacing(
        columns,
        rows,
        partial(_along, wall=wall, columns=columns, domain=domain),
        partial(_across, wall=wall, rows=rows, domain=domain),
        along_span,
    )


def _number(length: float, parts: list[Part], size: float) -> float:
    """Return the cells of parts and of even ones of a size behind them."""
    return sum(part[1] for part in parts) + (length - sum(part[0] for part in parts)) / size


def _even(length: float, parts: list[Part], size: float) -> int:
    """Return an even number of cells of parts and of a size behind them."""
    return 2 * round(_number(length, parts, size) / 2)


def _along(
    points: NDArray[np.float64],
    i: int,
    line: int,
    *,
    wall: WallCells,
    columns: tuple[int, ...],
    domain: float,
) -> str:
    """Return the grading of column ``i`` on a line of y."""
    length, cells = math.dist(points[i, line], points[i + 1, line]), columns[i]
    if i == 0:
        return _text(_filled(length, cells, [growing(NEAR_FIELD, domain, _OUTWARD)])[::-1], -1)
    if i == 1:
        return _text(_filled(length, cells, [wall.off_edges])[::-1], -1)
    if i == 2:
        if not wall.from_edge:
            return "1"
        half = _filled(length / 2, cells // 2, wall.from_edge)
        return f"({_parts(half, 1)} {_parts(half[::-1], -1)})"
    if i == 3:
        return _text(_filled(length, cells, wall.behind), 1)
    return _text(_filled(length, cells, [growing(WAKE, domain, _INTO_WAKE)]), 1)


def _across(
    points: NDArray[np.float64],
    line: int,
    j: int,
    *,
    wall: WallCells,
    rows: tuple[int, ...],
    domain: float,
) -> str:
    """Return the grading of row ``j`` on a line of x."""
    length, cells = math.dist(points[line, j], points[line, j + 1]), rows[j]
    at_plate = line in (2, 3)
    if j == 2:
        return both_ends(expansion(length / 2, cells // 2, wall.across[0])) if at_plate else "1"
    if j in (0, 4):
        parts = _filled(length, cells, [growing(NEAR_FIELD, domain, _OUTWARD)])
    elif at_plate:
        parts = _filled(length, cells, [wall.off_sides])
    else:
        parts = [(length, cells, expansion(length, cells, _BESIDE[line]))]
    return _text(parts[::-1], -1) if j < 2 else _text(parts, 1)


def _filled(length: float, cells: int, parts: list[Part]) -> list[Part]:
    """Return parts with even cells behind; geometric from the first cell on if there is no room."""
    rest = length - sum(part[0] for part in parts)
    left = cells - sum(part[1] for part in parts)
    if rest > 0 and left > 0 and rest / left > parts[0][0] / parts[0][1]:
        return [*parts, (rest, left, 1.0)]
    reach, number, ratio = parts[0]
    growth = ratio ** (1 / (number - 1))
    first = reach * (growth - 1) / (growth**number - 1)
    return [(length, cells, expansion(length, cells, first))]


def _text(parts: Sequence[Part], direction: int) -> str:
    """Return parts as blockMesh reads them; direction -1 is towards the fine end."""
    return f"({_parts(parts, direction)})"


def _parts(parts: Sequence[Part], direction: int) -> str:
    return " ".join(f"({part:.8g} {cells} {ratio**direction:.8g})" for part, cells, ratio in parts)


#: Cells that grow by a fifth from walls with y+ below 1, and are finer at the edges.
BY_CELL_SIZE = by_size(WallCells())
#: Cells at the walls as in Section 4.1: five layers, and one size along them, edges included.
_LAYERS = layers(FIRST_LAYER)
FIVE_LAYERS = by_size(WallCells(_LAYERS, _LAYERS, WALL, WALL, (WALL, 10)))
#: The same of the plate in three dimensions, with cells of the near field's size at its tip.
FIVE_LAYERS_OF_PLATE = by_size(
    WallCells(_LAYERS, _LAYERS, WALL_OF_PLATE, WALL_OF_PLATE, (WALL_OF_PLATE, 4)),
    DOMAIN_OF_PLATE,
    along_span=3.1,
)
