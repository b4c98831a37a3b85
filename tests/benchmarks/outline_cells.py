"""Cells of a beam of NACA 0012 on its coarse mesh, in the channel and in free air.

python -m tests.benchmarks.outline_cells
"""

from equisection.solvers.openfoam.beam.rigid_beam import outline_beam_mesh_of
from equisection.solvers.openfoam.mesh.outline_beam_mesher import extrusion_of
from equisection.solvers.openfoam.mesh.presets import PRESETS
from tests.openfoam.test_outline_beam import case_of

if __name__ == "__main__":
    case = case_of("naca 0012", 0.0)
    nothing_around = case.geometry.model_copy(update={"channel_height": None})
    free = case.model_copy(update={"geometry": nothing_around})
    for where, one, far in (("channel", case, 0.0), ("free air, 30 c", free, 30.0)):
        mesh = outline_beam_mesh_of(one, PRESETS["coarse"].plate, far)
        print(where, extrusion_of(mesh).cells)
