"""Time integration of the strip system, exact but for the deficits.

With Y' = A Y + B u + e the matrix exponential over a step h, for deficits u that vary linearly
over the step ("first-order hold", Franklin, Powell & Workman, *Digital Control of Dynamic
Systems*, section 4.3), gives

    Y_1 = Phi Y_0 + Gamma_0 u_0 + Gamma_1 u_1 + e_h.

Structure, Wagner lags, bubble lags and apparent mass are therefore integrated exactly at any
step: no mode is too stiff, and a linear polar has no time-step error at all. u_1 follows from
x_1 = C Y_1 + E u_1 + g, a small fixed-point problem in the signals of the strips: started from
the extrapolation of u and iterated twice, which is second order in h.

Lanes never mix, so a lane that fails (its bubble leaves the polar: NaN) or is stopped leaves the
batch, and the others go on to the same last bit.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.motion.strip_system import StripSystem

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

CORRECTIONS = 2
"""Fixed-point iterations a step for the deficits."""

MONITOR_INTERVAL = 5.0
"""Convective times between two calls of a monitor."""

Monitor = Callable[["Recording", Indices], Indices]
"""Called with the recording so far and the lanes still running; returns the lanes to stop."""

Progress = Callable[[float, float], None]
"""Called with the convective time done and the whole duration."""


@dataclass(frozen=True)
class Failure:
    """A lane whose bubble left the polar: lane number, time s, incidence there (rad)."""

    lane: int
    time: float
    incidence_rad: float


@dataclass
class Recording:
    """Recorded output of N lanes, in the order of the rows of the output matrix.

    Parameters
    ----------
    time
        s, shape (n_times,).
    values
        Shape (n_times, N, n_out); NaN after the end of a lane.
    samples
        Number of valid times of each lane, shape (N,).
    recorded
        Number of times reached by the run as a whole.
    failures
        Lanes that left the polar.
    """

    time: Floats
    values: Floats
    samples: Indices
    recorded: int
    failures: list[Failure]


@dataclass(frozen=True)
class _Stepper:
    """One step for all running lanes: state part and deficit part of the columns."""

    from_old: Floats
    from_new: Floats
    probe_state: Floats
    probe_new: Floats

    def of(self, lanes: Indices) -> _Stepper:
        """Keep some of the lanes."""
        return _Stepper(
            self.from_old[lanes],
            self.from_new[lanes],
            self.probe_state[lanes],
            self.probe_new[lanes],
        )


def _stepper(system: StripSystem, step: float) -> _Stepper:
    n = system.layout.size
    lanes, _, columns = system.rates.shape
    m = columns - n - 1
    exponent = np.zeros((lanes, columns + m, columns + m))
    exponent[:, :n, :columns] = step * system.rates
    exponent[:, n : n + m, columns:] = np.eye(m)  # u grows by its change over the step
    phi = np.stack([scipy.linalg.expm(matrix) for matrix in exponent])[:, :n]
    from_new = phi[:, :, columns:]
    from_old = phi[:, :, :columns].copy()
    from_old[:, :, n : n + m] -= from_new
    probe_state = np.concatenate([system.probe[:, :, :n], system.probe[:, :, -1:]], axis=2)
    probe_new = system.probe[:, :, :n] @ from_new + system.probe[:, :, n:-1]
    return _Stepper(from_old, from_new, probe_state, probe_new)


def _times(matrices: Floats, vectors: Floats) -> Floats:
    """Product lane by lane, (N, a, b) with (N, b)."""
    product: Floats = np.matmul(matrices, vectors[:, :, None])[:, :, 0]
    return product


def march(
    system: StripSystem,
    start: tuple[Floats, Floats],
    outputs: Floats,
    *,
    duration: float,
    time_step: float,
    output_interval: float,
    monitor: Monitor | None = None,
    progress: Progress | None = None,
) -> Recording:
    """Integrate all lanes from ``start`` = (Y, u) and record ``outputs`` @ [Y | u | 1].

    Parameters
    ----------
    system
        The assembled lanes.
    start
        States (N, n) and deficits (N, d S) at s = 0.
    outputs
        Rows to record, shape (N, n_out, n + d S + 1).
    duration, time_step, output_interval
        Convective times; the step is shortened to divide the output interval.
    monitor, progress
        Called every ``MONITOR_INTERVAL``.
    """
    substeps = math.ceil(output_interval / time_step - 1e-9)
    step = output_interval / substeps
    count = 1 + math.ceil(duration / output_interval - 1e-9)
    lanes = start[0].shape[0]
    recording = Recording(
        time=np.asarray(output_interval * np.arange(count), dtype=np.float64),
        values=np.full((count, lanes, outputs.shape[1]), np.nan),
        samples=np.zeros(lanes, dtype=np.intp),
        recorded=0,
        failures=[],
    )
    whole = _stepper(system, step)
    run = _Run(system, whole, np.arange(lanes), start[0].copy(), start[1].copy())
    run.drop_lost_at_start(recording.failures)
    monitored = max(1, round(MONITOR_INTERVAL / output_interval))
    for sample in range(count):
        if sample:
            run.advance(substeps, recording.time[sample - 1], step, recording.failures)
        active = run.active
        if not active.size:
            break
        columns = np.concatenate([run.states, run.deficits, np.ones((active.size, 1))], axis=1)
        recorded_rows = outputs if active.size == lanes else outputs[active]
        recording.values[sample, active] = _times(recorded_rows, columns)
        recording.samples[active] = sample + 1
        recording.recorded = sample + 1
        if sample % monitored == 0 or sample == count - 1:
            if progress is not None:
                progress(float(recording.time[sample]), float(recording.time[-1]))
            if monitor is not None and sample:
                run.keep(~np.isin(active, monitor(recording, active)))
    return recording


class _Run:
    """The running lanes of a march and their present state."""

    def __init__(
        self,
        system: StripSystem,
        whole: _Stepper,
        active: Indices,
        states: Floats,
        deficits: Floats,
    ) -> None:
        self._system = system
        self._stepper = whole
        self.active = active
        self.states = states
        self.deficits = deficits
        self._earlier = deficits

    def keep(self, which: NDArray[np.bool_]) -> None:
        """Go on with some of the running lanes only."""
        if which.all():
            return
        chosen = np.flatnonzero(which)
        self._stepper = self._stepper.of(chosen)
        self.active = self.active[chosen]
        self.states = self.states[chosen]
        self.deficits = self.deficits[chosen]
        self._earlier = self._earlier[chosen]

    def drop_lost_at_start(self, failures: list[Failure]) -> None:
        """Drop lanes whose starting state is not inside the polar."""
        lost = np.asarray(~np.isfinite(self.deficits).all(axis=1))
        for lane in np.flatnonzero(lost):
            failures.append(Failure(int(lane), 0.0, float(self._system.incidence[lane])))
        self.keep(~lost)

    def advance(self, substeps: int, time: float, step: float, failures: list[Failure]) -> None:
        """Take ``substeps`` steps from ``time``; lanes that leave the polar drop out."""
        for number in range(1, substeps + 1):
            if not self.active.size:
                return
            x = self._step()
            if math.isfinite(float(np.sum(self.deficits))):
                continue
            lost = np.asarray(~np.isfinite(self.deficits).all(axis=1))
            for row in np.flatnonzero(lost):
                at = x[row, : self._system.layout.strips]
                worst = float(at[np.argmax(np.abs(at))])
                failures.append(Failure(int(self.active[row]), float(time + number * step), worst))
            self.keep(~lost)

    def _step(self) -> Floats:
        stepper, system = self._stepper, self._system
        ones = np.ones((self.active.size, 1))
        old = np.concatenate([self.states, self.deficits, ones], axis=1)
        states = _times(stepper.from_old, old)
        known = _times(stepper.probe_state, np.concatenate([states, ones], axis=1))
        deficits = 2.0 * self.deficits - self._earlier
        x = guess = known + _times(stepper.probe_new, deficits)
        for correction in range(CORRECTIONS):
            if correction:
                x = known + _times(stepper.probe_new, deficits)
            deficits = system.deficits(x)
        self.states = states + _times(stepper.from_new, deficits)
        self._earlier, self.deficits = self.deficits, deficits
        return np.where(np.isfinite(x), x, guess)  # NaN deficits make a corrected x NaN
