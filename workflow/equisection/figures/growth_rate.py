"""Growth rate and frequency over k* of every model, and of classical linear theory."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from equisection.figures.models import LOOKS
from equisection.figures.origin import add_provenance, solvers_of
from equisection.figures.other_axis import add_other_axis, as_given
from equisection.figures.panels import letter, say
from equisection.figures.references import read_references
from equisection.figures.style import DASHES, GREY, LIGHT_GREY, PAGE_WIDTH
from equisection.results.netcdf import read_dataset
from equisection.study.axes import Axis, onset_axis_among

#: Symbols and units of the panels, by the columns of both tables.
_QUANTITIES = {
    "growth_rate": ("growth rate", "growth rate (V/c)"),
    "frequency_strouhal": ("frequency", "$f c/V$"),
}
_BAND_OF_FREQUENCY = ("frequency_low", "frequency_high")


def from_files(
    summary: Path, linear_theory: Path, references: Sequence[Path], learnt: Sequence[Path]
) -> Figure:
    """Draw the growth rates of the runs, of models learnt from them, and of linear theory."""
    stated = read_references(references, "onset_k_star")
    models = [read_dataset(path) for path in learnt]
    return draw(pd.read_csv(summary), pd.read_csv(linear_theory), stated, models)


def draw(
    summary: pd.DataFrame,
    linear: pd.DataFrame,
    onsets: pd.DataFrame,
    learnt: Sequence[xr.Dataset] = (),
) -> Figure:
    """Draw growth rates (left) and frequencies (right).

    Parameters
    ----------
    summary
        ``comparison/summary.csv``.
    linear
        ``comparison/linear_theory.csv``.
    onsets
        k* of onsets to mark, as :func:`read_references` returns them.
    learnt
        Models learnt from releases, ``rom/<model>/model.nc``, drawn without marks and with bands.
    """
    figure = Figure(figsize=(PAGE_WIDTH, 3.4))
    panels = figure.subplots(1, 2)
    along = onset_axis_among(summary.columns)
    for axes, place, (name, (title, label)) in zip(panels, "ab", _QUANTITIES.items(), strict=True):
        axes.set(xlabel=along.label, ylabel=label)
        letter(axes, place, title)
        _over_study(axes, summary, linear, name, along)
        _by_learnt_models(axes, learnt, name, summary)
        for k_star, name_of in zip(onsets["value"], onsets["label"], strict=True):
            axes.axvline(k_star, color=GREY, linewidth=0.8, linestyle=":", label=name_of)
        if axes.has_data():
            add_other_axis(axes, along, as_given(summary))
    entries = {
        label: handle
        for axes in panels
        for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)
    }
    if entries:
        figure.legend(handles=list(entries.values()), loc="outside upper center", ncols=3)
    sources = solvers_of(
        (f"solver '{solver}'", str(resolution))
        for solver, resolution in summary[["solver", "resolution"]].drop_duplicates().values
    )
    learnt_words = [
        f"band, and bar from end to end of the onset: {data.attrs['model']}, {data.attrs['words']}"
        for data in learnt
    ]
    add_provenance(
        figure, *sources, *learnt_words, "linear: thin plate in free air, Theodorsen, p-k method"
    )
    return figure


def _by_learnt_models(
    axes: Axes, learnt: Sequence[xr.Dataset], name: str, summary: pd.DataFrame
) -> None:
    """Draw what learnt models predict, where the motion is one that they have seen."""
    low, high = ("growth_low", "growth_high") if name == "growth_rate" else _BAND_OF_FREQUENCY
    along = onset_axis_among(summary.columns).name
    for data in learnt:
        look = LOOKS[str(data.attrs["model"])]
        seen = data.isel({along: (data["extrapolated"].values == 0) & data[name].notnull().values})
        axes.fill_between(seen[along], seen[low], seen[high], color=look.colour, alpha=0.15, lw=0)
        axes.plot(
            seen[along],
            seen[name],
            color=look.colour,
            linewidth=0.8,
            label=f"{look.label}, model learnt at k* = {data.attrs['learnt_from_k_star']:g}",
        )
        if name == "growth_rate":
            _interval_of_onset(axes, data, along, look.colour)


def _interval_of_onset(axes: Axes, data: xr.Dataset, along: str, colour: str) -> None:
    """Draw the interval of the onset of a learnt model on the line of no growth."""
    at = [float(data.attrs.get(f"onset_k_star{end}", np.nan)) for end in ("_low", "_high")]
    if not np.isfinite(at).all():
        return
    order = np.argsort(data["k_star"].values)
    ends = np.interp(at, data["k_star"].values[order], data[along].values[order])
    axes.plot(ends, [0.0, 0.0], color=colour, linewidth=3.0, alpha=0.5, solid_capstyle="butt")


def _over_study(
    axes: Axes, summary: pd.DataFrame, linear: pd.DataFrame, name: str, along: Axis
) -> None:
    known = summary[np.isfinite(summary[name].astype(float)) & (summary["regime"] != "failed")]
    if known.empty and linear.empty:
        say(axes, f"No run has a {_QUANTITIES[name][0]}.")
        return
    axes.axhline(0.0, color=LIGHT_GREY, linewidth=0.8)
    for model, runs in known.groupby("model", sort=False):
        look = LOOKS[str(model)]
        axes.plot(
            runs[along.name],
            runs[name],
            color=look.colour,
            linestyle=look.line,
            marker=look.marker,
            label=look.label,
        )
    for number, ((reduction, motion), rows) in enumerate(
        linear.groupby(["reduction", "motion"], sort=False), start=1
    ):
        axes.plot(
            rows[along.name],
            rows[name],
            color=GREY,
            linestyle=DASHES[number],
            marker="." if len(rows) == 1 else "",
            label=f"linear, {motion}, {reduction} reduction",
        )
