"""The free section on two meshes, of which the one around the plate moves with it as it is.

The rigid steady flow is made on the same two meshes, so that the release has no jump: with
``overSimpleFoam``, which knows SIMPLE but not SIMPLEC.

The free run is ``pimpleFoam`` with the mesh of the overset library, and not ``overPimpleDyMFoam``:
the latter (v1912) moves the mesh once in a time step, before its iterations, whatever
``moveMeshOuterCorrectors`` says. Loads and springs are then those of the step before, and a lag of
one step dt in a spring makes an oscillation grow at the rate omega^2 dt/2, for k* = 10 at 0.02 c/V
at more than twice the rate at which the air damps it. What ``overPimpleDyMFoam`` does beyond
``pimpleFoam`` is to blank the fields in the hole, where the plate is; those values reach no cell
outside of it but through the gradients of the cells next to it.

The function object of the motion does not know this kind of mesh; the motion is read from the log.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from equisection.errors import SolverError
from equisection.files import write_text
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.case_folder import emptied
from equisection.solvers.openfoam.dictionaries import control, dictionary, write_system
from equisection.solvers.openfoam.free_run import STATE_INTERVAL
from equisection.solvers.openfoam.mesh.outline_mesh import OutlineMesh
from equisection.solvers.openfoam.mesh.outline_overset_mesh import OutlineOversetMesh
from equisection.solvers.openfoam.mesh.overset_mesh import OVERSET, OversetMesh
from equisection.solvers.openfoam.reading.loads import Loads
from equisection.solvers.openfoam.rigid_flow import (
    MOST,
    Tell,
    has_converged,
    has_converged_around_outline,
)
from equisection.solvers.openfoam.section.free_section import SectionRun
from equisection.solvers.openfoam.section.rigid_section import check_mesh, iterate, make_mesh
from equisection.solvers.openfoam.section.section_history import SectionHistory, read_section
from equisection.solvers.openfoam.section.section_motion import (
    BodyMotion,
    rigid_body,
    write_displacement,
)

#: Meshes that lie above each other, around the plate or around any outline.
OverlappingMeshes = OversetMesh | OutlineOversetMesh
Floats = NDArray[np.float64]

#: Edge of the boxes in which the library looks for the other mesh (chords): those that the plate
#: touches are its hole.
_BOX = 0.1
#: What is beyond the plate's mesh has no distance from it, and stands still.
_EVERYWHERE = 1e3
#: The library has no GAMG for meshes that overlap: its agglomeration ends with a fault.
_PRESSURE = {"solver": "PBiCGStab", "preconditioner": "DILU", "tolerance": 1e-7, "maxIter": 500}
_LINE = re.compile(
    rb"^Time = (?P<time>\S+)"
    rb"|^\s*Centre of rotation: \(\S+ (?P<height>\S+) \S+\)"
    rb"|^\s*Orientation: \((?P<cosine>\S+) (?P<sine>\S+) ",
    re.MULTILINE,
)


@dataclass(frozen=True)
class OversetRun(SectionRun):
    """The run of one case on the meshes that lie above each other."""

    @property
    def meshes(self) -> OverlappingMeshes:
        """Both meshes, as fine as the one that morphs."""
        mesh = self.mesh
        if isinstance(mesh, OutlineMesh):
            return OutlineOversetMesh(mesh)
        return OversetMesh(mesh.channel, mesh.incidence, mesh.refinement)

    def steady(self, tell: Tell) -> tuple[Path, Loads, bool]:
        """Run the steady solver on the same meshes."""
        folder = emptied(self.work / "steady")
        meshes, case = self.meshes, self.case
        ends = {**flow.IN_THE_PLANE, OVERSET: OVERSET}
        reynolds = flow.reynolds_number(case.geometry, case.medium)
        flow.write_flow(folder, reynolds, ends, self.turbulence)
        at_rest = {"dynamicFvMesh": "dynamicOversetFvMesh", "solvers": {}}
        write_text(folder / "constant" / "dynamicMeshDict", dictionary("dynamicMeshDict", at_rest))
        entries = control("simpleFoam", MOST, 1, MOST)
        entries |= {"application": "overSimpleFoam", "libs": ['"liboverset.so"']}
        solution = flow.steady_solution()
        solution["solvers"]["p"] = {**_PRESSURE, "relTol": 0.02}
        solution["SIMPLE"] = {"nNonOrthogonalCorrectors": 0}
        solution["relaxationFactors"] = {
            "fields": {"p": 0.3},
            "equations": {"U": 0.7, "k": 0.7, "omega": 0.7},
        }
        write_system(folder, entries, _overlapping(flow.schemes(steady=True), meshes), solution)
        is_converged = has_converged
        if isinstance(meshes, OutlineOversetMesh):
            cells = meshes.write(folder)
            check_mesh(self.installation, folder)
            is_converged = has_converged_around_outline
        else:
            write_text(folder / "system" / "blockMeshDict", meshes.block_mesh_dict())
            make_mesh(self.installation, folder)
            cells = meshes.cells
        write_text(folder / "0" / "zoneID", _zones(meshes.background_cells, cells))
        return iterate(self.installation, "overSimpleFoam", folder, tell, is_converged)

    def write_motion(self, folder: Path) -> None:
        """Write the dictionary that moves the section and its mesh."""
        assert self.case.section is not None
        body = rigid_body(
            self.case.section, self.axes, _EVERYWHERE, 2 * _EVERYWHERE, self.case.section_heave_rate
        )
        body["report"] = True
        section = {
            "motionSolverLibs": ['"libsixDoFRigidBodyMotion.so"'],
            "motionSolver": "sixDoFRigidBodyMotion",
            "solver": "sixDoFRigidBodyMotion",
            "sixDoFRigidBodyMotionCoeffs": body,
        }
        moving = {"dynamicFvMesh": "dynamicOversetFvMesh", "solvers": {"section": section}}
        write_text(folder / "constant" / "dynamicMeshDict", dictionary("dynamicMeshDict", moving))
        write_displacement(folder, {OVERSET: {"patchType": OVERSET, "type": "zeroGradient"}})

    def write_system(self, folder: Path) -> None:
        """Write the control of the run, whose end may differ from that of an earlier start."""
        entries = control("pimpleFoam", self.case.duration, self.case.time_step, STATE_INTERVAL)
        # the fields name a kind of patch that no program knows by itself
        entries["libs"] = ['"liboverset.so"']
        solution = self.solution()
        solvers = solution["solvers"]
        solvers["p"] = {**_PRESSURE, "relTol": 0.05}
        solvers["pFinal"] = {**_PRESSURE, "relTol": 0.01}
        solvers["pcorr"] = solvers["pcorrFinal"] = {**_PRESSURE, "tolerance": 1e-4, "relTol": 0}
        write_system(
            folder, entries, _overlapping(flow.schemes(steady=False), self.meshes), solution
        )

    def mesh_fault(self, rotation: float, height: float) -> str:
        """Return the fault of the section's mesh where it has left the channel, else ''."""
        channel, half = self.mesh.channel, self.mesh.channel.height / 2
        reach = float(self.meshes.reach(rotation, height))
        if reach >= half:
            return (
                f"the section's mesh reaches {reach:.3g} c off the middle of a channel of "
                f"{half:g} c"
            )
        front, rear = map(float, self._ends(rotation))
        if front <= -channel.upstream:
            place, end = front, f"inlet is at {-channel.upstream:g} c"
        elif rear >= channel.downstream:
            place, end = rear, f"outlet is at {channel.downstream:g} c"
        else:
            return ""
        return f"the section's mesh reaches {place:.3g} c, the {end}"

    def _ends(self, rotation: ArrayLike) -> tuple[Floats, Floats]:
        """Return the ends of the section's mesh along the stream at rotations since the release.

        An axis off mid-chord stays where it is along the stream, and mid-chord turns about it.
        """
        twist = np.asarray(rotation) + self.axes.start_twist
        along, _ = self.axes.mid_chord_places(twist, np.zeros_like(twist))
        return self.meshes.ends(rotation, along)

    def require_room_at_release(self) -> None:
        """Refuse a channel that both meshes at the release do not fit into."""
        self.meshes.require_room()

    def within_room(self, so_far: SectionHistory) -> SectionHistory:
        """Return the part of a history before the section's mesh has left the channel.

        What is beyond it takes no values from the channel's mesh, and the loads are wrong.
        """
        _, height = self.axes.mid_chord_places(so_far.twist, so_far.deflection)
        rotation, channel = so_far.twist - self.axes.start_twist, self.mesh.channel
        front, rear = self._ends(rotation)
        outside = np.flatnonzero(
            (self.meshes.reach(rotation, height) >= channel.height / 2)
            | (front <= -channel.upstream)
            | (rear >= channel.downstream)
        )
        return so_far.first(int(outside[0])) if outside.size else so_far

    def history(self, loads: Loads | None = None) -> SectionHistory:
        """Return the history so far, its motion from the log."""
        return read_section(self.folder, self.axes, loads, read_motion)


