"""Meshes of beams of any outline on the presets: are they sound, and what do they take.

    python -m tests.benchmarks outline-beams

A wing, 6 c of NACA 0012 with a free tip, and a bay of a bridge, 6 c of an H section from wall to
wall. Processor seconds and memory are those of the mesher and of ``checkMesh``, the largest of
either; no flow is run. Beside them is the memory that a job of that mesh asks for.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

from equisection.errors import EquisectionError
from equisection.run.cost import megabytes, read_cost_model
from equisection.solvers.openfoam.beam.rigid_beam import outline_beam_mesh_of
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.reading.meshed_section import quality
from equisection.solvers.work import Work
from tests.benchmarks.measure import Row, most_megabytes, processor_seconds
from tests.benchmarks.outlines import checked
from tests.sample_cases import GEOMETRY, STEADY_PLATE
from tests.sample_outlines import SHAPES
from tests.workflow.project import ROOT

#: Outline, span and gap beyond the tip (chords).
BEAMS = {"wing": ("naca 0012", 6.0, 1.0), "bridge": ("h", 6.0, 0.0)}
MESHES = ("coarse", "medium", "fine")
INCIDENCE_DEG = 2.0


def rows(meshes: tuple[str, ...] = MESHES) -> Iterator[Row]:
    """Yield what each mesh is and takes, in a process of its own, whose memory is to be seen."""
    for mesh in meshes:
        for beam in BEAMS:
            command = [sys.executable, "-m", __name__, beam, mesh]
            said = subprocess.run(command, capture_output=True, text=True, check=False)
            last = (said.stdout.strip().splitlines() or [said.stderr.strip()[-200:]])[-1]
            sound = last.startswith("sound")
            yield Row(f"{beam}, {mesh}", last, "sound", sound)


def made(beam: str, mesh: str) -> str:
    """Make a mesh, have it checked, and say what it is and takes."""
    outline, span, gap = BEAMS[beam]
    geometry = GEOMETRY.model_copy(
        update={"outline": SHAPES[outline].as_pairs(), "span": span, "tip_gap": gap or None}
    )
    case = STEADY_PLATE.model_copy(update={"incidence_deg": INCIDENCE_DEG, "geometry": geometry})
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        try:
            outline_beam_mesh_of(case, PRESETS[mesh].plate).write(folder)
            of_mesher = processor_seconds()
            cells = checked(find(), folder)
        except EquisectionError as error:
            return str(error)
        oblique = quality(folder / "log.checkMesh")["max_non_orthogonality_deg"]
    costs = read_cost_model(ROOT / "workflow/profiles/cost.yaml").of("openfoam", "3d")
    asked = megabytes(Work(cells), costs, 1)
    return (
        f"sound, {cells:,} cells, {oblique:.0f} deg oblique at most; {of_mesher:.0f} processor "
        f"s, {processor_seconds():.0f} with the check; {most_megabytes():.0f} MB of the {asked} "
        "that a job asks for"
    )


if __name__ == "__main__":
    print(made(*sys.argv[1:]))
