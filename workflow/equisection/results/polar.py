"""Polars gathered from steady results, as data sets over resolution and incidence."""

from __future__ import annotations

from collections.abc import Iterable, Mapping

import numpy as np
import xarray as xr

from equisection.aerodynamics.polar import SectionPolar
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
        joined = xr.concat(row, "incidence_deg", data_vars="all", combine_attrs="drop")
        parts.append(joined.expand_dims(resolution=[resolution]))
    polar = xr.concat(parts, "resolution", data_vars="all", combine_attrs="drop")
    _describe(polar)
    polar["is_run"] = (
        ("resolution", "incidence_deg"),
        np.array([[key in results for key in _row(name, angles)] for name in resolutions], np.int8),
        {"units": "1", "long_name": "1 where there is a case of resolution and incidence"},
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


def given_polar(polar: SectionPolar, resolution: str) -> xr.Dataset:
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


def polar_as_modes_feel_it(polar: xr.Dataset, modes: ModeSet) -> xr.Dataset:
    """Return a beam's polar with lift and moment as its first modes feel them, not in the mean.

    Lift is that of the first bending mode, moment that of the first torsion mode
    (:mod:`equisection.reduction.modal_load`); drag stays the mean.

    Parameters
    ----------
    polar
        ``steady/polar_3d.nc``, with loads along the span.
    modes
        Modes of the beam.

    Raises
    ------
    ResultFileError
        The beam's results have no loads along the span.
    ModesError
        There is no bending or no torsion mode.
    """
    if "span" not in polar.dims:
        if polar["cl"].notnull().any():
            raise ResultFileError(
                "the beam's results have no loads along the span, which correction 'modal' weights "
                "by the modes; set correction: mean"
            )
        return polar
    felt = {}
    for name, first in (("cl", modes.bending(1)), ("cm", modes.torsion(1))):
        load = polar[f"{name}_section"].transpose(..., "span")
        values = modal_load(polar["span"].values, load.values, first.span, first.shape[0])
        felt[name] = load.isel(span=0, drop=True).copy(data=values)
    return polar.assign(felt)


def _row(resolution: str, angles: Iterable[float]) -> list[tuple[str, float]]:
    return [(resolution, angle) for angle in angles]


def _coefficients(result: xr.Dataset) -> xr.Dataset:
    """Return a result without what it has beside its coefficients."""
    return result[[name for name in (*_COEFFICIENTS, *_SECTIONAL) if name in result]]


def _as_all(result: xr.Dataset, others: Iterable[xr.Dataset]) -> xr.Dataset:
    """Return a result with the stations of the others; one that failed has none of its own."""
    if "span" in result.coords:
        return result
    with_span = next((other for other in others if "span" in other.coords), None)
    if with_span is None:
        return result
    unknown = xr.full_like(with_span[list(_SECTIONAL)], np.nan)
    return result.merge(unknown)


def polar_at(dataset: xr.Dataset, resolution: str) -> SectionPolar:
    """Return the polar of one resolution, without the incidences that failed.

    Raises
    ------
    ResultFileError
        Fewer than four incidences have a result.
    """
    if resolution not in dataset["resolution"].values:
        raise ResultFileError(
            f"the polar has no resolution '{resolution}': none of its incidences has a result"
        )
    chosen = dataset.sel(resolution=resolution)
    there = np.isfinite(chosen["cl"].values)
    if there.sum() < 4:
        raise ResultFileError(
            f"the polar at resolution '{resolution}' has {there.sum()} incidences with a result, "
            f"at least 4 are needed ({dataset.attrs.get('failures') or 'add incidences'})"
        )
    return SectionPolar(
        incidence=np.radians(chosen["incidence_deg"].values[there]),
        drag=chosen["cd"].values[there],
        lift=chosen["cl"].values[there],
        moment=chosen["cm"].values[there],
        label=str(dataset.attrs[f"solver_{resolution}"]),
    )
