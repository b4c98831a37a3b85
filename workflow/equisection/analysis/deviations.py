"""How far each section is from the beam that it stands for: which reduction comes closer.

The beam (`3d`) is what every section is to stand for, so it is the measure here, run by the same
solver. Twist and deflection of a section are those of the tip, recovered by its own reduction.
"""

from __future__ import annotations

import numpy as np
import pandas as pd

#: Quantities of ``comparison/summary.csv`` whose ratio to the beam's tells how close a section is.
_RATIOS = {
    "twist": "mean_twist_deg",
    "deflection": "mean_deflection_chords",
    "frequency": "frequency_strouhal",
}
#: What a section is judged by: three relative deviations (-) and the difference of the growth
#: rates (V/c), which pass through zero.
QUANTITIES = (*_RATIOS, "growth")
#: Columns of ``comparison/section_and_beam.csv``, in order.
COLUMNS = ("model", "k_star", *QUANTITIES)
#: The model that the others are compared with.
BEAM = "3d"


def deviations(summary: pd.DataFrame) -> pd.DataFrame:
    """Return ``comparison/section_and_beam.csv``: each section at each k* that the beam has too.

    Parameters
    ----------
    summary
        ``comparison/summary.csv``. Failed runs count as not run.

    Returns
    -------
    pd.DataFrame
        ``twist``, ``deflection`` and ``frequency``: section over beam, less one (-); ``growth``:
        section less beam (V/c). NaN where one of both has no such number. Means that are not
        settled (``mean_known``) are compared as they are, over the last periods of both.
    """
    run = summary[summary["regime"] != "failed"]
    beam = run[run["model"] == BEAM].drop(columns="model")
    both = run[run["model"] != BEAM].merge(beam, on="k_star", suffixes=("", "_beam"))
    return pd.DataFrame(
        {
            "model": both["model"],
            "k_star": both["k_star"],
            **{
                name: both[column] / both[f"{column}_beam"] - 1.0
                for name, column in _RATIOS.items()
            },
            "growth": both["growth_rate"] - both["growth_rate_beam"],
        },
        columns=list(COLUMNS),
    )


def root_mean_square(table: pd.DataFrame) -> pd.DataFrame:
    """Return the root mean square over k* of each deviation, one line for each model.

    It is over the k* at which all models have it, but for those that have it at none: one that
    fails where it is hardest to be close must not be the closer for it.
    """
    lines = {}
    for name in QUANTITIES:
        by_k_star = table.pivot(index="k_star", columns="model", values=name).astype(float)
        lines[name] = np.sqrt((by_k_star.dropna(axis="columns", how="all").dropna() ** 2).mean())
    return pd.DataFrame(lines, index=table["model"].drop_duplicates())
