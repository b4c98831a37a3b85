"""Upper bound on the work of an OpenFOAM job: one case, to its last iteration and time step."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from equisection.beam.beam import Beam
from equisection.beam.outline import outline_of, rectangle
from equisection.config import Config
from equisection.config.groups.openfoam_keys import BLOCKS, MORPH
from equisection.solvers.openfoam.beam import rigid_beam as plate_rigid
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox
from equisection.solvers.openfoam.mesh.outline_beam_mesh import OF_BEAM, OutlineBeamMesh
from equisection.solvers.openfoam.mesh.outline_mesh import OutlineMesh
from equisection.solvers.openfoam.mesh.outline_sizes import TYPICAL_CELLS
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.rigid_flow import MOST, STEP, TURNS
from equisection.solvers.openfoam.section import rigid_section as section_rigid
from equisection.solvers.work import Work

#: What a time step on overset meshes costs, with their cells, over one on the mesh that morphs.
OVERSET = 2.0
#: What a cell around an outline costs in an iteration or a step, over one of the mesh of blocks.
OUTLINE = 2.0
#: Iterations that a time step takes in the mean where more are allowed: its residuals end them.
ENOUGH = 4


def steady_work(config: Config, dimension: str, resolution: str, cases: int) -> Work:
    """Return the work of a rigid case: a steady flow, and an unsteady one if it has none.

    Around an outline that goes on once more where its vortices set in late.
    """
    longest = section_rigid.RECORD if dimension == "2d" else plate_rigid.RECORD
    steps = longest.end / STEP * iterations_of(config.openfoam.outer_correctors)
    steps *= 1 if _is_on_blocks(config) else TURNS
    return _work(config, dimension, resolution, cases, steps)


def unsteady_work(config: Config, dimension: str, resolution: str, cases: int) -> Work:
    """Return the work of a free case: the steady flow that it starts from, and all of its steps."""
    section = config.openfoam
    steps = config.unsteady.duration / config.unsteady.time_step
    steps *= iterations_of(section.outer_correctors)
    if dimension == "2d" and section.mesh_motion != MORPH:
        steps *= OVERSET
    return _work(config, dimension, resolution, cases, steps)


def forced_work(config: Config, dimension: str, resolution: str, cases: int) -> Work:
    """Return the work of a case in prescribed motion, with the steady flow that it starts from."""
    section = config.openfoam
    steps = config.forced.longest / config.unsteady.time_step
    steps *= iterations_of(section.outer_correctors)
    return _work(config, dimension, resolution, cases, steps)


def _work(config: Config, dimension: str, resolution: str, cases: int, steps: float) -> Work:
    times = 1.0 if _is_on_blocks(config) else OUTLINE
    cells = cells_of_job(config, dimension, resolution) * cases
    return Work(cells, MOST * times, steps * times)


def _is_on_blocks(config: Config) -> bool:
    return config.beam.outline is None and config.openfoam.mesher == BLOCKS


def iterations_of(outer_correctors: int) -> int:
    """Return the number of iterations that a time step is expected to take of those allowed."""
    return min(outer_correctors, ENOUGH)


def cells_of_job(config: Config, dimension: str, resolution: str) -> int:
    """Return the number of cells of the mesh; around an outline roughly, around a beam at most."""
    mesh = config.openfoam.meshes[resolution]
    if _is_on_blocks(config):
        return cells_of(mesh, dimension)
    if dimension == "2d":
        return PRESETS[mesh].outline_cells
    channel, far_field = config.flow.channel, config.openfoam.far_field_chords
    gap = far_field if channel is None else channel.tip_gap_chords
    refinement, along_span = PRESETS[mesh].plate, PRESETS[mesh].plate_spacing.along_span
    layers, along = _layers(config.beam, Path.cwd(), refinement, gap, along_span)
    # beyond the tip the outline is filled, by no more cells than there are around it
    return round(TYPICAL_CELLS * refinement**2 * (2 * layers - along))


@cache  # each job of a run asks for it
def _layers(
    beam: Beam, directory: Path, refinement: float, gap: float, along_span: float
) -> tuple[int, int]:
    """Return the layers of cells from wall to wall, and those along the beam."""
    thickness = beam.thickness / beam.chord
    outline = beam.outline_in_flow(directory) or outline_of(rectangle(thickness))
    # layers go by the cells at the wall, whatever box is around them
    box = ChannelBox(thickness, 1.0, 1.0, 1.0)
    section = OutlineMesh(outline.as_pairs(), box, 0.0, refinement, OF_BEAM)
    mesh = OutlineBeamMesh(section, beam.length / beam.chord, gap, along_span)
    return mesh.layers, mesh.edges().size - 1


def cells_of(mesh: str, dimension: str) -> int:
    """Return the number of cells of a mesh of blocks, of the section or of the plate."""
    preset = PRESETS[mesh]
    return preset.cells if dimension == "2d" else preset.plate_cells
