"""Critical speed of each model over the incidence, with interval, mechanism and design speed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.markers import TICKUP
from matplotlib.patches import Patch
from numpy.typing import NDArray

from equisection.figures.map_shown import (
    MARKERS_OF_MECHANISMS,
    mark_design_speed,
    models_of,
    say_origin,
)
from equisection.figures.models import Look
from equisection.figures.panels import letter
from equisection.figures.style import BLACK, GREY, LIGHT_GREY, ORANGE, PAGE_WIDTH
from equisection.results.netcdf import read_dataset

Floats = NDArray[np.float64]

#: Panels in a row.
_ACROSS = 3
#: Part of the highest speed that is drawn above it, where an end is open.
_ROOM = 1.12
_INTERVAL, _BELOW_DESIGN = "interval", "interval below the design speed"
_STABLE = "stable up to here"
_OPEN = "open above"
#: Marker of a speed up to which a model is stable.
_UPWARDS = TICKUP


def from_files(stability_map: Path, stability: Path, design_speed: float | None) -> Figure:
    """Draw the critical speeds of a run."""
    return draw(read_dataset(stability_map), pd.read_csv(stability), design_speed)


def draw(stability_map: xr.Dataset, stability: pd.DataFrame, design_speed: float | None) -> Figure:
    """Draw critical speeds over the incidence, a panel for each model.

    Parameters
    ----------
    stability_map
        ``comparison/stability_map.nc``.
    stability
        ``comparison/stability.csv``, with the interval of each speed.
    design_speed
        Speed (m/s) to mark; None for none.
    """
    models = list(models_of(stability_map))
    # of models that were learnt at these incidences alone nothing is known in between
    joined = stability_map.attrs["basis"] != "model"
    rows = -(-len(models) // _ACROSS)
    figure = Figure(figsize=(PAGE_WIDTH, 1.2 + 2.5 * rows))
    across = min(len(models), _ACROSS)
    panels = figure.subplots(rows, across, sharex=True, sharey=True, squeeze=False)
    top = _top(stability, design_speed)
    seen: set[str] = set()
    for number, (axes, (one, look)) in enumerate(zip(panels.flat, models, strict=False)):
        for other, _ in models if joined else ():
            axes.plot(other["incidence_deg"], other["critical_speed"], color=LIGHT_GREY, zorder=1)
        ends = _ends(stability, one)
        seen |= _interval(axes, one["incidence_deg"].values, ends, top, design_speed, joined=joined)
        seen |= _speeds(axes, one, look, joined=joined)
        mark_design_speed(axes, design_speed, upright=False)
        letter(axes, "abcdefgh"[number], look.label)
    for axes in panels.flat[len(models) :]:
        axes.set_visible(False)
    for axes in panels[:, 0]:
        axes.set_ylabel("critical speed (m/s)")
    for axes in panels[-1]:
        axes.set_xlabel("incidence (deg)")
    panels[0, 0].set_ylim(0.0, top)
    _legend(figure, seen, design_speed, joined=joined)
    say_origin(figure, stability_map)
    return figure


def _top(stability: pd.DataFrame, design_speed: float | None) -> float:
    """Return the highest speed (m/s) of the axis, with room above what is drawn."""
    drawn = stability[["speed", "speed_low", "speed_to"]].to_numpy(dtype=np.float64)
    return _ROOM * max(float(drawn[np.isfinite(drawn)].max(initial=1.0)), design_speed or 0.0)


def _ends(stability: pd.DataFrame, one: xr.Dataset) -> Floats:
    """Return both ends of the interval at each incidence of a model, shape (2, n)."""
    rows = stability[stability["model"] == str(one["model"].values)]
    known = rows.set_index(rows["incidence_deg"].round(6))[["speed_from", "speed_to"]]
    return np.asarray(known.reindex(one["incidence_deg"].values.round(6)).to_numpy().T)


def _interval(
    axes: Axes,
    angle: Floats,
    ends: Floats,
    top: float,
    design_speed: float | None,
    *,
    joined: bool,
) -> set[str]:
    """Shade the interval, and hatch what of it is below the design speed."""
    low, high = ends
    known = np.isfinite(low)
    if not known.any():
        return set()
    drawn = np.minimum(high, top)
    if joined:
        axes.fill_between(angle, low, drawn, color=LIGHT_GREY, alpha=0.6, linewidth=0.0)
    axes.vlines(angle[known], low[known], drawn[known], color=GREY, linewidth=0.9)
    seen = {_INTERVAL}
    opened = np.isinf(high)
    if opened.any():
        axes.plot(angle[opened], np.full(opened.sum(), 0.985 * top), "^", color=GREY, markersize=5)
        seen.add(_OPEN)
    if design_speed is not None and (low < design_speed).any():
        if joined:
            axes.fill_between(
                angle,
                np.minimum(low, design_speed),
                np.minimum(drawn, design_speed),
                facecolor="none",
                edgecolor=ORANGE,
                hatch="/////",
                linewidth=0.0,
            )
        under = low < design_speed
        ends_there = np.minimum(drawn[under], design_speed)
        axes.vlines(angle[under], low[under], ends_there, color=ORANGE, linewidth=2.0)
        seen.add(_BELOW_DESIGN)
    return seen


def _speeds(axes: Axes, one: xr.Dataset, look: Look, *, joined: bool) -> set[str]:
    """Draw the critical speeds of a model with the markers of their mechanisms."""
    seen = set()
    angle, speed = one["incidence_deg"].values, one["critical_speed"].values
    if joined:
        axes.plot(angle, speed, color=look.colour, linestyle=look.line)
    for mechanism, marker in MARKERS_OF_MECHANISMS.items():
        here = (one["critical_mechanism"].values == mechanism) & np.isfinite(speed)
        seen |= {mechanism} if here.any() else set()
        axes.plot(angle[here], speed[here], marker, color=look.colour)
    none = np.isnan(speed) & np.isfinite(one["speed_low"].values)
    if none.any():
        axes.plot(
            angle[none],
            one["speed_low"].values[none],
            color=look.colour,
            linestyle="",
            marker=_UPWARDS,
            markersize=9,
        )
    return seen | ({_STABLE} if none.any() else set())


def _legend(figure: Figure, seen: set[str], design_speed: float | None, *, joined: bool) -> None:
    """Explain the marks that are in the figure, on lines that have no data."""
    axes = figure.axes[0]
    handles: list[Artist] = []
    if design_speed is not None:
        handles += [line for line in axes.lines if line.get_label() == "design speed"]
    for mechanism in (name for name in MARKERS_OF_MECHANISMS if name in seen):
        marker = MARKERS_OF_MECHANISMS[mechanism]
        handles += axes.plot([], [], marker, color=GREY, label=mechanism)
    if _STABLE in seen:
        handles += axes.plot([], [], linestyle="", marker=_UPWARDS, color=BLACK, label=_STABLE)
    patches = []
    if _INTERVAL in seen:
        patches.append(Patch(facecolor=LIGHT_GREY, alpha=0.6, label=_INTERVAL))
    if _BELOW_DESIGN in seen:
        patches.append(
            Patch(facecolor="none", edgecolor=ORANGE, hatch="/////", label=_BELOW_DESIGN)
        )
    if _OPEN in seen:
        handles += axes.plot([], [], "^", color=GREY, markersize=5, label=_OPEN)
    others = axes.plot([], [], color=LIGHT_GREY, label="the other models")
    handles = [*handles, *patches, *(others if joined and len(figure.axes) > 1 else [])]
    figure.legend(handles=handles, loc="outside upper center", ncols=4)
