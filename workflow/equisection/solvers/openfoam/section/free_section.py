"""The free section: released from the rigid steady flow, until its verdict is in.

The run is resumed from its last whole state, if its folder has one.
"""

from __future__ import annotations

import json
import logging
import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from equisection.beam.section import Section
from equisection.cases import UnsteadyCase
from equisection.errors import SolverError
from equisection.files import write_text
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers import verdicts
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.case_folder import (
    copy_flow,
    drop_broken_states,
    drop_histories_after,
    emptied,
    is_ready,
    mark_ready,
)
from equisection.solvers.openfoam.dictionaries import control, write_system
from equisection.solvers.openfoam.free_run import STATE_INTERVAL, FreeRun, IterationsCheck
from equisection.solvers.openfoam.mesh.mesh_quality import MorphingMesh
from equisection.solvers.openfoam.process import BlowUpError, Watch, run_program
from equisection.solvers.openfoam.reading.loads import (
    Loads,
    has_loads,
    read_loads,
    require_reasonable,
)
from equisection.solvers.openfoam.rigid_flow import WINDOW, Tell
from equisection.solvers.openfoam.section.body_axes import BodyAxes, moment_about
from equisection.solvers.openfoam.section.rigid_section import SectionCells, run_steady
from equisection.solvers.openfoam.section.section_history import SectionHistory, read_section
from equisection.solvers.openfoam.section.section_motion import motion_output, write_motion
from equisection.solvers.openfoam.time_spent import spent
from equisection.solvers.verdicts import (
    decided_at,
    judge,
    last_look,
    refused,
    told_without_equilibrium,
)
from equisection.verdict.zigzag import zigzag_of

logger = logging.getLogger(__name__)

#: Obliqueness of a face (deg) beyond which a mesh is as good as tangled: the state that is known is
#: that before the blow-up.
_OBLIQUE = 80.0
#: Loads of the rigid section at the release, beside the run that starts from them.
_AT_RELEASE = "release.json"


