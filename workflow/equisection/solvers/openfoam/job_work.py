"""Upper bound on the work of an OpenFOAM job: one case, to its last iteration and time step."""

from __future__ import annotations

from equisection.config import Config
from equisection.config.groups.openfoam_keys import MORPH
from equisection.solvers.openfoam.beam import rigid_beam as plate_rigid
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.rigid_flow import MOST, STEP
from equisection.solvers.openfoam.section import rigid_section as section_rigid
from equisection.solvers.work import Work

#: What a time step on overset meshes costs, with their cells, over one on the mesh that morphs.
OVERSET = 2.0
#: Iterations that a time step takes in the mean where more are allowed: its residuals end them.
ENOUGH = 4


def steady_work(config: Config, dimension: str, resolution: str, cases: int) -> Work:
    """Return the work of a rigid case: a steady flow, and an unsteady one if it has none."""
    longest = section_rigid.RECORD if dimension == "2d" else plate_rigid.RECORD
    steps = longest.end / STEP * iterations_of(config.openfoam.outer_correctors)
    return Work(cells_of(config.openfoam.meshes[resolution], dimension) * cases, MOST, steps)


def unsteady_work(config: Config, dimension: str, resolution: str, cases: int) -> Work:
    """Return the work of a free case: the steady flow that it starts from, and all of its steps."""
    section = config.openfoam
    steps = config.unsteady.duration / config.unsteady.time_step
    steps *= iterations_of(section.outer_correctors)
    if dimension == "2d" and section.mesh_motion != MORPH:
        steps *= OVERSET
    return Work(cells_of(section.meshes[resolution], dimension) * cases, MOST, steps)


def forced_work(config: Config, dimension: str, resolution: str, cases: int) -> Work:
    """Return the work of a case in prescribed motion, with the steady flow that it starts from."""
    section = config.openfoam
    steps = config.forced.longest / config.unsteady.time_step
    steps *= iterations_of(section.outer_correctors)
    return Work(cells_of(section.meshes[resolution], dimension) * cases, MOST, steps)


def iterations_of(outer_correctors: int) -> int:
    """Return the number of iterations that a time step is expected to take of those allowed."""
    return min(outer_correctors, ENOUGH)


def cells_of(mesh: str, dimension: str) -> int:
    """Return the number of cells of a mesh, of the section or of the plate."""
    preset = PRESETS[mesh]
    return preset.cells if dimension == "2d" else preset.plate_cells
