"""The plate's mesh of 5e6 cells: made, checked and divided among 64 ranks, with time and memory.

python -m tests.benchmarks.divided
"""

from pathlib import Path

from equisection.solvers.openfoam.beam.rigid_beam import PlateFlow, plate_mesh_of
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.ranks import divide
from tests.benchmarks.measure import most_megabytes, processor_seconds
from tests.sample_cases import STEADY_PLATE


def used() -> str:
    """Return processor time and largest memory of the programs so far."""
    return f"{processor_seconds():.0f} s, {most_megabytes():.0f} MB"


if __name__ == "__main__":
    mesh = plate_mesh_of(STEADY_PLATE, PRESETS["finest"].plate)
    case = PlateFlow(find(), STEADY_PLATE, mesh, Coupling(), 1, Path("results/plate-mesh"))
    folder = case.set_up()
    print(mesh.cells, "cells", used())
    divide(find(), folder, 64, mesh.layers)
    print("divided", used())
