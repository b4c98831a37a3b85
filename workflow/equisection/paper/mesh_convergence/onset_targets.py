"""Interval of the onset of each model, beside the one that is wanted, and what narrows it."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import pandas as pd

from equisection.analysis.grid_limit import FORMAL_ORDER, GridLimit
from equisection.paper.mesh_convergence.kept_releases import OWN_RATIOS
from equisection.paper.mesh_convergence.mesh_series import LIMIT, MeshSeries, MeshValue
from equisection.paper.mesh_convergence.onset_by_mesh import ONSET
from equisection.paper.mesh_convergence.onset_by_mesher import BOTH_MESHERS

#: Wanted half-width of the interval of the onset's limit, as a part of it, by model.
WANTED = {"2d": 0.05, "2d-corrected": 0.05, OWN_RATIOS: 0.05, "3d": 0.10}


def best_limit(table: pd.DataFrame, model: str) -> pd.Series | None:
    """Return the line of the best limit of the onset of a model without damping.

    That is the limit of both meshers, or else the narrowest interval of k*: as a part of the limit,
    whatever errs high would look surer. Without any interval it is the onset on one mesh that the
    table has first; None where the model has none.

    Parameters
    ----------
    table
        ``mesh_convergence.csv`` (:func:`.mesh_series.as_table`).
    model
        The model.
    """
    chosen = table[
        (table["quantity"] == ONSET)
        & (table["model"] == model)
        & (table["at"].fillna("") == "")
        & (table["mesh"] == LIMIT)
    ]
    if chosen.empty:
        return None
    of_both = chosen[chosen["basis"].str.endswith(BOTH_MESHERS)]
    chosen = chosen if of_both.empty else of_both
    width = chosen["high"] - chosen["low"]
    width = width.where(width < math.inf)
    return chosen.iloc[0] if width.isna().all() else chosen.loc[width.idxmin()]


def foreseen(series: MeshSeries, cells: Sequence[int], error: float | None = None) -> GridLimit:
    """Return the limit that a series of two meshes would have with values on finer ones.

    These are taken to lie where the error falls by the formal order.

    Parameters
    ----------
    series
        Series of two meshes.
    cells
        Cells of each finer mesh, rising.
    error
        Half-width of the interval of each of their values; that of the finest mesh by default.
    """
    limit, finest = series.limit.value, series.values[-1]
    half = finest.half_width if error is None else error
    values = list(series.values)
    for count in cells:
        shrunk = (finest.cells / count) ** (FORMAL_ORDER / series.dimensions)
        value = limit + (finest.value - limit) * shrunk
        values.append(MeshValue("", count, value, value - half, value + half))
    return replace(series, values=tuple(values)).limit


def targets(table: pd.DataFrame) -> pd.DataFrame:
    """Return a line for each model: its best limit, how sure it is, and how sure it has to be.

    Returns
    -------
    pd.DataFrame
        ``model``, ``basis``, ``limit``, ``low``, ``high`` (k*), ``interval`` and ``wanted`` (half
        of the interval, % of the limit), and ``lacking`` (% of the limit; 0 where it is reached,
        NaN without an interval).
    """
    rows = []
    for model, wanted in WANTED.items():
        best = best_limit(table, model)
        if best is None:
            continue
        value, low, high = (float(best[name]) for name in ("value", "low", "high"))
        part = 50.0 * (high - low) / abs(value)
        known = math.isfinite(part)
        lacking = max(part - 100.0 * wanted, 0.0) if known else math.nan
        interval = part if known else math.nan
        rows.append((model, best["basis"], value, low, high, interval, 100.0 * wanted, lacking))
    columns = ["model", "basis", "limit", "low", "high", "interval", "wanted", "lacking"]
    return pd.DataFrame(rows, columns=columns)
