"""Parts of a map of stability as figures show them: models, mechanisms, and one incidence."""

from __future__ import annotations

from collections.abc import Iterator

import matplotlib
import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from equisection.figures.models import LOOKS, Look
from equisection.figures.origin import add_provenance
from equisection.figures.style import GREY

#: Marker of each mechanism.
MARKERS_OF_MECHANISMS = {
    "divergence": "D",
    "flutter": "o",
    "stall-flutter": "s",
    "galloping": "^",
    "unknown": "x",
}
#: Incidences whose lines a panel has at most.
_MOST_INCIDENCES = 7
#: Modes of each kind that are drawn; higher ones have next to no damping but that of the structure.
_MODES = 2


def models_of(stability_map: xr.Dataset) -> Iterator[tuple[xr.Dataset, Look]]:
    """Yield the map of each model with its look."""
    for name in stability_map["model"].values:
        yield stability_map.sel(model=name), LOOKS[str(name)]


def nearest_incidence(stability_map: xr.Dataset, incidence_deg: float) -> xr.Dataset:
    """Return the map at the incidence nearest to one (deg)."""
    return stability_map.sel(incidence_deg=incidence_deg, method="nearest")


def spread_incidences(
    stability_map: xr.Dataset,
) -> list[tuple[int, str, tuple[float, ...]]]:
    """Return places, labels and colours of incidences spread over those of a map."""
    angles = stability_map["incidence_deg"].values
    chosen = np.linspace(0, angles.size - 1, min(_MOST_INCIDENCES, angles.size))
    places = np.unique(chosen.astype(int)).tolist()
    colours = matplotlib.colormaps["viridis"](np.linspace(0.0, 0.9, len(places)))
    return [
        (place, f"{angles[place]:g} deg", tuple(colour))
        for place, colour in zip(places, colours, strict=True)
    ]


def first_modes(stability_map: xr.Dataset) -> list[str]:
    """Return the names of the first modes of each kind."""
    names = [str(name) for name in stability_map["mode"].values]
    return [name for name in names if int(name.split()[-1]) <= _MODES]


def mark_design_speed(axes: Axes, speed: float | None, *, upright: bool) -> None:
    """Draw the design speed (m/s), if there is one."""
    if speed is not None:
        draw = axes.axvline if upright else axes.axhline
        draw(speed, color=GREY, linewidth=0.9, linestyle="--", label="design speed")


def say_origin(figure: Figure, stability_map: xr.Dataset) -> None:
    """Say what the map is from."""
    if stability_map.attrs["basis"] == "model":
        words = [str(one).split(" at k*")[0] for one in np.ravel(stability_map["learnt"].values)]
        sources = dict.fromkeys(one for one in words if one.startswith("model learnt"))
        add_provenance(
            figure,
            *(f"{one} at each incidence" for one in sources),
            "bars: interval of the model; growth of small motions about the equilibrium from rest",
            f"polar {stability_map.attrs['polar']}",
        )
        return
    add_provenance(
        figure,
        "eigenvalues about the static equilibrium from rest, embedded solver",
        f"polar {stability_map.attrs['polar']}",
    )
