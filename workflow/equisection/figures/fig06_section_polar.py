"""Fig. 6: lift and moment of the rigid section over incidence, at each resolution."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from equisection.figures.panels import legend_above, letter, say
from equisection.figures.provenance import add_provenance
from equisection.figures.style import COLOURS, DASHES, MARKERS, PAGE_WIDTH


def draw(polar: xr.Dataset) -> Figure:
    """Draw c_l (left) and c_m (right) at every resolution.

    Parameters
    ----------
    polar
        ``steady/polar_2d.nc``.
    """
    figure = Figure(figsize=(PAGE_WIDTH, 3.1))
    panels = figure.subplots(1, 2)
    resolutions = [str(name) for name in polar["resolution"].values]
    for axes, name in zip(panels, ("cl", "cm"), strict=True):
        for number, resolution in enumerate(resolutions):
            axes.plot(
                polar["incidence_deg"],
                polar[name].sel(resolution=resolution),
                color=COLOURS[number % len(COLOURS)],
                linestyle=DASHES[number % len(DASHES)],
                marker=MARKERS[number % len(MARKERS)],
                fillstyle="full" if number == 0 else "none",
                label=f"{resolution}: {polar.attrs[f'solver_{resolution}']}",
            )
        if not np.isfinite(polar[name].values).any():
            say(axes, "No incidence has a result.")
        axes.set_xlabel(r"$\theta$ (deg)")
    panels[0].set_ylabel("$c_l$")
    panels[1].set_ylabel("$c_m$ about mid-chord")
    letter(panels[0], "a", "lift")
    letter(panels[1], "b", "moment")
    legend_above(figure, panels[0], columns=1 if len(resolutions) < 3 else 2)
    add_provenance(figure, "rigid 2D section", *_failed(polar))
    return figure


def _failed(polar: xr.Dataset) -> list[str]:
    count = int(np.isnan(polar["cl"].values).sum())
    return [f"{count} of {polar['cl'].size} cases have no result"] if count else []
