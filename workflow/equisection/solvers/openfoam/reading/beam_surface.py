"""Pressure, friction and wall distance over the plate, from the fields of all ranks of a run."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from foamlib import FoamFieldFile
from numpy.typing import NDArray

from equisection.results.plate_surface import ALONG, NORMALS, SPANWISE, PlateSurface, joined
from equisection.solvers.openfoam.case_folder import states
from equisection.solvers.openfoam.dictionaries import PLATE
from equisection.solvers.openfoam.mesh.poly_mesh import PolyMesh, read_poly_mesh
from equisection.solvers.openfoam.ranks import parts
from equisection.solvers.openfoam.reading.section_surface import on_plate, to_section

Floats = NDArray[np.float64]


def plate_surface(folder: Path, incidence: float, *, mean: bool = False) -> PlateSurface:
    """Return the surface data of the last state of a run, divided or not.

    Parameters
    ----------
    folder
        The case, with ``wallShearStress`` and ``yPlus`` in its last state.
    incidence
        Incidence (rad), by which the mesh is turned.
    mean
        True reads the means over time.
    """
    suffix = "Mean" if mean else ""
    meshes = {part: read_poly_mesh(part) for part in parts(folder)}
    pieces = [
        _of_rank(mesh, states(part)[-1], incidence, suffix)
        for part, mesh in meshes.items()
        if mesh.patches[PLATE].start < mesh.patches[PLATE].stop
    ]
    return joined(pieces)


def _of_rank(mesh: PolyMesh, state: Path, incidence: float, suffix: str) -> PlateSurface:
    faces = mesh.patches[PLATE]
    corners = _in_plate(mesh.points[mesh.faces[faces]], incidence)
    # boundary faces point out of the flow, so into the plate
    outward = -0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    side = np.array(list(NORMALS))[(outward @ np.array(list(NORMALS.values())).T).argmax(axis=1)]
    x, y, z = corners.mean(axis=1).T
    # the pressure at the wall is that of the cell, as in the loads (zero gradient)
    pressure = np.asarray(FoamFieldFile(state / f"p{suffix}").internal_field)[mesh.owner[faces]]
    # wallShearStress is what the wall does to the flow; its negative acts on the wall
    friction = -2.0 * _in_plate(on_plate(state / f"wallShearStress{suffix}"), incidence)
    return PlateSurface(
        x=x + 0.5,
        y=y,
        z=z,
        area=np.linalg.norm(outward, axis=1),
        side=side,
        pressure=2.0 * pressure,
        friction=(friction * np.array([ALONG[name] for name in side])).sum(axis=1),
        spanwise_friction=(friction * np.array([SPANWISE[name] for name in side])).sum(axis=1),
        y_plus=on_plate(state / f"yPlus{suffix}"),
    )


def _in_plate(vectors: Floats, incidence: float) -> Floats:
    """Turn vectors of the flow's frame, shape (..., 3), into that of the plate."""
    return np.concatenate([to_section(vectors[..., :2], incidence), vectors[..., 2:]], axis=-1)
