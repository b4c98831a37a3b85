"""Pressure, friction and wall distance on the plate, from the fields of a rigid run."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
from foamlib import FoamFieldFile
from numpy.typing import NDArray

from equisection.results.surface import TANGENTS, SectionSurface
from equisection.solvers.openfoam.case_folder import states
from equisection.solvers.openfoam.dictionaries import PLATE
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.block_mesh import Mesh
from equisection.solvers.openfoam.mesh.outline_mesh import OutlineMesh
from equisection.solvers.openfoam.mesh.poly_mesh import PolyMesh, read_poly_mesh
from equisection.solvers.openfoam.process import run_program
from equisection.solvers.openfoam.reading.contour_places import ends_of

Floats = NDArray[np.float64]

_AT_WALL = ("wallShearStress", "yPlus")


def surface_of_steady(
    installation: Installation, folder: Path, mesh: Mesh | OutlineMesh
) -> SectionSurface:
    """Return the surface data of the last state of a steady run.

    Raises
    ------
    SolverError
        The program that makes them failed.
    """
    write_wall_fields(installation, folder)
    return _read(folder, mesh, "")


def write_wall_fields(installation: Installation, folder: Path, ranks: int = 1) -> None:
    """Run the program that writes shear stress and y+ at the wall into a steady run's last state.

    Raises
    ------
    SolverError
        The program failed.
    """
    functions = ("-postProcess", "-latestTime", "-funcs", "(wallShearStress yPlus)")
    run_program(installation, "simpleFoam", folder, arguments=functions, ranks=ranks)


def averaging(start: float, every: int, fields: Sequence[str] = ("p",)) -> dict[str, Any]:
    """Return the function objects that average the flow at the wall, and further fields.

    Parameters
    ----------
    start
        Time of the first sample (c/V).
    every
        Time steps from one sample to the next.
    fields
        Fields of the flow that are averaged too.
    """
    common = {
        "libs": ['"libfieldFunctionObjects.so"'],
        "timeStart": start,
        "executeControl": "timeStep",
        "executeInterval": every,
        "log": False,
    }
    averaged = " ".join(
        f"{name} {{ mean on; prime2Mean off; base time; }}" for name in (*fields, *_AT_WALL)
    )
    at_wall = {name: {"type": name, **common, "writeControl": "none"} for name in _AT_WALL}
    mean = {
        "type": "fieldAverage",
        **common,
        "writeControl": "writeTime",
        "fields": f"({averaged})",
    }
    return {**at_wall, "means": mean}


def surface_of_mean(folder: Path, mesh: Mesh | OutlineMesh) -> SectionSurface:
    """Return the surface data of the means of an unsteady run."""
    return _read(folder, mesh, "Mean")


def _read(folder: Path, mesh: Mesh | OutlineMesh, suffix: str) -> SectionSurface:
    """Return the surface data from the fields of the last state.

    ``wallShearStress`` is what the wall does to the flow; its negative acts on the wall. The
    pressure at the wall is that of the cell, as in the loads (zero gradient).
    """
    poly, state = read_poly_mesh(folder), states(folder)[-1]
    faces = poly.patches[PLATE]
    pressure = np.asarray(FoamFieldFile(state / f"p{suffix}").internal_field)[poly.owner[faces]]
    friction = -on_plate(state / f"wallShearStress{suffix}")[:, :2]
    if isinstance(mesh, OutlineMesh):
        return _of_outline(
            poly, mesh.incidence, pressure, friction, on_plate(state / f"yPlus{suffix}")
        )
    x, y, length, side = _contour(poly, faces, mesh.incidence)
    tangent = _to_flow(np.array([TANGENTS[name] for name in side]), mesh.incidence)
    order = np.lexsort((y, x, side))
    return SectionSurface(
        x=x[order],
        y=y[order],
        length=length[order],
        side=side[order],
        pressure=2.0 * pressure[order],
        friction=2.0 * (friction * tangent).sum(axis=1)[order],
        y_plus=on_plate(state / f"yPlus{suffix}")[order],
    )


def _of_outline(
    poly: PolyMesh, incidence: float, pressure: Floats, friction: Floats, y_plus: Floats
) -> SectionSurface:
    """Return the surface data of the patch in the order of each side, from nose to tail."""
    order, side, first, last = contour_of_outline(poly, incidence)
    edge = last - first
    length = np.hypot(*edge.T)
    middle = (first + last) / 2
    surface = SectionSurface(
        x=middle[:, 0] + 0.5,
        y=middle[:, 1],
        length=length,
        side=side,
        pressure=2.0 * pressure[order],
        friction=np.zeros(len(order)),
        y_plus=y_plus[order],
        normal_x=edge[:, 1] / length,
        normal_y=-edge[:, 0] / length,
    )
    tangent = _to_flow(surface.normals_and_tangents()[1], incidence)
    return replace(surface, friction=2.0 * (friction[order] * tangent).sum(axis=1))


def contour_of_outline(
    poly: PolyMesh, incidence: float
) -> tuple[NDArray[np.int64], NDArray[np.str_], Floats, Floats]:
    """Return the faces of the section's patch along its contour, in the frame of the section.

    Returns
    -------
    tuple
        Numbers of the faces in the patch, and side of each, the upper one first and each from the
        foremost to the rearmost point; and both ends of each (n, 2), counter-clockwise about the
        body.
    """
    corners = poly.faces[poly.patches[PLATE]]
    z = poly.points[corners][:, :, 2]
    # the two corners of a face in the lower plane, the later one first: the patch's faces are
    # passed with the flow on their left, the body is to be
    low = corners[z < z.min() + 1e-9].reshape(-1, 2)
    places = to_section(poly.points[:, :2], incidence)
    behind = dict(zip(low[:, 1].tolist(), range(len(low)), strict=True))
    nodes = low[:, 0]
    nose, tail = (int(nodes[end]) for end in ends_of(places[nodes]))
    loop, node, turn = [], tail, 0
    for _ in range(len(low)):
        face = behind[node]
        loop.append(face)
        node = int(low[face, 0])
        turn = len(loop) if node == nose else turn
    order = np.array([*loop[:turn][::-1], *loop[turn:]])
    side = np.where(np.arange(len(order)) < turn, "upper", "lower")
    return order, side, places[low[order, 1]], places[low[order, 0]]


def on_plate(path: Path) -> Floats:
    """Return the values of a field on the plate's faces, shape (n,) or (n, 3)."""
    patch: Any = FoamFieldFile(path).boundary_field[PLATE]
    return np.asarray(patch.value, dtype=float)


