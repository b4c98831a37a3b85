"""Growth rate and frequency over k* of every model, and of classical linear theory."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from equisection.figures.models import LOOKS, Look
from equisection.figures.origin import add_provenance, solvers_of
from equisection.figures.other_axis import add_other_axis, as_given
from equisection.figures.panels import letter, say
from equisection.figures.references import read_references
from equisection.figures.style import DASHES, GREY, LIGHT_GREY, PAGE_WIDTH
from equisection.results.netcdf import read_dataset
from equisection.results.unsteady_result import Regime
from equisection.study.axes import Axis, onset_axis_among

#: Symbols and units of the panels, by the columns of both tables.
_QUANTITIES = {
    "growth_rate": ("growth rate", "growth rate (V/c)"),
    "frequency_strouhal": ("frequency", "$f c/V$"),
}
#: Ends of the interval of a growth rate.
_ENDS = ("growth_low", "growth_high")
_BAND_OF_FREQUENCY = ("frequency_low", "frequency_high")
#: Height of the panel of growth rates, over how far they are apart, from which bars are left long.
_MOST_ROOM = 5.0


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
    """Draw growth rates with their intervals, frequencies, and limit cycles of learnt models.

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
    with_cycles = [data for data in learnt if data.attrs.get("limit_cycles")]
    figure = Figure(figsize=(PAGE_WIDTH, 3.4))
    panels = figure.subplots(1, 3 if with_cycles else 2)
    along = onset_axis_among(summary.columns)
    if with_cycles:
        _limit_cycles(panels[2], with_cycles, summary, along)
    for axes, place, (name, (title, label)) in zip(
        panels[:2], "ab", _QUANTITIES.items(), strict=True
    ):
        axes.set(xlabel=along.label, ylabel=label)
        letter(axes, place, title)
        _over_study(axes, summary, linear, name, along)
        _by_learnt_models(axes, learnt, name, summary)
        if name == "growth_rate":
            _leave_long_bars(axes)
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
    sources: tuple[str, ...] = solvers_of(
        (f"solver '{solver}'", str(resolution))
        for solver, resolution in summary[["solver", "resolution"]].drop_duplicates().values
    )
    if set(_ENDS) <= set(summary) and summary[list(_ENDS)].notna().any(axis=None):
        sources += ("bars: 95 % of the fit of twist and deflection; open mark: sign not told",)
    learnt_words = [
        f"band, and bar from end to end of the onset: {data.attrs['model']}, {data.attrs['words']}"
        for data in learnt
    ]
    learnt_words += [
        f"(c): {data.attrs['model']}, {data.attrs['limit_cycles']}" for data in with_cycles
    ]
    add_provenance(
        figure, *sources, *learnt_words, "linear: thin plate in free air, Theodorsen, p-k method"
    )
    return figure


def _limit_cycles(
    axes: Axes, learnt: Sequence[xr.Dataset], summary: pd.DataFrame, along: Axis
) -> None:
    """Draw the limit cycles of learnt models, dotted beyond what they have seen, and of runs."""
    axes.set(xlabel=along.label, ylabel="amplitude of the limit cycle (deg)")
    letter(axes, "c", "limit cycle")
    for data in learnt:
        look = LOOKS[str(data.attrs["model"])]
        at, size = data[along.name].values, data["limit_cycle_deg"].values
        beyond = data["limit_cycle_extrapolated"].values == 1
        axes.plot(at, np.where(beyond, np.nan, size), color=look.colour, linewidth=0.8)
        axes.plot(at, np.where(beyond, size, np.nan), color=look.colour, linewidth=0.8, ls=":")
        runs = summary[
            (summary["model"] == data.attrs["model"]) & (summary["regime"] == Regime.LIMIT_CYCLE)
        ]
        axes.plot(
            runs[along.name],
            runs["twist_amplitude_deg"],
            color=look.colour,
            linestyle="",
            marker=look.marker,
        )
    axes.set_ylim(bottom=0.0)
    add_other_axis(axes, along, as_given(summary))


def _by_learnt_models(
    axes: Axes, learnt: Sequence[xr.Dataset], name: str, summary: pd.DataFrame
) -> None:
    """Draw what learnt models predict, where the motion is one that they have seen."""
    low, high = _ENDS if name == "growth_rate" else _BAND_OF_FREQUENCY
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


def _intervals(axes: Axes, runs: pd.DataFrame, along: Axis, look: Look) -> None:
    """Draw the intervals of growth rates, and open marks where they hold zero."""
    low, high = _ENDS
    known = runs[runs[low].notna() & runs[high].notna()]
    axes.vlines(known[along.name], known[low], known[high], color=look.colour, linewidth=0.8)
    unknown = known[(known[low] <= 0.0) & (known[high] >= 0.0)]
    axes.plot(
        unknown[along.name],
        unknown["growth_rate"],
        color=look.colour,
        linestyle="none",
        marker=look.marker,
        markerfacecolor="white",
    )


def _leave_long_bars(axes: Axes) -> None:
    """Let bars that are far longer than growth rates differ go on beyond the frame."""
    drawn = [line.get_ydata() for line in axes.lines if line.get_transform() == axes.transData]
    values = np.concatenate([[0.0], *(np.asarray(one, dtype=float) for one in drawn)])
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    room = high - low
    bottom, top = axes.get_ylim()
    if top - bottom > _MOST_ROOM * room > 0.0:
        axes.set_ylim(max(bottom, low - room), min(top, high + room))


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
        if name == "growth_rate" and set(_ENDS) <= set(runs):
            _intervals(axes, runs, along, look)
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
