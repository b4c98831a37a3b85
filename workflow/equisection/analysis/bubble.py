"""Recirculation bubble of rigid section and plate, and wall distance, from their surface data."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from equisection.results.plate_surface import plate_surface_from_dataset
from equisection.results.surface import SectionSurface, suction_side, surface_from_dataset

COLUMNS = (
    "resolution", "incidence_deg", "side", "bubble", "y_plus_mean", "y_plus_largest",
    "y_plus_below_1", "method", "solver", "note",
)  # fmt: skip
PLATE_COLUMNS = ("resolution", "incidence_deg", "root", "tip", "solver")
#: Says of a result that was made before surface data were stored how to have them.
MISSING = (
    "no surface data, which results made by an earlier version lack; to have them delete "
    "results/.store/{case_hash} and the result, and run with reuse: '' in the configuration"
)


def bubble_table(results: Mapping[tuple[str, float], xr.Dataset]) -> pd.DataFrame:
    """Return ``tables/bubble.csv``: a line for each resolution and ascending incidence.

    Parameters
    ----------
    results
        Steady result of each resolution and incidence (deg), the resolutions in the order of the
        table. One that has no value, or no surface data, has a line that says so.
    """
    resolutions = list(dict.fromkeys(resolution for resolution, _ in results))
    rows = [
        (resolution, angle, *_line(surface_from_dataset(result), angle, result))
        for (resolution, angle), result in sorted(
            results.items(), key=lambda entry: (resolutions.index(entry[0][0]), entry[0][1])
        )
    ]
    return pd.DataFrame(rows, columns=COLUMNS)


def plate_bubble_table(results: Iterable[xr.Dataset]) -> pd.DataFrame:
    """Return where the bubble of the plate ends on its suction side, at the root and at the tip.

    Parameters
    ----------
    results
        Steady results of the plate; those without surface data, or at 0 deg, have no line.

    Returns
    -------
    pd.DataFrame
        ``resolution``, ``incidence_deg``, ``root`` and ``tip`` (x/c; 0 without a bubble, 1 for the
        whole chord) and ``solver``, by resolution and ascending incidence.
    """
    rows = []
    for result in results:
        surface = plate_surface_from_dataset(result)
        angle = float(result.attrs["incidence_deg"])
        if surface is None or angle == 0.0:
            continue
        _, ends = surface.reattachment(suction_side(angle))
        made = str(result.attrs["solver_description"])
        rows.append((str(result.attrs["resolution"]), angle, ends[0], ends[-1], made))
    return pd.DataFrame(rows, columns=PLATE_COLUMNS).sort_values(list(PLATE_COLUMNS[:2]))


def _line(surface: SectionSurface | None, angle: float, result: xr.Dataset) -> tuple[object, ...]:
    attributes = result.attrs
    made = (str(attributes["method"]), str(attributes["solver_description"]))
    side = suction_side(angle)
    if surface is None:
        note = str(attributes["failure"]) or MISSING.format(case_hash=attributes["case_hash"])
        return (side, math.nan, math.nan, math.nan, math.nan, *made, note)
    length, y_plus = _along_both_sides(surface)
    return (
        side,
        surface.reattachment(side),
        float(np.average(y_plus, weights=length)),
        float(y_plus.max()),
        float(length[y_plus < 1].sum() / length.sum()),
        *made,
        "",
    )


def _along_both_sides(
    surface: SectionSurface,
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return lengths and y+ of the faces of upper and lower side, without the edges."""
    sides = [surface.on(side) for side in ("upper", "lower")]
    return (
        np.concatenate([side.length for side in sides]),
        np.concatenate([side.y_plus for side in sides]),
    )
