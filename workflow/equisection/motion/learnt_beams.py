"""Beams with learnt loads on their strips: released, many at once, and linearised about their rest.

The equations of motion are those of :mod:`equisection.motion.strip_system` with the loads of
:mod:`equisection.aerodynamics.learnt_strips`: with f and g the shapes at the strips, h_s the shares
of these in the span, and the apparent mass on the left,

    (I + I_a) Theta'' - S W''   = sum_s h_s f_s c_m,ea,s - C Theta' - K Theta,
    (m + M_a) W'' - S^T Theta'' = sum_s h_s g_s F_s - c W' - k W,
    F_s = c_l,s + (pi/2) theta_s',    c_m,ea,s = c_m,s + x_ea (F_s + r_s).

With the elastic axis x_ea chords behind mid-chord S and I_a have the parts of the apparent mass
that :func:`equisection.motion.strip_system.mass_with_air` has.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.aerodynamics.learnt_strips import REAR_POINT, LearntStrips
from equisection.aerodynamics.unsteady_loads import APPARENT_MASS
from equisection.motion.beams import BeamParameters
from equisection.motion.strip_system import diagonal, mass_with_air

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

#: Step of the time integration, and interval of histories (c/V).
BEAM_STEP = 0.1
#: Steps along the branch from rest: part of the loads of the first and the longest, the shortest
#: before an end of the branch, and how far (rad) a strip may be from where the tangent leads.
_FIRST, _LONGEST, _SHORTEST, _OFF_TANGENT = 0.125, 0.25, 1e-4, 5e-3
_STEPS_OF_NEWTON, _ARRIVED = 12, 1e-11
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
    """

    def __init__(self, parameters: BeamParameters, loads: LearntStrips) -> None:
        self.loads = loads
        self.parameters = parameters
        structure = parameters.structure
        self._axis = parameters.axis
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
        by_rate = (REAR_POINT - self._axis) * on_strips - of_bending
        self._to_incidence = np.concatenate([on_strips, by_rate])

    @property
    def swings_along(self) -> NDArray[np.intp]:
        """Places of the bending modes that swing along with the pitch of the first beam.

        These are the first one and those up to :data:`SWINGS_ALONG` of the torsion's frequency.
        """
        torsion, bending = self.parameters.structure.natural_frequencies
        along = bending[0] <= SWINGS_ALONG * torsion[0, 0]
        along[0] = True
        return np.flatnonzero(along)

    @property
    def natural_frequencies(self) -> Floats:
        """Frequencies f c/V of the first torsion mode, then of the bending modes that swing along.

        They have the shape (N, 1 + bending modes).
        """
        torsion, bending = self.parameters.structure.natural_frequencies
        found = np.concatenate([torsion[:, :1], bending[:, self.swings_along]], axis=1)
        return np.asarray(found / (2.0 * math.pi))

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
        moment = self.loads.about_axis(a, lift, moment, self._axis)
        return np.concatenate([moment @ self._by_moment, lift @ self._by_lift], axis=1), a

    def _incidence_of(self, motion: Floats) -> Floats:
        return np.asarray(motion @ self._to_incidence, dtype=np.float64)

    @property
    def _size(self) -> int:
        return 2 * self._modes + int(self._f.shape[1])

    def released(
        self,
        duration: float,
        time_step: float = BEAM_STEP,
        start: tuple[float, float] = (0.0, 0.0),
    ) -> LearntSwings:
        """Release all beams from steady flow.

        Modes and lags go exactly as under loads and incidences that are linear over a step. The
        loads at its end are extrapolated, computed, and computed again for the motion that
        follows: second order in the step, and stable however stiff the highest modes are.

        Parameters
        ----------
        duration
            Time (c/V).
        time_step
            Step, and interval of the histories (c/V).
        start
            Twist (rad) in which the tip is held in the first torsion mode until the release, and
            heave rate (over V) that it gets then in the first bending mode.
        """
        lanes, modes = self.parameters.structure.lanes, self._modes
        count = max(round(duration / time_step), 1)
        free, before, after = self._over_a_step(time_step)
        decay = math.exp(-self.loads.rate * time_step)
        mean = (1.0 - decay) / (self.loads.rate * time_step)
        record = np.zeros((count + 1, lanes, modes))
        motion = np.zeros((lanes, 2 * modes, 1))
        motion[:, 0] = start[0] / self.parameters.torsion_at_tip[0]
        lag = self._incidence_of(motion[..., 0])
        first_bending = modes + self._torsion_modes
        motion[:, first_bending] = start[1] / self.parameters.bending_at_tip[0]
        record[0] = motion[:, :modes, 0]
        load, a = self._loads(motion[..., 0], lag)
        least, most = a.min(axis=1), a.max(axis=1)
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

        They are those on the branch that comes from rest when the loads rise slowly from nothing,
        and NaN beyond its end: a fold, where the stiffness of beam and air together is lost, or the
        end of the polars. Steps along the branch are bound by how far a strip may be from where the
        tangent leads, so that no other branch is taken for it.
        """
        structure = self.parameters.structure
        lanes = structure.lanes
        theta = np.zeros((lanes, self._torsion_modes))
        part, step = np.zeros(lanes), np.full(lanes, _FIRST)
        torque, slope = self._torque(theta)
        while (on := np.flatnonzero((part < 1.0) & (step >= _SHORTEST))).size:
            reached = np.minimum(part[on] + step[on], 1.0)
            rise = (reached - part[on])[:, None] * torque[on]
            guess = theta[on] + _solved(self._held(on, part[on], slope[on]), rise)
            found, there = self._corrected(on, reached, guess)
            off = np.abs((found - guess) @ self._f).max(axis=1)
            there &= off <= _OFF_TANGENT
            taken = on[there]
            theta[taken], part[taken] = found[there], reached[there]
            if taken.size:
                torque[taken], slope[taken] = self._torque(theta[taken])
            step[on] = np.where(there, np.minimum(1.5 * step[on], _LONGEST), 0.5 * step[on])
        theta[part < 1.0] = np.nan
        a = theta @ self._f
        lift, _ = self.loads.coefficients(a, np.zeros_like(a), a)
        return np.concatenate([theta, lift @ self._by_lift / structure.bending_stiffness], axis=1)

    def _torque(self, theta: Floats) -> tuple[Floats, Floats]:
        """Return the moments on the torsion modes at rest (N, n_t), and their slopes by Theta."""
        a = theta @ self._f
        lift, moment = self.loads.coefficients(a, np.zeros_like(a), a)
        moment = self.loads.about_axis(a, lift, moment, self._axis)
        _, by = self.loads.slopes(a, self._axis)
        at_rest = by[0] + by[2]  # the lag has caught up
        slopes = (self._by_moment.T[None] * at_rest[:, None, :]) @ self._f.T
        return np.asarray(moment @ self._by_moment), np.asarray(slopes)

    def _held(self, lanes: NDArray[np.intp], part: Floats, slope: Floats) -> Floats:
        """Return the stiffness of some beams and a part of the air together, (n, n_t, n_t)."""
        springs = self._stiffness[lanes][:, : self._torsion_modes, : self._torsion_modes]
        return np.asarray(springs - part[:, None, None] * slope)

    def _corrected(
        self, lanes: NDArray[np.intp], part: Floats, guess: Floats
    ) -> tuple[Floats, NDArray[np.bool_]]:
        """Return Theta under a part of the loads by Newton's method, and where it is stable."""
        theta = guess
        springs = self.parameters.structure.torsion_stiffness[lanes]
        for _ in range(_STEPS_OF_NEWTON):
            torque, slope = self._torque(theta)
            held = self._held(lanes, part, slope)
            change = _solved(held, part[:, None] * torque - springs * theta)
            theta = theta + change
            if not np.any(np.abs(change) > _ARRIVED):
                break
        arrived = (np.abs(change) <= _ARRIVED).all(axis=1)  # no NaN is
        with np.errstate(invalid="ignore"):  # a beam that left the polars
            stable = np.linalg.det(held) > 0.0
        return theta, np.asarray(arrived & stable)

    def eigenvalues(self) -> Complexes:
        """Return the eigenvalues p (V/c) about the equilibria, shape (N, n); NaN without one.

        The loads are linearised at rest, so that these are the rates of small motions.
        """
        found = np.full((self.parameters.structure.lanes, self._size), np.nan, dtype=complex)
        linear = self.linearised(self.equilibria())
        there = np.isfinite(linear).all(axis=(1, 2))
        if there.any():
            found[there] = np.linalg.eigvals(linear[there])
        return found

    def linearised(self, rest: Floats) -> Floats:
        """Return the matrices of small motions (q, q', x) about equilibria.

        Parameters
        ----------
        rest
            Theta and W of static equilibrium, shape (N, n_t + n_b), NaN where there is none.

        Returns
        -------
        Floats
            Shape (N, n, n); NaN of a beam without an equilibrium.
        """
        modes = self._modes
        unit = np.eye(self._size)  # of (q, q', x); rows are states
        motion, lag = unit[:, : 2 * modes], unit[:, 2 * modes :]
        incidence, twist_rate = motion @ self._to_incidence, motion @ self._to_twist_rate
        a = rest[:, : self._torsion_modes] @ self._f
        lift, moment = (
            slopes[0][:, None] * incidence
            + slopes[1][:, None] * twist_rate
            + slopes[2][:, None] * lag
            for slopes in self.loads.slopes(a, self._axis)
        )
        load = np.concatenate([moment @ self._by_moment, lift @ self._by_lift], axis=2)
        pushed = load - motion[:, :modes] @ self._stiffness.transpose(0, 2, 1)
        pushed = pushed - motion[:, modes:] @ self._damping.transpose(0, 2, 1)
        accelerations = pushed @ self._inverse.transpose(0, 2, 1)
        lags = self.loads.rate * (incidence - lag)

        def of_all(rows: Floats) -> Floats:
            return np.broadcast_to(rows, (len(rest), *rows.shape))

        columns = [of_all(motion[:, modes:]), accelerations, of_all(lags)]
        return np.concatenate(columns, axis=2).transpose(0, 2, 1)

    def influence(self, rest: Floats) -> Callable[[Complexes], Complexes]:
        """Return the loads Q of small motions q exp(p s) about equilibria, shape (N, m, m).

        Rows and columns are bending, then torsion, as
        :func:`equisection.motion.mechanism.instabilities` has them; apparent mass that does no work
        is left out. ``rest`` is that of :meth:`linearised`.
        """
        a = rest[:, : self._torsion_modes] @ self._f
        slopes = self.loads.slopes(a, self._axis)
        by = [self._by_lift, self._by_moment]
        lag_rate, off = self.loads.rate, REAR_POINT - self._axis

        def loads(p: Complexes) -> Complexes:
            at = p[:, None, None]
            turned = np.broadcast_to(self._f, (p.size, *self._f.shape))
            heaved = np.broadcast_to(self._g, (p.size, *self._g.shape))
            incidence = np.concatenate([-at * heaved, (1.0 + off * at) * turned], axis=1)
            turning = np.concatenate([0.0 * heaved, at * turned], axis=1)
            lag = lag_rate / (at + lag_rate) * incidence
            rows = [
                np.einsum("nms,sk->nkm", of_a * incidence + of_rate * turning + of_lag * lag, shape)
                for (of_a, of_rate, of_lag), shape in zip(
                    (one[:, :, None, :] for one in slopes), by, strict=True
                )
            ]
            return np.concatenate(rows, axis=1)

        return loads


def _solved(matrices: Floats, sides: Floats) -> Floats:
    """Return the solutions (N, n) of linear equations, NaN where the matrix has none."""
    fit = np.isfinite(matrices).all(axis=(1, 2)) & np.isfinite(sides).all(axis=1)
    found = np.full_like(sides, np.nan)
    if fit.any():
        found[fit] = np.linalg.solve(matrices[fit], sides[fit][:, :, None])[:, :, 0]
    return found
