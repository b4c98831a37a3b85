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
from equisection.motion.strip_system import diagonal, mass_with_air

Floats = NDArray[np.float64]

#: Step of the time integration, and interval of histories (c/V).
BEAM_STEP = 0.1
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
        self._torsion_modes, bending_modes = int(self._f.shape[0]), int(self._g.shape[0])
        self._modes = int(self._torsion_modes + bending_modes)
        self._stiffness: Floats = diagonal(
            np.concatenate([structure.torsion_stiffness, structure.bending_stiffness], axis=1)
        )
        self._damping = np.zeros_like(self._stiffness)
        self._damping[:, : self._torsion_modes, : self._torsion_modes] = structure.torsion_damping
        self._damping[:, self._torsion_modes :, self._torsion_modes :] = structure.bending_damping
        none = np.zeros((self._modes, self._f.shape[1]))
        on_strips = np.concatenate([self._f, np.zeros_like(self._g)])
        self._to_twist_rate = np.concatenate([none, on_strips])
        of_bending = np.concatenate([np.zeros_like(self._f), self._g])
        self._to_incidence = np.concatenate([on_strips, REAR_POINT * on_strips - of_bending])

    @property
    def swings_along(self) -> NDArray[np.intp]:
        """Places of the bending modes that swing along with the pitch of the first beam.

        These are the first one and those up to :data:`SWINGS_ALONG` of the torsion's frequency.
        """
        _, bending = np.split(self._natural[0], [self._torsion_modes])
        along = bending <= SWINGS_ALONG * self._natural[0, 0]
        along[0] = True
        return np.flatnonzero(along)

    @property
    def natural_frequencies(self) -> Floats:
        """Frequencies f c/V of the first torsion mode, then of the bending modes that swing along.

        They have the shape (N, 1 + bending modes).
        """
        places = np.concatenate([[0], self._torsion_modes + self.swings_along])
        return np.asarray(self._natural[:, places] / (2.0 * math.pi))

    @property
    def _natural(self) -> Floats:
        """Frequencies omega c/V of the modes without imbalance, shape (N, m)."""
        structure = self.parameters.structure
        squares = (
            structure.torsion_stiffness / structure.torsion_inertia,
            structure.bending_stiffness / structure.bending_mass,
        )
        return np.sqrt(np.concatenate(squares, axis=1))

    def rates(self, state: Floats) -> Floats:
        """Return the rates of the states (q, q', x), shape (N, n), with q = (Theta, W)."""
        modes = self._modes
        motion, lag = state[:, : 2 * modes], state[:, 2 * modes :]
        load, a = self._loads(motion, lag)
        pushed = load[..., None] - self._stiffness @ motion[:, :modes, None]
        pushed = pushed - self._damping @ motion[:, modes:, None]
        return np.concatenate(
            [motion[:, modes:], (self._inverse @ pushed)[..., 0], self.loads.rate * (a - lag)],
            axis=1,
        )

    def _loads(self, motion: Floats, lag: Floats) -> tuple[Floats, Floats]:
        """Return the loads on the modes (q, q'), shape (N, m), and the incidences a, (N, S)."""
        twist_rate, a = motion @ self._to_twist_rate, self._incidence_of(motion)
        lift, moment = self.loads.coefficients(a, twist_rate, lag)
        lift = lift + APPARENT_MASS * twist_rate
        return np.concatenate([moment @ self._by_moment, lift @ self._by_lift], axis=1), a

    def _incidence_of(self, motion: Floats) -> Floats:
        return np.asarray(motion @ self._to_incidence, dtype=np.float64)

    @property
    def _size(self) -> int:
        return 2 * self._modes + int(self._f.shape[1])

    def released(self, duration: float, time_step: float = BEAM_STEP) -> LearntSwings:
        """Release all beams at rest from steady flow.

        Modes and lags go exactly as under loads and incidences that are linear over a step. The
        loads at its end are extrapolated, computed, and computed again for the motion that
        follows: second order in the step, and stable however stiff the highest modes are.

        Parameters
        ----------
        duration
            Time (c/V).
        time_step
            Step, and interval of the histories (c/V).
        """
        lanes, modes = self.parameters.structure.lanes, self._modes
        count, strips = max(round(duration / time_step), 1), self._f.shape[1]
        free, before, after = self._over_a_step(time_step)
        decay = math.exp(-self.loads.rate * time_step)
        mean = (1.0 - decay) / (self.loads.rate * time_step)
        record = np.zeros((count + 1, lanes, modes))
        least, most = np.zeros((2, lanes))
        motion, lag = np.zeros((lanes, 2 * modes, 1)), np.zeros((lanes, strips))
        a = np.zeros_like(lag)
        load = self._loads(motion[..., 0], lag)[0]
        earlier = load
        with np.errstate(invalid="ignore", over="ignore"):  # a beam that left the polars
            for n in range(count):
                known, lag_known = free @ motion + before @ load[..., None], decay * lag
                lag_known = lag_known + (mean - decay) * a
                reached = 2.0 * load - earlier
                earlier = load
                for _ in range(2):
                    motion = known + after @ reached[..., None]
                    a = self._incidence_of(motion[..., 0])
                    lag = lag_known + (1.0 - mean) * a
                    reached, _ = self._loads(motion[..., 0], lag)
                load = reached
                record[n + 1] = motion[:, :modes, 0]
                least = np.fmin(least, a.min(axis=1))
                most = np.fmax(most, a.max(axis=1))
                if not np.isfinite(load).any():
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

    def _over_a_step(self, step: float) -> tuple[Floats, Floats, Floats]:
        """Return what state, load at the beginning and load at the end make of (q, q') in a step.

        The matrices have the shapes (N, 2 m, 2 m), (N, 2 m, m) and (N, 2 m, m).
        """
        lanes, modes = self.parameters.structure.lanes, self._modes
        one = np.eye(modes)
        rates = np.zeros((lanes, 4 * modes, 4 * modes))
        rates[:, :modes, modes : 2 * modes] = one
        rates[:, modes : 2 * modes, :modes] = -self._inverse @ self._stiffness
        rates[:, modes : 2 * modes, modes : 2 * modes] = -self._inverse @ self._damping
        rates[:, modes : 2 * modes, 2 * modes : 3 * modes] = self._inverse
        rates[:, 2 * modes : 3 * modes, 3 * modes :] = one / step
        whole = scipy.linalg.expm(rates * step)[:, : 2 * modes]
        rise = whole[:, :, 3 * modes :]
        return whole[:, :, : 2 * modes], whole[:, :, 2 * modes : 3 * modes] - rise, rise

    def equilibria(self) -> Floats:
        """Return Theta and W of static equilibrium, shape (N, n_t + n_b).

        Where Newton's method finds none inside the polars they are NaN.
        """
        structure = self.parameters.structure
        found = np.full((structure.lanes, self._modes), np.nan)
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
                _, by = self.loads.slopes(a)
                slope = by[0] + by[2]
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
        modes, size = self._modes, self._size
        unit = np.eye(size)  # of (q, q', x); rows are states
        motion, lag = unit[:, : 2 * modes], unit[:, 2 * modes :]
        incidence, twist_rate = motion @ self._to_incidence, motion @ self._to_twist_rate
        lift, moment = (
            slopes[0] * incidence + slopes[1] * twist_rate + slopes[2] * lag
            for slopes in self.loads.slopes(theta @ self._f)
        )
        lift = lift + APPARENT_MASS * twist_rate
        load = np.concatenate([moment @ self._by_moment, lift @ self._by_lift], axis=1)
        pushed = load - motion[:, :modes] @ self._stiffness[lane].T
        pushed = pushed - motion[:, modes:] @ self._damping[lane].T
        lags = self.loads.rate * (incidence - lag)
        return np.concatenate([motion[:, modes:], pushed @ self._inverse[lane].T, lags], axis=1).T
