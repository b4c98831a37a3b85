"""Steady loads along a beam from its section polar: Prandtl's lifting line, non-linear.

Every section works at its effective incidence

    alpha_e = theta_0 + theta - alpha_i,    alpha_i = D c_l(alpha_e),

with D of `induction_matrix`. To first order in alpha_i, as the theory is, the lift keeps its
direction and alpha_i tilts it back into the induced drag c_l alpha_i. The moment of a section is
that of its polar at alpha_e.

The equation is solved by Newton's method with a line search from the load of a linear polar with
the steepest slope a of this one. It may stall near the lift peak. Then the chord method
alpha_e <- alpha_e - (1 + a D)^-1 residual takes over, a pseudo-time iteration that follows the
attached flow upwards. Beyond the peak a lift curve that falls faster than 4 h/c per radian, h being
the width of a strip, lets the load alternate from strip to strip (a wave of two strips induces
c_l c/(4 h)): such a saw-tooth is an error, as is a solution that does not converge.

The theory leaves out the chordwise variation of the induced flow (short spans) and the tip
vortex that rolls up over the plate.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.induction import SpanStrips
from equisection.aerodynamics.polar import Polar
from equisection.errors import SolverError

Floats = NDArray[np.float64]

TOLERANCE_RAD = 1e-10
"""Largest error of the effective incidence (rad) that counts as converged."""

_NEWTON_STEPS = 60
_CHORD_STEPS = 4000
_CHORD_ROUNDS = 5
_SAW_TOOTH_RAD = 1e-3
_SLOPE_STEP = 1e-4  # rad, the step of the polar's own table


@dataclass(frozen=True, eq=False)
class SpanwiseLoads:
    """Steady loads of a beam.

    Attributes
    ----------
    effective_incidence, induced_incidence
        alpha_e and alpha_i (rad) at the stations, shape (n,).
    cl_section, cm_section, cd_section
        c_l, c_m about mid-chord nose up, and c_d with the induced drag, shape (n,).
    lift, moment, drag, induced_drag
        C_L, C_M, C_D and the part C_Di of it, of the beam (Eq. 22).
    """

    effective_incidence: Floats
    induced_incidence: Floats
    cl_section: Floats
    cm_section: Floats
    cd_section: Floats
    lift: float
    moment: float
    drag: float
    induced_drag: float


@dataclass(frozen=True, eq=False)
class LiftingLine:
    """Beam of one section: its polar, its strips and the incidence that they induce on each other.

    Attributes
    ----------
    polar
        Section polar.
    strips
        Strips of the span.
    matrix
        D (rad) of `induction_matrix` for these strips, shape (n, n).
    """

    polar: Polar
    strips: SpanStrips
    matrix: Floats

    def solve(self, incidence_rad: float, twist_rad: ArrayLike = 0.0) -> SpanwiseLoads:
        """Return the loads at theta_0 = ``incidence_rad`` with twist theta (scalar or (n,))."""
        geometric = incidence_rad + np.broadcast_to(
            np.asarray(twist_rad, dtype=np.float64), self.strips.stations.shape
        )
        effective = self._effective_incidence(geometric)
        self._refuse_saw_tooth(effective - geometric, float(np.degrees(np.max(np.abs(geometric)))))
        self.polar.require(effective)
        return self._loads(effective)

    def beam_polar(self, incidences_rad: ArrayLike) -> Polar:
        """C_D, C_L and C_M of the untwisted beam against theta_0 (rad, ascending)."""
        incidences = np.asarray(incidences_rad, dtype=np.float64)
        loads = [self.solve(float(incidence)) for incidence in incidences]
        return Polar(
            incidences,
            np.array([load.drag for load in loads]),
            np.array([load.lift for load in loads]),
            np.array([load.moment for load in loads]),
            f"{self.polar.label}, lifting line",
        )

    def _effective_incidence(self, geometric: Floats) -> Floats:
        steepest = np.max(np.diff(self.polar.lift) / np.diff(self.polar.incidence))
        chord = np.linalg.inv(np.eye(geometric.size) + max(steepest, 0.0) * self.matrix)
        effective = chord @ geometric
        for _ in range(_CHORD_ROUNDS):
            converged = self._newton(geometric, effective)
            if converged is not None:
                return converged
            for _ in range(_CHORD_STEPS):
                step = chord @ self._residual(effective, geometric)
                effective = effective - step
                if np.max(np.abs(step)) < TOLERANCE_RAD:
                    break
        degrees = np.degrees(np.max(np.abs(geometric)))
        raise SolverError(
            f"the lifting line on polar {self.polar.label!r} does not converge at {degrees:.4g} "
            f"deg with {geometric.size} strips; use fewer strips or a smaller incidence"
        )

    def _refuse_saw_tooth(self, change: Floats, degrees: float) -> None:
        jumps = np.diff(change)
        tooth = (jumps[:-1] * jumps[1:] < 0) & (np.abs(jumps[:-1]) > _SAW_TOOTH_RAD)
        tooth &= np.abs(jumps[1:]) > _SAW_TOOTH_RAD
        if np.any(tooth[:-1] & tooth[1:]):
            raise SolverError(
                f"the lifting line on polar {self.polar.label!r} alternates from strip to strip at "
                f"{degrees:.4g} deg: beyond the peak the lift falls too steeply for "
                f"{change.size} strips; use fewer strips or a smaller incidence"
            )

    def _newton(self, geometric: Floats, start: Floats) -> Floats | None:
        """Effective incidence (rad), or None. Outside the polar it continues constant."""
        effective = start
        residual = self._residual(effective, geometric)
        for _ in range(_NEWTON_STEPS):
            if np.max(np.abs(residual)) < TOLERANCE_RAD:
                return effective
            jacobian = np.eye(geometric.size) + self.matrix * self._slopes(effective)
            step = np.linalg.solve(jacobian, residual)
            fraction, norm = 1.0, np.linalg.norm(residual)
            while fraction > 1e-3:
                trial = effective - fraction * step
                trial_residual = self._residual(trial, geometric)
                if np.linalg.norm(trial_residual) < (1 - 0.1 * fraction) * norm:
                    break
                fraction *= 0.5
            else:
                return None
            effective, residual = trial, trial_residual
        return None

    def _inside(self, effective: Floats) -> Floats:
        return np.clip(effective, *self.polar.incidence_range)

    def _residual(self, effective: Floats, geometric: Floats) -> Floats:
        lift = self.polar.lift_coefficient(self._inside(effective))
        residual: Floats = effective + self.matrix @ lift - geometric
        return residual

    def _slopes(self, effective: Floats) -> Floats:
        above = self._inside(effective + _SLOPE_STEP)
        below = self._inside(effective - _SLOPE_STEP)
        rise = self.polar.lift_coefficient(above) - self.polar.lift_coefficient(below)
        return rise / (2 * _SLOPE_STEP)

    def _loads(self, effective: Floats) -> SpanwiseLoads:
        weights = self.strips.weights
        lift = self.polar.lift_coefficient(effective)
        moment = self.polar.moment_coefficient(effective)
        induced: Floats = self.matrix @ lift
        drag = self.polar.drag_coefficient(effective) + lift * induced
        return SpanwiseLoads(
            effective_incidence=effective,
            induced_incidence=induced,
            cl_section=lift,
            cm_section=moment,
            cd_section=drag,
            lift=float(weights @ lift),
            moment=float(weights @ moment),
            drag=float(weights @ drag),
            induced_drag=float(weights @ (lift * induced)),
        )
