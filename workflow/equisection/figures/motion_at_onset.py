"""Motion at the onset at one incidence: along the span, and at the tip over a period."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from equisection.figures.map_shown import models_of, nearest_incidence, say_origin
from equisection.figures.panels import letter, say
from equisection.figures.style import PAGE_WIDTH
from equisection.keys.shown import rounded
from equisection.results.netcdf import read_dataset


def from_files(stability_map: Path, incidence_deg: float) -> Figure:
    """Draw the motion at the onset of a run, at the incidence nearest to that of its flow."""
    return draw(read_dataset(stability_map), incidence_deg)


def draw(stability_map: xr.Dataset, incidence_deg: float) -> Figure:
    """Draw the amplitudes along the span (left), and twist against deflection (right).

    Parameters
    ----------
    stability_map
        ``comparison/stability_map.nc``.
    incidence_deg
        Incidence (deg), nearest to which one of the map is drawn.
    """
    chosen = nearest_incidence(stability_map, incidence_deg)
    figure = Figure(figsize=(PAGE_WIDTH, 3.6))
    left, right = figure.subplots(1, 2)
    phase = np.linspace(0.0, 2.0 * np.pi, 121)
    drawn = False
    for one, look in models_of(chosen):
        twist = one["onset_twist_real"].values + 1j * one["onset_twist_imag"].values
        moved = one["onset_deflection_real"].values + 1j * one["onset_deflection_imag"].values
        known = np.isfinite(twist)
        if not known.any():
            continue
        drawn = True
        place = one["strip_place"].values[known]
        if known.sum() > 1:
            left.plot(place, np.abs(twist[known]), color=look.colour, label=f"{look.label}, twist")
            left.plot(
                place,
                np.abs(moved[known]),
                color=look.colour,
                linestyle="--",
                label=f"{look.label}, deflection/c",
            )
        ratio = float(one["tip_ratio"]) * np.exp(1j * np.radians(float(one["tip_phase"])))
        turning = np.exp(1j * phase)
        right.plot(
            turning.real,
            (ratio * turning).real,
            color=look.colour,
            linestyle=look.line,
            label=f"{look.label}: {one['critical_mechanism'].values!s}, "
            f"{rounded(float(one['critical_frequency']), 3)} Hz",
        )
    if not drawn:
        say(left, "No onset in the range.")
        say(right, "No onset in the range.")
    elif left.has_data():
        left.legend(fontsize="x-small")
    else:
        say(left, "No beam is among the models.")
    left.set(xlabel="$z/L$", ylabel="amplitude over the tip's twist")
    right.set(xlabel="twist over its amplitude", ylabel="deflection in chords over twist (1/rad)")
    if drawn:
        right.legend(fontsize="x-small")
    angle = float(chosen["incidence_deg"])
    letter(left, "a", f"along the span at {angle:g} deg")
    letter(right, "b", f"tip over a period at {angle:g} deg")
    say_origin(figure, stability_map)
    return figure
