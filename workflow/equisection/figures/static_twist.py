"""Static twist of the tip over the speed at each incidence, and the share of divergence in use."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from equisection.figures.map_shown import (
    mark_design_speed,
    models_of,
    say_origin,
    spread_incidences,
)
from equisection.figures.models_shown import beam_model
from equisection.figures.panels import letter, say
from equisection.figures.style import PAGE_WIDTH
from equisection.results.netcdf import read_dataset


def from_files(stability_map: Path, design_speed: float | None) -> Figure:
    """Draw the static twist of a run."""
    return draw(read_dataset(stability_map), design_speed)


def draw(stability_map: xr.Dataset, design_speed: float | None) -> Figure:
    """Draw the twist of one model over speed (left), shares of the divergence speed (right).

    Parameters
    ----------
    stability_map
        ``comparison/stability_map.nc``.
    design_speed
        Speed (m/s) that the shares are of; None for none.
    """
    names = [str(name) for name in stability_map["model"].values]
    shown = beam_model(names) or names[0]
    one = stability_map.sel(model=shown)
    figure = Figure(figsize=(PAGE_WIDTH, 3.6))
    left, right = figure.subplots(1, 2)
    for place, label, colour in spread_incidences(one):
        twist = np.degrees(one["equilibrium_twist"].values[place])
        left.plot(one["speed"], twist, color=colour, label=label)
    left.set(xlabel="$V$ (m/s)", ylabel="static twist of the tip (deg)")
    mark_design_speed(left, design_speed, upright=True)
    left.legend(title=f"model {shown}", fontsize="x-small", title_fontsize="x-small")
    letter(left, "a", "static twist")
    letter(right, "b", "share of divergence")
    right.set(xlabel="incidence (deg)", ylabel="design speed over divergence speed")
    if design_speed is None:
        say(right, "No flow.design_speed is given.")
    elif not _draw_shares(right, stability_map, design_speed):
        say(right, "No divergence in the range.")
    say_origin(figure, stability_map)
    return figure


def _draw_shares(axes: Axes, stability_map: xr.Dataset, design_speed: float) -> bool:
    """Draw the shares of the divergence speed, and tell whether there are any."""
    angles = stability_map["incidence_deg"].values
    for each, look in models_of(stability_map):
        share = design_speed / each["divergence_speed"].values
        if np.isfinite(share).any():
            axes.plot(
                angles,
                share,
                color=look.colour,
                linestyle=look.line,
                marker=look.marker,
                label=look.label,
            )
    if not axes.has_data():
        return False
    axes.set_ylim(0.0, 1.1 * axes.dataLim.y1)
    axes.set_xlim(angles[0] - 0.5, angles[-1] + 0.5)
    axes.set_title("no point: no divergence in the range", fontsize="x-small", loc="right")
    axes.legend(fontsize="x-small")
    return True
