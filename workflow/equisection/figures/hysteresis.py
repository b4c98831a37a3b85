"""Loops of the lift over the twist, and phase portraits, inside and at the onset."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import matplotlib
import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure
from numpy.typing import NDArray

from equisection.figures.cases_shown import (
    SECTION_LETTERS,
    ShownCase,
    cases_shown,
    result_at,
    results_of,
)
from equisection.figures.drawn_history import History, read_history
from equisection.figures.models import LOOKS
from equisection.figures.models_shown import section_model
from equisection.figures.origin import add_provenance, solver_of, solvers_of
from equisection.figures.panels import in_words, letter, say
from equisection.figures.style import PAGE_WIDTH
from equisection.results.netcdf import read_dataset
from equisection.store.index import result_files

#: Colours of time, dark at first.
_COLOURS = matplotlib.colormaps["viridis"]


@dataclass(frozen=True)
class Loops:
    """Cases A and B, with their histories by letter; the model is None without a 2D one."""

    model: str | None
    cases: Sequence[ShownCase]
    histories: Mapping[str, History]
    solver: str  # of the sweep, for when there is no history


def read_loops(
    summary: pd.DataFrame, onset: pd.DataFrame, results: Sequence[Path], i_star: float
) -> Loops:
    """Choose cases A and B of the section and read their histories alone."""
    model = section_model(list(dict.fromkeys(summary["model"])))
    solver = "no run"
    if len(summary):
        first = summary.iloc[0]
        solver = solver_of(f"solver '{first['solver']}'", str(first["resolution"]))
    if model is None:
        return Loops(None, (), {}, solver)
    cases = cases_shown(summary, onset, model, SECTION_LETTERS)[:2]
    files = results_of(results, model)
    histories = {
        case.letter: read_history(result_at(files, case.value, case.axis), i_star)
        for case in cases
        if case.exists
    }
    return Loops(model, cases, histories, solver)


def from_files(
    summary: Path, onset: Path, indices: Sequence[Path], equivalent: Path, reduction: str
) -> Figure:
    """Draw the loops of cases A and B."""
    i_star = float(read_dataset(equivalent)["i_star"].sel(reduction=reduction))
    return draw(read_loops(pd.read_csv(summary), pd.read_csv(onset), result_files(indices), i_star))


def draw(loops: Loops) -> Figure:
    """Draw c_l over theta (top) and d theta/dt* over theta (bottom) of case A and of case B."""
    figure = Figure(figsize=(PAGE_WIDTH, 5.6))
    panels = figure.subplots(2, 2)
    cases = {case.letter: case for case in loops.cases}
    for column, name in enumerate(SECTION_LETTERS[:2]):
        top, bottom = panels[0, column], panels[1, column]
        case, history = cases.get(name), loops.histories.get(name)
        title = name
        if case and case.exists and loops.model:
            label = LOOKS[loops.model].label
            title = f"{name}: {label}, {case.axis.typeset(case.value)}, {in_words(case.regime)}"
        letter(top, "ab"[column], title)
        letter(bottom, "cd"[column], f"{name}, phase portrait")
        if case is None or history is None or history.time.size < 3:
            reason = _why_nothing(case)
            for axes in (top, bottom):
                say(axes, f"No history of case {name}: {reason}.")
            continue
        rate = np.gradient(history.twist_deg, history.time)
        _trace(top, history.twist_deg, history.lift, history.time)
        lines = _trace(bottom, history.twist_deg, rate, history.time)
        figure.colorbar(lines, ax=[top, bottom], label="$t^*$", pad=0.02, aspect=40)
        top.set(xlabel=r"$\theta$ (deg)", ylabel="$c_l$")
        bottom.set(xlabel=r"$\theta$ (deg)", ylabel=r"$\mathrm{d}\theta/\mathrm{d}t^*$ (deg)")
    words = solvers_of((h.description, h.resolution) for h in loops.histories.values())
    add_provenance(figure, *(words or (loops.solver,)))
    return figure


def _why_nothing(case: ShownCase | None) -> str:
    if case is None:
        return "no run of a 2D model has a result"
    return "it diverged" if case.exists else case.regime


def _trace(
    axes: Axes,
    x: NDArray[np.float64],
    y: NDArray[np.float64],
    time: NDArray[np.float64],
) -> LineCollection:
    """Draw y over x as a line whose colour is the time."""
    points = np.stack([x, y], axis=1)
    lines = LineCollection(
        list(np.stack([points[:-1], points[1:]], axis=1)),
        array=0.5 * (time[:-1] + time[1:]),
        cmap=_COLOURS.resampled(256),
        linewidth=0.55,
        rasterized=True,
    )
    lines.set_clim(float(time[0]), float(time[-1]))
    axes.add_collection(lines)
    axes.autoscale_view()
    axes.margins(0.06)
    return lines
