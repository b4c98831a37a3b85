"""Summary of the runs of a sweep: the verdict on each, and its cost."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from equisection.errors import ResultFileError
from equisection.results.unsteady_result import BOUNDED
from equisection.store.index import read_index
from equisection.study.axes import K_STAR, SPEED, AsGiven, Axis, Point, axes_of, onset_axis_among
from equisection.study.plan import model

#: Columns of ``comparison/summary.csv`` after the model and the axes of the study: attributes of a
#: result.
QUANTITIES = (
    "regime",
    "mean_twist_deg",
    "mean_deflection_chords",
    "twist_amplitude_deg",
    "frequency_strouhal",
    "growth_rate",
    "cpu_seconds",
    "wall_seconds",
    "end_time",
    "reason",
    "solver",
    "resolution",
    "mean_known",
    "loads_zigzag",
    "deflection_amplitude_chords",
    "heave_grows",
    "growth_standard_error",
    "growth_low",
    "growth_high",
    "growth_start",
    "growth_end",
    "growth_note",
    "twist_turns",
)
#: Those that results may lack, which were made before.
_NEWER = QUANTITIES[QUANTITIES.index("loads_zigzag") :]


def columns(axes: Sequence[Axis] = (K_STAR,)) -> tuple[str, ...]:
    """Return the columns of ``comparison/summary.csv`` of a study over some axes, in order."""
    return ("model", *(axis.name for axis in axes), *QUANTITIES)


def summary_of(indices: Iterable[Path]) -> pd.DataFrame:
    """Return the summary of the runs that some indices of results name.

    Parameters
    ----------
    indices
        Indices of a run, ``unsteady/<model>/<batch>.json``. The axes of the study come from the
        names of its cases.

    Raises
    ------
    ResultFileError
        An index cannot be read, or has a name that is not that of a case.
    """
    runs = [
        (index.parent.name, _point(index, name), attributes)
        for index in indices
        for name, attributes in read_index(index).items()
    ]
    rows = [(model, point.columns | attributes) for model, point, attributes in runs]
    return summarise(rows, axes_of(point for _, point, _ in runs))


def _point(index: Path, name: str) -> Point:
    try:
        return Point.named(name)
    except ValueError as error:
        raise ResultFileError(f"{index}: {error}; delete it and run again") from None


def summarise(
    rows: Iterable[tuple[str, Mapping[str, Any]]], axes: Sequence[Axis] = (K_STAR,)
) -> pd.DataFrame:
    """Return the summary, by model in the order given, then by ascending values on the axes.

    Parameters
    ----------
    rows
        Model and attributes of each result.
    axes
        Axes of the study.
    """
    frame = pd.DataFrame(
        [
            {"model": model}
            | {axis.name: attributes.get(axis.name, math.nan) for axis in axes}
            | {name: _of(attributes, name) for name in QUANTITIES}
            for model, attributes in rows
        ],
        columns=list(columns(axes)),
    )
    order = {model: number for number, model in enumerate(dict.fromkeys(frame["model"]))}
    return frame.sort_values(
        ["model", *(axis.name for axis in axes)],
        key=lambda column: column.map(order) if column.name == "model" else column,
    ).reset_index(drop=True)


def _of(attributes: Mapping[str, Any], name: str) -> Any:
    """Return an attribute; of results without ``mean_known`` only growth makes a mean unknown.

    A result without ``loads_zigzag`` has loads that are not iterated, or no history.
    """
    if name in _NEWER:
        return attributes.get(name, math.nan)
    if name == "mean_known" and name not in attributes:
        return int(attributes["regime"] in BOUNDED)
    return attributes[name]


def with_oscillations(
    summary: pd.DataFrame, factors: Mapping[str, float], default_reduction: str
) -> pd.DataFrame:
    """Return a summary whose amplitudes of the deflection are those of the tip, of sections too.

    Parameters
    ----------
    summary
        Summary with the amplitudes as recovered by the rule of the means.
    factors
        Factor of each reduction (:func:`equisection.reduction.reduce.oscillation_factor`).
    default_reduction
        Reduction of models that do not name theirs.
    """
    models = [model(str(name), default_reduction) for name in summary["model"]]
    factor = [factors[one.reduction] if one.dimension == "2d" else 1.0 for one in models]
    name = "deflection_amplitude_chords"
    return summary.assign(**{name: summary[name].astype(float) * factor})


def with_both(summary: pd.DataFrame, given: AsGiven) -> pd.DataFrame:
    """Return a summary over k* with the speed of each run at its end, or one over speed with k*."""
    if onset_axis_among(summary.columns) is K_STAR:
        return summary.assign(speed=given.speed_at(summary[K_STAR.name]))
    return summary.assign(k_star=given.k_star_at(summary[SPEED.name]))
