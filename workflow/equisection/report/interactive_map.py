"""Map of stability to point at: growth over incidence and speed, and the critical speed on it.

It is data for plotly.js, which draws it where the page is read. Each model has its own map.
"""

from __future__ import annotations

import html
import json
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray
from plotly import graph_objects

from equisection.figures.map_shown import MARKERS_OF_MECHANISMS, models_of
from equisection.figures.style import BLACK, BLUE, GREY, LIGHT_GREY, VERMILLION
from equisection.keys.shown import rounded

Floats = NDArray[np.float64]

#: Growth rates beyond this percentile of their sizes have the colour of the ends.
_STRONG = 90.0
#: Height of the map (CSS pixels).
_HEIGHT = 520
#: Room above the map (CSS pixels), for the legend and for the buttons.
_ABOVE = 40
_SYMBOLS = {"D": "diamond", "o": "circle", "s": "square", "^": "triangle-up", "x": "x"}


def interactive_map(
    stability_map: xr.Dataset, stability: pd.DataFrame, design_speed: float | None
) -> dict[str, Any]:
    """Return the map of each model as data for plotly.js.

    Parameters
    ----------
    stability_map
        ``comparison/stability_map.nc``.
    stability
        ``comparison/stability.csv``, with the interval of each speed.
    design_speed
        Speed (m/s) to mark; None for none.

    Returns
    -------
    dict
        ``models``, each with ``name``, ``label`` and its ``figure`` (``data`` and ``layout``), and
        ``is_learnt``: the critical speeds are those of releases by learnt models.
    """
    models = [
        {
            "name": str(one["model"].values),
            "label": look.label,
            "figure": json.loads(_figure(one, stability, design_speed).to_json()),
        }
        for one, look in models_of(stability_map)
    ]
    return {"models": models, "is_learnt": _is_learnt(stability_map)}


def _is_learnt(stability_map: xr.Dataset) -> bool:
    return bool(stability_map.attrs["basis"] == "model")


def _figure(one: xr.Dataset, stability: pd.DataFrame, design_speed: float | None) -> Any:
    figure = graph_objects.Figure(layout=_layout())
    if np.isfinite(one["growth_rate"].values).any():
        figure.add_traces(_growth(one))
    figure.add_traces(_critical_speeds(one, _rows_of(one, stability)))
    if design_speed is not None:
        ends = one["incidence_deg"].values[[0, -1]]
        figure.add_scatter(
            x=ends,
            y=[design_speed] * 2,
            mode="lines+markers",  # of one incidence alone a line has no length
            marker={"symbol": "line-ew-open", "size": 14, "color": BLACK},
            line={"color": BLACK, "dash": "dash", "width": 2},  # seen on any colour of the map
            name="design speed",
            hovertemplate=f"design speed {rounded(design_speed, 4)} m/s<extra></extra>",
        )
    return figure


def _layout() -> dict[str, Any]:
    axis = {"showgrid": False, "zeroline": False, "ticks": "outside", "linecolor": GREY}
    return {
        "template": "none",
        "height": _HEIGHT,
        "margin": {"l": 60, "r": 10, "t": _ABOVE, "b": 60},
        "showlegend": True,
        "xaxis": {**axis, "title": {"text": "incidence (deg)"}},
        "yaxis": {**axis, "title": {"text": "speed (m/s)"}},
        "legend": {"orientation": "h", "y": 1.02, "yanchor": "bottom", "x": 0},
        "hoverlabel": {"align": "left"},
    }


def _rows_of(one: xr.Dataset, stability: pd.DataFrame) -> pd.DataFrame:
    """Return the lines of a model in the table, one for each incidence of the map."""
    rows = stability[stability["model"] == str(one["model"].values)]
    by_angle = rows.set_index(rows["incidence_deg"].round(6))
    return by_angle.reindex(one["incidence_deg"].values.round(6))


def _growth(one: xr.Dataset) -> list[Any]:
    """Return the growth rate of the least stable motion as colours, white where it is nil.

    Where there is no equilibrium to be stable or not, the colour is grey.
    """
    growth = one["growth_rate"].transpose("speed", "incidence_deg").values
    sizes = np.abs(growth[np.isfinite(growth)])
    strong = float(np.percentile(sizes, _STRONG)) or 1.0
    place = {
        "x": one["incidence_deg"].values,
        "y": one["speed"].values,
        "text": _words_of_points(one),
        "hovertemplate": "%{text}<extra></extra>",
        "hoverongaps": False,
    }
    coloured = graph_objects.Heatmap(
        **place,
        z=growth,
        zmin=-strong,
        zmax=strong,
        colorscale=[[0.0, BLUE], [0.5, "#FFFFFF"], [1.0, VERMILLION]],
        colorbar={"title": {"text": "growth (1/s)", "side": "right"}, "thickness": 12},
        name="growth",
    )
    lost = np.isnan(growth)
    if not lost.any():
        return [coloured]
    grey = [[0.0, LIGHT_GREY], [1.0, LIGHT_GREY]]
    without = graph_objects.Heatmap(
        **place,
        z=np.where(lost, 1.0, np.nan),
        colorscale=grey,
        showscale=False,
        name="no static equilibrium",
    )
    return [without, coloured]


