"""Mean deformation over k* for every model, and histories of the twist."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Patch
from matplotlib.patheffects import withStroke
from matplotlib.ticker import MaxNLocator

from equisection.analysis.deviations import deviations
from equisection.figures.cases_shown import (
    BEAM_LETTERS,
    SECTION_LETTERS,
    ShownCase,
    cases_shown,
    result_at,
    results_of,
)
from equisection.figures.drawn_history import Extent, History, read_extent, read_history
from equisection.figures.models import LOOKS, Look
from equisection.figures.models_shown import beam_model, section_model
from equisection.figures.origin import add_provenance, solvers_of
from equisection.figures.other_axis import add_other_axis, as_given
from equisection.figures.panels import in_words, letter, say
from equisection.figures.style import GREY, PAGE_WIDTH
from equisection.results.netcdf import read_dataset
from equisection.results.section_dataset import oscillation_factors as factors_of
from equisection.results.unsteady_result import BOUNDED, Regime
from equisection.solvers.known_error import side_in_words
from equisection.store.index import result_files
from equisection.study.axes import K_STAR, Axis, onset_axis_among
from equisection.study.plan import model as model_named

#: Places z/L of twist and deflection at a free tip.
AT_TIPS = (1.0, 1.0)
#: Distance z/L below which a place is that of its name.
_ONE_PLACE = 1e-3
#: Marks, on the axis, of runs without a mean.
_FAILED, _DIVERGED = "x", "+"
#: Markers of a model at most, but for the few that are of another kind than the rest.
_MOST_MARKERS = 40
#: Part of the axis below which two letters would stand on each other.
_TOO_CLOSE = 0.03
#: Characters that the title of a panel above has room for.
_WIDEST_TITLE = 46
#: Symbols and units of the two upper panels.
_QUANTITIES = {
    "mean_twist_deg": r"mean twist {}  $\overline{\theta}$ (deg)",
    "mean_deflection_chords": r"mean deflection {}  $\overline{w}/c$",
}
#: Names of the same in a table of deviations.
_DEVIATIONS = {"mean_twist_deg": "twist", "mean_deflection_chords": "deflection"}

#: Look of both sides of the bracket of an onset.
_EDGE: dict[str, Any] = {"linewidth": 1.0, "linestyle": (0, (4, 2)), "zorder": 1}
#: Look of the range of motion, hatched.
_EXTENT: dict[str, Any] = {
    "facecolor": "none",
    "edgecolor": "#A8A8A8",
    "hatch": "/////",
    "linewidth": 0.4,
}


#: Look of the interval of an onset by a learnt model.
_INTERVAL: dict[str, Any] = {"linewidth": 4.0, "alpha": 0.5, "solid_capstyle": "butt"}


@dataclass(frozen=True)
class Response:
    """All that the figure shows.

    Attributes
    ----------
    summary, onset
        ``comparison/summary.csv`` and ``comparison/onset.csv``.
    cases
        The cases of each model whose histories are shown, each run once: of the section, then of
        the beam.
    histories
        Histories by the letters of the cases.
    extents
        Range of the section's motion by the value on the axis of the onset, where it is bounded.
    places
        Places z/L along the beam of twist and deflection.
    reduction
        Reduction of models that do not name theirs, ``consistent`` or ``paper``.
    """

    summary: pd.DataFrame
    onset: pd.DataFrame
    cases: Mapping[str, Sequence[ShownCase]] = field(default_factory=dict)
    histories: Mapping[str, History] = field(default_factory=dict)
    extents: Mapping[float, Extent] = field(default_factory=dict)
    places: tuple[float, float] = AT_TIPS
    reduction: str = "consistent"


#: Extents of the section that are read and drawn; more would not be told apart in the panel.
MOST_EXTENTS = 200


def read_response(
    summary: pd.DataFrame,
    onset: pd.DataFrame,
    results: Sequence[Path],
    i_star: float,
    *,
    places: tuple[float, float] = AT_TIPS,
    reduction: str = "consistent",
    oscillation_factors: Mapping[str, float] | None = None,
) -> Response:
    """Choose the cases and read their histories alone, and the extents of the bounded section.

    The deflection of a section about its mean is recovered by the factor of its reduction, 1 where
    none is given.
    """
    models = list(dict.fromkeys(summary["model"]))
    cases: dict[str, list[ShownCase]] = {}
    histories: dict[str, History] = {}
    extents: dict[float, Extent] = {}
    section, beam = section_model(models), beam_model(models)
    for model, letters in ((section, SECTION_LETTERS), (beam, BEAM_LETTERS)):
        if model is None:
            continue
        files = results_of(results, model)
        cases[model] = _once(cases_shown(summary, onset, model, letters))
        histories |= {
            case.letter: read_history(result_at(files, case.value, case.axis), i_star)
            for case in cases[model]
            if case.exists
        }
        if model == section:
            bounded = summary[(summary["model"] == model) & summary["regime"].isin(BOUNDED)]
            apart = -(-len(bounded) // MOST_EXTENTS) or 1
            axis = onset_axis_among(summary.columns)
            values = bounded[axis.name].sort_values().iloc[::apart]
            form = model_named(section, reduction).reduction
            factor = (oscillation_factors or {}).get(form, 1.0)
            extents = {
                value: read_extent(result_at(files, value, axis), factor) for value in values
            }
    return Response(summary, onset, cases, histories, extents, places, reduction)


def from_files(
    summary: Path,
    onset: Path,
    indices: Sequence[Path],
    equivalent: Path,
    *,
    reduction: str,
) -> Figure:
    """Draw the means of all models, and the histories of the chosen cases."""
    sections = read_dataset(equivalent)
    response = read_response(
        pd.read_csv(summary),
        pd.read_csv(onset),
        result_files(indices),
        float(sections["i_star"].sel(reduction=reduction)),
        places=(float(sections["twist_place"]), float(sections["deflection_place"])),
        reduction=reduction,
        oscillation_factors=factors_of(sections),
    )
    return draw(response)


def draw(response: Response) -> Figure:
    """Draw the means over k* (top) and the histories (middle: section, bottom: beam).

    A row of a model that the sweep does not have is left out.
    """
    models = list(dict.fromkeys(response.summary["model"]))
    section, beam = section_model(models), beam_model(models)
    rows = {model: response.cases[model] for model in (section, beam) if model is not None}
    count = max(len(rows), 1)
    columns = math.lcm(*map(len, rows.values()))
    figure = Figure(figsize=(PAGE_WIDTH, 7.6 - 2.07 * (2 - count)))
    halves = figure.add_gridspec(2, 1, height_ratios=(1.0, 0.6 * count))
    above, below = halves[0].subgridspec(1, 2), halves[1].subgridspec(count, columns)
    top = [figure.add_subplot(above[0]), figure.add_subplot(above[1])]
    for axes, name, place in zip(top, _QUANTITIES, "ab", strict=True):
        _means(axes, response, name)
        letter(axes, place, _agreement(response.summary, section, beam, name))
    places = iter("cdefgh")
    for row, (model, shown) in enumerate(rows.items()):
        width = columns // len(shown)
        for column, case in enumerate(shown):
            axes = figure.add_subplot(below[row, column * width : (column + 1) * width])
            _history(axes, next(places), case, response.histories.get(case.letter), LOOKS[model])
    figure.legend(handles=_handles(response, models), loc="outside upper center", ncols=4)
    sections = {"2d", "2d-corrected"} & set(models)
    of_reduction = f"2D: reduction '{response.reduction}'"
    notes = [*([of_reduction] if sections else []), *_known_errors(response.onset)]
    add_provenance(figure, *_sources(response), *notes)
    return figure


def _once(cases: Sequence[ShownCase]) -> list[ShownCase]:
    """Return each run by its first letter: the stiffest may be the one next to the onset."""
    by_run = {case.value if case.exists else case.letter: case for case in reversed(cases)}
    return sorted(by_run.values(), key=lambda case: case.letter)


def _means(axes: Axes, response: Response, name: str) -> None:
    """Draw the mean of one quantity over k*, with the bracket of the onset."""
    summary = response.summary
    along = onset_axis_among(summary.columns)
    place = response.places[list(_QUANTITIES).index(name)]
    axes.set(xlabel=along.label, ylabel=_QUANTITIES[name].replace("{}", place_in_words(place), 1))
    if summary.empty or summary.loc[summary["regime"] != "failed", name].isna().all():
        say(axes, "No run of the sweep has a mean: every one failed or diverged.")
        return
    for look, unstable, stable in _brackets(response):
        for side in (unstable, stable):
            axes.axvline(side, color=look.colour, **_EDGE)
    _extent(axes, response, name)
    for model, runs in summary.groupby("model", sort=False):
        look = LOOKS[str(model)]
        there = runs[runs[name].notna() & (runs["regime"] != "failed")]
        bounded = there["mean_known"] == 1
        axes.plot(there[along.name], there[name], color=look.colour, linestyle=look.line)
        for chosen, filled in ((there[bounded], True), (there[~bounded], False)):
            axes.plot(
                chosen[along.name],
                chosen[name],
                color=look.colour,
                linestyle="none",
                marker=look.marker,
                markevery=1 + len(there) // _MOST_MARKERS,
                markerfacecolor=look.colour if filled else "white",
            )
        for marker, without in _without_mean(runs, along).items():
            axes.plot(
                without,
                np.zeros(len(without)),
                color=look.colour,
                linestyle="none",
                marker=marker,
                transform=axes.get_xaxis_transform(),
                clip_on=False,
                zorder=5,
            )
    for shown in response.cases.values():
        _letters(axes, shown, name)
    axes.xaxis.set_major_locator(MaxNLocator(nbins=8, steps=[1, 2, 5, 10]))
    low, high = axes.get_ylim()
    height = high - low
    axes.set_ylim(low - 0.1 * height, high + 0.06 * height)  # room for the letters
    for look, ends in _learnt_intervals(response):
        axes.plot(
            ends, [0.02, 0.02], **_INTERVAL, color=look.colour, transform=axes.get_xaxis_transform()
        )
    add_other_axis(axes, along, as_given(summary))


def _agreement(summary: pd.DataFrame, section: str | None, beam: str | None, name: str) -> str:
    """Say how far a mean of the section is from the beam's where neither grows, and where that is.

    Means that still drift (open markers) count as they are.
    """
    if section is None or beam is None:
        return ""
    along = onset_axis_among(summary.columns)
    table = deviations(summary[summary["regime"].isin(BOUNDED)])
    of_section = table[table["model"] == section].set_index(along.name)[_DEVIATIONS[name]]
    deviation = of_section[np.isfinite(of_section)]
    if deviation.size < 2:
        return ""
    farthest = 100.0 * float(deviation.abs().max())
    labels = [LOOKS[model].label for model in (section, beam)]
    low, high = float(deviation.index.min()), float(deviation.index.max())
    words = f"{labels[0]} within {farthest:.0f} % of {labels[1]},"
    where = f"= {low:g} to {high:g}" + ("" if along.unit == "1" else f" {along.unit}")
    fits = len(f"{words} {along.symbol} {where}") <= _WIDEST_TITLE
    return words + (" " if fits else "\n") + f"{along.tex} {where}"


def _learnt_intervals(response: Response) -> list[tuple[Look, tuple[float, float]]]:
    """Return the intervals of the onsets of learnt models along the axis, with their looks."""
    names = [f"k_star_learnt_{end}" for end in ("low", "high")]
    given = as_given(response.summary)
    if not set(names) <= set(response.onset) or given is None:
        return []
    over_k_star = onset_axis_among(response.summary.columns) is K_STAR
    found = []
    for row in response.onset.dropna(subset=names).to_dict("records"):
        ends = [float(row[name]) for name in names]
        low, high = ends if over_k_star else map(given.speed_at, ends)
        found.append((LOOKS[str(row["model"])], (low, high)))
    return found


def place_in_words(place: float) -> str:
    """Return a place z/L along the span in words."""
    for named, words in ((1.0, "of the tip"), (0.5, "at midspan"), (0.0, "at the root end")):
        if abs(place - named) < _ONE_PLACE:
            return words
    return f"at $z/L$ = {place:.2g}"


def _brackets(response: Response) -> list[tuple[Look, float, float]]:
    """Return the brackets that are shown: look of the model, and both sides.

    Those of the section and of the beam, as far as both sides are known; one for both if they
    are the same.
    """
    axis = onset_axis_among(response.summary.columns)
    sides = [f"{axis.name}_unstable", f"{axis.name}_stable"]
    closed = response.onset.dropna(subset=sides)
    found = []
    for model in response.cases:
        for unstable, stable in closed.loc[closed["model"] == model, sides].values:
            found.append((LOOKS[model], float(unstable), float(stable)))
    if len(found) == 2 and found[0][1:] == found[1][1:]:
        label = f"{found[0][0].label} and {found[1][0].label}"
        return [(replace(found[1][0], label=label, colour=GREY), *found[1][1:])]
    return found


def _without_mean(runs: pd.DataFrame, along: Axis) -> dict[str, list[float]]:
    """Return the places of runs that have no mean, by their mark on the axis."""
    failed = runs["regime"] == "failed"
    diverged = ~failed & runs["mean_twist_deg"].isna()
    marks = {_FAILED: runs.loc[failed, along.name], _DIVERGED: runs.loc[diverged, along.name]}
    return {mark: list(places) for mark, places in marks.items() if len(places)}


def _extent(axes: Axes, response: Response, name: str) -> None:
    """Shade between what values the section moves."""
    if len(response.extents) < 2:
        return
    values = sorted(response.extents)
    extents = [response.extents[value] for value in values]
    ranges = [e.twist_deg if name == "mean_twist_deg" else e.deflection_chords for e in extents]
    low, high = zip(*ranges, strict=True)
    axes.fill_between(
        values,
        low,
        high,
        **_EXTENT,
    )


def _letters(axes: Axes, cases: Sequence[ShownCase], name: str) -> None:
    """Mark the cases whose histories are shown; those too close to tell apart share a mark."""
    low, high = axes.get_xlim()
    groups: list[list[ShownCase]] = []
    for case in sorted((c for c in cases if c.has_mean), key=lambda c: c.value):
        if groups and case.value - groups[-1][0].value < _TOO_CLOSE * (high - low):
            groups[-1].append(case)
        else:
            groups.append([case])
    for same in groups:
        above = same[0].letter in SECTION_LETTERS
        axes.annotate(
            ", ".join(sorted(case.letter for case in same)),
            (same[0].value, getattr(same[0], name)),
            xytext=(4, 15) if above else (-5, -15),
            textcoords="offset points",
            ha="center",
            va="center",
            fontsize=8,
            fontweight="bold",
            path_effects=[withStroke(linewidth=2.0, foreground="white")],
            arrowprops={"arrowstyle": "-", "linewidth": 0.5, "shrinkA": 0, "shrinkB": 2},
        )


def _history(axes: Axes, place: str, case: ShownCase, history: History | None, look: Look) -> None:
    """Draw the history of one case, or say why there is none."""
    if not case.exists or history is None:
        letter(axes, place, f"{case.letter}: {look.label}")
        say(axes, f"No case {case.letter}: {case.regime}.", 24)
        return
    outcome = f"{case.axis.typeset(case.value)}, {in_words(case.regime)}"
    letter(axes, place, f"{case.letter}: {look.label}\n{outcome}")
    if history.time.size == 0:
        say(axes, "The run left no history: it diverged.", 24)
        return
    axes.plot(history.time, history.tip_twist_deg, color=look.colour, linewidth=0.6)
    axes.set(xlabel="$t^*$", ylabel=r"$\theta$ (deg)", xlim=(0.0, float(history.time[-1])))


def _handles(response: Response, models: list[str]) -> list[Line2D | Patch]:
    """Explain models, marks and shades."""
    handles: list[Line2D | Patch] = [
        Line2D([], [], color=look.colour, marker=look.marker, linestyle=look.line, label=look.label)
        for look in (LOOKS[model] for model in models)
    ]
    run = response.summary[response.summary["regime"] != "failed"]
    drifts = (run["mean_known"] == 0) & run["regime"].isin(BOUNDED)
    marked = (
        ("still growing", run["regime"] == Regime.GROWING),
        ("still drifting", drifts),
        ("undecided", run["regime"] == Regime.UNDECIDED),
    )
    words = [word for word, there in marked if there.any()]
    if words:
        handles.append(_mark("o", " or ".join(words).replace("or still ", "or ")))
    labels = {_FAILED: "failed", _DIVERGED: "diverged, no mean"}
    along = onset_axis_among(response.summary.columns)
    handles += [_mark(mark, labels[mark]) for mark in _without_mean(response.summary, along)]
    handles += [
        Line2D([], [], color=look.colour, label=f"onset between, {look.label}", **_EDGE)
        for look, _, _ in _brackets(response)
    ]
    handles += [
        Line2D([], [], color=look.colour, **_INTERVAL, label=f"onset by learnt model, {look.label}")
        for look, _ in _learnt_intervals(response)
    ]
    if len(response.extents) > 1:
        model = section_model(list(response.cases))
        label = f"range of motion, {LOOKS[model].label}" if model else "range of motion"
        handles.append(Patch(label=label, **_EXTENT))
    return handles


def _mark(marker: str, label: str) -> Line2D:
    return Line2D(
        [],
        [],
        color=GREY,
        linestyle="none",
        marker=marker,
        markerfacecolor="white",
        label=label,
    )


def _known_errors(onset: pd.DataFrame) -> list[str]:
    """Say to which side the onset of a model errs, where that is known."""
    if "growth_error" not in onset:
        return []
    known = onset[onset["growth_error"].notna()].drop_duplicates("model")
    notes = []
    for (mean, rms, errs), rows in known.groupby(
        ["growth_error", "growth_error_rms", "errs"], sort=False
    ):
        first = str(rows["model"].iloc[0])  # what is known goes by the dimension
        who = LOOKS[first].label if len(rows) == 1 else f"{first[:2].upper()} models"
        notes.append(
            f"{who}: growth {mean:+.4f} V/c off kept CFD in the mean ({rms:.4f} rms), the onset "
            f"errs to {side_in_words(str(errs))}"
        )
    return notes


def _sources(response: Response) -> tuple[str, ...]:
    """Say what solvers made the runs; in words where a history tells."""
    words = solvers_of((h.description, h.resolution) for h in response.histories.values())
    if words:
        return words
    pairs = response.summary[["solver", "resolution"]].drop_duplicates()
    return solvers_of((f"solver '{solver}'", str(name)) for solver, name in pairs.values)
