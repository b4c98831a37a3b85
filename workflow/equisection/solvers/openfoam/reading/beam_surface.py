"""Pressure, friction and wall distance over the plate, from the fields of all ranks of a run."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from foamlib import FoamFieldFile
from numpy.typing import NDArray

from equisection.results.plate_surface import NORMALS, PlateSurface, joined
from equisection.solvers.openfoam.case_folder import states
from equisection.solvers.openfoam.dictionaries import PLATE
from equisection.solvers.openfoam.mesh.block_mesh import Mesh
from equisection.solvers.openfoam.mesh.outline_mesh import OutlineMesh
from equisection.solvers.openfoam.mesh.poly_mesh import PolyMesh, read_poly_mesh
from equisection.solvers.openfoam.ranks import parts
from equisection.solvers.openfoam.reading.contour_places import Contour
from equisection.solvers.openfoam.reading.section_surface import on_plate, to_section

Floats = NDArray[np.float64]


def plate_surface(folder: Path, section: Mesh | OutlineMesh, *, mean: bool = False) -> PlateSurface:
    """Return the surface data of the last state of a run, divided or not.

    Parameters
    ----------
    folder
        The case, with ``wallShearStress`` and ``yPlus`` in its last state.
    section
        Mesh of the section, turned by its incidence.
    mean
        True reads the means over time.
    """
    suffix = "Mean" if mean else ""
    meshes = {part: read_poly_mesh(part) for part in parts(folder)}
    pieces = [
        _of_rank(mesh, states(part)[-1], section, suffix)
        for part, mesh in meshes.items()
        if mesh.patches[PLATE].start < mesh.patches[PLATE].stop
    ]
    return joined(pieces)


def _of_rank(mesh: PolyMesh, state: Path, section: Mesh | OutlineMesh, suffix: str) -> PlateSurface:
    faces, incidence = mesh.patches[PLATE], section.incidence
    corners = _in_plate(mesh.points[mesh.faces[faces]], incidence)
    # boundary faces point out of the flow, so into the plate
    outward = -0.5 * np.cross(corners[:, 2] - corners[:, 0], corners[:, 3] - corners[:, 1])
    area = np.linalg.norm(outward, axis=1)
    x, y, z = corners.mean(axis=1).T
    side, along_contour = _sides(section, np.stack([x, y], axis=-1), outward / area[:, None])
    # the pressure at the wall is that of the cell, as in the loads (zero gradient)
    pressure = np.asarray(FoamFieldFile(state / f"p{suffix}").internal_field)[mesh.owner[faces]]
    # wallShearStress is what the wall does to the flow; its negative acts on the wall
    friction = -2.0 * _in_plate(on_plate(state / f"wallShearStress{suffix}"), incidence)
    surface = PlateSurface(
        x=x + 0.5,
        y=y,
        z=z,
        area=area,
        side=side,
        pressure=2.0 * pressure,
        friction=np.zeros_like(x),
        spanwise_friction=np.zeros_like(x),
        y_plus=on_plate(state / f"yPlus{suffix}"),
        **along_contour,
    )
    _, along, spanwise = surface.directions()
    return replace(
        surface,
        friction=(friction * along).sum(axis=1),
        spanwise_friction=(friction * spanwise).sum(axis=1),
    )


def _sides(
    section: Mesh | OutlineMesh, middles: Floats, normals: Floats
) -> tuple[NDArray[np.str_], dict[str, Floats]]:
    """Return the side of each face; of an outline, its normal and its place along the contour."""
    if isinstance(section, Mesh):
        every = np.array(list(NORMALS.values()))
        return np.array(list(NORMALS))[(normals @ every.T).argmax(axis=1)], {}
    is_tip = normals[:, 2] > np.hypot(normals[:, 0], normals[:, 1])
    side = np.full(len(normals), "upper")
    arc, across = middles[:, 0] + 0.5, np.zeros((len(normals), 2))
    across[~is_tip] = normals[~is_tip, :2]
    contour = Contour.of(np.array(section.outline))
    side[~is_tip], arc[~is_tip] = contour.place(middles[~is_tip], across[~is_tip])
    side[is_tip] = "tip"
    return side, {"normal_x": across[:, 0], "normal_y": across[:, 1], "arc": arc}


def _in_plate(vectors: Floats, incidence: float) -> Floats:
    """Turn vectors of the flow's frame, shape (..., 3), into that of the plate."""
    return np.concatenate([to_section(vectors[..., :2], incidence), vectors[..., 2:]], axis=-1)
