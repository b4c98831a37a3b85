"""The beam in prescribed motion of one of its modes, from the rigid steady flow on.

The mesh follows the lumped points as in a free run (:mod:`.coupled_run`); their places are those of
the motion, whatever the loads. With a mean twist the steady flow is that around the beam held in
it.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

from equisection.cases import BeamModes, ForcedCase
from equisection.files import write_text
from equisection.results.forced_result import ForcedResult, motion_of
from equisection.solvers.openfoam.beam.coupled_run import CoupledRun
from equisection.solvers.openfoam.beam.lumped_points import Handed, LumpedPoints
from equisection.solvers.openfoam.beam.pipes import Alive, Pipes
from equisection.solvers.openfoam.case_folder import is_ready
from equisection.solvers.openfoam.process import BlowUpError
from equisection.solvers.openfoam.reading.loads import BEYOND_REASON
from equisection.solvers.openfoam.rigid_flow import Tell
from equisection.solvers.openfoam.time_spent import spent

logger = logging.getLogger(__name__)

Floats = NDArray[np.float64]

#: Columns of a row of the history before the loads of the modes: time, C_L and C_M.
_BEFORE = 3


@dataclass(frozen=True)
class ForcedPlateRun(CoupledRun[ForcedCase]):
    """The run of one case of the plate in prescribed motion."""

    @property
    def history_file(self) -> Path:
        """File with the loads of each step."""
        return self.folder / "loads.txt"

    @cached_property
    def points(self) -> LumpedPoints:
        """The plate's modes at its lumped points; its structure has no part in the motion."""
        shapes = self.case.shapes
        assert shapes is not None
        modes = BeamModes(
            span=shapes.span,
            bending_frequency=(1.0,) * len(shapes.bending),
            bending_shape=shapes.bending,
            torsion_frequency=(1.0,) * len(shapes.torsion),
            torsion_shape=shapes.torsion,
            inertia=1.0,
            mass=1.0,
            elastic_axis=shapes.elastic_axis,
        )
        return LumpedPoints.of(modes, self.mesh.edges(), self.mesh.section.incidence)

    @property
    def first_position(self) -> Floats:
        """Position of the modes at time 0."""
        return self.position(0.0)

    def position(self, time: float) -> Floats:
        """Return the position of the modes at a time (c/V), torsion modes first."""
        position, torsion = np.zeros(self.points.frequency.size), self.points.torsion_modes
        twist, deflection = motion_of(self.case, time)
        if self.case.component == "pitch":
            position[self.case.mode - 1] = float(twist)
        else:
            position[torsion + self.case.mode - 1] = float(deflection)
        position[0] += math.radians(self.case.mean_twist_deg)
        return position

    def run(self, tell: Tell) -> ForcedResult:
        """Move the plate and record its loads.

        A case whose flow or mesh breaks down has a result with a ``failure``.

        Raises
        ------
        SolverError
            A program failed through no fault of the case, or the version of OpenFOAM is another.
        """
        failure = ""
        try:
            start = self.start(tell)
            if start < self.case.duration:
                self._go_on(start, tell)
        except BlowUpError as error:
            failure = str(error)
            if not is_ready(self.folder) or not self.history_file.exists():
                return ForcedResult.without_history(failure)
        return self._result(failure)

    def _go_on(self, start: float, tell: Tell) -> None:
        self._keep_until(start - 0.5 * self.case.time_step)
        self.exchange(start, lambda pipes: _Moving(self, pipes, start, tell))

    def history(self) -> Floats:
        """Return time, C_L, C_M and the loads of the modes so far, shape (n, 3 + modes)."""
        width = _BEFORE + self.points.frequency.size
        text = self.history_file.read_text(encoding="ascii") if self.history_file.exists() else ""
        rows = [line.split() for line in text.splitlines(keepends=True) if line.endswith("\n")]
        return np.array(rows, dtype=np.float64).reshape(len(rows), width)

    def _keep_until(self, time: float) -> None:
        """Drop rows later than a time; the loads there are handed over anew."""
        kept = self.history()
        rows = kept[kept[:, 0] <= time]
        write_text(self.history_file, "".join(row_of(row) for row in rows))

    def _result(self, failure: str) -> ForcedResult:
        case, history = self.case, self.history()
        every = round(case.output_interval / case.time_step)
        rows = history[np.rint(history[:, 0] / case.time_step).astype(int) % every == 0]
        twist, deflection = motion_of(case, rows[:, 0])
        loads, torsion = rows[:, _BEFORE:].T, self.points.torsion_modes
        return ForcedResult(
            rows[:, 0],
            twist,
            deflection,
            rows[:, 1],
            rows[:, 2],
            failure,
            bending_load=loads[torsion:],
            torsion_load=loads[:torsion],
            spent=spent(self.work),
        )


def row_of(values: Floats) -> str:
    """Return numbers as a line of the history."""
    return " ".join(f"{value:.12g}" for value in values) + "\n"


class _Moving:
    """The side of a run that says where the points are, from its start or resumption to its end.

    In the first turn of a step the loads are those at its beginning.
    """

    def __init__(self, run: ForcedPlateRun, pipes: Pipes, start: float, tell: Tell) -> None:
        self._run, self._pipes, self._tell = run, pipes, tell
        self._at = start
        self._is_first = True

    def __call__(self, alive: Alive, end: Callable[[], None]) -> None:
        """Serve the program until it has ended."""
        del end
        with self._run.history_file.open("a", encoding="ascii") as stream:
            while (message := self._pipes.receive(alive)) is not None:
                if not self._pipes.send(self._answer(message, stream), alive):
                    break

    def _answer(self, message: str, stream: IO[str]) -> str:
        """Return the places of the points at the time that is handed over."""
        run = self._run
        handed = Handed.read(message, run.folder)
        place = run.position(self._at)
        if self._is_first:  # moments are about the points at rest then
            handed, self._is_first = handed.about(run.points.mid_chord(place)), False
        if handed.time > self._at + 0.5 * run.case.time_step:
            self._record(handed, place, stream)
            self._at = handed.time
            self._tell(self._at, run.case.duration)
        return run.points.message(run.position(self._at))

    def _record(self, handed: Handed, place: Floats, stream: IO[str]) -> None:
        """Write the loads at the beginning of a step, which are final."""
        points = self._run.points
        lift, moment = points.coefficients(handed.forces, handed.moments)
        if not max(abs(lift), abs(moment)) < BEYOND_REASON:
            raise BlowUpError(f"C_L {lift:.3g}, C_M {moment:.3g}")
        about_axis = points.about_axis(handed.forces, handed.moments, place)
        by_inertia = points.modal_loads(handed.forces, about_axis)
        loads = by_inertia * points.inertia / (0.5 * points.span)
        stream.write(row_of(np.array([self._at, lift, moment, *loads])))
        stream.flush()