def read_motion(folder: Path) -> BodyMotion:
    """Return the motion at the end of each time step that has one, from the log of a run.

    A step that was written before a kill and repeated after the resumption counts once.

    Raises
    ------
    SolverError
        There is no motion in the log.
    """
    log = folder / "log.pimpleFoam"
    height, now = float("nan"), float("nan")
    rows: dict[float, tuple[float, float]] = {}
    said = log.read_bytes() if log.is_file() else b""
    for found in _LINE.finditer(said):
        if found["time"]:
            after = float(found["time"])
            if rows and after <= next(reversed(rows)):
                rows = {time: row for time, row in rows.items() if time < after}
            now = after
        elif found["height"]:
            height = float(found["height"])
        else:
            # the first row of the rotation about +z by minus the twist
            rows[now] = (np.arctan2(float(found["sine"]), float(found["cosine"])), height)
    if not rows:
        raise SolverError(f"{log}: no motion of a rigid body in it; is this pimpleFoam's log?")
    values = np.array(list(rows.values()), dtype=float)
    return BodyMotion(np.array(list(rows)), values[:, 0], values[:, 1])


def _zones(background: int, cells: int) -> str:
    """Return the field by which the library knows the meshes apart, the background first."""
    zones = ["0"] * background + ["1"] * (cells - background)
    mirror, beside = {"type": "symmetryPlane"}, {"type": "zeroGradient"}
    entries = {
        "dimensions": "[0 0 0 0 0 0 0]",
        "internalField": f"nonuniform List<scalar> {cells} ({' '.join(zones)})",
        "boundaryField": {
            OVERSET: {"type": OVERSET, "value": "uniform 1"},
            "floor": mirror,
            "ceiling": mirror,
            "sides": {"type": "empty"},
            '"(inlet|outlet|plate)"': beside,
        },
    }
    return dictionary("zoneID", entries, "volScalarField")


def _overlapping(schemes: dict[str, Any], meshes: OverlappingMeshes) -> dict[str, Any]:
    """Return schemes with those of the overlap.

    ``inverseDistance`` finds the same stencil and the same loads, but searches for it anew each
    time that the mesh moves, and takes 1.7 times as long for a whole time step.
    """
    channel = meshes.channel
    length = channel.upstream + channel.downstream
    boxes = (round(length / _BOX), round(channel.height / _BOX), 1)
    overlap = {"method": "trackingInverseDistance", "searchBoxDivisions": (boxes, boxes)}
    return {**schemes, "oversetInterpolation": overlap}
