"""Cells of three or four corners in a plane, joined and written as OpenFOAM's mesh of one layer."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import scipy.sparse
from numpy.typing import NDArray
from scipy.sparse.csgraph import reverse_cuthill_mckee

from equisection.errors import SolverError
from equisection.files import write_text

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

#: Planes that bound the layer (chords).
_PLANES = (-0.5, 0.5)

#: Name of the patch of each edge on the boundary, from its ends, each of shape (n, 2).
PatchOf = Callable[[Floats, Floats], NDArray[np.str_]]


@dataclass(frozen=True)
class PlaneCells:
    """Cells with their corners counter-clockwise.

    Attributes
    ----------
    points : (n, 2) array
        Points (chords).
    corners : (m, 4) array of int
        Corners of each cell; two that follow each other are one in a triangle.
    """

    points: Floats
    corners: Indices

    def turned(self, angle: float) -> PlaneCells:
        """Return the cells turned about the origin by an angle (rad), counter-clockwise."""
        cosine, sine = np.cos(angle), np.sin(angle)
        return PlaneCells(self.points @ np.array([[cosine, sine], [-sine, cosine]]), self.corners)

    def joined(self, other: PlaneCells, common: Indices, own: Indices) -> PlaneCells:
        """Return these cells and others, of which the points ``common`` are our points ``own``."""
        number = np.full(len(other.points), -1)
        number[common] = own
        free = np.flatnonzero(number < 0)
        number[free] = len(self.points) + np.arange(free.size)
        return PlaneCells(
            np.concatenate([self.points, other.points[free]]),
            np.concatenate([self.corners, number[other.corners]]),
        )


def corner_areas(cells: PlaneCells) -> Floats:
    """Return twice the area of the smallest triangle of successive corners of each cell.

    It is not positive for a cell that is folded or not convex.
    """
    corners = cells.points[cells.corners]
    edge = np.roll(corners, -1, axis=1) - corners
    before = np.roll(edge, 1, axis=1)
    # where two corners of a triangle are one, the edge of no length gives way to the next
    nothing = (edge == 0).all(axis=-1, keepdims=True)
    edge = np.where(nothing, np.roll(edge, -1, axis=1), edge)
    nothing = (before == 0).all(axis=-1, keepdims=True)
    before = np.where(nothing, np.roll(before, 1, axis=1), before)
    cross = before[..., 0] * edge[..., 1] - before[..., 1] * edge[..., 0]
    return np.asarray(cross.min(axis=1))


def write_layer(
    folder: Path, parts: Sequence[PlaneCells], patches: Mapping[str, str], of: PatchOf
) -> int:
    """Write ``constant/polyMesh`` of one layer of cells of depth 1, and return their number.

    Cells are part by part, in the order of reverse Cuthill-McKee; faces in that of OpenFOAM: inside
    by the lower cell and then the higher one, then patch by patch.

    Parameters
    ----------
    folder
        Folder of the case.
    parts
        The cells, in parts that have no point in common.
    patches
        Names and types of the patches of the plane's boundary, in their order; ``sides`` come
        behind them.
    of
        Patch of each edge of the boundary.

    Raises
    ------
    SolverError
        Cells overlap, or an edge is on no patch.
    """
    points = np.concatenate([part.points for part in parts])
    before = np.cumsum([0, *(len(part.points) for part in parts)])
    corners = np.concatenate(
        [ordered(part.corners) + own for part, own in zip(parts, before[:-1], strict=True)]
    )
    inside, boundary = edges_of(corners)
    shift = len(points)

    def upright(edge: Indices) -> Indices:
        a, b = edge.T
        return np.stack([a, b, b + shift, a + shift], axis=-1)

    owner, ends = boundary[:, 0], boundary[:, 1:]
    names = of(points[ends[:, 0]], points[ends[:, 1]])
    unknown = ~np.isin(names, list(patches))
    if unknown.any():
        x, y = points[ends[unknown][0, 0]]
        raise SolverError(f"the mesh has a gap at x = {x:.4g} c, y = {y:.4g} c")
    groups = [(upright(inside[:, 2:]), inside[:, 0])]
    places, start = [], len(inside)
    for name, kind in patches.items():
        here = names == name
        groups.append((upright(ends[here]), owner[here]))
        places.append((name, kind, int(here.sum()), start))
        start += int(here.sum())
    number = np.arange(len(corners))
    groups += [(corners[:, ::-1], number), (corners + shift, number)]
    places.append(("sides", "empty", 2 * len(corners), start))
    faces = np.concatenate([faces for faces, _ in groups])
    owners = np.concatenate([owners for _, owners in groups])
    both = np.concatenate([np.c_[points, np.full(shift, plane)] for plane in _PLANES])
    write_faces(folder, both, faces, (owners, inside[:, 1]), places)
    return len(corners)


def ordered(corners: Indices) -> Indices:
    """Return the cells in an order in which neighbours are near each other."""
    inside, _ = edges_of(corners)
    ones = np.ones(len(inside), dtype=np.int8)
    graph = scipy.sparse.coo_array((ones, inside[:, :2].T), shape=(len(corners),) * 2).tocsr()
    return np.asarray(corners[reverse_cuthill_mckee(graph + graph.T, symmetric_mode=True)])


def edges_of(corners: Indices) -> tuple[Indices, Indices]:
    """Return edges inside, as (lower cell, higher cell, ends), and those of the boundary.

    An edge has its ends as its (lower) cell passes them; those of the boundary are (cell, ends).

    Raises
    ------
    SolverError
        An edge is of more than two cells.
    """
    cell = np.repeat(np.arange(len(corners)), 4)
    ends = np.stack([corners, np.roll(corners, -1, axis=1)], axis=-1).reshape(-1, 2)
    real = ends[:, 0] != ends[:, 1]
    cell, ends = cell[real], ends[real]
    low, high = ends.min(axis=1), ends.max(axis=1)
    order = np.lexsort((cell, high, low))
    cell, ends, low, high = cell[order], ends[order], low[order], high[order]
    same = (low[1:] == low[:-1]) & (high[1:] == high[:-1])
    if (same[1:] & same[:-1]).any():
        raise SolverError("the mesh has an edge of three cells")
    first = np.append(same, False)
    second = np.append(False, same)
    inside = np.column_stack([cell[first], cell[second], ends[first]])
    inside = inside[np.lexsort((inside[:, 1], inside[:, 0]))]
    alone = ~first & ~second
    return inside, np.column_stack([cell[alone], ends[alone]])


def write_faces(
    folder: Path,
    points: Floats,
    faces: Indices,
    cells_of_faces: tuple[Indices, Indices],
    patches: list[tuple[str, str, int, int]],
) -> None:
    """Write ``constant/polyMesh``.

    Parameters
    ----------
    folder
        Folder of the case.
    points
        Points, shape (n, 3).
    faces
        Corners of each face, shape (m, 4), in OpenFOAM's order; two that follow each other are one
        in a triangle.
    cells_of_faces
        Owner of each face, and neighbour of each of those inside, which come first.
    patches
        Name, type, number of faces and first face of each patch.
    """
    place = folder / "constant" / "polyMesh"
    owners, neighbours = cells_of_faces
    cells = int(owners.max()) + 1
    note = (
        f"nPoints:{len(points)} nCells:{cells} nFaces:{len(faces)} nInternalFaces:{len(neighbours)}"
    )
    triangle = (faces == np.roll(faces, 1, axis=1)).any(axis=1)
    texts = np.where(triangle, "", [f"4({a} {b} {c} {d})" for a, b, c, d in faces.tolist()])
    for row in np.flatnonzero(triangle):
        a, b, c = dict.fromkeys(faces[row].tolist())
        texts[row] = f"3({a} {b} {c})"
    contents = {
        "points": ("vectorField", [f"({x:.15g} {y:.15g} {z:.15g})" for x, y, z in points.tolist()]),
        "faces": ("faceList", texts.tolist()),
        "owner": ("labelList", map(str, owners.tolist())),
        "neighbour": ("labelList", map(str, neighbours.tolist())),
        "boundary": (
            "polyBoundaryMesh",
            [
                f"{name}\n{{\n    type {kind};\n    nFaces {count};\n    startFace {start};\n}}"
                for name, kind, count, start in patches
            ],
        ),
    }
    for name, (kind, rows) in contents.items():
        lines = list(rows)
        head = (
            "FoamFile\n{\n    version 2.0;\n    format ascii;\n"
            f'    class {kind};\n    note "{note}";\n'
            f'    location "constant/polyMesh";\n    object {name};\n}}\n\n'
        )
        body = "\n".join(lines)
        write_text(place / name, f"{head}{len(lines)}\n(\n{body}\n)\n")
