"""The separation bubble: branches of the measured polar, and the lags between them.

Branches
    The *attached* branch is linear, c_l = a_l alpha and c_m = a_m alpha. What the measured polar
    lacks of it is the *deficit* of the bubble,

        Delta_l(alpha) = a_l alpha - c_l(alpha),    Delta_m(alpha) = a_m alpha - c_m(alpha),

    whatever its sign, so that attached minus deficit is the polar at every incidence.
State
    x is the incidence to which the bubble has adapted: the incidence whose steady bubble is the
    one there is now. It follows the incidence alpha_d that feeds the bubble with the two
    lags of Goman and Khrabrov (J. Aircraft 31(5), 1994, Eq. 2),

        tau_1 x' + x = alpha_d - tau_2 alpha_d',

    who write x_0(alpha_d - tau_2 alpha_d') on the right with a degree of attachment x_0 instead
    of the incidence that has it. Labelling the same bubble by its incidence needs no fitted
    x_0(alpha), and a polar that is non-linear from one degree on offers nothing to fit it to.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.polar import SectionPolar

Floats = NDArray[np.float64]

SLOPE_HALF_STEP = 5e-4
"""Half the step (rad) of the central differences that give slopes of the deficit."""


@dataclass(frozen=True)
class SeparationLags:
    """Lags of the bubble in convective times, for its deficit of moment and of lift.

    ``moment_lag`` and ``moment_delay`` are tau_1 and tau_2 of the deficit of moment,
    ``lift_lag`` and ``lift_delay`` those of the deficit of lift. All zero is a bubble that
    follows at once.
    """

    moment_lag: float
    moment_delay: float
    lift_lag: float
    lift_delay: float
    provenance: str = "given by the user"

    def __post_init__(self) -> None:
        for part in ("moment", "lift"):
            lag = getattr(self, f"{part}_lag")
            delay = getattr(self, f"{part}_delay")
            if not (np.isfinite(lag) and np.isfinite(delay) and lag >= 0.0):
                raise ValueError(
                    f"{part}_lag = {lag!r} and {part}_delay = {delay!r}: two finite numbers are "
                    "wanted, the lag not negative"
                )
            if lag == 0.0 and delay != 0.0:
                raise ValueError(
                    f"{part}_delay = {delay!r} with {part}_lag = 0: a delay alone is a derivative "
                    f"of the incidence; give {part}_lag a value above 0 as well"
                )

    @classmethod
    def none(cls) -> SeparationLags:
        """Return a bubble without lag: the steady polar behind the attached flow's own lag."""
        return cls(0.0, 0.0, 0.0, 0.0, "no separation lag")


@dataclass(frozen=True)
class Branches:
    """Attached branch and deficit of one polar.

    ``lift_slope`` a_l and ``moment_slope`` a_m (1/rad) default to the slopes of the polar at
    zero incidence.
    """

    polar: SectionPolar
    lift_slope: float
    moment_slope: float

    @classmethod
    def from_polar(cls, polar: SectionPolar) -> Branches:
        """Attached branch with the slopes that the polar has at zero incidence."""
        return cls(polar, polar.lift_slope(0.0), polar.moment_slope(0.0))

    def lift_deficit(self, alpha: Floats) -> Floats:
        """Delta_l at ``alpha`` (rad, any shape); NaN where the polar has no value."""
        return self.lift_slope * alpha - self.polar.lift_coefficient(alpha)

    def moment_deficit(self, alpha: Floats) -> Floats:
        """Delta_m at ``alpha`` (rad, any shape); NaN where the polar has no value."""
        return self.moment_slope * alpha - self.polar.moment_coefficient(alpha)


IDENTIFIED_LAGS = SeparationLags(
    moment_lag=2.98,
    moment_delay=0.63,
    lift_lag=2.98,
    lift_delay=0.63,
    provenance="preliminary",
)
"""Lags of the plate's bubble (h = 0.04 c, sharp edges, Re 1.27e5)."""
