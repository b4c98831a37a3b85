"""Loads of a beam's strips, learnt from the motion of its modes in one release.

What the modes need for their motion, by their own equations,

    Q_theta = I Theta'' - S W'' + C Theta' + K Theta,    Q_w = m W'' - S^T Theta'' + c W' + k W,

are the loads on them, f and g the first torsion and the first bending mode at the strips:

    Q_theta,1 = sum_s h_s f_s c_m,ea,s,    Q_w,1 = sum_s h_s g_s c_l,s.

With the elastic axis x_ea chords behind mid-chord c_m,ea = c_m + x_ea (c_l + r). The lift is
learnt first, from the bending mode; what it does about the axis is then known, and c_m is learnt
from what is left of the torsion mode.

Derivatives are those of a quintic spline, and all recorded modes move the strips. Linear least
squares then give the coefficients of :mod:`equisection.aerodynamics.learnt_strips`, bound by a
ridge as those of a section, and a search the rate of the lags.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.aerodynamics.learnt_loads import (
    LEARN_FROM,
    SHORTEST_RECORD,
    bound_fit,
    lagged,
    rate_of_least,
    require_lesson,
    require_swing,
)
from equisection.aerodynamics.learnt_strips import (
    REAR_POINT,
    SLOPE_TERM,
    STRIP_TERMS,
    LearntStrips,
    strip_terms,
)
from equisection.aerodynamics.strip_polars import StripPolars
from equisection.aerodynamics.unsteady_loads import APPARENT_INERTIA, APPARENT_MASS
from equisection.errors import ResultFileError
from equisection.motion.beams import BeamParameters

Floats = NDArray[np.float64]

#: Time (c/V) before the end of a record in which splines have no good second derivative.
_LAST = 1.0


@dataclass(frozen=True, eq=False)
class BeamRelease:
    """Motion of a released beam at uniform times.

    Attributes
    ----------
    time
        s = tV/c, shape (n,).
    torsion, bending
        Theta_i (rad) and W_j (chords), shape (n_t, n) and (n_b, n).
    parameters
        Modes of the beam at the strips, of one lane.
    incidence_rad
        Rigid incidence theta_0 (rad).
    k_star
        k* of the beam.
    name
        Model and case, for instance ``3d/k6.44``.
    source
        The solver in words.
    """

    time: Floats
    torsion: Floats
    bending: Floats
    parameters: BeamParameters
    incidence_rad: float
    k_star: float
    name: str
    source: str


@dataclass(frozen=True, eq=False)
class _Lesson:
    """Motion of the strips and loads of two modes that polars and apparent mass leave.

    ``a`` and ``twist_rate`` have the shape (n, S); ``moment`` and ``lift`` (n,) are over the sums
    of the weights ``by_moment`` and ``by_lift`` (S,), which have the sum 1. ``moment`` lacks what
    the learnt lift adds about an ``axis`` off mid-chord (chords).
    """

    step: float
    a: Floats
    twist_rate: Floats
    moment: Floats
    lift: Floats
    by_moment: Floats
    by_lift: Floats
    used: NDArray[np.bool_]
    terms: NDArray[np.intp]
    axis: float

    @classmethod
    def of(
        cls, release: BeamRelease, polars: StripPolars, until: float, free_slope: bool
    ) -> _Lesson:
        s, structure = release.time, release.parameters.structure
        axis = release.parameters.axis
        splines = [
            scipy.interpolate.make_interp_spline(s, values.T, 5)
            for values in (release.torsion, release.bending)
        ]
        (theta, theta_1, theta_2), (w, w_1, w_2) = (
            [spline(s, order) for order in range(3)] for spline in splines
        )
        f, g = structure.torsion_shapes.T, structure.bending_shapes.T
        twist_rate = theta_1 @ f
        a = theta @ f - w_1 @ g + (REAR_POINT - axis) * twist_rate
        alpha = release.incidence_rad + a
        steady_lift, steady_moment = polars.loads(alpha)
        lifts = steady_lift + APPARENT_MASS * (twist_rate - w_2 @ g - axis * theta_2 @ f)
        moments = steady_moment - APPARENT_INERTIA * (theta_2 @ f)
        if axis:
            moments = moments + axis * (lifts + polars.normal_rise(alpha))
        on_torsion = (
            theta_2 * structure.torsion_inertia[0]
            - w_2 @ structure.imbalance[0].T
            + theta_1 @ structure.torsion_damping[0].T
            + theta * structure.torsion_stiffness[0]
        )[:, 0]
        on_bending = (
            w_2 * structure.bending_mass[0]
            - theta_2 @ structure.imbalance[0]
            + w_1 @ structure.bending_damping[0].T
            + w * structure.bending_stiffness[0]
        )[:, 0]
        by_moment, by_lift = structure.weights * f[0], structure.weights * g[0]
        left = on_torsion - moments @ by_moment, on_bending - lifts @ by_lift
        used = (s >= LEARN_FROM) & (s <= min(until * (1.0 + 1e-9), s[-1] - _LAST))
        used &= np.isfinite(left[0]) & np.isfinite(left[1])
        if not used.any():
            raise ResultFileError(
                f"{release.name}: the motion is beyond the polars of the strips, which cover "
                f"{np.degrees(polars.incidence_range)} deg; add angles to steady.incidence_deg"
            )
        require_swing(release.name, a[used])
        terms = np.arange(len(STRIP_TERMS))
        return cls(
            step=float(s[1] - s[0]),
            a=a,
            twist_rate=twist_rate,
            moment=left[0] / by_moment.sum(),
            lift=left[1] / by_lift.sum(),
            by_moment=by_moment / by_moment.sum(),
            by_lift=by_lift / by_lift.sum(),
            used=used,
            terms=terms if free_slope else terms[terms != SLOPE_TERM],
            axis=axis,
        )

    def fitted(self, rate: float) -> tuple[Floats, Floats, float, float]:
        """Return B_m, B_l and their residuals at a rate of the lags (V/c)."""
        h = self.a - lagged(self.a, self.step, rate)
        terms = strip_terms(self.a, self.twist_rate, h)[self.terms][:, self.used]
        by_lift, left_lift = bound_fit((terms @ self.by_lift).T, self.lift[self.used])
        on_axis = (terms @ self.by_moment).T
        about_axis = self.moment[self.used] - self.axis * (on_axis @ by_lift)
        by_moment, left_moment = bound_fit(on_axis, about_axis)
        moment, lift = np.zeros((2, len(STRIP_TERMS)))
        moment[self.terms], lift[self.terms] = by_moment, by_lift
        return moment, lift, float(left_moment), float(left_lift)


def learn_strips(
    release: BeamRelease,
    polars: StripPolars,
    until: float = math.inf,
    *,
    free_slope: bool = False,
    shortest: float = SHORTEST_RECORD,
) -> LearntStrips:
    """Learn the loads of the strips of a beam from a release.

    Parameters
    ----------
    release
        Motion of the release.
    polars
        Loads of the rigid beam by the same solver on the same mesh, at the strips of the release.
    until
        Part of the record that is used, from the release on (c/V).
    free_slope
        True: the slope of the steady loads is corrected, too.
    shortest
        Shortest record (c/V) that is learnt from.

    Raises
    ------
    ResultFileError
        The record is too short, has gaps, is too coarse in time, or has settled.
    """
    require_lesson(release.name, release.time, shortest)
    whole = polars.continued
    lesson = _Lesson.of(release, whole, until, free_slope)
    rate = rate_of_least(lesson.fitted)
    moment, lift, left_moment, left_lift = lesson.fitted(rate)
    seen = release.incidence_rad + lesson.a[lesson.used]
    return LearntStrips(
        polars=whole,
        incidence_rad=release.incidence_rad,
        rate=rate,
        moment=moment,
        lift=lift,
        residual_moment=left_moment,
        residual_lift=left_lift,
        seen=(float(seen.min()), float(seen.max())),
        learnt_until=min(until, float(release.time[-1])),
    )
