"""Cases of which histories and loops are shown, by the letters A to F.

A and D are just inside the instability (the highest unstable k*), B and E are just outside
(the lowest stable k* above the onset), C and F are the stiffest that did not fail; A, B, C of
the section, D, E, F of the beam.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import pandas as pd

from equisection.errors import ResultFileError
from equisection.study.axes import K_STAR, Axis, Point, onset_axis, onset_axis_among

SECTION_LETTERS = ("A", "B", "C")
BEAM_LETTERS = ("D", "E", "F")


@dataclass(frozen=True)
class ShownCase:
    """A letter of the figure with its case, or with the reason why there is none.

    Attributes
    ----------
    letter : str
        ``A`` to ``F``.
    value : float
        Its value on the axis of the onset; NaN if there is no such case.
    regime : str
        Its regime, or the reason why there is no such case.
    mean_twist_deg, mean_deflection_chords : float
        Its means (NaN if there is none).
    axis : Axis
        Axis of the onset.
    """

    letter: str
    value: float
    regime: str
    mean_twist_deg: float = math.nan
    mean_deflection_chords: float = math.nan
    axis: Axis = K_STAR

    @property
    def exists(self) -> bool:
        """Tell whether there is such a case."""
        return not math.isnan(self.value)

    @property
    def has_mean(self) -> bool:
        """Tell whether the case has a mean; a section that diverges statically has none."""
        return not math.isnan(self.mean_twist_deg)


def cases_shown(
    summary: pd.DataFrame, onset: pd.DataFrame, model: str, letters: Sequence[str]
) -> list[ShownCase]:
    """Choose the three cases of a model.

    Parameters
    ----------
    summary, onset
        ``comparison/summary.csv`` and ``comparison/onset.csv``.
    model
        The model.
    letters
        Letters of the case inside the instability, of that outside, of the stiffest.
    """
    runs = summary[(summary["model"] == model) & (summary["regime"] != "failed")]
    bracket = onset[onset["model"] == model]
    axis = onset_axis_among(summary.columns)
    unstable, stable = (
        float(bracket[f"{axis.name}_{side}"].iloc[0]) if len(bracket) else math.nan
        for side in ("unstable", "stable")
    )
    stiffest = max(map(float, runs[axis.name]), key=axis.stability, default=math.nan)
    nothing = "every run failed" if runs.empty else ""
    return [
        _case(runs, axis, letters[0], unstable, nothing or "no run is unstable"),
        _case(runs, axis, letters[1], stable, nothing or "no run above the onset is stable"),
        _case(runs, axis, letters[2], stiffest, nothing),
    ]


def _case(runs: pd.DataFrame, axis: Axis, letter: str, value: float, otherwise: str) -> ShownCase:
    found = runs[axis.same(runs[axis.name], value)]
    if found.empty:
        return ShownCase(letter, math.nan, otherwise, axis=axis)
    run = found.iloc[0]
    return ShownCase(
        letter,
        float(run[axis.name]),
        str(run["regime"]),
        float(run["mean_twist_deg"]),
        float(run["mean_deflection_chords"]),
        axis,
    )


def results_of(paths: Sequence[Path], model: str) -> dict[float, Path]:
    """Return the result files of a model (in the folder of its name) along the onset's axis."""
    points = {Point.named(path.stem): path for path in paths if path.parent.name == model}
    return {point[onset_axis(point.axes)]: path for point, path in points.items()}


def result_at(results: Mapping[float, Path], value: float, axis: Axis = K_STAR) -> Path:
    """Return the result file of a value on the onset's axis.

    Raises
    ------
    ResultFileError
        No result is named by this value.
    """
    nearest = min(results, key=lambda known: abs(known - value), default=math.nan)
    if not axis.same(nearest, value):
        raise ResultFileError(
            f"no result for {axis.symbol} = {value:g} among the {len(results)} given; summary.csv "
            "is not of this sweep: delete it and run again"
        )
    return results[nearest]
