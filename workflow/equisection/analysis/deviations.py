"""Deviation of each section from its beam, by which the reductions are compared.

The beam (`3d`), run by the same solver, is the reference. Twist and deflection of a section are
those of the tip, recovered by its own reduction.
"""

from __future__ import annotations

import numpy as np
import pandas as pd

from equisection.results.unsteady_result import BOUNDED, UNKNOWN
from equisection.study.axes import AXES, INCIDENCE, axes_among

#: Quantities of ``comparison/summary.csv`` whose ratio to the beam's tells how close a section is.
_RATIOS = {
    "twist": "mean_twist_deg",
    "deflection": "mean_deflection_chords",
    "frequency": "frequency_strouhal",
}
#: What a section is judged by: three relative deviations (-) and the difference of the growth
#: rates (V/c), which pass through zero.
QUANTITIES = (*_RATIOS, "growth")
#: The model that the others are compared with.
BEAM = "3d"
#: Means up to which one is nil, that of a symmetric beam at no incidence: twist (deg), deflection
#: (chords). What a finite record has in their place is what is left of its oscillation.
NIL = {"mean_twist_deg": 0.005, "mean_deflection_chords": 0.001}


def deviations(summary: pd.DataFrame) -> pd.DataFrame:
    """Return ``comparison/section_and_beam.csv``: each section at each point that the beam has too.

    Parameters
    ----------
    summary
        ``comparison/summary.csv``; the axes of its study are columns here too. Failed and
        undecided runs count as not run.

    Returns
    -------
    pd.DataFrame
        ``twist``, ``deflection`` and ``frequency``: section over beam, less one (-); ``growth``:
        section less beam (V/c). NaN where section or beam has no such number, and of means that
        are nil (:func:`means_are_nil`). Means that are not settled (``mean_known``) are compared as
        they are, over the last periods of both. Last comes the speed of a study over k*, or the k*
        of one over speed, where the summary has it.
    """
    axes = [axis.name for axis in axes_among(summary.columns)]
    also = [axis.name for axis in AXES if axis.name in summary and axis.name not in axes]
    run = summary[~summary["regime"].isin(UNKNOWN)]
    beam = run[run["model"] == BEAM].drop(columns="model")
    both = run[run["model"] != BEAM].merge(beam, on=axes, suffixes=("", "_beam"))
    both.loc[_are_nil(both, summary), list(NIL)] = np.nan
    return pd.DataFrame(
        {
            "model": both["model"],
            **{name: both[name] for name in axes},
            **{
                name: both[column] / both[f"{column}_beam"] - 1.0
                for name, column in _RATIOS.items()
            },
            "growth": both["growth_rate"] - both["growth_rate_beam"],
            **{name: both[name] for name in also},
        },
        columns=["model", *axes, *QUANTITIES, *also],
    )


def means_are_nil(summary: pd.DataFrame) -> bool:
    """Tell whether both means of the beam are nil (:data:`NIL`) wherever its motion is bounded."""
    bounded = summary[(summary["model"] == BEAM) & summary["regime"].isin(BOUNDED)]
    means = bounded[list(NIL)].dropna()
    return not means.empty and bool((means.abs() < pd.Series(NIL)).all(axis=None))


def _are_nil(both: pd.DataFrame, summary: pd.DataFrame) -> pd.Series:
    """Tell of each line whether the means at its incidence are nil."""
    angle = INCIDENCE.name
    if angle not in both:
        return pd.Series(means_are_nil(summary), index=both.index)
    nil = {one: means_are_nil(runs) for one, runs in summary.groupby(angle)}
    return both[angle].map(nil).astype(bool)


def root_mean_square(table: pd.DataFrame) -> pd.DataFrame:
    """Return the root mean square of each deviation over the study, one line for each model.

    It is over the points at which all models have the deviation; models that have it at no point
    are left out. So a model that fails at a difficult point does not come closer by that.
    """
    axes = [axis.name for axis in axes_among(table.columns)]
    lines = {}
    for name in QUANTITIES:
        by_point = table.pivot(index=axes, columns="model", values=name).astype(float)
        lines[name] = np.sqrt((by_point.dropna(axis="columns", how="all").dropna() ** 2).mean())
    return pd.DataFrame(lines, index=table["model"].drop_duplicates())
