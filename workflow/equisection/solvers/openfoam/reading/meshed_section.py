"""The mesh that OpenFOAM made, read from its files, and the Courant number in its cells."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from foamlib import FoamFieldFile
from numpy.typing import NDArray

from equisection.cases import SteadyCase
from equisection.errors import SolverError
from equisection.results.section_mesh import SectionMesh
from equisection.solvers.openfoam.case_folder import states
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.poly_mesh import PolyMesh, read_poly_mesh
from equisection.solvers.openfoam.process import run_program
from equisection.solvers.openfoam.section.rigid_section import SectionCells, run_steady
from equisection.solvers.openfoam.stream_turbulence import STREAM, StreamTurbulence

#: What ``checkMesh`` says of the mesh, by our names.
_QUALITY = {
    "max_aspect_ratio": r"Max aspect ratio = ([\d.e+-]+)",
    "max_non_orthogonality_deg": r"non-orthogonality Max: ([\d.e+-]+)",
    "mean_non_orthogonality_deg": r"non-orthogonality Max: .* average: ([\d.e+-]+)",
    "max_skewness": r"Max skewness = ([\d.e+-]+)",
}

#: Distance within which points are in one plane (chords).
SAME_PLANE = 1e-6

Floats = NDArray[np.float64]


def section_mesh(
    installation: Installation,
    case: SteadyCase,
    mesh: SectionCells,
    time_step: float,
    work: Path,
    *,
    turbulence: StreamTurbulence = STREAM,
) -> SectionMesh:
    """Return the mesh of a case, and the Courant number of its steady flow at a time step (c/V).

    ``CourantNo`` of OpenFOAM is 0.5 sum |phi| dt/V over the faces of a cell; the steady run's dt
    is 1.

    Raises
    ------
    SolverError
        A program failed, or the mesh is not sound.
    """
    folder, loads, converged = run_steady(
        installation, case, mesh, work, _nothing, turbulence=turbulence
    )
    run_program(
        installation, "postProcess", folder, arguments=("-func", "CourantNo", "-latestTime")
    )
    points, corners = read_cells(folder)
    courant = np.asarray(FoamFieldFile(states(folder)[-1] / "Co").internal_field, dtype=float)
    how = "converged" if converged else "not converged"
    return SectionMesh(
        points=points,
        corners=corners,
        courant=time_step * courant,
        time_step=time_step,
        incidence_deg=case.incidence_deg,
        flow=f"rigid, steady, {how} after {loads.time.size} iterations",
        quality=quality(folder / "log.checkMesh"),
    )


def _nothing(done: float, total: float) -> None:
    del done, total


def quality(log: Path) -> dict[str, float]:
    """Return the numbers that ``checkMesh`` gives.

    Raises
    ------
    SolverError
        One of them is not in its log.
    """
    said = log.read_text(encoding="utf-8", errors="replace")
    found = {name: re.search(pattern, said) for name, pattern in _QUALITY.items()}
    missing = [name for name, match in found.items() if match is None]
    if missing:
        raise SolverError(f"{log}: no {', '.join(missing)} in it; is this checkMesh's log?")
    return {name: float(match[1]) for name, match in found.items() if match}


def read_cells(folder: Path) -> tuple[Floats, NDArray[np.int64]]:
    """Return points (n, 2) and corners of the cells (m, 4) of the layer of lowest z.

    A cell has one face in the plane that bounds the mesh there, which shows the cell. The last two
    corners of a triangle are one.
    """
    return cells_of_first_layer(read_poly_mesh(folder))


def cells_of_first_layer(mesh: PolyMesh) -> tuple[Floats, NDArray[np.int64]]:
    """Return points and cells of :func:`read_cells`, from a mesh that was read."""
    z = mesh.points[:, 2]
    low = z < z.min() + SAME_PLANE
    shown = np.flatnonzero(low[mesh.faces].all(axis=1))
    corners = mesh.faces[shown][np.argsort(mesh.owner[shown])]
    numbers = np.cumsum(low) - 1
    return mesh.points[low, :2], numbers[corners]