@dataclass(frozen=True)
class SectionRun(FreeRun[SectionCells]):
    """The run of one case of the section."""

    @property
    def axes(self) -> BodyAxes:
        """Axes of the section."""
        case = self.case
        assert case.section is not None
        incidence = math.radians(case.incidence_deg)
        return BodyAxes.of(
            case.section, incidence, case.section_start_twist, case.section_equilibrium
        )

    def steady(self, tell: Tell) -> tuple[Path, Loads, bool]:
        """Make the rigid steady flow, as :func:`~.section_rigid.run_steady` does."""
        return run_steady(
            self.installation, self.case, self.mesh, self.work, tell, turbulence=self.turbulence
        )

    def write_motion(self, folder: Path) -> None:
        """Write the dictionaries that move section and mesh."""
        assert self.case.section is not None
        write_motion(
            folder,
            self.case.section,
            self.axes,
            2 * self.mesh.channel.room,
            self.case.section_heave_rate,
        )

    def write_system(self, folder: Path) -> None:
        """Write the control of the run, whose end may differ from that of an earlier start."""
        entries = control("pimpleFoam", self.case.duration, self.case.time_step, STATE_INTERVAL)
        entries["functions"] |= motion_output()
        write_system(folder, entries, flow.schemes(steady=False), self.solution())

    def solution(self) -> dict[str, Any]:
        """Return ``fvSolution``."""
        return flow.unsteady_solution(self.coupling)

    def history(self, loads: Loads | None = None) -> SectionHistory:
        """Return the history so far, with loads that are read already; see :func:`read_section`."""
        return read_section(self.folder, self.axes, loads)

    def run(self, tell: Tell) -> UnsteadyResult:
        """Release the section and follow it until its verdict is in.

        Raises
        ------
        SolverError
            A program failed through no fault of the case. A case whose flow or mesh breaks down
            has a result: ``failed``, or ``growing`` if the motion had grown beyond the bound
            before.
        """
        case, failure = self.case, ""
        try:
            if not is_ready(self.folder):
                self._set_up(tell)
            start = drop_broken_states(self.folder)
            drop_histories_after(self.folder, start)
            if start:
                logger.info("goes on from %g c/V", start)
            if start < case.duration and not (start and self._is_over()):
                self.write_system(self.folder)
                run_program(self.installation, "pimpleFoam", self.folder, self._watch(start, tell))
                require_reasonable(read_loads(self.folder), self.folder)
                self.require_room(self.history())
        except BlowUpError as error:
            failure = str(error)
            if not is_ready(self.folder) or not has_loads(self.folder):
                return refused(case.model_copy(update={"refusal": failure}))
        so_far = self.within_room(self.history())
        if failure and self._is_over():
            logger.info("what went wrong is later than the verdict: %s", failure)
            failure = ""
        if failure and so_far.time.size:
            failure = f"{failure}; {self._where(so_far)}"
        result = _result(case, self.folder, so_far, failure)
        return replace(result, spent=spent(self.work))

    def _is_over(self) -> bool:
        """Tell whether the verdict is in."""
        so_far = self.within_room(self.history())
        history = _from_release(self.folder, so_far, self.case, self.case.duration)
        return math.isfinite(decided_at(self.case, _tip(self.case.section, history)))

    def mesh_fault_at(self, so_far: SectionHistory, sample: int) -> str:
        """Return the fault of the mesh at a sample of a history, or ''."""
        twist, deflection = so_far.twist[sample], so_far.deflection[sample]
        _, height = self.axes.mid_chord_places(twist, deflection)
        return self.mesh_fault(float(twist) - self.axes.start_twist, float(height))

    def _where(self, so_far: SectionHistory) -> str:
        """Return where the section was when the flow blew up, and what the mesh has to do with it.

        The last loads that are reasonable may be those of the step before.
        """
        twist, deflection = float(so_far.twist[-1]), float(so_far.deflection[-1])
        where = (
            f"after {so_far.time[-1]:g} c/V, at a twist of {math.degrees(twist):.3g} deg and a "
            f"deflection of {deflection:.3g} c"
        )
        try:
            fault = self.mesh_fault_at(so_far, -1)
        except SolverError as error:
            # the run has its result, whatever becomes of the search for its cause
            logger.warning("the mesh at its end was not checked: %s", error)
            return where
        return f"{where}, where {fault}" if fault else where

    def mesh_fault(self, rotation: float, height: float) -> str:
        """Return the fault of the mesh at a rotation since the release (rad), or ''.

        ``height`` is that of mid-chord (chords).
        """
        mesh = MorphingMesh(self.installation, self.folder, 2 * self.mesh.channel.room)
        quality = mesh.along(rotation, height, 1, self.work / "moved")[-1]
        faults = quality.faults
        if not faults and quality.non_orthogonality_deg > _OBLIQUE:
            faults = f"a face is {quality.non_orthogonality_deg:.0f} deg oblique"
        if not faults:
            return ""
        return f"the mesh has tangled ({faults}); openfoam.mesh_motion: overset goes further"

    def require_room_at_release(self) -> None:
        """Refuse a channel that the mesh at the release does not fit into.

        Raises
        ------
        SolverError
            With the channel.
        """
        self.mesh.require_room()

    def within_room(self, so_far: SectionHistory) -> SectionHistory:
        """Return what the mesh could follow of a history; one that morphs tangles by itself."""
        return so_far

    def require_room(self, so_far: SectionHistory) -> None:
        """Refuse a motion that the mesh cannot follow.

        Raises
        ------
        BlowUpError
            With the time and the fault of the mesh.
        """
        followed = self.within_room(so_far).time.size
        if followed < so_far.time.size:
            fault = self.mesh_fault_at(so_far, followed)
            raise BlowUpError(f"at {so_far.time[followed]:g} c/V {fault}")

    def _watch(self, start: float, tell: Tell) -> Watch:
        case, looked, iterations = self.case, last_look(start), IterationsCheck()

        def decided(time: float) -> bool:
            nonlocal looked
            tell(time, case.duration)
            look = last_look(time - case.time_step)  # the step of this time has only begun
            if look <= looked:
                return False
            before, looked = looked, look
            loads = read_loads(self.folder)
            require_reasonable(loads, self.folder)
            so_far = self.history(loads)
            self.require_room(so_far)
            iterations.look(so_far.time, so_far.lift, so_far.moment)
            history = _from_release(self.folder, so_far, case, look)
            return math.isfinite(decided_at(case, _tip(case.section, history), before))

        return decided

    def _set_up(self, tell: Tell) -> None:
        """Make the folder of the free run from the rigid steady flow, converged or not."""
        source, loads, converged = self.steady(self.before_release(tell))
        if not converged:
            logger.info("the steady flow does not converge; the release is from its last state")
        folder = emptied(self.folder)
        copy_flow(source, folder)
        self.write_motion(folder)
        drag, lift, moment = loads.last(WINDOW // 3).means()
        about_axis = float(moment_about(self.axes.elastic_axis, moment, lift, drag))
        known = {"lift": lift, "moment": moment, "axis_moment": about_axis}
        write_text(folder / _AT_RELEASE, json.dumps(known))
        mark_ready(folder)


def _tip(section: Section | None, history: SectionHistory) -> verdicts.TipMotion:
    assert section is not None
    return verdicts.TipMotion(
        history.time,
        history.twist / section.twist_recovery,
        history.deflection / section.deflection_recovery,
    )


def _from_release(
    folder: Path, history: SectionHistory, case: UnsteadyCase, end: float
) -> SectionHistory:
    """Return the samples to be stored, the release in front."""
    loads = json.loads((folder / _AT_RELEASE).read_text(encoding="utf-8"))
    sampled = history.sampled(case.time_step, case.output_interval, end)
    return SectionHistory(
        np.concatenate([[0.0], sampled.time]),
        np.concatenate([[case.section_start_twist], sampled.twist]),
        np.concatenate([[case.section_equilibrium[1]], sampled.deflection]),
        np.concatenate([[loads["lift"]], sampled.lift]),
        np.concatenate([[loads["moment"]], sampled.moment]),
        np.concatenate([[loads.get("axis_moment", loads["moment"])], sampled.axis_moment]),
    )


def _result(
    case: UnsteadyCase, folder: Path, so_far: SectionHistory, failure: str
) -> UnsteadyResult:
    history = _from_release(folder, so_far, case, case.duration)
    end = math.inf if failure else decided_at(case, _tip(case.section, history))
    if math.isfinite(end):
        history = _from_release(folder, so_far, case, end)
    tip = _tip(case.section, history)
    assert case.section is not None
    is_offset = case.section.axis_behind_mid_chord != 0.0
    result = UnsteadyResult(
        time=history.time,
        twist=history.twist,
        deflection=history.deflection,
        tip_twist=tip.twist,
        tip_deflection=tip.deflection,
        lift=history.lift,
        moment=history.moment,
        axis_moment=history.axis_moment if is_offset else np.empty(0),
        incidence=math.radians(case.incidence_deg) + history.twist,
        verdict=judge(case, tip, failure),
        loads_zigzag=zigzag_of(so_far.time, so_far.lift, so_far.moment),
    )
    is_without = case.start.state == "equilibrium" and case.start.equilibrium is None
    return told_without_equilibrium(result) if is_without else result
