"""Difference of each section from the beam over k*: twist, deflection, frequency and growth."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from equisection.analysis.deviations import means_are_nil, root_mean_square
from equisection.figures.models import LOOKS
from equisection.figures.origin import add_provenance, solvers_of
from equisection.figures.other_axis import add_other_axis, as_given
from equisection.figures.panels import legend_above, letter, say
from equisection.figures.style import GREY, PAGE_WIDTH
from equisection.keys.shown import rounded
from equisection.study.axes import Axis, onset_axis_among

#: Titles and axes of the panels, with the factor to what the axis shows.
_QUANTITIES = {
    "twist": ("mean twist", "section over beam $- 1$ (%)", 100.0),
    "deflection": ("mean deflection", "section over beam $- 1$ (%)", 100.0),
    "frequency": ("frequency", "section over beam $- 1$ (%)", 100.0),
    "growth": ("growth rate", "section $-$ beam ($10^{-3}$ V/c)", 1000.0),
}
_MEANS = ("twist", "deflection")
#: Height (pt) of the words beside the title above a panel, with an axis at the top and without.
_ABOVE_AXIS, _ABOVE = 24.0, 3.0
#: Units of the root mean squares beside the panels' titles.
_UNITS = {"twist": " %", "deflection": " %", "frequency": " %", "growth": ""}


def from_files(summary: Path, deviations: Path) -> Figure:
    """Draw ``comparison/section_and_beam.csv``."""
    return draw(pd.read_csv(deviations), pd.read_csv(summary))


def draw(table: pd.DataFrame, summary: pd.DataFrame) -> Figure:
    """Draw the deviations of the sections from the beam, and their root mean square over k*.

    Parameters
    ----------
    table
        ``comparison/section_and_beam.csv``.
    summary
        ``comparison/summary.csv``, for solver and resolution.
    """
    figure = Figure(figsize=(PAGE_WIDTH, 5.4))
    panels = figure.subplots(2, 2)
    over_all = root_mean_square(table)
    for axes, place, name in zip(panels.flat, "abcd", _QUANTITIES, strict=True):
        title, label, factor = _QUANTITIES[name]
        letter(axes, place, title)
        along = onset_axis_among(table.columns)
        axes.set(xlabel=along.label, ylabel=label)
        if name in _MEANS and means_are_nil(summary):
            say(axes, "Means are nil: symmetric, at no incidence.")
        else:
            _over_study(axes, table, name, factor, along)
        if place in "ab" and axes.lines:  # those below have the same axis
            add_other_axis(axes, along, as_given(table))
        _root_mean_squares(axes, over_all[name] * factor, _UNITS[name])
    drawn = [axes for axes in panels.flat if axes.lines]
    if drawn:
        legend_above(figure, drawn[0], columns=2)
    sources = summary[["solver", "resolution"]].drop_duplicates().values
    add_provenance(figure, *solvers_of((f"solver '{one}'", str(mesh)) for one, mesh in sources))
    return figure


def _over_study(axes: Axes, table: pd.DataFrame, name: str, factor: float, along: Axis) -> None:
    known = table[np.isfinite(table[name].astype(float))]
    if known.empty:
        say(axes, f"No section and beam were run at one {along.symbol}.")
        return
    axes.axhline(0.0, color=GREY, linewidth=0.8)
    for model, rows in known.groupby("model", sort=False):
        look = LOOKS[str(model)]
        axes.plot(
            rows[along.name],
            factor * rows[name],
            color=look.colour,
            linestyle=look.line,
            marker=look.marker,
            label=look.label,
        )


def _root_mean_squares(axes: Axes, values: pd.Series, unit: str) -> None:
    """Write the root mean squares on the right of the panel's title, in the models' colours."""
    words = [(str(model), f"{rounded(value, 2)}{unit}") for model, value in values.dropna().items()]
    place = 1.0
    for model, word in reversed(words):
        axes.annotate(
            word,
            (place, 1.0),
            xycoords="axes fraction",
            xytext=(0.0, _ABOVE_AXIS if axes.child_axes else _ABOVE),
            textcoords="offset points",
            ha="right",
            va="bottom",
            fontsize=6.5,
            color=LOOKS[model].colour,
        )
        place -= 0.035 + 0.0185 * len(word)
