"""Cells in a plane extruded along the span, and written as OpenFOAM's mesh of a beam.

Beyond a free tip cells fill the inside of the outline as well::

    z = 0              tip        far wall
    |  around the body  |  around it  |
    |       body        |  inside it  |
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.errors import SolverError
from equisection.solvers.openfoam.mesh.plane_cells import (
    PatchOf,
    PlaneCells,
    edges_of,
    ordered,
    write_faces,
)

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

#: Part of the boundary: its patch, corners of its faces, and cell of each.
_Part = tuple[str, Indices, Indices]


@dataclass(frozen=True)
class Extrusion:
    """Cells around a body extruded along z, and beyond its tip those inside of it.

    Attributes
    ----------
    around
        Cells around the body.
    inside
        The same cells followed by those inside of the body, which share its points: their first
        points are those of ``around``. None for a body from wall to wall.
    levels : (n + 1,) array
        z/c of the planes between the layers of cells.
    tip
        Number of the level at the tip; n for a body from wall to wall.
    """

    around: PlaneCells
    inside: PlaneCells | None
    levels: Floats
    tip: int

    @property
    def cells(self) -> int:
        """Number of cells."""
        return int(sum(len(self._cells(layer)) for layer in range(self.levels.size - 1)))

    def write(self, folder: Path, patches: Mapping[str, str], of: PatchOf, body: str) -> int:
        """Write ``constant/polyMesh``, and return the number of cells.

        Cells are layer by layer, in each in the order of reverse Cuthill-McKee; faces are in that
        of OpenFOAM.

        Parameters
        ----------
        folder
            Folder of the case.
        patches
            Names and types of all patches, in their order; those of the planes that bound the mesh
            along z are ``root_wall`` and ``far_wall``.
        of
            Patch of each edge of the plane's boundary.
        body
            Patch of the body, to which its tip belongs.

        Raises
        ------
        SolverError
            Cells overlap, or an edge is on no patch.
        """
        corners, inside = ordered(self.around.corners), None
        if self.inside is not None:
            every = np.concatenate([corners, ordered(self._inner)])
            inside = PlaneCells(self.inside.points, every)
        around = PlaneCells(self.around.points, corners)
        return replace(self, around=around, inside=inside)._write(folder, patches, of, body)

    @property
    def _inner(self) -> Indices:
        """Corners of the cells inside of the body."""
        assert self.inside is not None
        return self.inside.corners[len(self.around.corners) :]

    def _cells(self, layer: int) -> Indices:
        """Return the corners in the plane of the cells of a layer."""
        if layer < self.tip or self.inside is None:
            return self.around.corners
        return self.inside.corners

    def _points(self) -> Floats:
        """Return all points: those around the body level by level, then those inside of it."""
        own = len(self.around.points)
        parts = [np.c_[self.around.points, np.full(own, z)] for z in self.levels]
        if self.inside is not None:
            free = self.inside.points[own:]
            parts += [np.c_[free, np.full(len(free), z)] for z in self.levels[self.tip :]]
        return np.concatenate(parts)

    def _at(self, level: int, points: Indices) -> Indices:
        """Return the numbers of points of the plane at a level."""
        own, levels = len(self.around.points), self.levels.size
        if self.inside is None:
            return points + level * own
        free = len(self.inside.points) - own
        inner = levels * own + (level - self.tip) * free + points - own
        return np.where(points < own, points + level * own, inner)

    def _first_cell(self, layer: int) -> int:
        """Return the number of the first cell of a layer."""
        before = min(layer, self.tip) * len(self._cells(0))
        return before + max(0, layer - self.tip) * len(self._cells(self.levels.size - 2))

    def _upright(self, layer: int, ends: Indices) -> Indices:
        """Return the faces over edges of the plane in a layer."""
        low, high = self._at(layer, ends), self._at(layer + 1, ends)
        return np.column_stack([low[:, 0], low[:, 1], high[:, 1], high[:, 0]])

    def _write(self, folder: Path, patches: Mapping[str, str], of: PatchOf, body: str) -> int:
        inside = [np.concatenate(part) for part in zip(*self._inside(), strict=True)]
        faces, owner, neighbour = inside
        order = np.lexsort((neighbour, owner))
        faces, owner, neighbour = faces[order], owner[order], neighbour[order]
        boundary = list(self._boundary(patches, of, body))
        groups, owners, places, start = [faces], [owner], [], len(faces)
        for name, kind in patches.items():
            here = [(corners, cells) for patch, corners, cells in boundary if patch == name]
            count = sum(len(cells) for _, cells in here)
            groups += [corners for corners, _ in here]
            owners += [cells for _, cells in here]
            places.append((name, kind, count, start))
            start += count
        write_faces(
            folder,
            self._points(),
            np.concatenate(groups),
            (np.concatenate(owners), neighbour),
            places,
        )
        return self.cells

    def _inside(self) -> Iterator[tuple[Indices, Indices, Indices]]:
        """Yield faces inside of the mesh with their lower and their higher cell."""
        edges: dict[int, Indices] = {}
        for layer in range(self.levels.size - 1):
            cells, first = self._cells(layer), self._first_cell(layer)
            if len(cells) not in edges:
                edges[len(cells)] = edges_of(cells)[0]
            low, high, ends = np.split(edges[len(cells)], [1, 2], axis=1)
            yield self._upright(layer, ends), first + low[:, 0], first + high[:, 0]
            if layer + 2 < self.levels.size:
                count = len(cells)
                number = np.arange(count)
                above = self._first_cell(layer + 1)
                yield self._at(layer + 1, cells), first + number, above + number

    def _boundary(self, patches: Mapping[str, str], of: PatchOf, body: str) -> Iterator[_Part]:
        """Yield the faces on the boundary."""
        last = self.levels.size - 2
        known: dict[int, tuple[Indices, NDArray[np.str_]]] = {}
        for layer in range(last + 1):
            cells, first = self._cells(layer), self._first_cell(layer)
            if len(cells) not in known:
                edges = edges_of(cells)[1]
                known[len(cells)] = edges, self._names(edges, patches, of)
            edges, names = known[len(cells)]
            for name in np.unique(names):
                here = edges[names == name]
                yield str(name), self._upright(layer, here[:, 1:]), first + here[:, 0]
        start, end = self._cells(0), self._cells(last)
        yield "root_wall", self._at(0, start[:, ::-1]), np.arange(len(start))
        yield "far_wall", self._at(last + 1, end), self._first_cell(last) + np.arange(len(end))
        if self.inside is not None:
            before = len(self.around.corners)
            number = self._first_cell(self.tip) + before + np.arange(len(self._inner))
            yield body, self._at(self.tip, self._inner[:, ::-1]), number

    def _names(self, edges: Indices, patches: Mapping[str, str], of: PatchOf) -> NDArray[np.str_]:
        """Return the patch of each edge of the plane's boundary."""
        points = self.around.points
        names = of(points[edges[:, 1]], points[edges[:, 2]])
        unknown = ~np.isin(names, list(patches))
        if unknown.any():
            x, y = points[edges[unknown][0, 1]]
            raise SolverError(f"the mesh has a gap at x = {x:.4g} c, y = {y:.4g} c")
        return names
