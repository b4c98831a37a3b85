"""Parts of a map of stability as figures show them: models, mechanisms, and one incidence."""

from __future__ import annotations

from collections.abc import Iterator

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


def models_of(stability_map: xr.Dataset) -> Iterator[tuple[xr.Dataset, Look]]:
    """Yield the map of each model with its look."""
    for name in stability_map["model"].values:
        yield stability_map.sel(model=name), LOOKS[str(name)]


def nearest_incidence(stability_map: xr.Dataset, incidence_deg: float) -> xr.Dataset:
    """Return the map at the incidence nearest to one (deg)."""
    return stability_map.sel(incidence_deg=incidence_deg, method="nearest")


def mark_design_speed(axes: Axes, speed: float | None, *, upright: bool) -> None:
    """Draw the design speed (m/s), if there is one."""
    if speed is not None:
        draw = axes.axvline if upright else axes.axhline
        draw(speed, color=GREY, linewidth=0.9, linestyle="--", label="design speed")


def say_origin(figure: Figure, stability_map: xr.Dataset) -> None:
    """Say what the map is from."""
    add_provenance(
        figure,
        "eigenvalues about the static equilibrium from rest, embedded solver",
        f"polar {stability_map.attrs['polar']}",
    )
