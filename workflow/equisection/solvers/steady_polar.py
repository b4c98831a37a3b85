"""Steady result of a section whose polar is known: its coefficients at one incidence."""

from __future__ import annotations

import numpy as np

from equisection.aerodynamics.polar import Polar
from equisection.results.steady_result import SteadyResult


def section_of_polar(polar: Polar, alpha: float, method: str) -> SteadyResult:
    """Return the coefficients of a section at an incidence.

    Parameters
    ----------
    polar
        Polar of the section.
    alpha
        Incidence (rad).
    method
        Origin of the values, in words.

    Raises
    ------
    IncidenceOutOfRangeError
        The polar does not cover the incidence.
    """
    nothing = np.empty(0)
    polar.require(alpha)
    return SteadyResult(
        drag=float(polar.drag_coefficient(alpha)),
        lift=float(polar.lift_coefficient(alpha)),
        moment=float(polar.moment_coefficient(alpha)),
        span=nothing,
        section_lift=nothing,
        section_moment=nothing,
        method=method,
    )
