"""Process that makes the mesh of a beam of any outline.

It is started by :class:`~equisection.solvers.openfoam.mesh.outline_beam_mesh.OutlineBeamMesh` with
the folder of the case, which holds its input.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import KDTree

from equisection.beam.outline import edge_lengths
from equisection.solvers.openfoam.mesh.beam_mesh import SIDE_WALLS
from equisection.solvers.openfoam.mesh.extruded_cells import Extrusion
from equisection.solvers.openfoam.mesh.gmsh_fill import filled
from equisection.solvers.openfoam.mesh.outline_beam_mesh import OutlineBeamMesh
from equisection.solvers.openfoam.mesh.outline_mesh import OutlineMesh
from equisection.solvers.openfoam.mesh.outline_mesher import (
    PATCHES,
    cells_of,
    make,
    patches_of,
    read_mesh,
)
from equisection.solvers.openfoam.mesh.outline_wall import wall_of
from equisection.solvers.openfoam.mesh.plane_cells import PlaneCells


def extrusion_of(mesh: OutlineBeamMesh) -> Extrusion:
    """Return the cells of a beam in its channel.

    Raises
    ------
    BlowUpError
        No layers fit around the outline.
    SolverError
        gmsh is missing.
    """
    around, levels = cells_of(mesh.section), mesh.levels()
    inside = with_inside(mesh.section, around) if mesh.gap else None
    return Extrusion(around, inside, levels, mesh.edges().size - 1)


def with_inside(mesh: OutlineMesh, around: PlaneCells) -> PlaneCells:
    """Return the cells around the body followed by those inside of it, on the same wall.

    Raises
    ------
    SolverError
        gmsh is missing.
    """
    # the first points of the cells around the body are those of its wall
    count = len(wall_of(np.array(mesh.outline), mesh.sizes, mesh.refinement).points)
    wall = around.points[:count]
    lengths = edge_lengths(wall)
    at_wall, tree = 0.5 * (lengths + np.roll(lengths, 1)), KDTree(wall)

    def size(x: float, y: float) -> float:
        way, nearest = tree.query((x, y), k=3)
        own = float(np.min(at_wall[nearest] + mesh.sizes.outward * way))
        return min(own, mesh.sizes.near / mesh.refinement)

    own = np.arange(count)
    return around.joined(filled([wall], size), own, own)


def write_mesh(found: dict[str, Any], folder: Path) -> int:
    """Write the mesh of an input into the folder of a case, and return its number of cells."""
    mesh = OutlineBeamMesh(
        read_mesh(found["section"]), found["span"], found["gap"], found["along_span"]
    )
    channel = mesh.section.channel
    return extrusion_of(mesh).write(
        folder, {**PATCHES, **SIDE_WALLS}, lambda a, b: patches_of(channel, a, b), "plate"
    )


if __name__ == "__main__":
    sys.exit(make(write_mesh))
