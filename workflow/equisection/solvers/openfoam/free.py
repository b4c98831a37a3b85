"""The free section: released from the rigid steady flow, until its verdict is in.

The run is resumed from its last whole state, if its folder has one.
"""

from __future__ import annotations

import json
import logging
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from equisection.cases import SectionProperties, UnsteadyCase
from equisection.errors import SolverError
from equisection.files import write_text
from equisection.results.unsteady import UnsteadyResult
from equisection.solvers import verdicts
from equisection.solvers.openfoam import flow
from equisection.solvers.openfoam.case_folder import (
    copy_flow,
    drop_broken_states,
    drop_histories_after,
    emptied,
    is_ready,
    mark_ready,
)
from equisection.solvers.openfoam.dictionaries import control, write_system
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.loads import Loads, read_loads, reasonable, require_reasonable
from equisection.solvers.openfoam.mesh import Mesh
from equisection.solvers.openfoam.mesh_quality import MorphingMesh
from equisection.solvers.openfoam.process import BlowUpError, Every, Watch, run_program
from equisection.solvers.openfoam.rigid import WINDOW, Tell, run_steady
from equisection.solvers.openfoam.section_motion import (
    Motion,
    motion_output,
    read_motion,
    write_motion,
)
from equisection.solvers.openfoam.spent import spent
from equisection.solvers.verdicts import LOOKS_EVERY, is_decided, judge, refused

logger = logging.getLogger(__name__)

#: Interval of the states that a run is resumed from (c/V).
STATE_INTERVAL = 2.0
#: Loads of the rigid section at the release, beside the run that starts from them.
_AT_RELEASE = "release.json"

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class SectionHistory:
    """Motion and loads of the section over convective time, shape (n,).

    Attributes
    ----------
    time
        s (c/V).
    twist, deflection
        Nose up (rad); up (chords).
    lift, moment
        c_l, and c_m about the moving mid-chord.
    """

    time: Floats
    twist: Floats
    deflection: Floats
    lift: Floats
    moment: Floats

    def sampled(self, step: float, interval: float, end: float = math.inf) -> SectionHistory:
        """Return the samples up to an end at multiples of an interval, which is one of the step."""
        every = round(interval / step)
        kept = np.rint(self.time / step).astype(int) % every == 0
        kept &= self.time < end + 0.5 * step
        return SectionHistory(
            self.time[kept],
            self.twist[kept],
            self.deflection[kept],
            self.lift[kept],
            self.moment[kept],
        )