def _words_of_points(one: xr.Dataset) -> list[list[str]]:
    """Return what is said of each point, a line for each speed."""
    names = ["growth_rate", "frequency", "mechanism", "equilibrium_twist"]
    over = one[names].transpose("speed", "incidence_deg")
    return [
        [
            _words_of_point(over.isel(speed=row, incidence_deg=column))
            for column in range(over.sizes["incidence_deg"])
        ]
        for row in range(over.sizes["speed"])
    ]


def _words_of_point(here: xr.Dataset) -> str:
    growth, mechanism = float(here["growth_rate"]), str(here["mechanism"].values)
    where = (
        f"<b>{rounded(float(here['speed']), 4)} m/s at {float(here['incidence_deg']):g} deg</b><br>"
    )
    if not np.isfinite(growth):
        name = "" if mechanism in ("none", "unknown") else f": {html.escape(mechanism)}"
        return f"{where}no static equilibrium from rest{name}"
    kind = "stable" if growth <= 0.0 else html.escape(mechanism)
    frequency = rounded(float(here["frequency"]), 3)
    return (
        f"{where}{kind}<br>growth {rounded(growth, 3)} 1/s at {frequency} Hz<br>"
        f"static twist of the tip {np.degrees(float(here['equilibrium_twist'])):.3g} deg"
    )


def _critical_speeds(one: xr.Dataset, rows: pd.DataFrame) -> list[Any]:
    """Return the critical speeds with their intervals, and where there is none up to a speed."""
    angle, speed = one["incidence_deg"].values, one["critical_speed"].values
    # of models that were learnt at these incidences alone nothing is known in between
    joined = not _is_learnt(one)
    low, high = (rows[name].to_numpy(dtype=np.float64) for name in ("speed_from", "speed_to"))
    top = float(np.nanmax([*one["speed"].values, *speed]))
    opened = np.isinf(high) & np.isfinite(speed)
    below, above = speed - low, np.where(opened, top, high) - speed
    found = graph_objects.Scatter(
        x=angle,
        y=speed,
        mode="lines+markers" if joined else "markers",
        line={"color": BLACK, "width": 2},
        marker={
            "size": 9,
            "color": BLACK,
            "symbol": [
                _SYMBOLS[MARKERS_OF_MECHANISMS.get(str(name), "x")]
                for name in one["critical_mechanism"].values
            ],
        },
        error_y={
            "type": "data",
            "symmetric": False,
            "array": _bars(above),
            "arrayminus": _bars(below),
            "color": BLACK,
            "thickness": 1,
        },
        text=[
            _words_of_speed(one.isel(incidence_deg=place), rows.iloc[place])
            for place in range(angle.size)
        ],
        hovertemplate="%{text}<extra></extra>",
        name="critical speed and its interval" if np.isfinite(below).any() else "critical speed",
    )
    stable = np.isnan(speed) & np.isfinite(one["speed_low"].values)
    marks = (
        (opened, np.full(angle.size, top), "triangle-up", "interval is open above"),
        (stable, one["speed_low"].values, "arrow-bar-up", "stable up to here"),
    )
    return [found, *(_marks(angle[at], y[at], *look) for at, y, *look in marks if at.any())]


def _marks(angle: Floats, speed: Floats, symbol: str, name: str) -> Any:
    """Return marks of one kind."""
    return graph_objects.Scatter(
        x=angle,
        y=speed,
        mode="markers",
        marker={"symbol": symbol, "size": 12, "color": BLACK},
        hovertemplate=f"{name}: %{{y:.4g}} m/s at %{{x:g}} deg<extra></extra>",
        name=name,
    )


def _bars(length: Floats) -> list[float]:
    """Return lengths of error bars, nil where they are not known."""
    return [float(one) if np.isfinite(one) and one > 0.0 else 0.0 for one in length]


def _words_of_speed(here: xr.Dataset, row: pd.Series) -> str:
    """Return what is said of a critical speed."""
    speed, angle = float(here["critical_speed"]), float(here["incidence_deg"])
    lines = [f"<b>{rounded(speed, 4)} m/s at {angle:g} deg</b>"]
    frequency = float(here["critical_frequency"])
    at = f" at {rounded(frequency, 3)} Hz" if np.isfinite(frequency) and frequency > 0.0 else ""
    lines.append(f"{html.escape(str(here['critical_mechanism'].values))}{at}")
    low, high = row["speed_from"], row["speed_to"]
    if np.isfinite(low):
        end = f"to {rounded(high, 4)} m/s" if np.isfinite(high) else "open above"
        lines.append(f"interval from {rounded(low, 4)} {end}")
    if np.isfinite(row.get("margin", np.nan)):
        lines.append(f"{rounded(row['margin'], 3)} times the design speed")
    return "<br>".join(lines)
