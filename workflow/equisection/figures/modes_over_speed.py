"""Damping ratio and frequency of the modes of each model over the speed, at one incidence."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from equisection.figures.map_shown import (
    first_modes,
    mark_design_speed,
    models_of,
    nearest_incidence,
    say_origin,
)
from equisection.figures.panels import letter
from equisection.figures.style import DASHES, GREY, LIGHT_GREY, PAGE_WIDTH
from equisection.results.netcdf import read_dataset

#: Damping ratios (%) that the panel shows at most.
_MOST_DAMPING = 12.0


def from_files(stability_map: Path, incidence_deg: float, design_speed: float | None) -> Figure:
    """Draw the modes of a run at the incidence nearest to that of its flow."""
    return draw(read_dataset(stability_map), incidence_deg, design_speed)


def draw(stability_map: xr.Dataset, incidence_deg: float, design_speed: float | None) -> Figure:
    """Draw damping ratios (left) and frequencies (right) of the first modes.

    Parameters
    ----------
    stability_map
        ``comparison/stability_map.nc``.
    incidence_deg
        Incidence (deg), nearest to which one of the map is drawn.
    design_speed
        Speed (m/s) to mark; None for none.
    """
    chosen = nearest_incidence(stability_map, incidence_deg)
    figure = Figure(figsize=(PAGE_WIDTH, 3.6))
    left, right = figure.subplots(1, 2)
    names = first_modes(chosen)
    lowest = 0.0
    for one, look in models_of(chosen):
        for name, dash in zip(names, DASHES, strict=False):
            mode = one.sel(mode=name)
            if not np.isfinite(mode["mode_damping"].values).any():
                continue
            style = {"color": look.colour, "linestyle": dash}
            left.plot(one["speed"], 100.0 * mode["mode_damping"], **style)
            right.plot(one["speed"], mode["mode_frequency"], **style)
            lowest = min(lowest, float(np.nanmin(100.0 * mode["mode_damping"].values)))
        critical = float(one["critical_speed"])
        if np.isfinite(critical):
            left.plot(critical, 0.0, "o", color=look.colour)
        right.plot([], [], color=look.colour, label=look.label)
    for name, dash in zip(names, DASHES, strict=False):
        right.plot([], [], color=GREY, linestyle=dash, label=name)
    left.axhline(0.0, color=LIGHT_GREY, linewidth=0.8)
    for axes in (left, right):
        mark_design_speed(axes, design_speed, upright=True)
        axes.set_xlabel("$V$ (m/s)")
    left.set_ylabel("damping ratio (%)")
    left.set_ylim(max(1.1 * lowest, -_MOST_DAMPING), _MOST_DAMPING)
    right.set_ylabel("frequency (Hz)")
    right.set_ylim(bottom=0.0)
    angle = float(chosen["incidence_deg"])
    letter(left, "a", f"damping at {angle:g} deg")
    letter(right, "b", f"frequency at {angle:g} deg")
    handles, labels = right.get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside upper center", ncols=5)
    say_origin(figure, stability_map)
    return figure
