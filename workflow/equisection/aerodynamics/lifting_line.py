r"""Steady loads along a beam from its section polar: Weissinger's line, non-linear.

As in Weissinger's method (NACA TM 1120, 1947) the incidence that the strips induce on each other is
that at three quarters of the chord, without what a section induces on itself, since its polar has
that. The section's lift is that of alpha_E, and its leading edge, whose suction decides moment and
separation, works at alpha_S, which the rise of the induced incidence along the chord adds to
(:mod:`equisection.aerodynamics.unsteady_induction`):

    alpha_E = theta_0 + theta - T c_l,    alpha_S = alpha_E + G c_l,    G = (kappa/2) (T - T_q),
    c_l = a_l alpha_E - Delta_l(alpha_S),    c_m = c_m(alpha_S),

with T = T(0) and T_q = T_q(0) and slope and deficit of :mod:`equisection.aerodynamics.separation`.
Since a_l alpha - Delta_l(alpha) is the polar, (1 + a_l G) c_l is its lift at alpha_S, and

    alpha_S + D c_l,polar(alpha_S) = theta_0 + theta,    D = (T - G) (1 + a_l G)^-1.

Beams in motion (:mod:`equisection.motion.strip_system`) have these loads at rest. With T_q in the
place of T the rise vanishes, and this is Prandtl's lifting line. The induced drag is c_l T_q c_l,
as it is there: what the wake carries away depends on the load along the span alone.

The equation is solved by Newton's method with a line search from the load of a linear polar with
the steepest slope a of this one. It may stall near the lift peak. Then the chord method
alpha_e <- alpha_e - (1 + a D)^-1 residual takes over, a pseudo-time iteration that follows the
attached flow upwards. Beyond the peak a lift curve that falls too steeply lets the load alternate
from strip to strip (on Prandtl's line faster than 4 h/c per radian, h being the width of a strip,
since a wave of two strips induces c_l c/(4 h)): such a saw-tooth is an error, as is a solution that
does not converge.

The theory leaves out the tip vortex that rolls up over the plate.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import Branches
from equisection.aerodynamics.span_strips import SpanStrips
from equisection.aerodynamics.unsteady_induction import CURVATURE_SHARE, steady_induction
from equisection.aerodynamics.vortex_rings import SpanGeometry
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
        alpha_S, at which the polar is read, and T c_l (rad) at the stations, shape (n,).
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
    rear, front
        T and T_q (rad) of these strips, shape (n, n); the same twice for Prandtl's lifting line.
    """

    polar: Polar
    strips: SpanStrips
    rear: Floats
    front: Floats

    @classmethod
    def of(cls, polar: Polar, strips: SpanStrips, geometry: SpanGeometry) -> LiftingLine:
        """Take the induction of the strips in their channel."""
        return cls(polar, strips, *steady_induction(geometry))

    @cached_property
    def matrix(self) -> Floats:
        """D (rad): alpha_S = theta_0 + theta - D c_l,polar(alpha_S), shape (n, n)."""
        return np.asarray((self.rear - self._advance) @ self._carried, dtype=np.float64)

    @cached_property
    def _advance(self) -> Floats:
        """G (rad), shape (n, n): alpha_S - alpha_E of c_l."""
        return np.asarray(0.5 * CURVATURE_SHARE * (self.rear - self.front), dtype=np.float64)

    @cached_property
    def _carried(self) -> Floats:
        """(1 + a_l G)^-1, shape (n, n): c_l of the polar's lift at alpha_S."""
        slope = Branches.from_polar(self.polar).lift_slope
        carried = np.linalg.inv(np.eye(len(self.rear)) + slope * self._advance)
        return np.asarray(carried, dtype=np.float64)

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
        lift = self._carried @ self.polar.lift_coefficient(effective)
        moment = self.polar.moment_coefficient(effective)
        induced_drag = lift * (self.front @ lift)
        drag = self.polar.drag_coefficient(effective) + induced_drag
        return SpanwiseLoads(
            effective_incidence=effective,
            induced_incidence=self.rear @ lift,
            cl_section=lift,
            cm_section=moment,
            cd_section=drag,
            lift=float(weights @ lift),
            moment=float(weights @ moment),
            drag=float(weights @ drag),
            induced_drag=float(weights @ induced_drag),
        )
