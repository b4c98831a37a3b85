"""Histories of a moving section from a flow solver, to identify the lags from and judge them by.

The loads are the section's own, with or without correction for the finite span: the correction
changes masses and stiffnesses, and so the motion, but not the loads under a given motion.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.beam.section import Section

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ReferenceHistory:
    """Motion and loads of a released section at uniform times, each of shape (n,).

    Parameters
    ----------
    time
        s = tV/c.
    twist, deflection
        theta (rad) and w/c.
    lift_coefficient, moment_coefficient
        c_l, and c_m about the moving mid-chord.
    incidence_rad
        Rigid incidence theta_0 (rad).
    k_star
        k* of the section's beam.
    section
        The section in its flow as it moved (Eq. 18), corrected where it was.
    name
        Model and case, for instance ``2d-corrected/k6.44``.
    source
        The solver in words.
    """

    time: Floats
    twist: Floats
    deflection: Floats
    lift_coefficient: Floats
    moment_coefficient: Floats
    incidence_rad: float
    k_star: float
    section: Section
    name: str
    source: str

    @property
    def time_step(self) -> float:
        """Interval of the samples in convective times."""
        return float(self.time[1] - self.time[0])


def unexplained_damping(history: ReferenceHistory, start: float) -> float:
    """Negative damping d that the recorded motion shows and the recorded moment does not.

    Least squares of I* theta'' + k* theta - c_m = d theta' (plus a constant) after ``start``
    (c/V). It is 0 for a flow solver whose coupling conserves energy; d > 0 adds d/(2 I*) to the
    growth rate of the twist.

    Raises
    ------
    EquisectionError
        The section has dampers, or an imbalance or an axis by which the lift turns it.
    """
    history.section.require_defaults("the balance of the moment alone")
    rate = np.gradient(history.twist, history.time_step)
    acceleration = np.gradient(rate, history.time_step)
    imbalance = (
        history.section.inertia * acceleration
        + history.section.torsional_stiffness * history.twist
        - history.moment_coefficient
    )
    late = history.time > start
    late[-2:] = False  # one-sided differences
    return float(np.polyfit(rate[late], imbalance[late], 1)[0])
