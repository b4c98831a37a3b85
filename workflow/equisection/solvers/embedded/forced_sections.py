"""Loads of a section in prescribed motion, by the equations of the embedded solver.

The circulation follows by lags that are Theodorsen's (:mod:`equisection.aerodynamics.wake_lags`),
since a prescribed motion can have as many as it needs.
"""

from __future__ import annotations

import math

import numpy as np

from equisection.aerodynamics.unsteady_loads import ForcedMotion, UnsteadyLoads, forced_loads
from equisection.aerodynamics.wake_lags import WakeLags, accurate_lags
from equisection.cases import ForcedCase
from equisection.errors import IncidenceOutOfRangeError
from equisection.results.forced_result import ForcedResult, motion_of
from equisection.solvers.embedded.job_work import STEPS

#: Steps beyond the end, where differences are one-sided.
_BEYOND = 4


def forced_section(
    case: ForcedCase, loads: UnsteadyLoads, wake: WakeLags | None = None
) -> ForcedResult:
    """Return the history of a case; a failed one where the section leaves its polar.

    Parameters
    ----------
    case
        The case.
    loads
        Unsteady loads of its polar.
    wake
        Lags of the circulation; Theodorsen's with None.
    """
    longest = math.tau / max(one.frequency for one in case.harmonics) / STEPS
    every = max(1, math.ceil(case.output_interval / longest - 1e-9))
    step = case.output_interval / every
    number = round(case.duration / case.output_interval) * every + 1
    time = np.asarray(step * np.arange(number + _BEYOND), dtype=np.float64)
    twist, deflection = motion_of(case, time)
    motion = ForcedMotion(time, math.radians(case.incidence_deg) + twist, deflection)
    found = forced_loads(motion, loads, wake or accurate_lags())
    failure, kept = "", slice(0, number, every)
    try:
        for incidence in (found.effective_incidence.min(), found.effective_incidence.max()):
            loads.branches.polar.require(float(incidence))
    except IncidenceOutOfRangeError as error:
        failure = f"{error}; or make forced.amplitude_deg smaller"
    return ForcedResult(
        time[kept],
        twist[kept],
        deflection[kept],
        found.lift_coefficient[kept],
        found.moment_coefficient[kept],
        failure,
    )
