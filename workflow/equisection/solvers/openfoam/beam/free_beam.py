"""The free plate: flow and structure coupled in each time step, until the verdict is in.

OpenFOAM moves the mesh and resolves the flow; the structure is solved here, on its modes
(``motion.modal_response``), with loads and places exchanged over pipes. The run starts from the
rigid steady flow, or that of the plate held in its first torsion mode, and is resumed from its last
whole state, if its folder has one.
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

from equisection.errors import SolverError
from equisection.motion.modal_response import Staggered
from equisection.results.tip_flow import TipFlow
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.beam.beam_history import (
    PlateHistory,
    add_row,
    keep_until,
    read_plate,
    require_state,
)
from equisection.solvers.openfoam.beam.deformed_mesh import deform_mesh
from equisection.solvers.openfoam.beam.exchange_trial import try_exchange
from equisection.solvers.openfoam.beam.lumped_points import (
    Handed,
    LumpedPoints,
    motion_schemes,
    motion_solvers,
    write_lumped_motion,
)
from equisection.solvers.openfoam.beam.pipes import Alive, Pipes, names
from equisection.solvers.openfoam.beam.rigid_beam import BeamCells, PlateFlow, plate_control
from equisection.solvers.openfoam.case_folder import (
    drop_broken_states,
    drop_histories_after,
    drop_states_after,
    emptied,
    is_ready,
    mark_ready,
    states,
)
from equisection.solvers.openfoam.dictionaries import write_system
from equisection.solvers.openfoam.free_run import (
    STATE_INTERVAL,
    CaseT,
    FreeRun,
    IterationsCheck,
    MovingRun,
)
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.outline_beam_mesh import OutlineBeamMesh
from equisection.solvers.openfoam.process import (
    SILENCE,
    BlowUpError,
    Every,
    run_beside,
    run_program,
)
from equisection.solvers.openfoam.ranks import copy_flow_of_all, parts
from equisection.solvers.openfoam.reading.loads import BEYOND_REASON, read_loads
from equisection.solvers.openfoam.reading.sampled_tip_flow import Pose, sample_tip_flow
from equisection.solvers.openfoam.rigid_flow import Tell
from equisection.solvers.openfoam.section.rigid_section import require_sound_mesh
from equisection.solvers.openfoam.time_spent import spent
from equisection.solvers.verdicts import (
    LOOKS_EVERY,
    TipMotion,
    decided_at,
    first_modes,
    is_decided,
    judge,
    last_look,
    refused,
)
from equisection.verdict.zigzag import zigzag_of

logger = logging.getLogger(__name__)

Floats = NDArray[np.float64]

#: The version that the coupled beam was run on, and later ones, known by their sources.
_RUN, _READ = "v1912", range(2306, 2607)
#: Room that must be left between the plate and floor or ceiling (chords).
_ROOM = 0.1


@dataclass(frozen=True)
class PlateRun(FreeRun[BeamCells]):
    """The run of one case of the plate.

    Attributes
    ----------
    ranks
        Ranks of MPI that a program runs on.
    """

    ranks: int

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
        return self.points.release(math.radians(start.twist_deg), start.heave_rate)

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
        require_version(self.installation)
        try:
            if not is_ready(self.folder):
                self._set_up(tell)
            start = last_common_state(self.folder)
            if not start:
                try_unless_run_before(self, self.points, self.release[0])
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

    def _set_up(self, tell: Tell) -> None:
        """Make the folder of the free run from the rigid steady flow, converged or not."""
        rigid = PlateFlow(
            self.installation, self.case, self.mesh, self.coupling, self.ranks, self.work
        )
        is_held = self.case.start.twist_deg != 0.0
        source, _, converged = rigid.steady(
            self.before_release(tell), self._deform if is_held else None
        )
        if not converged:
            logger.info("the steady flow does not converge; the release is from its last state")
        self.start_from(source)

    def start_from(self, source: Path) -> None:
        """Make the folder of the free run from the last state of a steady run of the same mesh."""
        folder = emptied(self.folder)
        copy_flow_of_all(source, folder)
        is_held = self.case.start.twist_deg != 0.0
        write_lumped_motion(folder, self.points, names(), is_deformed=is_held)
        mark_ready(folder)

    def _deform(self, folder: Path) -> None:
        """Move the mesh of a folder to that of the plate as it is held until the release."""
        deform_mesh(
            self.installation,
            folder,
            self.points,
            self.release[0],
            self.work / "held",
            of_outline=self._is_of_outline,
        )

    @property
    def _is_of_outline(self) -> bool:
        return isinstance(self.mesh, OutlineBeamMesh)

    def _is_over(self) -> bool:
        """Tell whether the verdict is in."""
        case = self.case
        history = self.history().sampled(case.time_step, case.output_interval, case.duration)
        return math.isfinite(decided_at(case, self.tip_motion(history)))

    def _go_on(self, start: float, tell: Tell) -> None:
        write_coupled_system(self)
        # a case that was divided stays so, on however many ranks its job runs now
        ranks = len(parts(self.folder))
        if ranks != self.ranks:
            logger.info("%d ranks: the run was begun on as many", ranks)
        if start:
            logger.info("goes on from %g c/V", start)
        # the loads at the start are handed over anew in the first step
        before = start - 0.5 * self.case.time_step
        state = keep_until(self.history_file, before, self.points.frequency.size).state()
        if start:
            require_state(state, start, self.case.time_step, self.folder)
        position, velocity = self.release
        structure = Staggered(
            self.points.modes(self.case.time_step), state, position=position, velocity=velocity
        )
        pipes = Pipes(self.folder, SILENCE)
        try:
            run_beside(
                self.installation,
                "pimpleFoam",
                self.folder,
                _Exchange(self, structure, pipes, start, tell),
                ranks=ranks,
            )
        finally:
            pipes.close()

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
        return UnsteadyResult(
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


def require_version(installation: Installation) -> None:
    """Refuse a version of OpenFOAM of whose ``lumpedPointMovement`` nothing is known.

    Raises
    ------
    SolverError
        It is neither the one that was run nor one whose sources are known.
    """
    version = installation.version()
    if version != _RUN and version not in {f"v{number}" for number in _READ}:
        raise SolverError(
            f"OpenFOAM {version}: the coupled beam runs on {_RUN} and, with a trial of its first "
            f"step, on v{_READ[0]} to v{_READ[-1]}; lumpedPointMovement of others may read other "
            "dictionaries; run it there, or leave the model 3d out of sweep.models and "
            "forced.beam_modes at 0"
        )


def try_unless_run_before(
    run: MovingRun[CaseT, BeamCells], points: LumpedPoints, position: Floats
) -> None:
    """Try the exchange with a version that the coupled beam was not run on.

    Parameters
    ----------
    run
        The run, at time 0.
    position
        Position of the modes there.

    Raises
    ------
    SolverError
        The trial failed.
    """
    if run.installation.version() == _RUN:
        return
    loads = read_loads(run.work / "steady")
    step = run.case.time_step
    try_exchange(
        run.installation,
        run.folder,
        points,
        position,
        steady=(float(loads.lift[-1]), float(loads.moment[-1])),
        write_system=lambda folder: write_coupled_system(run, folder, step, step),
    )


def write_coupled_system(
    run: MovingRun[CaseT, BeamCells],
    folder: Path | None = None,
    end: float | None = None,
    write_every: float | None = None,
) -> None:
    """Write what controls a run; its end may differ from that of an earlier start.

    Parameters
    ----------
    folder
        Folder, by default that of the run.
    end
        End (c/V), by default that of the case.
    write_every
        Interval of the states (c/V), by default that of every run.
    """
    case = run.case
    entries = plate_control(
        "pimpleFoam",
        end or case.duration,
        case.time_step,
        write_every or STATE_INTERVAL,
        run.mesh.span,
    )
    entries["libs"] = ['"liblumpedPointMotion.so"']
    solution = flow.unsteady_solution(run.coupling)
    of_outline = isinstance(run.mesh, OutlineBeamMesh)
    solution["solvers"] |= motion_solvers(of_outline=of_outline)
    schemes = flow.schemes(steady=False)
    schemes["laplacianSchemes"] |= motion_schemes()
    write_system(folder or run.folder, entries, schemes, solution)


def last_common_state(folder: Path) -> float:
    """Return the time of the last state that is whole on all ranks; drop what is later."""
    start = min(drop_broken_states(part) for part in parts(folder))
    for part in parts(folder):
        drop_states_after(part, start)
    drop_histories_after(folder, start)
    return start


class _Exchange:
    """The structure's side of a run, from its start or resumption to its end."""

    def __init__(
        self, run: PlateRun, structure: Staggered, pipes: Pipes, start: float, tell: Tell
    ) -> None:
        self._run, self._structure, self._pipes, self._tell = run, structure, pipes, tell
        self._due = Every(LOOKS_EVERY, last_look(start))
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
        if not self._due.is_due(time):
            return False
        case = self._run.case
        so_far = self._run.history()
        self._iterations.look(so_far.time, so_far.lift, so_far.moment)
        history = so_far.sampled(case.time_step, case.output_interval, last_look(time))
        return is_decided(case, self._run.tip_motion(history))
