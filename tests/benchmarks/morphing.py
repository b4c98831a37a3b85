"""How far the mesh that morphs can follow the free section before its cells turn over.

    python -m tests.benchmarks.morphing [twist in deg ...]

The mesh of the preset `coarse` at 2.5 deg goes upwards at a constant twist. For each twist: the
first deflection (chords) at which a face is more than 70 deg off the line between its cells, and
the first at which `checkMesh` finds a fault, and which.
"""

import argparse
import math
import tempfile
from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.dictionaries import (
    control,
    write_mesh_dictionary,
    write_system,
)
from equisection.solvers.openfoam.installation import Installation, find
from equisection.solvers.openfoam.mesh.mesh_quality import MorphingMesh
from equisection.solvers.openfoam.section.rigid_section import make_mesh, mesh_of
from tests.sample_cases import STEADY

TWIST_DEG = (-20.0, -8.0, 0.0, 8.0, 20.0, 30.0)
#: Largest deflection (chords), and the steps to it.
REACH, STEPS = 1.0, 50


def mesh_at_rest(installation: Installation, folder: Path, refinement: float = 1.0) -> MorphingMesh:
    """Make the mesh of the sample case."""
    mesh = mesh_of(STEADY, refinement)
    write_mesh_dictionary(folder, mesh)
    entries = control("pimpleFoam", 1.0, 1.0, 1.0)
    write_system(folder, entries, flow.schemes(steady=False), flow.unsteady_solution())
    make_mesh(installation, folder)
    return MorphingMesh(installation, folder, mesh.channel.height)


def table(twists_deg: Sequence[float], work: Path) -> pd.DataFrame:
    """Return how far the mesh is sound at each twist."""
    mesh = mesh_at_rest(find(), work / "rest")
    rows = []
    for twist_deg in twists_deg:
        found = mesh.along(math.radians(twist_deg), REACH, STEPS, work / "moved")
        oblique = [at.deflection for at in found if not at.non_orthogonality_deg <= 70.0]
        faulty = [at for at in found if at.faults]
        rows.append(
            {
                "twist_deg": twist_deg,
                "beyond_70_deg": min(oblique, default=math.nan),
                "faulty": faulty[0].deflection if faulty else math.nan,
                "fault": faulty[0].faults.split(".")[0] if faulty else "",
            }
        )
    return pd.DataFrame(rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.morphing")
    parser.add_argument("twist", nargs="*", type=float, default=TWIST_DEG, help="deg, nose up")
    with tempfile.TemporaryDirectory() as place:
        print(table(parser.parse_args().twist, Path(place)).to_string(index=False))
