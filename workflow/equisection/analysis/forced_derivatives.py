"""Flutter derivatives from the histories of forced motion."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pandas as pd

from equisection.aerodynamics.derivatives import Derivatives
from equisection.analysis.forced_loads import ForcedResults, LoadsOverMotion, loads_over_motion
from equisection.cases import ForcedCase

#: Rows of Q by the loads, and columns by the components of the motion.
_LOADS, _COMPONENTS = ("cl", "cm"), ("heave", "pitch")


@dataclass(frozen=True)
class ForcedAnswers:
    """Derivatives, how well each history is fitted, and what there is to say of it."""

    derivatives: Derivatives
    fits: pd.DataFrame
    remarks: tuple[str, ...]


def derivatives_of(results: ForcedResults) -> ForcedAnswers:
    """Return the derivatives of the cases of one section, in pitch and in heave.

    Parameters
    ----------
    results
        Case and data set of each result, by name.

    Raises
    ------
    ResultFileError
        A case has no whole history, or a component is missing at a reduced velocity.
    """
    found = loads_over_motion(
        results,
        _LOADS,
        _COMPONENTS,
        moved=lambda case: case.component,
        histories=lambda data: [data[load].to_numpy() for load in _LOADS],
        driven=lambda case, data: {
            "heave": data["deflection"].to_numpy() / case.geometry.chord,
            "pitch": data["twist"].to_numpy(),
        },
    )
    first = next(case for case, _ in results.values())
    return ForcedAnswers(_table(found, first), found.fits, found.remarks)


def _source(case: ForcedCase) -> str:
    """Return the solver and the resolution, or the source of what a solver has read."""
    recorded = case.solver.settings.get("source")
    return str(recorded or f"solver {case.solver.name}, {case.resolution}")


def _table(found: LoadsOverMotion, case: ForcedCase) -> Derivatives:
    by_k = found.spread / (math.tau / found.reduced_velocity[:, None, None]) ** 2
    (lift_w, lift_twist), (moment_w, moment_twist) = np.moveaxis(by_k, 0, -1)
    columns = (
        lift_w,
        lift_twist,
        lift_twist,
        lift_w,
        moment_w,
        moment_twist,
        moment_twist,
        moment_w,
    )
    return Derivatives.of_loads(
        found.reduced_velocity,
        found.values,
        spread=np.stack(columns, axis=1),
        incidence_deg=case.incidence_deg,
        label=f"forced motion, {_source(case)}",
    )
