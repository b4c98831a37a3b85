"""Steady results written as a polar file, which the embedded solver and ``beam_polar`` read."""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import xarray as xr

from equisection.errors import ResultFileError
from equisection.io.aerodyn_polar import aerodyn_text
from equisection.io.csv_polar import csv_text
from equisection.io.polar_columns import COLUMNS
from equisection.io.polar_rows import MID_CHORD, REYNOLDS
from equisection.results.netcdf import read_dataset


def polar_csv(paths: Sequence[Path]) -> str:
    """Return the polar of steady results as CSV, by ascending incidence.

    The last column has the origin of each value. Comments name the solver, and the results that are
    left out because they failed.

    Raises
    ------
    ResultFileError
        A file is no steady result, two are of the same incidence, or they are of different
        solvers or meshes.
    """
    results = _one_polar(paths)
    comments = [f"{results[0].attrs['solver_description']}.", *_flow(results[0])]
    comments.append(
        "Written by 'equisection polar' from steady results. Moment about mid-chord, nose up."
    )
    comments += _left_out(results)
    return csv_text(_points(results), comments)


def polar_aerodyn(paths: Sequence[Path]) -> str:
    """Return the polar of steady results as an airfoil table of AeroDyn, by ascending incidence.

    Raises
    ------
    ResultFileError
        As for :func:`polar_csv`.
    """
    results = _one_polar(paths)
    comments = [
        f"{results[0].attrs['solver_description']}.",
        "Written by 'equisection polar' from steady results.",
        *_left_out(results),
    ]
    return aerodyn_text(
        [values for values, _ in _points(results)], _reynolds_number(results[0]), comments
    )


def _one_polar(paths: Sequence[Path]) -> list[xr.Dataset]:
    """Return steady results by ascending incidence; refuse those that do not make one polar."""
    results = sorted(
        (_steady(path) for path in paths), key=lambda data: data.attrs["incidence_deg"]
    )
    _require_one_polar(results)
    return results


def _left_out(results: Sequence[xr.Dataset]) -> list[str]:
    return [
        f"Left out: {data.attrs['incidence_deg']:g} deg, {data.attrs['failure']}"
        for data in results
        if data.attrs["failure"]
    ]


def _points(results: Sequence[xr.Dataset]) -> list[tuple[tuple[float, ...], str]]:
    """Return values in the order of COLUMNS, with how they were obtained."""
    return [
        (
            (data.attrs["incidence_deg"], *(float(data[name]) for name in COLUMNS[1:])),
            data.attrs["method"],
        )
        for data in results
        if not data.attrs["failure"]
    ]


def _reynolds_number(data: xr.Dataset) -> float:
    """Return the Reynolds number of a result's case; NaN where it holds none."""
    case = json.loads(data.attrs.get("case", "{}"))
    if not case:
        return math.nan
    medium, chord = case["medium"], case["geometry"]["chord"]
    return float(medium["density"] * medium["speed"] * chord / medium["dynamic_viscosity"])


def _steady(path: Path) -> xr.Dataset:
    wanted = "give files of results/<run>/steady/<dimension>/"
    if path.suffix != ".nc":
        raise ResultFileError(f"{path}: no NetCDF file; {wanted}")
    data = read_dataset(path)
    if not {"method", "failure", "incidence_deg"} <= data.attrs.keys():
        raise ResultFileError(f"{path}: no result of a steady case; {wanted}")
    return data.assign_attrs(path=str(path))


def _flow(data: xr.Dataset) -> list[str]:
    """Return a comment about plate and flow, where the result holds its case."""
    case = json.loads(data.attrs.get("case", "{}"))
    if not case:
        return []
    geometry, reynolds = case["geometry"], _reynolds_number(data)
    height = geometry["channel_height"]
    around = "free air" if height is None else f"channel {height:g} c high"
    return [
        f"Thickness {geometry['thickness']:g} c, Reynolds number {reynolds:.3g}, {around}.",
        *(f"Valid for: {what}" for what in _valid_for(case, reynolds)),
    ]


def _valid_for(case: dict[str, Any], reynolds: float) -> Iterator[str]:
    """Yield what a polar is of: thickness, and of a beam what ``steady.beam_polar`` is held to."""
    geometry = case["geometry"]
    thickness = f"h/c {geometry['thickness']:g}"
    if case["dimension"] != "3d":
        yield thickness
        return
    wall = str(geometry["root_on_wall"]).lower()
    yield (
        f"L/c {geometry['span']:g}, {thickness}, {REYNOLDS} {reynolds:.0f}, "
        f"flow.root_on_wall {wall}, moment_axis {MID_CHORD:g}"
    )
    if geometry["channel_height"] is not None:
        yield (
            f"flow.channel.height_chords {geometry['channel_height']:g}, "
            f"flow.channel.tip_gap_chords {geometry['tip_gap']:g}"
        )


def _require_one_polar(results: Sequence[xr.Dataset]) -> None:
    """Refuse results that do not make one polar."""
    first = results[0]
    of_incidence: dict[float, xr.Dataset] = {}
    for data in results:
        if data.attrs["solver_description"] != first.attrs["solver_description"]:
            raise ResultFileError(
                f"{data.attrs['path']}: by {data.attrs['solver_description']}, but "
                f"{first.attrs['path']} by {first.attrs['solver_description']}; give the results "
                "of one solver on one mesh, for instance steady/2d/coarse_a*.nc"
            )
        other = of_incidence.setdefault(data.attrs["incidence_deg"], data)
        if other is not data:
            raise ResultFileError(
                f"{data.attrs['path']}: of the same incidence as {other.attrs['path']}; give one "
                "of them"
            )
