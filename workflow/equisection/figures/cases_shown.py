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
from equisection.study.plan import case_name, k_star_of

SECTION_LETTERS = ("A", "B", "C")
BEAM_LETTERS = ("D", "E", "F")

#: Relative difference of k* below which a name and a number mean the same case.
_SAME = 1e-5


@dataclass(frozen=True)
class ShownCase:
    """A letter of the figure and the case that it stands for, or why there is none.

    Attributes
    ----------
    letter : str
        ``A`` to ``F``.
    k_star : float
        NaN if there is no such case.
    regime : str
        Its regime, or why there is no such case.
    mean_twist_deg, mean_deflection_chords : float
        Its means (NaN if there is none).
    """

    letter: str
    k_star: float
    regime: str
    mean_twist_deg: float = math.nan
    mean_deflection_chords: float = math.nan

    @property
    def exists(self) -> bool:
        """Whether there is such a case."""
        return not math.isnan(self.k_star)

    @property
    def has_mean(self) -> bool:
        """Whether it has a mean; a section that diverges statically has none."""
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
    unstable = float(bracket["k_star_unstable"].iloc[0]) if len(bracket) else math.nan
    stable = float(bracket["k_star_stable"].iloc[0]) if len(bracket) else math.nan
    stiffest = float(runs["k_star"].max()) if len(runs) else math.nan
    nothing = "every run failed" if runs.empty else ""
    return [
        _case(runs, letters[0], unstable, nothing or "no run is unstable"),
        _case(runs, letters[1], stable, nothing or "no run above the onset is stable"),
        _case(runs, letters[2], stiffest, nothing),
    ]


def _case(runs: pd.DataFrame, letter: str, k_star: float, otherwise: str) -> ShownCase:
    found = runs[(runs["k_star"] - k_star).abs() <= _SAME * abs(k_star)]
    if found.empty:
        return ShownCase(letter, math.nan, otherwise)
    run = found.iloc[0]
    return ShownCase(
        letter,
        float(run["k_star"]),
        str(run["regime"]),
        float(run["mean_twist_deg"]),
        float(run["mean_deflection_chords"]),
    )


def results_of(paths: Sequence[Path], model: str) -> dict[float, Path]:
    """Return the result files of a model (in the folder of its name) by their k*."""
    return {k_star_of(path.stem): path for path in paths if path.parent.name == model}


def result_at(results: Mapping[float, Path], k_star: float) -> Path:
    """Return the result file of a k*.

    Raises
    ------
    ResultFileError
        No result is named by this k*.
    """
    named = results.get(k_star_of(case_name(k_star)))
    if named is not None:
        return named
    nearest = min(results, key=lambda k: abs(k - k_star), default=math.nan)
    if not abs(nearest - k_star) <= _SAME * k_star:
        raise ResultFileError(
            f"no result for k* = {k_star:g} among the {len(results)} given; summary.csv is not of "
            "this sweep: delete it and run again"
        )
    return results[nearest]
