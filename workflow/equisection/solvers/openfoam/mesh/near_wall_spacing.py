"""Cells of given sizes on the block mesh: along the wall, near it, in the wake and elsewhere.

The sizes are those of Section 4.1 of the paper (docs/openfoam-polar.md). From the wall they grow
geometrically to that of a region, and stay there. The counts are those that the sizes ask for in a
channel 4 c high. In another channel, or around another thickness, the uniform part of each block
takes up the difference. Growth, size of the first cell (y+ below 1) and length of the wake region
are this project's.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from equisection.solvers.openfoam.mesh.block_mesh import Spacing, both_ends, expansion

#: Sizes (chords).
WALL, NEAR_FIELD, WAKE, DOMAIN = 0.004, 0.020, 0.040, 0.200
#: First cells (chords): off the upper and lower side, off the edges, along the plate at its edges,
#: and across its thickness.
OFF_WALL, OFF_EDGE, _AT_EDGE, _ACROSS = 1e-4, 3e-4, 1e-3, 4e-4
#: Growth from cell to cell: off the plate, into the wake, and towards inlet, floor and ceiling.
_GROWTH, _INTO_WAKE, _OUTWARD = 1.2, 1.05, 1.15
#: The near field's size behind the plate, up to the growth into the wake (chords).
_NEAR_BEHIND = 0.38
#: First cells of the rows beside the plate on the other lines of x (chords), as there is room.
_BESIDE = {0: 1.2e-2, 1: 3e-3, 4: 4e-3, 5: 1.2e-2}
#: Cells between the lines, along x and along y.
_COLUMNS, _ROWS = (30, 54, 258, 72, 82), (16, 58, 16, 58, 16)

#: Length, cells, and size of the last cell over that of the first.
Part = tuple[float, int, float]


def _along(points: NDArray[np.float64], i: int, line: int) -> str:
    """Return the grading of column ``i`` on a line of y."""
    length, cells = math.dist(points[i, line], points[i + 1, line]), _COLUMNS[i]
    if i == 0:
        return _text(_filled(length, cells, [_growing(NEAR_FIELD, DOMAIN, _OUTWARD)])[::-1], -1)
    if i == 1:
        return _text(_filled(length, cells, [_growing(OFF_EDGE, NEAR_FIELD, _GROWTH)])[::-1], -1)
    if i == 2:
        half = _filled(length / 2, cells // 2, [_growing(_AT_EDGE, WALL, _GROWTH)])
        return f"({_parts(half, 1)} {_parts(half[::-1], -1)})"
    if i == 3:
        near = (_NEAR_BEHIND, round(_NEAR_BEHIND / NEAR_FIELD), 1.0)
        behind = [_growing(OFF_EDGE, NEAR_FIELD, _GROWTH), near]
        return _text(_filled(length, cells, [*behind, _growing(NEAR_FIELD, WAKE, _INTO_WAKE)]), 1)
    return _text(_filled(length, cells, [_growing(WAKE, DOMAIN, _INTO_WAKE)]), 1)


def _across(points: NDArray[np.float64], line: int, j: int) -> str:
    """Return the grading of row ``j`` on a line of x."""
    length, cells = math.dist(points[line, j], points[line, j + 1]), _ROWS[j]
    at_plate = line in (2, 3)
    if j == 2:
        return both_ends(expansion(length / 2, cells // 2, _ACROSS)) if at_plate else "1"
    if j in (0, 4):
        parts = _filled(length, cells, [_growing(NEAR_FIELD, DOMAIN, _OUTWARD)])
    elif at_plate:
        parts = _filled(length, cells, [_growing(OFF_WALL, NEAR_FIELD, _GROWTH)])
    else:
        parts = [(length, cells, expansion(length, cells, _BESIDE[line]))]
    return _text(parts[::-1], -1) if j < 2 else _text(parts, 1)


def _growing(first: float, last: float, growth: float) -> Part:
    """Return the part in which the sizes grow from one to the other."""
    cells = round(math.log(last / first) / math.log(growth))
    return first * (growth**cells - 1) / (growth - 1), cells, growth ** (cells - 1)


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


BY_CELL_SIZE = Spacing(_COLUMNS, _ROWS, _along, _across)
