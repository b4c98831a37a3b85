"""Correction factors over incidence, with the polars that they come from, as a data set."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

from equisection.aerodynamics.polar import Polar
from equisection.reduction.correction import CorrectionFactors

_COEFFICIENTS = {"drag": "cd", "lift": "cl", "moment": "cm"}
_FACTORS = ("lift_factor", "moment_factor")
#: Incidences (deg) this close are one: they come from degrees by way of radians.
_SAME_DEG = 1e-6


def factors_to_dataset(factors: CorrectionFactors) -> xr.Dataset:
    """Return ``steady/correction.nc`` on the incidences that both polars cover.

    A factor is NaN where it is not a positive number, as where the moment of a cambered section
    changes sign.
    """
    section, beam = factors.section, factors.beam
    low = max(section.incidence_range[0], beam.incidence_range[0])
    high = min(section.incidence_range[1], beam.incidence_range[1])
    incidence = np.union1d(section.incidence, beam.incidence)
    incidence = incidence[(incidence >= low) & (incidence <= high)]
    variables: dict[str, object] = {
        "lift_factor": (
            "incidence_deg",
            factors.lift_factor(incidence),
            {
                "units": "1",
                "long_name": "c_l/C_L, factor of mass and flexural stiffness",
                "missing_allowed": "1",
            },
        ),
        "moment_factor": (
            "incidence_deg",
            factors.moment_factor(incidence),
            {
                "units": "1",
                "long_name": "c_m/C_M, factor of inertia and torsional stiffness",
                "missing_allowed": "1",
            },
        ),
    }
    for whole, polar in (("section", section), ("beam", beam)):
        axis = f"{whole}_incidence_deg"
        for name, short in _COEFFICIENTS.items():
            variables[f"{whole}_{short}"] = (
                axis,
                getattr(polar, name),
                {"units": "1", "long_name": f"{name} coefficient of the {whole}"},
            )
    degrees = {"units": "deg", "long_name": "incidence"}
    return xr.Dataset(
        variables,
        {
            "incidence_deg": ("incidence_deg", np.degrees(incidence), degrees),
            "section_incidence_deg": (
                "section_incidence_deg",
                np.degrees(section.incidence),
                degrees,
            ),
            "beam_incidence_deg": ("beam_incidence_deg", np.degrees(beam.incidence), degrees),
        },
        attrs={"section_label": section.label, "beam_label": beam.label},
    )


def no_factors() -> xr.Dataset:
    """Return ``steady/correction.nc`` of a run that has no polar of section or beam."""
    axis = ("incidence_deg", np.empty(0), {"units": "deg", "long_name": "incidence"})
    nothing = {"units": "1", "long_name": "factor that there is none of"}
    variables = {name: ("incidence_deg", np.empty(0), nothing) for name in _FACTORS}
    return xr.Dataset(variables, {"incidence_deg": axis})


def factors_from_dataset(dataset: xr.Dataset) -> CorrectionFactors:
    """Return the factors of ``steady/correction.nc``."""
    polars = {
        whole: Polar(
            incidence=np.radians(dataset[f"{whole}_incidence_deg"].values),
            drag=dataset[f"{whole}_cd"].values,
            lift=dataset[f"{whole}_cl"].values,
            moment=dataset[f"{whole}_cm"].values,
            label=str(dataset.attrs[f"{whole}_label"]),
        )
        for whole in ("section", "beam")
    }
    return CorrectionFactors(**polars)


def factor_at(dataset: xr.Dataset, name: str, incidence_deg: float) -> float:
    """Return a factor of ``steady/correction.nc`` at an incidence (deg), linear between its own.

    NaN beyond its incidences, and between two of which one has no factor.
    """
    incidence, factor = dataset["incidence_deg"].values, dataset[name].values
    same = np.flatnonzero(np.abs(incidence - incidence_deg) <= _SAME_DEG)
    if same.size:
        return float(factor[same[0]])
    if not incidence.size:
        return math.nan
    return float(np.interp(incidence_deg, incidence, factor, left=np.nan, right=np.nan))
