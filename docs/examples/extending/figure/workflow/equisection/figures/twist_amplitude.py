"""Amplitude of the tip's twist over k* of every model."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.figure import Figure

from equisection.figures.models import LOOKS
from equisection.figures.origin import add_provenance, solvers_of
from equisection.figures.panels import legend_above, say
from equisection.figures.style import PAGE_WIDTH
from equisection.study.axes import onset_axis_among


def from_files(summary: Path) -> Figure:
    """Draw the amplitudes of ``comparison/summary.csv``."""
    return draw(pd.read_csv(summary))


def draw(summary: pd.DataFrame) -> Figure:
    """Draw the amplitude of the tip's twist of each model; failed runs have none.

    Parameters
    ----------
    summary
        ``comparison/summary.csv``.
    """
    figure = Figure(figsize=(PAGE_WIDTH, 3.0))
    axes = figure.subplots()
    along = onset_axis_among(summary.columns)
    axes.set(xlabel=along.label, ylabel="twist amplitude of the tip (deg)")
    known = summary[np.isfinite(summary["twist_amplitude_deg"].astype(float))]
    if known.empty:
        say(axes, "No run has an amplitude.")
    for model, runs in known.groupby("model", sort=False):
        look = LOOKS[str(model)]
        axes.plot(
            runs[along.name],
            runs["twist_amplitude_deg"],
            color=look.colour,
            linestyle=look.line,
            marker=look.marker,
            label=look.label,
        )
    legend_above(figure, axes, columns=3)
    made_by = summary[["solver", "resolution"]].drop_duplicates().itertuples(index=False)
    add_provenance(
        figure, *solvers_of((f"solver '{one.solver}'", one.resolution) for one in made_by)
    )
    return figure
