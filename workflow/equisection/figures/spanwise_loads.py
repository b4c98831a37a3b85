"""Lift and moment along the span of the rigid beam at low and moderate incidence."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from equisection.figures.incidences import nearest_incidences
from equisection.figures.origin import add_provenance, solver_of
from equisection.figures.panels import letter, say, without_data
from equisection.figures.style import COLOURS, DASHES, GREY, MARKERS, PAGE_WIDTH
from equisection.results.netcdf import read_dataset
from equisection.results.polar_dataset import at_resolution

#: Two low incidences and a moderate one (deg).
WANTED_DEG = (1.0, 2.5, 7.0)


def from_files(polar_3d: Path, resolution: str) -> Figure:
    """Draw ``steady/polar_3d.nc`` at a resolution."""
    return draw(read_dataset(polar_3d), resolution)


def draw(polar: xr.Dataset, resolution: str) -> Figure:
    """Draw c_l (left) and c_m (right) over z/L, with the beam's C_L and C_M.

    Parameters
    ----------
    polar
        ``steady/polar_3d.nc``.
    resolution
        The resolution that is shown.
    """
    if resolution not in polar["resolution"].values:
        return without_data(f"No rigid beam was run at resolution '{resolution}'.")
    chosen = at_resolution(polar, resolution)
    finite = np.isfinite(chosen["cl"].values)
    available = [float(a) for a in chosen["incidence_deg"].values[finite]]
    angles = nearest_incidences(available, WANTED_DEG)
    figure = Figure(figsize=(PAGE_WIDTH, 3.1))
    panels = figure.subplots(1, 2)
    names = (("cl", "$c_l$", "lift"), ("cm", "$c_m$ about mid-chord", "moment"))
    for axes, (name, symbol, title), place in zip(panels, names, "ab", strict=True):
        letter(axes, place, title)
        if not angles or f"{name}_section" not in chosen:
            say(axes, "No incidence has spanwise loads.")
            continue
        for number, angle in enumerate(angles):
            at = chosen.sel(incidence_deg=angle)
            line = {"color": COLOURS[number], "linestyle": DASHES[number]}
            axes.plot(
                at["span"], at[f"{name}_section"], marker=MARKERS[number], clip_on=False, **line
            )
            axes.axhline(float(at[name]), color=COLOURS[number], linewidth=0.7, linestyle=":")
        axes.set(xlim=(0.0, 1.0), xlabel="$z/L$", ylabel=symbol)
        axes.set_ylim(bottom=min(0.0, axes.get_ylim()[0]))
    handles = [
        Line2D(
            [],
            [],
            color=COLOURS[i],
            linestyle=DASHES[i],
            marker=MARKERS[i],
            label=rf"$\theta$ = {angle:g} deg",
        )
        for i, angle in enumerate(angles)
    ]
    if handles:
        beam = Line2D([], [], color=GREY, linewidth=0.7, linestyle=":", label="beam: $C_L$, $C_M$")
        figure.legend(handles=[*handles, beam], loc="outside upper center", ncols=4)
    solver = solver_of(str(polar.attrs[f"solver_{resolution}"]), resolution)
    add_provenance(figure, f"rigid 3D beam: {solver}")
    return figure