@dataclass(frozen=True)
class SectionRun:
    """The run of one case.

    Attributes
    ----------
    installation
        OpenFOAM.
    case
        The case.
    mesh
        Its mesh.
    outer_correctors
        Iterations of flow, loads and motion a time step.
    work
        Where its folders are.
    velocity_relaxation
        Under-relaxation of the velocity in these iterations; 1 is none.
    """

    installation: Installation
    case: UnsteadyCase
    mesh: Mesh
    outer_correctors: int
    work: Path
    velocity_relaxation: float = 1.0

    @property
    def folder(self) -> Path:
        """Folder of the free run, beside that of the steady flow which it starts from."""
        return self.work / "free"

    def steady(self, tell: Tell) -> tuple[Path, Loads, bool]:
        """Make the rigid steady flow, as :func:`~.rigid.run_steady` does."""
        return run_steady(self.installation, self.case, self.mesh, self.work, tell)

    def write_motion(self, folder: Path) -> None:
        """Write what moves section and mesh."""
        assert self.case.section is not None
        write_motion(folder, self.case.section, self.mesh.channel.height)

    def write_system(self, folder: Path) -> None:
        """Write what controls the run; its end may differ from that of an earlier start."""
        entries = control("pimpleFoam", self.case.duration, self.case.time_step, STATE_INTERVAL)
        entries["functions"] |= motion_output()
        write_system(folder, entries, flow.schemes(steady=False), self.solution())

    def solution(self) -> dict[str, Any]:
        """Return ``fvSolution``."""
        return flow.solution(
            steady=False,
            outer_correctors=self.outer_correctors,
            velocity_relaxation=self.velocity_relaxation,
        )

    def history(self, loads: Loads | None = None) -> SectionHistory:
        """Return the history so far, with loads that are read already; see :func:`read_section`."""
        return read_section(self.folder, loads)

    def run(self, tell: Tell) -> UnsteadyResult:
        """Release the section and follow it until its verdict is in.

        Raises
        ------
        SolverError
            A program failed through no fault of the case. A case that went where it cannot be
            computed has a result: ``failed``, or ``growing`` if the motion had grown beyond the
            bound before.
        """
        case, failure = self.case, ""
        try:
            if not is_ready(self.folder):
                self._set_up(tell)
            start = drop_broken_states(self.folder)
            drop_histories_after(self.folder, start)
            if start:
                logger.info("goes on from %g c/V", start)
            if start < case.duration:
                self.write_system(self.folder)
                run_program(self.installation, "pimpleFoam", self.folder, self._watch(start, tell))
                require_reasonable(read_loads(self.folder), self.folder)
        except BlowUpError as error:
            failure = str(error)
            if not is_ready(self.folder):
                return refused(case.model_copy(update={"refusal": failure}))
        so_far = self.history()
        if failure and so_far.time.size:
            failure = f"{failure}; {self._where(so_far)}"
        result = _result(case, self.folder, so_far, failure)
        return replace(result, spent=spent(self.work))

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
            fault = self.mesh_fault(twist, deflection)
        except SolverError as error:
            # the run has its result, whatever becomes of the search for its cause
            logger.warning("the mesh at its end was not checked: %s", error)
            return where
        return f"{where}, where {fault}" if fault else where

    def mesh_fault(self, twist: float, deflection: float) -> str:
        """Return what is wrong with the mesh at a twist (rad) and a deflection (chords), if so."""
        mesh = MorphingMesh(self.installation, self.folder, self.mesh.channel.height)
        faults = mesh.along(twist, deflection, 1, self.work / "moved")[-1].faults
        if not faults:
            return ""
        return f"the mesh has tangled ({faults}); openfoam.mesh_motion: overset goes further"

    def _watch(self, start: float, tell: Tell) -> Watch:
        case, due = self.case, Every(LOOKS_EVERY, start)

        def decided(time: float) -> bool:
            tell(time, case.duration)
            if not due.is_due(time):
                return False
            loads = read_loads(self.folder)
            require_reasonable(loads, self.folder)
            history = self.history(loads).sampled(case.time_step, case.output_interval)
            return is_decided(case, _tip(case.section, history))

        return decided

    def _set_up(self, tell: Tell) -> None:
        """Make the folder of the free run from the rigid steady flow, converged or not."""
        case = self.case
        assert case.section is not None

        def nothing_yet(done: float, total: float) -> None:
            del done, total
            tell(0.0, case.duration)

        source, loads, converged = self.steady(nothing_yet)
        if not converged:
            logger.info("the steady flow does not converge; the release is from its last state")
        folder = emptied(self.folder)
        copy_flow(source, folder)
        self.write_motion(folder)
        _, lift, moment = loads.last(WINDOW // 3).means()
        write_text(folder / _AT_RELEASE, json.dumps({"lift": lift, "moment": moment}))
        mark_ready(folder)


def read_section(
    folder: Path,
    loads: Loads | None = None,
    motion_of: Callable[[Path], Motion] = read_motion,
) -> SectionHistory:
    """Return the history of a free run so far.

    Parameters
    ----------
    folder
        Folder of the run.
    loads
        Its loads, if they are read already.
    motion_of
        Reads its motion from where it stands.

    Raises
    ------
    SolverError
        A file is missing or of an unknown layout, or steps are missing in it.
    """
    loads = read_loads(folder) if loads is None else loads
    loads = loads.first(reasonable(loads))
    motion = motion_of(folder)
    # either file may have a row that the other does not have yet
    _, one, other = np.intersect1d(
        _steps(loads.time), _steps(motion.time), return_indices=True, assume_unique=True
    )
    _require_every_step(loads.time[one], folder)
    deflection = motion.deflection[other]
    return SectionHistory(
        time=loads.time[one],
        twist=motion.twist[other],
        deflection=deflection,
        lift=loads.lift[one],
        moment=_about_moving_centre(loads, one, deflection),
    )


def _steps(time: Floats) -> NDArray[np.int64]:
    """Return times as whole numbers, by which two files agree."""
    return np.rint(time * 1e7).astype(np.int64)


def _require_every_step(time: Floats, folder: Path) -> None:
    """Refuse a history that a full disk, or a hand, has left with a gap."""
    steps = np.diff(_steps(time))
    if steps.size and steps.max() > 1.5 * np.median(steps):
        gap = int(steps.argmax())
        raise SolverError(
            f"{folder / 'postProcessing'}: steps are missing between {time[gap]:g} and "
            f"{time[gap + 1]:g} c/V; delete {folder} and run again"
        )


def _about_moving_centre(loads: Loads, rows: NDArray[np.intp], deflection: Floats) -> Floats:
    """Return c_m about mid-chord at w/c from that about the centre at rest.

    c_m(w) = c_m(0) - (w/c) c_d: drag above the centre at rest turns the nose up about that.
    """
    return loads.moment[rows] - deflection * loads.drag[rows]


def _tip(section: SectionProperties | None, history: SectionHistory) -> verdicts.Motion:
    assert section is not None
    return verdicts.Motion(
        history.time,
        history.twist / section.twist_recovery,
        history.deflection / section.deflection_recovery,
    )


def _from_release(folder: Path, history: SectionHistory, case: UnsteadyCase) -> SectionHistory:
    """Return the samples to be stored, the release in front."""
    loads = json.loads((folder / _AT_RELEASE).read_text(encoding="utf-8"))
    sampled = history.sampled(case.time_step, case.output_interval, case.duration)
    return SectionHistory(
        np.concatenate([[0.0], sampled.time]),
        np.concatenate([[0.0], sampled.twist]),
        np.concatenate([[0.0], sampled.deflection]),
        np.concatenate([[loads["lift"]], sampled.lift]),
        np.concatenate([[loads["moment"]], sampled.moment]),
    )


def _result(
    case: UnsteadyCase, folder: Path, so_far: SectionHistory, failure: str
) -> UnsteadyResult:
    history = _from_release(folder, so_far, case)
    tip = _tip(case.section, history)
    return UnsteadyResult(
        time=history.time,
        twist=history.twist,
        deflection=history.deflection,
        tip_twist=tip.twist,
        tip_deflection=tip.deflection,
        lift=history.lift,
        moment=history.moment,
        incidence=math.radians(case.incidence_deg) + history.twist,
        verdict=judge(case, tip, failure),
    )
