r"""Unsteady loads of the strips of a beam, learnt from one release of it.

With the incidence at three quarters of the chord, counted from the rigid one, of a strip

    a = theta - w_m' + theta'/4,    alpha = theta_0 + a,

w_m the deflection of mid-chord, and a lag x of it, x' = g (a - x) with h = a - x, the loads of
every strip are

    c_m = c_m,polar(alpha) + B_m . T(a, theta', h) - (pi/64) theta'',
    c_l = c_l,polar(alpha) + B_l . T(a, theta', h) + (pi/2) (theta' - w_m''),
    T   = (theta', a theta', h, a h, a).

c_m is about mid-chord. About an elastic axis x_ea chords behind it there is x_ea (c_l + r) more,
with the force normal to the chord, r = c_l (cos alpha - 1) + C_D sin alpha; of the polars along the
span the drag is that of the whole beam.

The polar is that of the rigid beam at the station of the strip, so that the wake of the finite span
is in it, at rest. The incidence is taken where the circulation of a thin plate depends on it, and
the last terms are its apparent mass (Theodorsen, NACA Report 496, 1935). The last term of T
corrects the slope of the steady loads, which a polar of few incidences leaves open; it is zero
unless it is asked for. The strips share the coefficients and have their own lags.

A beam has fewer terms than a section (:mod:`..aerodynamics.learnt_loads`): what is learnt from are
the loads of two modes, which mix the incidences of all strips. They are too few for large
amplitudes.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.strip_polars import StripPolars
from equisection.aerodynamics.unsteady_loads import APPARENT_MASS

Floats = NDArray[np.float64]

#: Place of three quarters of the chord, chords behind mid-chord.
REAR_POINT = 0.25
STRIP_TERMS = ("theta'", "a theta'", "h", "a h", "a")
#: Place of the term that does not vanish at rest.
SLOPE_TERM = 4
#: Half-width (rad) of the difference that the slope of what an offset axis adds is taken over.
_HALF_WIDTH = 1e-3


@dataclass(frozen=True, eq=False)
class LearntStrips:
    """Loads of the strips of a beam, learnt from a release.

    Attributes
    ----------
    polars
        Steady loads along the span.
    incidence_rad
        Rigid incidence theta_0 (rad) that the model was learnt at.
    rate
        g, rate of the lags (V/c).
    moment, lift
        B_m and B_l, shape (5,).
    residual_moment, residual_lift
        Standard deviation of what the model leaves of the loads of the first torsion and the first
        bending mode, over that of what polars and apparent mass leave (-).
    seen
        Least and greatest incidence alpha (rad) of what it was learnt from.
    learnt_until
        End of the record (c/V).
    """

    polars: StripPolars
    incidence_rad: float
    rate: float
    moment: Floats
    lift: Floats
    residual_moment: float
    residual_lift: float
    seen: tuple[float, float]
    learnt_until: float

    @classmethod
    def of_steady_loads(cls, polars: StripPolars, incidence_rad: float) -> LearntStrips:
        """Return the loads of polars alone at a rigid incidence (rad), with nothing learnt."""
        nothing = np.zeros(len(STRIP_TERMS))
        at_rest = (incidence_rad, incidence_rad)
        return cls(polars, incidence_rad, 1.0, nothing, nothing, 0.0, 0.0, at_rest, 0.0)

    def coefficients(self, a: Floats, twist_rate: Floats, lag: Floats) -> tuple[Floats, Floats]:
        """Return c_l and c_m of the strips without apparent mass; NaN beyond the polars.

        Parameters
        ----------
        a, twist_rate, lag
            alpha - theta_0 (rad), theta' and x (rad), shape (..., S).
        """
        lift, moment = self.polars.loads(self.incidence_rad + a)
        terms = strip_terms(a, twist_rate, a - lag)
        return lift + np.tensordot(self.lift, terms, 1), moment + np.tensordot(
            self.moment, terms, 1
        )

    def about_axis(self, a: Floats, lift: Floats, moment: Floats, axis: float) -> Floats:
        """Return c_m about an axis chords behind mid-chord, by loads about mid-chord, (..., S).

        ``lift`` may have the part of the apparent mass that goes with theta'.
        """
        if not axis:
            return moment
        return moment + axis * (lift + self.polars.normal_rise(self.incidence_rad + a))

    def slopes(self, a: Floats, axis: float = 0.0) -> tuple[Floats, Floats]:
        """Return the slopes of c_l and c_m by (a, theta', x) at rest.

        They are at incidences a (rad), shape (..., S), and have the shape (3, ..., S), that of
        c_l with the (pi/2) theta' of the apparent mass, c_m about an axis chords behind mid-chord.
        """
        found = []
        for steady, b in zip(
            self.polars.slopes(self.incidence_rad + a), (self.lift, self.moment), strict=True
        ):
            by_lag = b[2] + a * b[3]
            corrected = steady + b[SLOPE_TERM]
            found.append(np.stack([corrected + by_lag, b[0] + a * b[1], -by_lag]))
        lift, moment = found
        lift[1] += APPARENT_MASS
        if axis:
            moment = moment + axis * lift
            moment[0] += axis * self._slope_of_rise(a)
        return lift, moment

    def _slope_of_rise(self, a: Floats) -> Floats:
        alpha = self.incidence_rad + a
        ends = [self.polars.normal_rise(alpha + side * _HALF_WIDTH) for side in (-1.0, 1.0)]
        return (ends[1] - ends[0]) / (2.0 * _HALF_WIDTH)


def strip_terms(a: Floats, twist_rate: Floats, h: Floats) -> Floats:
    """Return T, shape (5, ...), of incidence a (rad), theta' and h (rad)."""
    return np.stack([twist_rate, a * twist_rate, h, a * h, a])
