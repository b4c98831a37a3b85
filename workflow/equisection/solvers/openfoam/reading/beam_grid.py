"""The mesh of the plate that OpenFOAM made, read from its files."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from equisection.results.plate_grid import PlateGrid
from equisection.solvers.openfoam.beam.rigid_beam import PlateFlow
from equisection.solvers.openfoam.mesh.poly_mesh import read_poly_mesh
from equisection.solvers.openfoam.reading.meshed_section import (
    SAME_PLANE,
    cells_of_first_layer,
    quality,
)

Floats = NDArray[np.float64]


def plate_grid(plate: PlateFlow) -> PlateGrid:
    """Make the mesh of a rigid plate, and return it; no flow is computed.

    Raises
    ------
    SolverError
        A program failed, or the mesh is not sound.
    """
    folder = plate.set_up()
    mesh = read_poly_mesh(folder)
    points, corners = cells_of_first_layer(mesh)
    return PlateGrid(
        points=points,
        corners=corners,
        levels=_levels(mesh.points[:, 2]),
        span=plate.mesh.span,
        thickness=plate.mesh.section.channel.thickness,
        incidence_deg=plate.case.incidence_deg,
        cells=int(mesh.owner.max()) + 1,
        quality=quality(folder / "log.checkMesh"),
    )


def _levels(z: Floats) -> Floats:
    """Return the planes that the points stand in."""
    sorted_z = np.sort(z)
    return np.asarray(sorted_z[np.append(True, np.diff(sorted_z) > SAME_PLANE)])
