"""History of the structure of a coupled run, a row for each time step in a text file.

A row holds the whole state of the modes, so that the run can be taken up after any step, and the
loads on the plate. Its last number, where the elastic axis is off mid-chord, is the moment about
that. It is in the file before OpenFOAM goes on to the next step.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import IO

import numpy as np
from numpy.typing import NDArray

from equisection.errors import SolverError
from equisection.files import write_text
from equisection.motion.modal_response import ModalState

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class PlateHistory:
    """Motion and loads of the plate over convective time.

    Attributes
    ----------
    time
        s (c/V), shape (n,).
    position, velocity, load, earlier_load
        Of the modes, shape (n, modes): amplitudes and their rates, loads over inertia at this time
        and a step before.
    lift, moment
        C_L, and C_M about the moving mid-chords, shape (n,).
    axis_moment
        C_M about the moving elastic axis, shape (n,); NaN in a row without it.
    """

    time: Floats
    position: Floats
    velocity: Floats
    load: Floats
    earlier_load: Floats
    lift: Floats
    moment: Floats
    axis_moment: Floats

    def sampled(self, step: float, interval: float, end: float = math.inf) -> PlateHistory:
        """Return the samples up to an end at multiples of an interval, which is one of the step."""
        kept = np.rint(self.time / step).astype(int) % round(interval / step) == 0
        kept &= self.time < end + 0.5 * step
        return PlateHistory(*(getattr(self, name)[kept] for name in self.__dataclass_fields__))

    def state(self) -> ModalState | None:
        """Return the last state of the modes; None if there is none."""
        if not self.time.size:
            return None
        return ModalState(
            float(self.time[-1]),
            self.position[-1],
            self.velocity[-1],
            self.load[-1],
            self.earlier_load[-1],
        )


def read_plate(path: Path, modes: int) -> PlateHistory:
    """Return the history so far; a last row that is not whole is left out."""
    text = path.read_text(encoding="ascii") if path.exists() else ""
    rows = [line.split() for line in text.splitlines(keepends=True) if line.endswith("\n")]
    state = 3 + 4 * modes
    has_axis = bool(rows) and len(rows[0]) == state + 1
    values = np.array(rows, dtype=float).reshape(len(rows), state + has_axis)
    position, velocity, load, earlier = np.split(values[:, 3:state], 4, axis=1)
    time, lift, moment = values[:, :3].T
    about_axis = values[:, state] if has_axis else np.full(len(rows), math.nan)
    return PlateHistory(time, position, velocity, load, earlier, lift, moment, about_axis)


def keep_until(path: Path, time: float, modes: int) -> PlateHistory:
    """Drop rows later than a time, and return the rest."""
    history = read_plate(path, modes)
    lines = path.read_text(encoding="ascii").splitlines(keepends=True) if path.exists() else []
    write_text(path, "".join(lines[: int((history.time <= time).sum())]))
    return read_plate(path, modes)


def require_state(state: ModalState | None, start: float, step: float, folder: Path) -> None:
    """Refuse to go on from a state of the flow without the state of the structure a step before.

    Parameters
    ----------
    state
        The last state of the modes that is known before.
    start
        Time (c/V) of the flow's state.
    step
        Time step (c/V).
    folder
        Folder of the run.

    Raises
    ------
    SolverError
        There is no such state, or steps are missing in between.
    """
    if state is None or abs(state.time + step - start) > 0.5 * step:
        known = "nothing" if state is None else f"{state.time:g} c/V"
        raise SolverError(
            f"{folder}: the flow goes on from {start:g} c/V, the structure from {known}: steps are "
            f"missing in its history; delete {folder} and run again"
        )


def add_row(
    stream: IO[str],
    state: ModalState,
    lift: float,
    moment: float,
    axis_moment: float | None = None,
) -> None:
    """Add a row, and have it written; ``axis_moment`` is None for an axis at mid-chord."""
    vectors = (state.position, state.velocity, state.load, state.earlier_load)
    last = [] if axis_moment is None else [axis_moment]
    row = np.concatenate([[state.time, lift, moment], *vectors, last])
    stream.write(" ".join(f"{value:.17g}" for value in row) + "\n")
    stream.flush()
