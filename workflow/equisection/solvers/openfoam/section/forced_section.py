"""The section in prescribed motion, from the rigid steady flow on.

The wall moves as a rigid body by a table of its motion, and the mesh follows by Laplace's equation
with a diffusivity that falls with the distance from the wall. Floor and ceiling stand.

The run is resumed from its last whole state, if its folder has one.
"""

from __future__ import annotations

import logging
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from equisection.cases import ForcedCase
from equisection.files import write_text
from equisection.results.forced_result import ForcedResult, motion_of
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.case_folder import (
    copy_flow,
    drop_broken_states,
    drop_histories_after,
    emptied,
    is_ready,
    mark_ready,
)
from equisection.solvers.openfoam.dictionaries import PLATE, control, dictionary, write_system
from equisection.solvers.openfoam.free_run import STATE_INTERVAL, MovingRun
from equisection.solvers.openfoam.process import BlowUpError, Every, Watch, run_program
from equisection.solvers.openfoam.reading.loads import has_loads, read_loads, require_reasonable
from equisection.solvers.openfoam.rigid_flow import Tell
from equisection.solvers.openfoam.section.body_axes import moment_about
from equisection.solvers.openfoam.section.rigid_section import SectionCells, run_steady
from equisection.solvers.openfoam.section.section_motion import write_displacement
from equisection.solvers.openfoam.time_spent import spent
from equisection.solvers.verdicts import LOOKS_EVERY, last_look

logger = logging.getLogger(__name__)

#: Rows of the table of the motion beyond both ends of the run.
_BEYOND = 10
_TABLE = "motion.dat"
_MESH_SOLVER = {"solver": "PCG", "preconditioner": "DIC", "tolerance": 1e-9, "relTol": 1e-4}


@dataclass(frozen=True)
class ForcedRun(MovingRun[ForcedCase, SectionCells]):
    """The run of one case of the section in prescribed motion."""

    def run(self, tell: Tell) -> ForcedResult:
        """Move the section and record its loads.

        A case whose flow or mesh breaks down has a result with a ``failure``.

        Raises
        ------
        SolverError
            A program failed through no fault of the case.
        """
        case, failure = self.case, ""
        try:
            if not is_ready(self.folder):
                self._set_up(tell)
            start = drop_broken_states(self.folder)
            drop_histories_after(self.folder, start)
            if start < case.duration:
                write_system(
                    self.folder,
                    control("pimpleFoam", case.duration, case.time_step, STATE_INTERVAL),
                    flow.schemes(steady=False),
                    self.solution(),
                )
                run_program(self.installation, "pimpleFoam", self.folder, self._watch(start, tell))
                require_reasonable(read_loads(self.folder), self.folder)
        except BlowUpError as error:
            failure = str(error)
            if not is_ready(self.folder) or not has_loads(self.folder):
                return ForcedResult.without_history(failure)
        return self._result(failure)

    def solution(self) -> dict[str, Any]:
        """Return ``fvSolution``; the mesh moves once a step, its motion being known."""
        entries = flow.unsteady_solution(self.coupling)
        entries["solvers"]['"cellDisplacement.*"'] = _MESH_SOLVER
        entries["PIMPLE"]["moveMeshOuterCorrectors"] = False
        return entries

    def _watch(self, start: float, tell: Tell) -> Watch:
        due = Every(LOOKS_EVERY, last_look(start))

        def never(time: float) -> bool:
            tell(time, self.case.duration)
            if due.is_due(time):
                require_reasonable(read_loads(self.folder), self.folder)
            return False

        return never

    def _set_up(self, tell: Tell) -> None:
        """Make the folder of the moving run from the rigid steady flow, converged or not."""
        source, _, converged = run_steady(
            self.installation,
            self.case,
            self.mesh,
            self.work,
            self.before_release(tell),
            turbulence=self.turbulence,
        )
        if not converged:
            logger.info("the steady flow does not converge; the motion sets in from its last state")
        folder = emptied(self.folder)
        copy_flow(source, folder)
        write_text(folder / "constant" / _TABLE, self.table())
        entries = {
            "dynamicFvMesh": "dynamicMotionSolverFvMesh",
            "motionSolverLibs": ['"libfvMotionSolvers.so"'],
            "motionSolver": "displacementLaplacian",
            "displacementLaplacianCoeffs": {"diffusivity": f"inverseDistance 1({PLATE})"},
        }
        write_text(folder / "constant" / "dynamicMeshDict", dictionary("dynamicMeshDict", entries))
        write_displacement(folder, {PLATE: _wall()})
        mark_ready(folder)

    def table(self) -> str:
        """Return the motion as OpenFOAM reads it: time, translation, and rotation (deg) about z."""
        case = self.case
        steps = round(case.duration / case.time_step)
        time = case.time_step * np.arange(-_BEYOND, steps + _BEYOND + 1)
        pitch, heave = motion_of(case, time)
        rows = [
            f"({s:.9g} ((0 {up:.12e} 0) (0 0 {-math.degrees(twist):.12e})))"
            for s, up, twist in zip(time, heave, pitch, strict=True)
        ]
        return "\n".join([str(len(rows)), "(", *rows, ")", ""])

    def _result(self, failure: str) -> ForcedResult:
        case, loads = self.case, read_loads(self.folder)
        every = round(case.output_interval / case.time_step)
        kept = np.rint(loads.time / case.time_step).astype(int) % every == 0
        kept &= loads.time < case.duration + 0.5 * case.time_step
        time = loads.time[kept]
        twist, deflection = motion_of(case, time)
        lift, drag = loads.lift[kept], loads.drag[kept]
        moment = moment_about((0.0 * time, deflection), loads.moment[kept], lift, drag)
        return ForcedResult(time, twist, deflection, lift, moment, failure, spent=spent(self.work))


def _wall() -> dict[str, Any]:
    """Return the wall's displacement, that of a rigid body about mid-chord at rest."""
    return {
        "type": "solidBodyMotionDisplacement",
        "solidBodyMotionFunction": "tabulated6DoFMotion",
        "tabulated6DoFMotionCoeffs": {
            "CofG": (0, 0, 0),
            "timeDataFileName": f'"<constant>/{_TABLE}"',
        },
        "value": "uniform (0 0 0)",
    }
