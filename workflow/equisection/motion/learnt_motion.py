"""Sections with learnt loads: released, many at once, and linearised about their equilibrium.

With the elastic axis x chords behind mid-chord, M_a the apparent mass pi/2 and I_a the apparent
inertia pi/64, c_l and c_m the learnt loads without them (:mod:`..aerodynamics.learnt_loads`),

    (m + M_a) w''            + (-S + M_a x) theta''             = F - c_w w' - k_w w,
    (-S + M_a x) w'' + (I + I_a + M_a x^2) theta'' = c_m + x (F + r) - c_theta theta' - k theta,
    F = c_l + M_a theta',

r = c_l (cos alpha - 1) + c_d sin alpha from the polar, and the incidence at mid-chord is
theta_0 + theta - (w + x theta)'.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.learnt_loads import LearntLoads
from equisection.aerodynamics.unsteady_loads import APPARENT_INERTIA, APPARENT_MASS
from equisection.beam.section import Section
from equisection.motion.static_branch import StaticBranch

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

#: Step of the time integration, and interval of histories (c/V).
TIME_STEP = 0.1
#: Half-width (rad) of the difference that the slope of what an offset axis adds is taken over.
_HALF_WIDTH = 1e-3


@dataclass(frozen=True, eq=False)
class LearntHistories:
    """Histories of N sections, NaN after the end of one that left the polar.

    Attributes
    ----------
    time
        s (c/V), shape (n,).
    twist, deflection
        theta (rad) and w/c, shape (n, N).
    farthest
        Least and greatest incidence (rad), shape (N, 2).
    ends
        End of each history (c/V), shape (N,).
    """

    time: Floats
    twist: Floats
    deflection: Floats
    farthest: Floats
    ends: Floats


class LearntSections:
    """N sections in their flow with the loads of one model.

    Parameters
    ----------
    sections
        The sections (:meth:`equisection.beam.section.Section.in_flow`), with or without correction.
    loads
        The learnt loads.
    """

    def __init__(self, sections: Sequence[Section], loads: LearntLoads) -> None:
        for section in sections:
            section.require_in_flow()
        self.loads = loads
        self.sections = tuple(sections)
        self._axis = _members(sections, "axis_behind_mid_chord")
        self._damping = [
            _members(sections, f"{kind}_damping") for kind in ("flexural", "torsional")
        ]
        self._stiffness = [
            _members(sections, f"{kind}_stiffness") for kind in ("flexural", "torsional")
        ]
        mass = np.array([section.mass_matrix for section in sections])
        mass[:, 0, 0] += APPARENT_MASS
        mass[:, 0, 1] += APPARENT_MASS * self._axis
        mass[:, 1, 0] += APPARENT_MASS * self._axis
        mass[:, 1, 1] += APPARENT_INERTIA + APPARENT_MASS * self._axis**2
        self._inverse = np.linalg.inv(mass)

    def rates(self, state: Floats) -> Floats:
        """Return the rates of the states (w, theta, w', theta', x), shape (5, N)."""
        w, theta, w_rate, theta_rate, lag = state
        a = theta - w_rate - self._axis * theta_rate
        lift, moment = self.loads.coefficients(a, theta_rate, lag)
        lift = lift + APPARENT_MASS * theta_rate
        if self._axis.any():
            rise = self.loads.polar.normal_rise(self.loads.incidence_rad + a)
            moment = moment + self._axis * (lift + rise)
        up = lift - self._damping[0] * w_rate - self._stiffness[0] * w
        turn = moment - self._damping[1] * theta_rate - self._stiffness[1] * theta
        inverse = self._inverse
        return np.array(
            [
                w_rate,
                theta_rate,
                inverse[:, 0, 0] * up + inverse[:, 0, 1] * turn,
                inverse[:, 1, 0] * up + inverse[:, 1, 1] * turn,
                self.loads.rate * (a - lag),
            ]
        )

    def released(
        self,
        duration: float,
        time_step: float = TIME_STEP,
        start: tuple[float, float] = (0.0, 0.0),
    ) -> LearntHistories:
        """Release all sections from steady flow (Runge and Kutta, fourth order).

        Parameters
        ----------
        duration
            Time (c/V).
        time_step
            Step, and interval of the histories (c/V).
        start
            Twist (rad) in which the tip is held until the release, and heave rate (over V) of the
            tip then; each section has them by its recovery factors.
        """
        count = max(round(duration / time_step), 1)
        state = np.zeros((5, len(self.sections)))
        state[1] = state[4] = start[0] * _members(self.sections, "twist_recovery")
        state[2] = start[1] * _members(self.sections, "deflection_recovery")
        record = np.empty((count + 1, 2, len(self.sections)))
        record[0] = state[1::-1]
        least, most = state[1].copy(), state[1].copy()
        with np.errstate(invalid="ignore", over="ignore"):  # a section that left the polar
            for n in range(count):
                first = self.rates(state)
                second = self.rates(state + 0.5 * time_step * first)
                third = self.rates(state + 0.5 * time_step * second)
                last = self.rates(state + time_step * third)
                state = state + time_step / 6.0 * (first + 2.0 * second + 2.0 * third + last)
                record[n + 1] = state[1::-1]
                a = state[1] - state[2] - self._axis * state[3]
                least, most = np.fmin(least, a), np.fmax(most, a)
                if not np.isfinite(state).any():
                    record[n + 2 :] = np.nan
                    break
        time = time_step * np.arange(count + 1, dtype=np.float64)
        valid = np.isfinite(record).all(axis=1)
        return LearntHistories(
            time=time,
            twist=record[:, 0],
            deflection=record[:, 1],
            farthest=self.loads.incidence_rad + np.stack([least, most], axis=1),
            ends=time[np.maximum(valid.sum(axis=0) - 1, 0)],
        )

    def equilibria(self) -> Floats:
        """Return twist (rad) and deflection (chords) of static equilibrium, shape (2, N).

        They are those on the branch that comes from rest (:mod:`..motion.static_branch`), and NaN
        beyond its end.
        """
        polar, rigid = self.loads.polar, self.loads.incidence_rad
        twist = np.full(len(self.sections), np.nan)
        for axis in np.unique(self._axis):
            here = self._axis == axis
            branch = StaticBranch.from_rest(polar, rigid, float(axis))
            twist[here] = branch.incidence(self._stiffness[1][here]) - rigid
        lift = polar.lift_coefficient(rigid + twist)
        return np.stack([twist, lift / self._stiffness[0]])

    def eigenvalues(self) -> NDArray[np.complex128]:
        """Return the eigenvalues p (V/c) about the equilibria, shape (N, 5); NaN without one.

        The loads are linearised at rest, so that these are the rates of small motions.
        """
        found = np.full((len(self.sections), 5), np.nan, dtype=complex)
        linear = self.linearised()
        there = np.isfinite(linear).all(axis=(1, 2))
        if there.any():
            found[there] = np.linalg.eigvals(linear[there])
        return found

    def linearised(self) -> Floats:
        """Return the matrices of small motions (w, theta, w', theta', x) about the equilibria.

        Their shape is (N, 5, 5); NaN of a section without an equilibrium.
        """
        found = np.full((len(self.sections), 5, 5), np.nan)
        for lane, theta in enumerate(self.equilibria()[0]):
            if math.isfinite(theta):
                found[lane] = self._matrix(lane, float(theta))
        return found

    def influence(self, twist: Floats) -> Callable[[Complexes], Complexes]:
        """Return the loads Q of small motions q exp(p s) about equilibria (rad), shape (N,).

        Rows are lift and moment about the elastic axis, columns heave and twist, as
        :func:`equisection.motion.mechanism.instabilities` has them; apparent mass that does no work
        is left out.
        """
        by_motion = [self._loads_of(lane, float(theta)) for lane, theta in enumerate(twist)]
        rows = np.array(by_motion)  # by (a, theta', x)

        def loads(p: Complexes) -> Complexes:
            incidence = np.stack([-p, 1.0 - p * self._axis], axis=-1)
            turning = np.stack([np.zeros_like(p), p], axis=-1)
            lag = (self.loads.rate / (p + self.loads.rate))[:, None] * incidence
            parts = np.stack([incidence, turning, lag], axis=1)
            return np.asarray(rows @ parts)

        return loads

    def _loads_of(self, lane: int, theta: float) -> Floats:
        """Return the slopes of lift and moment about the axis by (a, theta', x), shape (2, 3)."""
        axis = float(self._axis[lane])
        lift, moment = self.loads.slopes(theta)
        lift = lift + np.array([0.0, APPARENT_MASS, 0.0])
        if axis:
            moment = moment + axis * (lift + self._slope_of_rise(theta) * np.eye(3)[0])
        return np.array([lift, moment])

    def _matrix(self, lane: int, theta: float) -> Floats:
        """Return the matrix of the small motions of a section about its equilibrium."""
        axis = float(self._axis[lane])
        incidence = np.array([0.0, 1.0, -1.0, -axis, 0.0])  # of (w, theta, w', theta', x)
        lag, turning = np.eye(5)[4], np.eye(5)[3]
        loads = self._loads_of(lane, theta) @ np.stack([incidence, turning, lag])
        springs = np.zeros((2, 5))
        for place in (0, 1):
            springs[place, place] = self._stiffness[place][lane]
            springs[place, 2 + place] = self._damping[place][lane]
        accelerations = self._inverse[lane] @ (loads - springs)
        return np.vstack(
            [np.eye(5)[2], np.eye(5)[3], accelerations, self.loads.rate * (incidence - lag)]
        )

    def _slope_of_rise(self, theta: float) -> float:
        alpha = self.loads.incidence_rad + theta
        ends = self.loads.polar.normal_rise(np.array([alpha - _HALF_WIDTH, alpha + _HALF_WIDTH]))
        return float(ends[1] - ends[0]) / (2.0 * _HALF_WIDTH)


def _members(sections: Sequence[Section], name: str) -> Floats:
    """Return a member of each section, shape (N,)."""
    return np.array([getattr(section, name) for section in sections], dtype=float)
