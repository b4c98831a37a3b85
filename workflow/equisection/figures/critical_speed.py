"""Critical speed of each model over the incidence, with its mechanism and the design speed."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from equisection.figures.map_shown import (
    MARKERS_OF_MECHANISMS,
    mark_design_speed,
    models_of,
    say_origin,
)
from equisection.figures.style import BLACK, GREY, PAGE_WIDTH
from equisection.results.netcdf import read_dataset


def from_files(stability_map: Path, design_speed: float | None) -> Figure:
    """Draw the critical speeds of a run."""
    return draw(read_dataset(stability_map), design_speed)


def draw(stability_map: xr.Dataset, design_speed: float | None) -> Figure:
    """Draw critical speeds over the incidence.

    Parameters
    ----------
    stability_map
        ``comparison/stability_map.nc``.
    design_speed
        Speed (m/s) to mark; None for none.
    """
    figure = Figure(figsize=(PAGE_WIDTH, 3.6))
    axes = figure.subplots()
    seen = set()
    by_model = stability_map.attrs["basis"] == "model"
    for one, look in models_of(stability_map):
        angle, speed = one["incidence_deg"].values, one["critical_speed"].values
        if by_model:  # nothing is known between the incidences that were learnt at
            ends = np.abs([speed - one[f"speed_{end}"].values for end in ("low", "high")])
            axes.errorbar(angle, speed, ends, color=look.colour, fmt="none", capsize=2.0)
            axes.plot([], [], color=look.colour, label=look.label)
        else:
            axes.plot(angle, speed, color=look.colour, linestyle=look.line, label=look.label)
        for mechanism, marker in MARKERS_OF_MECHANISMS.items():
            here = (one["critical_mechanism"].values == mechanism) & np.isfinite(speed)
            seen |= {mechanism} if here.any() else set()
            axes.plot(angle[here], speed[here], marker, color=look.colour)
        none = np.isnan(speed) & np.isfinite(one["speed_low"].values)
        axes.plot(angle[none], one["speed_low"].values[none], 2, color=look.colour, markersize=9)
        if none.any():
            seen.add("none")
    mark_design_speed(axes, design_speed, upright=False)
    for mechanism in (name for name in MARKERS_OF_MECHANISMS if name in seen):
        axes.plot([], [], MARKERS_OF_MECHANISMS[mechanism], color=GREY, label=mechanism)
    if "none" in seen:
        axes.plot([], [], linestyle="", marker=2, color=BLACK, label="stable up to here")
    axes.set(xlabel="incidence (deg)", ylabel="critical speed (m/s)")
    axes.set_ylim(bottom=0.0)
    figure.legend(loc="outside upper center", ncols=4)
    say_origin(figure, stability_map)
    return figure
