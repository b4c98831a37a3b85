"""The free plate: flow and structure coupled in each time step, until the verdict is in.

OpenFOAM moves the mesh and resolves the flow; the structure is solved here, on its modes
(``motion.modal_response``), with loads and places exchanged over pipes. The run starts from the
rigid steady flow, or that of the plate held in its first torsion mode or in its static equilibrium
(:mod:`.coupled_run`).
"""

from __future__ import annotations

import logging
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

from equisection.cases import UnsteadyCase
from equisection.errors import SolverError
from equisection.motion.modal_response import Staggered
from equisection.results.tip_flow import TipFlow
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers.openfoam.beam.beam_history import (
    PlateHistory,
    add_row,
    keep_until,
    read_plate,
    require_state,
)
from equisection.solvers.openfoam.beam.coupled_run import CoupledRun
from equisection.solvers.openfoam.beam.lumped_points import Handed, LumpedPoints
from equisection.solvers.openfoam.beam.pipes import Alive, Pipes
from equisection.solvers.openfoam.beam.rigid_beam import BeamCells
from equisection.solvers.openfoam.case_folder import is_ready, states
from equisection.solvers.openfoam.free_run import FreeRun, IterationsCheck
from equisection.solvers.openfoam.process import BlowUpError, run_program
from equisection.solvers.openfoam.ranks import parts
from equisection.solvers.openfoam.reading.loads import BEYOND_REASON
from equisection.solvers.openfoam.reading.sampled_tip_flow import Pose, sample_tip_flow
from equisection.solvers.openfoam.rigid_flow import Tell
from equisection.solvers.openfoam.section.rigid_section import require_sound_mesh
from equisection.solvers.openfoam.time_spent import spent
from equisection.solvers.verdicts import (
    TipMotion,
    decided_at,
    first_modes,
    judge,
    last_look,
    refused,
    told_without_equilibrium,
)
from equisection.verdict.zigzag import zigzag_of

logger = logging.getLogger(__name__)

Floats = NDArray[np.float64]

#: Room that must be left between the plate and floor or ceiling (chords).
_ROOM = 0.1


