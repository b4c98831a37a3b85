"""Beams with learnt loads on their strips: released, many at once, and linearised about their rest.

The equations of motion are those of :mod:`equisection.motion.strip_system` with the loads of
:mod:`equisection.aerodynamics.learnt_strips`: with f and g the shapes at the strips, h_s the shares
of these in the span, and the apparent mass on the left,

    (I + I_a) Theta'' - S W''   = sum_s h_s f_s c_m,s - C Theta' - K Theta,
    (m + M_a) W'' - S^T Theta'' = sum_s h_s g_s (c_l,s + (pi/2) theta_s') - c W' - k W.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.aerodynamics.learnt_strips import REAR_POINT, LearntStrips
from equisection.aerodynamics.unsteady_loads import APPARENT_MASS
from equisection.motion.beam_lesson import require_learnable
from equisection.motion.beams import BeamParameters
from equisection.motion.learnt_motion import TIME_STEP
from equisection.motion.strip_system import mass_with_air

Floats = NDArray[np.float64]

#: Largest step times frequency (rad) at which Runge and Kutta's method is stable with a margin.
_LARGEST_ANGLE = 2.0
_STEPS_OF_NEWTON = 60
#: Frequency of a bending mode over that of the first torsion mode up to which it swings along.
SWINGS_ALONG = 1.5


@dataclass(frozen=True, eq=False)
class LearntSwings:
    """Motion of the modes of N beams, NaN after the end of one that left the polars.

    Attributes
    ----------
    time
        s (c/V), shape (n,).
    torsion, bending
        Theta_i (rad) and W_j (chords), shape (n, N, n_t) and (n, N, n_b).
    farthest
        Least and greatest incidence of any strip (rad), shape (N, 2).
    ends
        End of each history (c/V), shape (N,).
    """

    time: Floats
    torsion: Floats
    bending: Floats
    farthest: Floats
    ends: Floats


class LearntBeams:
    """N beams in their flow with the loads of one model.

    Parameters
    ----------
    parameters
        Modes of the beams at the strips of the model.
    loads
        The learnt loads.

    Raises
    ------
    ResultFileError
        The axis of the beams is off mid-chord.
    """

    def __init__(self, parameters: BeamParameters, loads: LearntStrips) -> None:
        require_learnable(parameters, "3d")
        self.loads = loads
        self.parameters = parameters
        structure = parameters.structure
        self._f, self._g = structure.torsion_shapes.T, structure.bending_shapes.T
        self._by_moment = structure.weights[:, None] * structure.torsion_shapes
        self._by_lift = structure.weights[:, None] * structure.bending_shapes
        inertia, mass, across, back = mass_with_air(structure)
        whole = np.block([[inertia, across], [back, mass]])
        self._inverse = np.linalg.inv(np.broadcast_to(whole, (structure.lanes, *whole.shape[1:])))
        self._torsion_modes = self._f.shape[0]

    @property
    def natural_frequencies(self) -> Floats:
        """Frequencies f c/V of the first torsion mode and the bending modes that swing along.

        These are the first one and those up to :data:`SWINGS_ALONG` of the torsion's frequency, of
        the first beam; shape (N, 1 + bending modes).
        """
        structure = self.parameters.structure
        torsion = np.sqrt(structure.torsion_stiffness[:, :1] / structure.torsion_inertia[:, :1])
        bending = np.sqrt(structure.bending_stiffness / structure.bending_mass)
        along = bending[0] <= SWINGS_ALONG * torsion[0]
        along[0] = True
        return np.concatenate([torsion, bending[:, along]], axis=1) / (2.0 * math.pi)

    def rates(self, state: Floats) -> Floats:
        """Return the rates of the states (Theta, W, Theta', W', x), shape (N, n)."""
        theta, w, theta_1, w_1, lag = self._parts(state)
        twist_rate = theta_1 @ self._f
        a = self._incidence(theta, w_1, twist_rate)
        lift, moment = self.loads.coefficients(a, twist_rate, lag)
        structure = self.parameters.structure
        torque = (
            moment @ self._by_moment
            - structure.torsion_stiffness * theta
            - np.einsum("nij,nj->ni", structure.torsion_damping, theta_1)
        )
        force = (
            (lift + APPARENT_MASS * twist_rate) @ self._by_lift
            - structure.bending_stiffness * w
            - np.einsum("nij,nj->ni", structure.bending_damping, w_1)
        )
        pushed = np.concatenate([torque, force], axis=1)
        accelerations = np.einsum("nij,nj->ni", self._inverse, pushed)
        return np.concatenate(
            [theta_1, w_1, accelerations, self.loads.rate * (a - lag)], axis=1
        )

    def _incidence(self, theta: Floats, w_1: Floats, twist_rate: Floats) -> Floats:
        return theta @ self._f - w_1 @ self._g + REAR_POINT * twist_rate

    def _parts(self, state: Floats) -> list[Floats]:
        torsion, bending = self._torsion_modes, self._g.shape[0]
        both = torsion + bending
        return np.split(state, [torsion, both, both + torsion, 2 * both], axis=1)

    @property
    def _size(self) -> int:
        return 2 * (self._torsion_modes + self._g.shape[0]) + self._f.shape[1]

    def released(self, duration: float, time_step: float = TIME_STEP) -> LearntSwings:
        """Release all beams at rest from steady flow (Runge and Kutta, fourth order).

        Parameters
        ----------
        duration
            Time (c/V).
        time_step
            Interval of the histories (c/V); steps are parts of it where the modes are stiff.
        """
        structure = self.parameters.structure
        lanes, both = structure.lanes, self._torsion_modes + self._g.shape[0]
        squares = np.concatenate(
            [
                structure.torsion_stiffness / structure.torsion_inertia,
                structure.bending_stiffness / structure.bending_mass,
            ],
            axis=1,
        )
        parts = math.ceil(time_step * math.sqrt(float(squares.max())) / _LARGEST_ANGLE)
        count, step = max(round(duration / time_step), 1), time_step / parts
        state = np.zeros((lanes, self._size))
        record = np.empty((count + 1, lanes, both))
        record[0] = 0.0
        least, most = np.zeros((2, lanes))
        with np.errstate(invalid="ignore", over="ignore"):  # a beam that left the polars
            for n in range(count):
                for _ in range(parts):
                    state = self._stepped(state, step)
                record[n + 1] = state[:, :both]
                theta, _, theta_1, w_1, _ = self._parts(state)
                a = self._incidence(theta, w_1, theta_1 @ self._f)
                least = np.fmin(least, a.min(axis=1))
                most = np.fmax(most, a.max(axis=1))
                if not np.isfinite(state).any():
                    record[n + 2 :] = np.nan
                    break
        time = time_step * np.arange(count + 1, dtype=np.float64)
        valid = np.isfinite(record).all(axis=2)
        return LearntSwings(
            time=time,
            torsion=record[:, :, : self._torsion_modes],
            bending=record[:, :, self._torsion_modes :],
            farthest=self.loads.incidence_rad + np.stack([least, most], axis=1),
            ends=time[np.maximum(valid.sum(axis=0) - 1, 0)],
        )

    def _stepped(self, state: Floats, step: float) -> Floats:
        first = self.rates(state)
        second = self.rates(state + 0.5 * step * first)
        third = self.rates(state + 0.5 * step * second)
        last = self.rates(state + step * third)
        return state + step / 6.0 * (first + 2.0 * second + 2.0 * third + last)

    def equilibria(self) -> Floats:
        """Return Theta and W of static equilibrium, shape (N, n_t + n_b).

        Where Newton's method finds none inside the polars they are NaN.
        """
        structure = self.parameters.structure
        found = np.full((structure.lanes, self._torsion_modes + self._g.shape[0]), np.nan)
        least, most = np.subtract(self.loads.polars.incidence_range, self.loads.incidence_rad)
        none = np.zeros((1, self._f.shape[1]))
        for lane in range(structure.lanes):
            stiffness = structure.torsion_stiffness[lane]
            theta = np.zeros(self._torsion_modes)
            for _ in range(_STEPS_OF_NEWTON):
                a = theta @ self._f
                if not (least <= a.min() and a.max() <= most):
                    break
                lift, moment = self.loads.coefficients(a[None], none, a[None])
                slope = self.loads.slopes(a)[1][0] + self.loads.slopes(a)[1][2]
                missing = moment[0] @ self._by_moment - stiffness * theta
                matrix = np.diag(stiffness) - (self._f * slope) @ self._by_moment
                change = np.linalg.solve(matrix.T, missing)
                theta = theta + change
                if np.abs(change).max() < 1e-12:
                    w = lift[0] @ self._by_lift / structure.bending_stiffness[lane]
                    found[lane] = np.concatenate([theta, w])
                    break
        return found

    def eigenvalues(self) -> NDArray[np.complex128]:
        """Return the eigenvalues p (V/c) about the equilibria, shape (N, n); NaN without one.

        The loads are linearised at rest, so that these are the rates of small motions.
        """
        lanes = self.parameters.structure.lanes
        found = np.full((lanes, self._size), np.nan, dtype=complex)
        for lane, rest in enumerate(self.equilibria()):
            if np.isfinite(rest).all():
                found[lane] = scipy.linalg.eigvals(self._matrix(lane, rest[: self._torsion_modes]))
        return found

    def _matrix(self, lane: int, theta: Floats) -> Floats:
        """Return the matrix of the small motions of a beam about its equilibrium."""
        structure, size = self.parameters.structure, self._size
        parts = self._parts(np.eye(size))  # of (Theta, W, Theta', W', x), rows are states
        twist_rate = parts[2] @ self._f
        incidence = self._incidence(parts[0], parts[3], twist_rate)
        by_lift, by_moment = (
            slopes[0] * incidence + slopes[1] * twist_rate + slopes[2] * parts[4]
            for slopes in self.loads.slopes(theta @ self._f)
        )
        torque = (
            by_moment @ self._by_moment
            - parts[0] * structure.torsion_stiffness[lane]
            - parts[2] @ structure.torsion_damping[lane].T
        )
        force = (
            (by_lift + APPARENT_MASS * twist_rate) @ self._by_lift
            - parts[1] * structure.bending_stiffness[lane]
            - parts[3] @ structure.bending_damping[lane].T
        )
        accelerations = np.concatenate([torque, force], axis=1) @ self._inverse[lane].T
        lags = self.loads.rate * (incidence - parts[4])
        return np.concatenate([parts[2], parts[3], accelerations, lags], axis=1).T
