"""Plane areas between closed polygons filled with quadrilaterals by gmsh.

gmsh is a library of the machine's processor and may hang or crash on a polygon; it runs in the
process of :mod:`~equisection.solvers.openfoam.mesh.outline_mesher`, which has a time limit.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from equisection.errors import SolverError
from equisection.solvers.openfoam.mesh.plane_cells import PlaneCells

Floats = NDArray[np.float64]

#: Size of the cells (chords) at a place.
Size = Callable[[float, float], float]
#: gmsh's numbers of what is used: frontal Delaunay for quadrilaterals, their making by Blossom.
_FRONTAL_QUADS, _BLOSSOM = 8, 1
#: Corners of its kinds of elements.
_CORNERS = {2: 3, 3: 4}
#: System libraries that its wheel needs, as Debian and Ubuntu name them.
LIBRARIES = "libglu1-mesa libxcursor1 libxft2 libxinerama1 libxrender1 libfontconfig1 libgomp1"


def filled(loops: Sequence[Floats], size: Size) -> PlaneCells:
    """Return cells between closed polygons; the polygons' points come first, in their order.

    Parameters
    ----------
    loops
        Points of the outer polygon, and of those inside it, each (n, 2) with an even n. Their edges
        are edges of the cells.
    size
        Size of the cells.

    Raises
    ------
    SolverError
        gmsh, or a library that it needs, is missing.
    """
    gmsh = loaded()
    gmsh.initialize(interruptible=False)
    try:
        for name, value in {
            "General.Terminal": 0,
            "General.NumThreads": 1,
            "Mesh.MeshSizeExtendFromBoundary": 0,
            "Mesh.MeshSizeFromPoints": 0,
            "Mesh.MeshSizeFromCurvature": 0,
            "Mesh.Algorithm": _FRONTAL_QUADS,
            "Mesh.RecombinationAlgorithm": _BLOSSOM,
            "Mesh.RandomSeed": 1,
            "Mesh.Smoothing": 5,
        }.items():
            gmsh.option.setNumber(name, value)
        tags = _draw(gmsh.model, loops)
        gmsh.model.mesh.setSizeCallback(lambda dim, tag, x, y, z, lc: size(x, y))
        gmsh.model.mesh.generate(2)
        return _cells(gmsh.model.mesh, tags)
    finally:
        gmsh.finalize()


def loaded() -> Any:
    """Return the module of gmsh.

    Raises
    ------
    SolverError
        It, or a library that it needs, is missing.
    """
    try:
        import gmsh  # noqa: PLC0415
    except ModuleNotFoundError:
        raise SolverError(
            "meshes of an outline need gmsh: make openfoam, or "
            "pip install -c envs/constraints.txt -e '.[openfoam]'"
        ) from None
    except (OSError, ImportError) as error:
        raise SolverError(
            f"gmsh does not load ({error}): make openfoam, or apt-get install {LIBRARIES}"
        ) from None
    return gmsh


def _draw(model: Any, loops: Sequence[Floats]) -> list[int]:
    """Draw the area; return the tags of the polygons' points."""
    tags: list[int] = []
    curves = []
    for loop in loops:
        points = [model.geo.addPoint(float(x), float(y), 0.0) for x, y in loop]
        lines = [
            model.geo.addLine(a, b) for a, b in zip(points, points[1:] + points[:1], strict=True)
        ]
        for line in lines:
            model.geo.mesh.setTransfiniteCurve(line, 2)
        tags += points
        curves.append(model.geo.addCurveLoop(lines))
    area = model.geo.addPlaneSurface(curves)
    model.geo.mesh.setRecombine(2, area)
    model.geo.synchronize()
    return tags


def _cells(mesh: Any, tags: list[int]) -> PlaneCells:
    nodes, places, _ = mesh.getNodes()
    of_loops = np.array([mesh.getNodes(0, tag)[0][0] for tag in tags], dtype=np.int64)
    order = np.concatenate([of_loops, np.setdiff1d(nodes.astype(np.int64), of_loops)])
    number = np.zeros(int(nodes.max()) + 1, dtype=np.int64)
    number[order] = np.arange(order.size)
    points = np.zeros((order.size, 2))
    points[number[nodes.astype(np.int64)]] = places.reshape(-1, 3)[:, :2]
    found = []
    for kind, _, corners in zip(*mesh.getElements(2), strict=True):
        cells = number[corners.astype(np.int64)].reshape(-1, _CORNERS[int(kind)])
        found.append(cells if cells.shape[1] == 4 else cells[:, [0, 1, 2, 2]])
    corners = np.concatenate(found)
    x, y = np.moveaxis(points[corners], -1, 0)
    area = (x * np.roll(y, -1, axis=1) - np.roll(x, -1, axis=1) * y).sum(axis=1)
    corners[area < 0] = corners[area < 0][:, ::-1]
    return PlaneCells(points, corners)
