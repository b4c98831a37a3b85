"""Quality of the mesh that morphs, at a place of the section.

The mesh is moved there from rest without a flow, by OpenFOAM's own motion solver with the entries
of a run, and judged by ``checkMesh``.
"""

from __future__ import annotations

import math
import re
import shutil
from dataclasses import dataclass
from pathlib import Path

from equisection.beam.section import Section
from equisection.errors import SolverError
from equisection.files import write_text
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.case_folder import emptied
from equisection.solvers.openfoam.dictionaries import control, dictionary, write_system
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.process import run_program
from equisection.solvers.openfoam.section.body_axes import BodyAxes
from equisection.solvers.openfoam.section.section_motion import morphing, write_displacement

#: A section that goes on as it was started.
_COASTING = Section(
    torsional_stiffness=1e-12,
    flexural_stiffness=1e-12,
    inertia=2.0,
    mass=2.0,
    twist_recovery=1.0,
    deflection_recovery=1.0,
)


@dataclass(frozen=True)
class Quality:
    """Quality of a mesh that has moved, by ``checkMesh``.

    Attributes
    ----------
    deflection
        Deflection of the section (chords).
    non_orthogonality_deg
        Largest angle (deg) between a face's normal and the line between its cells' centres.
    faults
        Faults that it finds; empty for a sound mesh.
    """

    deflection: float
    non_orthogonality_deg: float
    faults: str


@dataclass(frozen=True)
class MorphingMesh:
    """The mesh of a case at rest, in its folder, and the height of the channel (chords)."""

    installation: Installation
    folder: Path
    channel_height: float

    def along(self, twist: float, deflection: float, steps: int, work: Path) -> list[Quality]:
        """Return the quality at a twist (rad) in even steps up to a deflection (chords).

        Raises
        ------
        SolverError
            A program failed, or did not write its output.
        """
        place = emptied(work)
        mesh = Path("constant") / "polyMesh"
        shutil.copytree(self.folder / mesh, place / mesh)
        # the deflection grows from 0 to its end in the time 1
        entries = {**control("pimpleFoam", 1.0, 1.0 / steps, 1.0 / steps), "purgeWrite": 0}
        entries["functions"] = {}
        write_system(place, entries, flow.schemes(steady=False), flow.unsteady_solution())
        moving = morphing(_COASTING, BodyAxes(0.0), self.channel_height)
        cosine, sine = math.cos(twist), math.sin(twist)
        moving["sixDoFRigidBodyMotionCoeffs"] |= {
            "test": True,  # no flow and no loads
            "velocity": (0, deflection, 0),
            "initialOrientation": (1, 0, 0, 0, 1, 0, 0, 0, 1),
            "orientation": (cosine, sine, 0, -sine, cosine, 0, 0, 0, 1),
        }
        write_text(place / "constant" / "dynamicMeshDict", dictionary("dynamicMeshDict", moving))
        write_displacement(place)
        run_program(self.installation, "moveDynamicMesh", place)
        run_program(
            self.installation, "checkMesh", place, arguments=("-noTopology", "-time", "1e-6:")
        )
        said = (place / "log.checkMesh").read_text(encoding="utf-8", errors="replace")
        parts = re.split(r"^Time = ", said, flags=re.MULTILINE)[1:]
        if len(parts) != steps:
            raise SolverError(f"{place}: {len(parts)} meshes are checked and {steps} were moved")
        return [_quality(part, deflection) for part in parts]


def _quality(said: str, end: float) -> Quality:
    angle = re.search(r"non-orthogonality Max: (\S+)", said)
    faults = [line.strip(" *") for line in said.splitlines() if "***" in line]
    return Quality(
        end * float(said.split(maxsplit=1)[0]),
        float(angle[1]) if angle else math.nan,
        "; ".join(faults),
    )
