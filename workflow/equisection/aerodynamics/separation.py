"""The separation bubble: branches of the measured polar, and the lags between them.

Branches
    The *attached* branch is linear, c_l = a_l alpha and c_m = a_m alpha, with the slopes that
    the polar has at zero lift. Attached branch minus polar is the *deficit* of the bubble,

        Delta_l(alpha) = a_l alpha - c_l(alpha),    Delta_m(alpha) = a_m alpha - c_m(alpha),

    so that attached minus deficit is the measured polar at every incidence.
State
    x is the incidence to which the bubble has adapted: the incidence whose steady bubble is the
    one there is now. It follows the incidence of the leading edge alpha_S (``unsteady_loads``)
    with the two lags of Goman and Khrabrov (J. Aircraft 31(5), 1994),

        tau_1 x' + x = alpha_S - tau_2 alpha_S',

    who write x_0(alpha - tau_2 alpha') on the right, with a degree of attachment x_0 instead of
    the incidence that has it. Labelling the same bubble by its incidence needs no fitted
    x_0(alpha), and a polar that is non-linear from one degree on offers nothing to fit it to.
Lift
    Leading-edge suction, and so most of the moment, answers at once. The circulation of separated
    flow waits until the vorticity that the bubble sheds has passed the trailing edge; that of
    attached flow has Wagner's lag and no other. With c* = a_l alpha_E - Delta_l(x),

        tau_3 c_lag' + c_lag = c*,    c = c* - b(x) (c* - c_lag),    b = min(1, 8 s(x)).

    s(alpha) is the share of its suction that the leading edge has lost, the largest between zero
    lift at alpha_0 and alpha,

        (Delta_m(alpha) - Delta_m(alpha_0))/(a_m (alpha - alpha_0)),    0 to 1.

    A linear polar has s = 0 everywhere: thin-plate theory for any lags. A section whose moment
    doesn't rise at zero lift (a_m <= 0) has no such suction at all, and b = 1.

Zero lags are a steady polar behind Wagner's lag; x and c_lag are then no states.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.polar import TABLE_STEP, Polar, is_nil
from equisection.errors import ArgumentError
from equisection.keys.arguments import is_finite_number

Floats = NDArray[np.float64]

SLOPE_HALF_STEP = 5e-4
"""Half the step (rad) of the central differences that give slopes of the deficit."""

LAG_ONSET = 8.0
"""b over s: with an eighth of the suction lost, all lift lags. Chosen for the growth of the kept
releases of the plate."""

_NEAR_ZERO_LIFT = 2e-3
"""Incidence (rad) about zero lift within which no loss of suction can be told."""


@dataclass(frozen=True)
class SeparationLags:
    """Lags of the bubble in convective times.

    Parameters
    ----------
    relaxation
        tau_1, not negative; zero only together with ``delay``.
    delay
        tau_2.
    lift_lag
        tau_3, not negative.
    provenance
        Where the values come from; lags of the same values are equal wherever these do.
    """

    relaxation: float
    delay: float
    lift_lag: float
    provenance: str = field(default="given by the user", compare=False)

    def __post_init__(self) -> None:
        for name in ("relaxation", "delay", "lift_lag"):
            value = getattr(self, name)
            if not is_finite_number(value) or (value < 0.0 and name != "delay"):
                raise ArgumentError(
                    f"{name} = {value!r}: a finite number of convective times is wanted"
                    + ("" if name == "delay" else ", not negative")
                )
        if self.relaxation == 0.0 and self.delay != 0.0:
            raise ArgumentError(
                f"delay = {self.delay!r} with relaxation = 0 would be a derivative of the "
                "incidence; give relaxation a value above 0 as well"
            )

    @classmethod
    def none(cls) -> SeparationLags:
        """Return a bubble without lag: the steady polar behind the attached flow's own lag."""
        return cls(0.0, 0.0, 0.0, "no separation lag")


@dataclass(frozen=True)
class Branches:
    """Attached branch and deficit of a polar; ``lift_slope`` a_l, ``moment_slope`` a_m (1/rad)."""

    polar: Polar
    lift_slope: float
    moment_slope: float

    @classmethod
    def from_polar(cls, polar: Polar) -> Branches:
        """Attached branch with the slopes that the polar has at zero lift.

        They do not depend on where incidence is counted from.
        """
        alpha = zero_lift(polar)
        return cls(polar, polar.lift_slope(alpha), polar.moment_slope(alpha))

    def lag_share(self, alpha: Floats) -> Floats:
        """Share b of the lift that lags at ``alpha`` (rad, any shape); NaN beyond the polar."""
        return np.interp(alpha, *self._lag_shares, left=np.nan, right=np.nan)

    @cached_property
    def _lag_shares(self) -> tuple[Floats, Floats]:
        """Incidences (rad) all over the polar and b there."""
        first, last = self.polar.incidence_range
        alpha = np.linspace(first, last, 2 + math.ceil((last - first) / TABLE_STEP))
        if self.moment_slope <= 0.0:
            return alpha, np.ones_like(alpha)
        zero = zero_lift(self.polar)
        way = alpha - zero
        far = np.abs(way) > _NEAR_ZERO_LIFT
        lost = np.zeros_like(alpha)
        missing = self.moment_deficit(alpha[far]) - self.moment_deficit(np.array(zero))
        lost[far] = np.clip(missing / (self.moment_slope * way[far]), 0.0, 1.0)
        above = way >= 0.0
        lost[above] = np.maximum.accumulate(lost[above])
        lost[~above] = np.maximum.accumulate(lost[~above][::-1])[::-1]
        return alpha, np.minimum(1.0, LAG_ONSET * lost)

    def lift_deficit(self, alpha: Floats) -> Floats:
        """Delta_l at ``alpha`` (rad, any shape); NaN where the polar has no value."""
        return self.lift_slope * alpha - self.polar.lift_coefficient(alpha)

    def moment_deficit(self, alpha: Floats) -> Floats:
        """Delta_m at ``alpha`` (rad, any shape); NaN where the polar has no value."""
        return self.moment_slope * alpha - self.polar.moment_coefficient(alpha)


def zero_lift(polar: Polar) -> float:
    """Return the incidence (rad) of zero lift, of several that nearest to 0 at which it rises.

    That of the least lift, up or down, where the polar does not come to zero.
    """
    if polar.covers(0.0) and is_nil(float(polar.lift_cubic(0.0)), polar.lift):
        return 0.0
    zeros = np.asarray(polar.lift_cubic.roots(extrapolate=False), dtype=np.float64)
    zeros = zeros[np.isfinite(zeros)]
    if not zeros.size:
        return float(polar.incidence[np.abs(polar.lift).argmin()])
    rising = zeros[polar.lift_cubic(zeros, 1) > 0.0]
    candidates = rising if rising.size else zeros
    return float(candidates[np.abs(candidates).argmin()])


IDENTIFIED_LAGS = SeparationLags(
    relaxation=2.37,
    delay=0.46,
    lift_lag=0.59,
    provenance=(
        "identified from the loads of two free releases of the plate (h = 0.04 c, sharp edges, "
        "Re 1.27e5, theta_0 = 2.5 deg, k* = 5 and 10): OpenFOAM v1912, k-omega SST, 11136 cells, "
        "polar of the same mesh; results/reference/paper-plate-openfoam/unsteady/2d, "
        "aerodynamics.identification.identify_lags"
    ),
)
"""Lags of the plate's bubble; tests/physics/test_identification.py identifies them again."""
