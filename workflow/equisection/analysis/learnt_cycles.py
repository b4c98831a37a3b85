"""Limit cycles over the sweep, by a model that is learnt from all of a release that grows.

A model knows the amplitudes that it was learnt from, so that the first 45 c/V of a release, which
give the onset, do not give the limit cycle (:func:`..reduced_model.limit_cycles`). That of a beam
has too few terms for large amplitudes, and gives none.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
import xarray as xr

from equisection.aerodynamics.learnt_loads import learn
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.analysis.reduced_model import limit_cycles
from equisection.cases import UnsteadyCase
from equisection.study.axes import Axis

#: Columns of the predicted limit cycles.
AMPLITUDE, EXTRAPOLATED = "limit_cycle_deg", "limit_cycle_extrapolated"


@dataclass(frozen=True)
class LimitCycles:
    """Limit cycles by a model.

    Attributes
    ----------
    table
        ``limit_cycle_deg``, amplitude of the tip's twist (deg), and ``limit_cycle_extrapolated``,
        by rising k*.
    words
        What the model was learnt from; empty where none is known.
    """

    table: pd.DataFrame
    words: str


def no_cycles(count: int) -> LimitCycles:
    """Return the limit cycles of a sweep of which none is known."""
    table = pd.DataFrame({AMPLITUDE: math.nan, EXTRAPOLATED: False}, index=range(count))
    return LimitCycles(table, "")


def cycles_of(
    cases: Sequence[UnsteadyCase],
    grown: ReferenceHistory,
    polar: Polar,
    start: tuple[float, float] = (0.0, 0.0),
) -> LimitCycles:
    """Return the limit cycles of the sections of cases.

    Parameters
    ----------
    cases
        Cases of sections by rising k*, some perhaps without a section to move.
    grown
        The release that grows.
    polar
        Steady polar of the section.
    start
        Twist (rad) and heave rate (over V) of the tip from which they are released.

    Raises
    ------
    ResultFileError
        The release cannot be learnt from.
    """
    sections = [case.section for case in cases if case.section is not None]
    found = no_cycles(len(cases))
    if not sections:
        return found
    table = found.table
    there = [case.section is not None for case in cases]
    of_sections = limit_cycles(learn(grown, polar), sections, start=start)
    factor = np.array([section.twist_recovery for section in sections])
    table.loc[there, AMPLITUDE] = of_sections["twist_amplitude_deg"].to_numpy() / factor
    table.loc[there, EXTRAPOLATED] = of_sections["extrapolated"].to_numpy()
    return LimitCycles(
        table,
        f"limit cycle by a model learnt from all {float(grown.time[-1]):.3g} c/V of the release "
        f"at k* = {grown.k_star:g}",
    )


def with_cycles(dataset: xr.Dataset, cycles: LimitCycles, axis: Axis) -> xr.Dataset:
    """Return ``rom/<model>/model.nc`` with limit cycles."""
    described = {
        AMPLITUDE: ("deg", "amplitude of the tip's twist in the limit cycle, 0 of one that decays"),
        EXTRAPOLATED: ("1", "1: it goes to an incidence that the release has not seen"),
    }
    return dataset.assign(
        {
            name: (
                axis.name,
                cycles.table[name].to_numpy(dtype=float),
                {"units": units, "long_name": text, "missing_allowed": "1"},
            )
            for name, (units, text) in described.items()
        }
    ).assign_attrs(limit_cycles=cycles.words)