@dataclass(frozen=True)
class PlateRun(CoupledRun[UnsteadyCase], FreeRun[BeamCells]):
    """The run of one free case of the plate."""

    @property
    def history_file(self) -> Path:
        """File of the structure's history."""
        return self.folder / "structure.txt"

    @cached_property
    def points(self) -> LumpedPoints:
        """The plate's modes at its lumped points."""
        assert self.case.beam is not None
        return LumpedPoints.of(self.case.beam, self.mesh.edges(), self.mesh.section.incidence)

    @property
    def release(self) -> tuple[Floats, Floats]:
        """Position and velocity of the modes at the release."""
        start = self.case.start
        pushed, velocity = self.points.release(math.radians(start.twist_deg), start.heave_rate)
        return pushed + np.array(start.equilibrium or 0.0), velocity

    @property
    def first_position(self) -> Floats:
        """Position of the modes at the release."""
        return self.release[0]

    def history(self) -> PlateHistory:
        """Return the history so far."""
        return read_plate(self.history_file, self.points.frequency.size)

    def run(self, tell: Tell) -> UnsteadyResult:
        """Release the plate and follow it until its verdict is in.

        Raises
        ------
        SolverError
            A program failed, or the version of OpenFOAM is another. A flow or a mesh that broke
            down, or a plate that comes to the wall, is a result: ``failed``, or ``growing`` if the
            motion had grown beyond the bound before.
        """
        case, failure = self.case, ""
        try:
            start = self.start(tell)
            if start < case.duration and not (start and self._is_over()):
                self._go_on(start, tell)
        except BlowUpError as error:
            failure = f"{error}{self._where()}"
            if not is_ready(self.folder):
                return refused(case.model_copy(update={"refusal": failure}))
        if failure and self._is_over():
            logger.info("what went wrong is later than the verdict: %s", failure)
            failure = ""
        tip_flow = None if failure else self._tip_flow()
        return replace(self._result(failure), tip_flow=tip_flow, spent=spent(self.work))

    def _is_over(self) -> bool:
        """Tell whether the verdict is in."""
        case = self.case
        history = self.history().sampled(case.time_step, case.output_interval, case.duration)
        return math.isfinite(decided_at(case, self.tip_motion(history)))

    def _go_on(self, start: float, tell: Tell) -> None:
        # the loads at the start are handed over anew in the first step
        before = start - 0.5 * self.case.time_step
        state = keep_until(self.history_file, before, self.points.frequency.size).state()
        if start:
            require_state(state, start, self.case.time_step, self.folder)
        position, velocity = self.release
        structure = Staggered(
            self.points.modes(self.case.time_step), state, position=position, velocity=velocity
        )
        self.exchange(start, lambda pipes: _Exchange(self, structure, pipes, start, tell))

    def _where(self) -> str:
        """Return when and how far out the plate was, and whether its mesh was sound until then."""
        if not self.history_file.exists() or not self.history().time.size:
            return ""
        history = self.history()
        twist, deflection = self.points.tip(history.position[-1])
        return (
            f"; at {history.time[-1]:.4g} c/V the tip's twist was {math.degrees(twist):.3g} deg, "
            f"its deflection {deflection:.3g} c{self._mesh_before()}"
        )

    def _mesh_before(self) -> str:
        """Return whether the last mesh that was written is sound."""
        last = states(parts(self.folder)[0])[-1].name
        if float(last) == 0.0:
            return ""
        program, ranks = "checkMesh", len(parts(self.folder))
        log = self.folder / f"log.{program}"
        log.unlink(missing_ok=True)  # what was said before is of another mesh
        try:
            run_program(
                self.installation, program, self.folder, arguments=("-latestTime",), ranks=ranks
            )
        except SolverError as error:
            # the run has its result, whatever becomes of the search for its cause
            logger.warning("the mesh at its end was not checked: %s", error)
            return ""
        try:
            require_sound_mesh(log)
        except SolverError as error:
            return f"; at {last} c/V {error}"
        return f"; at {last} c/V the mesh was sound"

    def _tip_flow(self) -> TipFlow | None:
        """Return the flow near the tip in the last state that was written."""
        time, history = float(states(parts(self.folder)[0])[-1].name), self.history()
        position = history.position[np.abs(history.time - time).argmin()]
        points, edges = self.points, self.mesh.edges()  # the mesh's points stand at the edges
        at_edges = (
            np.interp(edges, points.locations, motion)
            for motion in (points.twist(position), points.mid_chord(position)[1])
        )
        twist, deflection = points.tip(position)
        state = (
            f"{time:.4g} c/V after the release, the tip at {math.degrees(twist):.2f} deg and "
            f"{deflection:.3f} c"
        )
        return sample_tip_flow(
            self.installation, self.folder, self.mesh, state=state, pose=Pose(edges, *at_edges)
        )

    def tip_motion(self, history: PlateHistory) -> TipMotion:
        """Return the motion of the tip."""
        torsion = self.points.torsion_modes
        modes = first_modes(history.position[:, :torsion].T, history.position[:, torsion:].T)
        return TipMotion(history.time, *self.points.tip(history.position), modes)

    def _result(self, failure: str) -> UnsteadyResult:
        case = self.case
        every_step = self.history()
        history = every_step.sampled(case.time_step, case.output_interval, case.duration)
        end = math.inf if failure else decided_at(case, self.tip_motion(history))
        history = history.sampled(case.time_step, case.output_interval, end)
        tip = self.tip_motion(history)
        torsion = self.points.torsion_modes
        result = UnsteadyResult(
            time=history.time,
            twist=tip.twist,
            deflection=tip.deflection,
            tip_twist=tip.twist,
            tip_deflection=tip.deflection,
            lift=history.lift,
            moment=history.moment,
            axis_moment=history.axis_moment if self.points.axes.behind_mid_chord else np.empty(0),
            incidence=math.radians(case.incidence_deg) + tip.twist,
            verdict=judge(case, tip, failure),
            torsion_amplitudes=history.position[:, :torsion].T,
            bending_amplitudes=history.position[:, torsion:].T,
            torsion_loads=history.load[:, :torsion].T,
            bending_loads=history.load[:, torsion:].T,
            loads_zigzag=zigzag_of(every_step.time, every_step.lift, every_step.moment),
        )
        is_without = case.start.state == "equilibrium" and case.start.equilibrium is None
        return told_without_equilibrium(result) if is_without else result


