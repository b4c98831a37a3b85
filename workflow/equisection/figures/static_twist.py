"""Static twist of the tip over the speed at each incidence, and the share of divergence in use."""

from __future__ import annotations

from pathlib import Path

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from equisection.figures.map_shown import mark_design_speed, models_of, say_origin
from equisection.figures.models_shown import beam_model
from equisection.figures.panels import letter, say
from equisection.figures.style import PAGE_WIDTH
from equisection.results.netcdf import read_dataset

#: Incidences whose twist is drawn.
_MOST = 7


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
    angles = one["incidence_deg"].values
    places = np.unique(np.linspace(0, angles.size - 1, min(_MOST, angles.size)).astype(int))
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.9, places.size))
    for place, colour in zip(places, colours, strict=True):
        twist = np.degrees(one["equilibrium_twist"].values[place])
        left.plot(one["speed"], twist, color=colour, label=f"{angles[place]:g} deg")
    left.set(xlabel="$V$ (m/s)", ylabel="static twist of the tip (deg)")
    mark_design_speed(left, design_speed, upright=True)
    left.legend(title=f"model {shown}", fontsize="x-small", title_fontsize="x-small")
    letter(left, "a", "static twist")
    letter(right, "b", "share of divergence")
    right.set(xlabel="incidence (deg)", ylabel="design speed over divergence speed")
    drawn = False
    for each, look in models_of(stability_map) if design_speed is not None else ():
        share = design_speed / each["divergence_speed"].values if design_speed else None
        if share is not None and np.isfinite(share).any():
            style = {"color": look.colour, "linestyle": look.line, "marker": look.marker}
            right.plot(angles, share, label=look.label, **style)
            drawn = True
    if drawn:
        right.set_ylim(0.0, 1.1 * right.dataLim.y1)
        right.set_xlim(angles[0] - 0.5, angles[-1] + 0.5)
        right.set_title("no point: no divergence in the range", fontsize="x-small", loc="right")
        right.legend(fontsize="x-small")
    elif design_speed is None:
        say(right, "No flow.design_speed is given.")
    else:
        say(right, "No divergence in the range.")
    say_origin(figure, stability_map)
    return figure