def _contour(
    poly: PolyMesh, faces: slice, incidence: float
) -> tuple[Floats, Floats, Floats, NDArray[np.str_]]:
    """Return x, y and length of faces in the frame of the section, and the side of each."""
    in_flow = poly.points[poly.faces[faces], :2]
    # of the four corners of a face two and two stand behind each other
    low, high = in_flow.min(axis=1), in_flow.max(axis=1)
    length = np.hypot(*(high - low).T)
    middle = to_section(in_flow.mean(axis=1), incidence)
    lengthwise = np.ptp(to_section(in_flow, incidence), axis=1)
    is_edge = lengthwise[:, 0] < lengthwise[:, 1]
    side = np.where(
        is_edge,
        np.where(middle[:, 0] < 0, "leading edge", "trailing edge"),
        np.where(middle[:, 1] < 0, "lower", "upper"),
    )
    return middle[:, 0] + 0.5, middle[:, 1], length, side


def to_section(vectors: Floats, incidence: float) -> Floats:
    """Turn vectors of the flow's frame, shape (..., 2), into that of the section."""
    cosine, sine = math.cos(incidence), math.sin(incidence)
    return np.asarray(vectors @ np.array([[cosine, sine], [-sine, cosine]]))


def _to_flow(vectors: Floats, incidence: float) -> Floats:
    return to_section(vectors, -incidence)