class _Exchange:
    """The structure's side of a run, from its start or resumption to its end."""

    def __init__(
        self, run: PlateRun, structure: Staggered, pipes: Pipes, start: float, tell: Tell
    ) -> None:
        self._run, self._structure, self._pipes, self._tell = run, structure, pipes, tell
        self._looked = last_look(start)
        self._resumed = structure.proposed_position
        self._iterations = IterationsCheck()
        self._last: Handed | None = None
        self._answer = ""

    def __call__(self, alive: Alive, end: Callable[[], None]) -> None:
        """Serve the program until it has ended."""
        with self._run.history_file.open("a", encoding="ascii") as stream:
            while (message := self._pipes.receive(alive)) is not None:
                handed = self._handed(message)
                if not handed.is_again(self._last):
                    self._last = handed
                    self._answer = self._answer_to(handed, stream, end)
                if not self._pipes.send(self._answer, alive):
                    break

    def _answer_to(self, handed: Handed, stream: IO[str], end: Callable[[], None]) -> str:
        """Return the places of the points under loads that are new."""
        points, structure = self._run.points, self._structure
        coefficients = points.coefficients(handed.forces, handed.moments)
        if not max(map(abs, coefficients)) < BEYOND_REASON:
            raise BlowUpError(f"C_L {coefficients[0]:.3g}, C_M {coefficients[1]:.3g}")
        about_axis = points.about_axis(handed.forces, handed.moments, self._place())
        is_new_step = structure.is_new_step(handed.time)
        place = structure.turn(handed.time, points.modal_loads(handed.forces, about_axis))
        if is_new_step:
            assert structure.state is not None
            more = points.coefficients(handed.forces, about_axis)[1:]
            add_row(
                stream,
                structure.state,
                *coefficients,
                *(more if points.axes.behind_mid_chord else ()),
            )
            if self._is_over(structure.state.time):
                end()
        self._require_room(place, handed.time)
        return points.message(place)

    def _place(self) -> np.ndarray:
        """Return the position of the modes that the flow was solved around."""
        place = self._structure.proposed_position
        return np.zeros_like(self._run.points.frequency) if place is None else place

    def _handed(self, message: str) -> Handed:
        handed = Handed.read(message, self._run.folder)
        if self._resumed is not None:
            handed = handed.about(self._run.points.mid_chord(self._resumed))
            self._resumed = None
        return handed

    def _require_room(self, place: np.ndarray, time: float) -> None:
        points = self._run.points
        twist, deflection = points.tip(place)
        _, height = points.axes.mid_chord_places(twist, deflection)
        section = self._run.mesh.section
        low, high = section.reach(section.incidence + float(twist))
        room = 0.5 * section.channel.height - max(high + float(height), -low - float(height))
        if room < _ROOM:
            raise BlowUpError(
                f"the plate has come to within {room:.2g} c of floor or ceiling at {time:.4g} c/V"
            )

    def _is_over(self, time: float) -> bool:
        self._tell(time, self._run.case.duration)
        look = last_look(time)
        if look <= self._looked:
            return False
        before, self._looked = self._looked, look
        case = self._run.case
        so_far = self._run.history()
        self._iterations.look(so_far.time, so_far.lift, so_far.moment)
        history = so_far.sampled(case.time_step, case.output_interval, look)
        return math.isfinite(decided_at(case, self._run.tip_motion(history), before))
