"""One line for each run: what it turned out to be, and what it cost."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any

import pandas as pd

#: Columns of ``comparison/summary.csv``, in order; the attributes of a result they come from.
COLUMNS = (
    "model",
    "k_star",
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
)


def summarise(rows: Iterable[tuple[str, Mapping[str, Any]]]) -> pd.DataFrame:
    """Return the summary, by model in the order given and k* ascending.

    Parameters
    ----------
    rows
        Model and attributes of each result.
    """
    frame = pd.DataFrame(
        [
            {"model": model, **{name: _of(attributes, name) for name in COLUMNS[1:]}}
            for model, attributes in rows
        ],
        columns=list(COLUMNS),
    )
    order = {model: number for number, model in enumerate(dict.fromkeys(frame["model"]))}
    return frame.sort_values(
        ["model", "k_star"],
        key=lambda column: column.map(order) if column.name == "model" else column,
    ).reset_index(drop=True)


def _of(attributes: Mapping[str, Any], name: str) -> Any:
    """Return an attribute; of results without ``mean_known`` only growth makes a mean unknown."""
    if name == "mean_known" and name not in attributes:
        return int(attributes["regime"] in {"settled", "limit-cycle"})
    return attributes[name]
