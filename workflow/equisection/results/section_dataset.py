"""The equivalent section, in both forms, as a data set."""

from __future__ import annotations

import numpy as np
import xarray as xr

from equisection.conventions import dynamic_pressure
from equisection.reduction.integrals import Integrals
from equisection.reduction.reduce import EquivalentSection, Reduction

#: Members of :class:`EquivalentSection` with units and meaning.
_PROPERTIES = {
    "torsional_stiffness": ("N m rad-1 m-1", "torsional stiffness k_theta per unit span"),
    "flexural_stiffness": ("N m-2", "flexural stiffness k_w per unit span"),
    "inertia": ("kg m", "moment of inertia I_2D about mid-chord per unit span"),
    "mass": ("kg m-1", "mass m_2D per unit span"),
    "twist_recovery": ("1", "a: twist of the tip = twist of the section / a"),
    "deflection_recovery": ("1", "b: deflection of the tip = deflection of the section / b"),
}
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
    sections: list[EquivalentSection],
    integrals: Integrals,
    warnings: tuple[str, ...],
    *,
    density: float,
    speed: float,
    chord: float,
) -> xr.Dataset:
    """Return ``structure/equivalent.nc``; fluid density (kg/m3), speed (m/s), chord (m)."""
    variables: dict[str, object] = {
        name: (
            "reduction",
            np.array([getattr(section, name) for section in sections]),
            {"units": units, "long_name": text},
        )
        for name, (units, text) in _PROPERTIES.items()
    }
    non_dimensional = {
        "k_star": ([s.k_star(density, speed, chord) for s in sections], "k_theta/(q c^2)"),
        "k_w_star": ([s.k_w_star(density, speed) for s in sections], "k_w/q"),
        "i_star": ([s.i_star(density, chord) for s in sections], "I_2D/(rho c^4/2)"),
        "m_star": ([s.m_star(density, chord) for s in sections], "m_2D/(rho c^2/2)"),
        "inertia_ratio": ([s.inertia_ratio(chord) for s in sections], "c^2 m_2D/I_2D"),
        "stiffness_ratio": ([s.stiffness_ratio(chord) for s in sections], "c^2 k_w/k_theta"),
    }
    for name, (values, text) in non_dimensional.items():
        variables[name] = ("reduction", np.array(values), {"units": "1", "long_name": text})
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
    number = np.arange(1, integrals.f_mean.size + 1)
    return xr.Dataset(
        variables,
        {
            "reduction": (
                "reduction",
                [section.reduction for section in sections],
                {"units": "1", "long_name": "form of the reduction"},
            ),
            "row": ("row", number, {"units": "1", "long_name": "mode number i"}),
            "column": ("column", number, {"units": "1", "long_name": "mode number j"}),
        },
        attrs={
            "dynamic_pressure": dynamic_pressure(density, speed),
            "warnings": "; ".join(warnings),
        },
    )


def section_from_dataset(dataset: xr.Dataset, reduction: Reduction) -> EquivalentSection:
    """Return one form of the section of ``structure/equivalent.nc``."""
    chosen = dataset.sel(reduction=reduction)
    return EquivalentSection(
        reduction=reduction, **{name: float(chosen[name]) for name in _PROPERTIES}
    )
