"""The equivalent section, in both forms, as a data set."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from equisection.beam.section import QUANTITIES, Section
from equisection.conventions import dynamic_pressure
from equisection.reduction.flutter_bias import FlutterBias
from equisection.reduction.integrals import Integrals
from equisection.reduction.reduce import not_reducible, oscillation_factor

#: Begin of an attribute: why a reduction has no section, empty where it has one.
_NO_SECTION = "no_section_"
_RATIOS = {"inertia_ratio": "c^2 m_2D/I_2D", "stiffness_ratio": "c^2 k_w/k_theta"}
_INTEGRALS = {
    "mass_theta": "M_theta (Eq. 6)",
    "mass_w": "M_w (Eq. 6)",
    "stiffness_theta": "K_theta (Eq. 7) from the natural frequencies",
    "stiffness_w": "K_w (Eq. 7) from the natural frequencies",
    "strain_theta": "K_theta (Eq. 7) from the slopes of the shapes",
    "a_theta_theta": "A_theta,theta (Eq. 12)",
    "a_theta_w": "A_theta,w (Eq. 12)",
    "a_w_w": "A_w,w (Eq. 12)",
}


def equivalent_to_dataset(
    sections: Mapping[str, Section],
    integrals: Integrals,
    warnings: tuple[str, ...],
    *,
    pair: Integrals | None = None,
    places: tuple[float, float] | None = None,
    density: float,
    speed: float,
) -> xr.Dataset:
    """Return ``structure/equivalent.nc``.

    Parameters
    ----------
    sections
        The section (SI) of each reduction.
    integrals
        Integrals over the shapes of the modes.
    warnings
        Reasons why the section represents the beam badly.
    pair
        Integrals of the section's pair of modes, where that is not the first of ``integrals``.
    places
        z/L where twist and deflection of the beam are read; the tip for None.
    density, speed
        Density (kg/m3) and speed (m/s) of the flow.
    """
    si = list(sections.values())
    in_flow = [section.in_flow(density, speed) for section in si]
    variables: dict[str, object] = {
        name: _of_each(si, name, quantity.units, quantity.meaning)
        for name, quantity in QUANTITIES.items()
    }
    for member, quantity in QUANTITIES.items():
        if quantity.flow_name:
            text = quantity.flow_meaning
            variables[quantity.flow_name] = _of_each(in_flow, member, "1", text)
    for name, text in _RATIOS.items():
        variables[name] = _of_each(si, name, "1", text)
    for name, text in _INTEGRALS.items():
        variables[name] = (
            ("row", "column"),
            getattr(integrals, name),
            {"units": "1", "long_name": text},
        )
    for name, text in (("f_mean", "F_i, span mean of f_i"), ("g_mean", "G_i, span mean of g_i")):
        variables[name] = ("row", getattr(integrals, name), {"units": "1", "long_name": text})
    variables["cos_phi"] = (
        (),
        integrals.cos_phi,
        {"units": "1", "long_name": "likeness of the first shapes of twist and deflection"},
    )
    variables["oscillation_ratio"] = (
        (),
        integrals.oscillation_ratio,
        {"units": "1", "long_name": "W/Theta of an oscillating tip over w/theta of the section"},
    )
    of_pair = integrals if pair is None else pair
    factors = [oscillation_factor(section, of_pair, name) for name, section in sections.items()]
    variables["oscillation_factor"] = (
        "reduction",
        factors,
        {
            "units": "1",
            "long_name": "deflection of an oscillating tip about its mean over its recovered one",
        },
    )
    for motion, place in zip(("twist", "deflection"), places or (1.0, 1.0), strict=True):
        text = f"z/L where the {motion} of the beam is read, and recovered"
        variables[f"{motion}_place"] = ((), place, {"units": "1", "long_name": text})
    number = np.arange(1, integrals.f_mean.size + 1)
    return xr.Dataset(
        variables,
        {
            "reduction": (
                "reduction",
                list(sections),
                {"units": "1", "long_name": "form of the reduction"},
            ),
            "row": ("row", number, {"units": "1", "long_name": "mode number i"}),
            "column": ("column", number, {"units": "1", "long_name": "mode number j"}),
        },
        attrs={
            "dynamic_pressure": dynamic_pressure(density, speed),
            "warnings": "; ".join(warnings),
            **{f"{_NO_SECTION}{name}": not_reducible(of_pair, name) for name in sections},
        },
    )


def with_flutter(
    equivalent: xr.Dataset, found: Mapping[str, FlutterBias], density: float
) -> xr.Dataset:
    """Return ``structure/equivalent.nc`` with flutter by linear theory, of sections and beam.

    Parameters
    ----------
    equivalent
        The data set.
    found
        Flutter of each section and of the beam, by reduction, in its order.
    density
        Density of the fluid rho (kg/m^3).
    """
    each = list(found.values())
    beam = each[0]
    speed = "speed of flutter by linear theory"
    variables = {
        "flutter_speed": ("reduction", [one.section.speed for one in each], "m s-1", speed),
        "flutter_bias": (
            "reduction",
            [one.bias for one in each],
            "1",
            "speed of flutter of the section over that of the beam's first pair of modes, less 1",
        ),
        "pair_flutter_speed": ((), beam.pair.speed, "m s-1", f"{speed}, first pair of modes"),
        "beam_flutter_speed": ((), beam.beam.speed, "m s-1", f"{speed}, all modes of the beam"),
        "beam_flutter_k_star": (
            (),
            section_from_dataset(equivalent, "paper").k_star(density, beam.beam.speed),
            "1",
            "k* of flutter by linear theory, all modes of the beam",
        ),
        "section_bending_mode": (
            (),
            beam.bending_mode,
            "1",
            "number of the bending mode of the section, the one most like the first torsion mode",
        ),
        "section_likeness": ((), beam.likeness, "1", "cos phi of the section's pair of modes"),
        "section_damping_ratio": (
            (),
            beam.damping_ratio,
            "1",
            "larger damping ratio of the section's modes, dashpots projected",
        ),
        "critical_pair": (
            (),
            beam.critical_pair,
            "1",
            "number of the pair of modes that flutters first; 0 where none does",
        ),
    }
    return equivalent.assign(
        {
            name: (dims, values, {"units": units, "long_name": text, "missing_allowed": "1"})
            for name, (dims, values, units, text) in variables.items()
        }
    )


def _of_each(
    sections: Sequence[Section], name: str, units: str, text: str
) -> tuple[str, NDArray[np.float64], dict[str, str]]:
    """Return a number of each section as a variable."""
    values = np.array([getattr(section, name) for section in sections])
    return "reduction", values, {"units": units, "long_name": text}


def section_from_dataset(equivalent: xr.Dataset, reduction: str) -> Section:
    """Return one form of the section of ``structure/equivalent.nc``, in SI units."""
    chosen = equivalent.sel(reduction=reduction)
    return Section(**{member: float(chosen[member]) for member in QUANTITIES})


def section_in_flow(equivalent: xr.Dataset, reduction: str) -> Section:
    """Return one form of the section of ``structure/equivalent.nc``, in the flow of the run."""
    chosen = equivalent.sel(reduction=reduction)
    names = {
        member: quantity.flow_name or member
        for member, quantity in QUANTITIES.items()
        if member != "chord"
    }
    return Section(**{member: float(chosen[name]) for member, name in names.items()})


def no_section(equivalent: xr.Dataset, reduction: str) -> str:
    """Return why a reduction of ``structure/equivalent.nc`` has no section; empty where it has."""
    return str(equivalent.attrs.get(f"{_NO_SECTION}{reduction}", ""))


def nominal_k_star(equivalent: xr.Dataset) -> float:
    """Return k* of the beam as given: Eq. 17 in the paper's form, the axis of every comparison.

    Both reductions and the beam are at the same k* when they have the same Young's modulus.
    """
    return float(equivalent["k_star"].sel(reduction="paper"))


def oscillation_factors(equivalent: xr.Dataset) -> dict[str, float]:
    """Return the factor of an oscillating deflection by reduction."""
    factors = equivalent["oscillation_factor"]
    return {str(name): float(factors.sel(reduction=name)) for name in factors["reduction"].values}
