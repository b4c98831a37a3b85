"""Process that makes both meshes of an outline that moves above its channel.

It is started by
:class:`~equisection.solvers.openfoam.mesh.outline_overset_mesh.OutlineOversetMesh` with the folder
of the case, which holds its input.
"""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.solvers.openfoam.mesh.outline_mesh import OutlineMesh
from equisection.solvers.openfoam.mesh.outline_mesher import (
    PATCHES,
    disc_of,
    make,
    patches_of,
    read_mesh,
)
from equisection.solvers.openfoam.mesh.outline_overset_mesh import OutlineOversetMesh
from equisection.solvers.openfoam.mesh.overset_mesh import OVERSET
from equisection.solvers.openfoam.mesh.plane_cells import PlaneCells, write_layer

Floats = NDArray[np.float64]


def background_of(mesh: OutlineOversetMesh) -> PlaneCells:
    """Return the rectangular cells of the background."""
    x, y = mesh.background_lines()
    points = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    first = np.arange(x.size - 1) + x.size * np.arange(y.size - 1)[:, None]
    corners = first.reshape(-1, 1) + np.array([0, 1, x.size + 1, x.size])
    return PlaneCells(points, corners)


def write_meshes(section: OutlineMesh, folder: Path) -> int:
    """Write both meshes into the folder of a case, and return their number of cells."""
    disc, circle = disc_of(section)
    turned = disc.turned(-section.incidence)  # nose up is clockwise
    centre = turned.points[circle].mean(axis=0)
    chord = np.linalg.norm(turned.points[circle[1]] - turned.points[circle[0]])

    def patches(first: Floats, last: Floats) -> NDArray[np.str_]:
        found = patches_of(section.channel, first, last)
        away = np.hypot(*((first + last) / 2 - centre).T)
        is_outer = (found == "plate") & (away > section.disc_radius - chord)
        return np.where(is_outer, OVERSET, found)

    # the library wants the patch of the overlap first
    kinds = {OVERSET: OVERSET, **PATCHES}
    background = background_of(OutlineOversetMesh(section))
    return write_layer(folder, (background, turned), kinds, patches)


if __name__ == "__main__":
    sys.exit(make(lambda found, folder: write_meshes(read_mesh(found), folder)))
