"""Limit cycles over the sweep, by a model that is learnt from all of a release that grows.

A model knows the amplitudes that it was learnt from, so that the first 45 c/V of a release, which
give the onset, do not give the limit cycle (:func:`..reduced_model.limit_cycles`).
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from equisection.aerodynamics.learnt_loads import learn
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.aerodynamics.strip_polars import StripPolars
from equisection.analysis.recorded_beam import on_strips
from equisection.analysis.reduced_beam import limit_cycles_of_beams
from equisection.analysis.reduced_model import limit_cycles
from equisection.cases import UnsteadyCase
from equisection.motion.beam_lesson import BeamRelease, learn_strips
from equisection.study.axes import Axis

Floats = NDArray[np.float64]

#: Columns of the predicted limit cycles.
AMPLITUDE, EXTRAPOLATED = "limit_cycle_deg", "limit_cycle_extrapolated"
#: What is known of the error of a beam's limit cycle (``python -m tests.benchmarks learnt``).
ERROR_OF_BEAMS = "of a beam a guess: on embedded beams it was off by a factor of up to 4"


@dataclass(frozen=True)
class LimitCycles:
    """Limit cycles by a model.

    Attributes
    ----------
    table
        ``limit_cycle_deg``, amplitude of the tip's twist (deg), and ``limit_cycle_extrapolated``,
        by rising k*.
    words
        What the model was learnt from; empty where no release grows.
    """

    table: pd.DataFrame
    words: str


def no_cycles(count: int) -> LimitCycles:
    """Return the limit cycles of a sweep of which no release grows."""
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
    if not sections:
        return no_cycles(len(cases))
    found = limit_cycles(learn(grown, polar), sections, start=start)
    factor = np.array([section.twist_recovery for section in sections])
    there = [case.section is not None for case in cases]
    return _of_tips(there, found, factor, grown)


def cycles_of_beams(
    cases: Sequence[UnsteadyCase],
    grown: BeamRelease,
    polars: StripPolars,
    start: tuple[float, float] = (0.0, 0.0),
) -> LimitCycles:
    """Return the limit cycles of the beams of cases, as :func:`cycles_of` those of sections.

    ``polars`` are the steady loads along the span.
    """
    beams = [case.beam for case in cases if case.beam is not None]
    if not beams:
        return no_cycles(len(cases))
    loads = learn_strips(grown, polars, large=True)
    found = limit_cycles_of_beams(loads, on_strips(beams, loads.polars.strips), start=start)
    there = [case.beam is not None for case in cases]
    return _of_tips(there, found, np.ones(len(beams)), grown)


def _of_tips(
    there: Sequence[bool],
    found: pd.DataFrame,
    twist_recovery: Floats,
    grown: ReferenceHistory | BeamRelease,
) -> LimitCycles:
    """Return limit cycles with a line for each case, by those of the cases that have one."""
    table = no_cycles(len(there)).table
    table.loc[there, AMPLITUDE] = found["twist_amplitude_deg"].to_numpy() / twist_recovery
    table.loc[there, EXTRAPOLATED] = found["extrapolated"].to_numpy()
    words = (
        f"limit cycle by a model learnt from all {float(grown.time[-1]):.3g} c/V of the release "
        f"at k* = {grown.k_star:g}"
    )
    if isinstance(grown, BeamRelease):
        words += f", {ERROR_OF_BEAMS}"
    return LimitCycles(table, words)


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
