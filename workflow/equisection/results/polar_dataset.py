"""Polars gathered from steady results, as data sets over resolution and incidence."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

import numpy as np
import xarray as xr

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.strip_polars import StripPolars
from equisection.errors import ResultFileError
from equisection.reduction.modal_load import modal_load
from equisection.structure.mode_set import ModeSet

_COEFFICIENTS = {
    "cd": "drag coefficient",
    "cl": "lift coefficient",
    "cm": "moment coefficient about mid-chord, nose up",
}
_SECTIONAL = {
    "cl_section": "sectional lift coefficient",
    "cm_section": "sectional moment coefficient about mid-chord, nose up",
}
_IS_RUN = {"units": "1", "long_name": "1 where there is a case of resolution and incidence"}


def gather_polar(results: Mapping[tuple[str, float], xr.Dataset]) -> xr.Dataset:
    """Gather steady results into one data set.

    Parameters
    ----------
    results
        Result of each resolution and incidence (deg).

    Returns
    -------
    xarray.Dataset
        Over ``resolution`` and ``incidence_deg``; in 3D also over ``span``. A case that failed
        is NaN, with the reason in the attribute ``failures``; where ``is_run`` is 0 there is no
        case. Without results it is without resolutions and incidences.
    """
    if not results:
        return _empty_polar()
    resolutions = list(dict.fromkeys(resolution for resolution, _ in results))
    angles = sorted({angle for _, angle in results})
    gathered = {key: _coefficients(result) for key, result in results.items()}
    unknown = xr.full_like(next(iter(gathered.values()))[list(_COEFFICIENTS)], np.nan)
    parts = []
    for resolution in resolutions:
        row = [
            _as_all(gathered.get(key, unknown), gathered.values()).expand_dims(
                incidence_deg=[key[1]]
            )
            for key in _row(resolution, angles)
        ]
        joined = _side_by_side(row, "incidence_deg")
        parts.append(joined.expand_dims(resolution=[resolution]))
    polar = _side_by_side(parts, "resolution")
    _describe(polar)
    polar["is_run"] = (
        ("resolution", "incidence_deg"),
        np.array([[key in results for key in _row(name, angles)] for name in resolutions], np.int8),
        _IS_RUN,
    )
    failures = [
        f"{resolution} {angle:g} deg: {data.attrs['failure']}"
        for (resolution, angle), data in results.items()
        if data.attrs.get("failure")
    ]
    solvers = {
        resolution: next(
            str(data.attrs["solver_description"])
            for (name, _), data in results.items()
            if name == resolution
        )
        for resolution in resolutions
    }
    return polar.assign_attrs(
        failures="; ".join(failures),
        **{f"solver_{name}": text for name, text in solvers.items()},
    )


def _empty_polar() -> xr.Dataset:
    """Return the polar of no case."""
    nothing = (("resolution", "incidence_deg"), np.empty((0, 0)))
    polar = xr.Dataset(
        dict.fromkeys(_COEFFICIENTS, nothing),
        coords={"resolution": np.empty(0, str), "incidence_deg": np.empty(0)},
        attrs={"failures": ""},
    )
    _describe(polar)
    polar["is_run"] = (nothing[0], np.empty((0, 0), np.int8), _IS_RUN)
    return polar


def _describe(polar: xr.Dataset) -> None:
    """Put units and names on a polar."""
    names = {**_COEFFICIENTS, **_SECTIONAL}
    for name in polar.data_vars:
        polar[name].attrs = {
            "units": "1",
            "long_name": names[str(name)],
            "missing_allowed": "1",
        }
    polar["incidence_deg"].attrs = {"units": "deg", "long_name": "incidence"}
    polar["resolution"].attrs = {"units": "1", "long_name": "resolution"}
    if "span" in polar.coords:
        polar["span"].attrs = {"units": "1", "long_name": "position along the span z/L"}


def given_polar(polar: Polar, resolution: str) -> xr.Dataset:
    """Return a polar that no solver of this run computed, as that of a resolution."""
    columns = {"cd": polar.drag, "cl": polar.lift, "cm": polar.moment}
    dataset = xr.Dataset(
        {name: (("resolution", "incidence_deg"), values[None]) for name, values in columns.items()},
        coords={
            "resolution": [resolution],
            "incidence_deg": np.round(np.degrees(polar.incidence), 9),
        },
        attrs={"failures": "", f"solver_{resolution}": f"given: {polar.label}"},
    )
    _describe(dataset)
    return dataset


def _row(resolution: str, angles: Iterable[float]) -> list[tuple[str, float]]:
    return [(resolution, angle) for angle in angles]


def _coefficients(result: xr.Dataset) -> xr.Dataset:
    """Return a result with its coefficients alone."""
    return result[[name for name in (*_COEFFICIENTS, *_SECTIONAL) if name in result]]


def _side_by_side(parts: Sequence[xr.Dataset], dimension: str) -> xr.Dataset:
    """Join along a dimension, over the stations along the span that any of them has."""
    return xr.concat(parts, dimension, join="outer", data_vars="all", combine_attrs="drop")


def _as_all(result: xr.Dataset, others: Iterable[xr.Dataset]) -> xr.Dataset:
    """Return a result with the stations of the others; one that failed has none of its own."""
    if "span" in result.coords:
        return result
    with_span = next((other for other in others if "span" in other.coords), None)
    if with_span is None:
        return result
    unknown = xr.full_like(with_span[list(_SECTIONAL)], np.nan)
    return result.merge(unknown)


def at_resolution(polar: xr.Dataset, resolution: str) -> xr.Dataset:
    """Return a polar at one resolution, over the stations along the span that its mesh has."""
    chosen = polar.sel(resolution=resolution)
    if "span" not in chosen.dims:
        return chosen
    return chosen.isel(span=chosen["cl_section"].notnull().any("incidence_deg").values)


def polar_at(dataset: xr.Dataset, resolution: str, modes: ModeSet | None = None) -> Polar:
    """Return the polar of one resolution, without the incidences that failed.

    Parameters
    ----------
    dataset
        ``steady/polar_2d.nc`` or ``polar_3d.nc``.
    resolution
        Its resolution.
    modes
        Modes of the beam: lift and moment are to be those that its first bending and its first
        torsion mode feel (:mod:`equisection.reduction.modal_load`), not the means.

    Raises
    ------
    ResultFileError
        Fewer than four incidences have a result; with modes, these have no loads along the span.
    """
    if resolution not in dataset["resolution"].values:
        raise ResultFileError(
            f"the polar has no resolution '{resolution}': none of its incidences has a result"
        )
    chosen = at_resolution(dataset, resolution)
    there = np.isfinite(chosen["cl"].values)
    if there.sum() < 4:
        raise ResultFileError(
            f"the polar at resolution '{resolution}' has {there.sum()} incidences with a result, "
            f"at least 4 are needed ({dataset.attrs.get('failures') or 'add incidences'})"
        )
    if modes is not None:
        chosen = _as_modes_feel_it(chosen, modes)
    return Polar(
        incidence=np.radians(chosen["incidence_deg"].values[there]),
        drag=chosen["cd"].values[there],
        lift=chosen["cl"].values[there],
        moment=chosen["cm"].values[there],
        label=str(dataset.attrs[f"solver_{resolution}"]),
    )


def strip_polars_at(dataset: xr.Dataset, resolution: str) -> StripPolars:
    """Return the polars along the span of ``steady/polar_3d.nc`` at a resolution.

    Raises
    ------
    ResultFileError
        There are no loads along the span, or fewer than four incidences with a result.
    """
    known = resolution in dataset["resolution"].values and "cl_section" in dataset
    chosen = at_resolution(dataset, resolution) if known else dataset
    there = np.isfinite(chosen["cl"].values) if known else np.zeros(0, bool)
    if there.sum() < 4:
        raise ResultFileError(
            f"the polar of the beam at resolution '{resolution}' has {there.sum()} incidences with "
            "loads along the span, at least 4 are needed (steady.incidence_deg)"
        )
    lift, moment = (
        chosen[name].transpose("incidence_deg", "span").values[there]
        for name in ("cl_section", "cm_section")
    )
    return StripPolars(
        np.radians(chosen["incidence_deg"].values[there]),
        chosen["span"].values.astype(np.float64),
        lift,
        moment,
        label=str(dataset.attrs[f"solver_{resolution}"]),
        drag=chosen["cd"].values[there].astype(np.float64),
    )


def _as_modes_feel_it(polar: xr.Dataset, modes: ModeSet) -> xr.Dataset:
    """Return a beam's polar at a resolution with the lift and moment that its first modes feel."""
    if "span" not in polar.dims:
        raise ResultFileError(
            "the beam's results have no loads along the span, which correction 'modal' weights "
            "by the modes; set correction: mean"
        )
    felt = {}
    pair = modes.section_pair()[0]
    for name, first in (("cl", pair.bending(1)), ("cm", pair.torsion(1))):
        load = polar[f"{name}_section"].transpose("incidence_deg", "span").values
        felt[name] = (
            "incidence_deg",
            modal_load(polar["span"].values, load, first.span, first.shape[0]),
        )
    return polar.assign(felt)
