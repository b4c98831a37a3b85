"""Least damping ratio of each model over the incidence, up to 1.2 of the design speed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from equisection.figures.map_shown import (
    first_modes,
    mark_design_speed,
    say_origin,
    spread_incidences,
)
from equisection.figures.models import LOOKS
from equisection.figures.panels import letter
from equisection.figures.style import LIGHT_GREY, PAGE_WIDTH
from equisection.results.netcdf import read_dataset

#: Part of the design speed up to which the damping is drawn.
_UP_TO = 1.2
_MOST_MODELS = 3


def from_files(stability_map: Path, design_speed: float | None) -> Figure:
    """Draw the damping of a run up to 1.2 of its design speed."""
    return draw(read_dataset(stability_map), design_speed)


def draw(stability_map: xr.Dataset, design_speed: float | None) -> Figure:
    """Draw the least damping ratio of the first modes over speed, a panel for each model.

    Parameters
    ----------
    stability_map
        ``comparison/stability_map.nc``.
    design_speed
        Speed (m/s); without one all speeds are drawn.
    """
    if design_speed is not None:
        shown = stability_map["speed"].values <= _UP_TO * design_speed
        stability_map = stability_map.isel(speed=np.flatnonzero(shown))
    names = [str(name) for name in stability_map["model"].values][:_MOST_MODELS]
    drawn, incidences = first_modes(stability_map), spread_incidences(stability_map)
    figure = Figure(figsize=(PAGE_WIDTH, 3.4))
    panels = np.atleast_1d(figure.subplots(1, len(names), sharey=True))
    for axes, name, mark in zip(panels, names, "abc", strict=False):
        one = stability_map.sel(model=name)
        least = 100.0 * one["mode_damping"].sel(mode=drawn).min("mode", skipna=True)
        for place, label, colour in incidences:
            axes.plot(one["speed"], least.isel(incidence_deg=place), color=colour, label=label)
        axes.axhline(0.0, color=LIGHT_GREY, linewidth=0.8)
        mark_design_speed(axes, design_speed, upright=True)
        axes.set_xlabel("$V$ (m/s)")
        letter(axes, mark, LOOKS[name].label)
    panels[0].set_ylabel("least damping ratio (%)")
    handles, labels = panels[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=8, fontsize="x-small")
    say_origin(figure, stability_map)
    return figure
