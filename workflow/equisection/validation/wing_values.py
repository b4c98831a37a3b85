"""Known lift and flutter of finite wings in free air."""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache, partial

import xarray as xr

from equisection.aerodynamics.lifting_line import LiftingLine
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.vortex_rings import SpanGeometry
from equisection.solvers.embedded.map_of_any_body import stability_map
from equisection.validation.flutter_values import goland
from equisection.validation.known_values import KnownValue, Source
from equisection.validation.pazy_values import PAZY_WITH_SKIN

_LATTICE = Source(
    "independent",
    "vortex lattice, extrapolated from 4 by 12 and 8 by 24 rings a half "
    "(`tests/physics/test_unsteady_induction.py`)",
)
_UNSTEADY_LATTICE = Source(
    "published",
    "SHARPy's test (ImperialCollegeLondon/sharpy): linear vortex lattice of 16 by 32 "
    "panels, density 1.02 kg/m3, to 1 %",
)
_DOUBLETS = Source(
    "published",
    "Riso and Cesnik (UM-A2SRL/AePW3-LDWG), 2023: built-up model, without tip mass, doublet "
    "lattice of 36 by 18 panels (MSC Nastran)",
)
_ONE_VORTEX = "one bound vortex along the chord, not a lattice"


def lift_slope(aspect_ratio: float) -> float:
    """dC_L/dalpha (1/rad) of a rectangular thin wing in free air by Weissinger's line."""
    strips = cosine_strips(60, root_on_wall=False)
    span = SpanGeometry.of(strips, 1.0, aspect_ratio, root_on_wall=False)
    wing = LiftingLine.of(Polar.flat_plate(0.5), strips, span)
    return wing.solve(math.radians(1.0)).lift / math.radians(1.0)


@cache
def _goland_onset() -> xr.Dataset:
    """Motion of Goland's wing at its onset on the embedded solver, with the wake of its span."""
    return stability_map(
        goland(),
        Polar.flat_plate(10.0),
        incidence_deg=0.0,
        speed=(140.0, 190.0),
        density=1.02,
        lags=SeparationLags.none(),
        method="beam",
        modes=(2, 2),
        strips=12,
    )


@cache
def _pazy_onset() -> xr.Dataset:
    """Motion of the Pazy wing with skin at its onset, the same way."""
    return stability_map(
        PAZY_WITH_SKIN.beam,
        Polar.flat_plate(10.0),
        incidence_deg=0.0,
        speed=(50.0, 80.0),
        density=1.225,
        lags=SeparationLags.none(),
        method="beam",
        modes=(3, 2),
        strips=12,
    )


def _of_onset(onset: Callable[[], xr.Dataset], name: str) -> float:
    return float(onset()[name])


def _flutter() -> list[KnownValue]:
    # Zero of the damping between the published speeds of 67 and 68 m/s, by a straight line.
    part = 0.12292427 / (0.12292427 + 0.28564397)
    goland_name, pazy_name = (
        f"{name}, finite span, embedded solver" for name in ("Goland's wing", "Pazy wing with skin")
    )
    values = (
        (goland_name, "m/s", 166.0, _UNSTEADY_LATTICE, _goland_onset, 0.05),
        (pazy_name, "m/s", 67.0 + part, _DOUBLETS, _pazy_onset, 0.04),
        (pazy_name, "Hz", 34.7780098 - part * 0.1846405, _DOUBLETS, _pazy_onset, 0.02),
    )
    names = {"m/s": "critical_speed", "Hz": "critical_frequency"}
    return [
        KnownValue(
            case,
            "flutter",
            unit,
            known,
            source,
            partial(_of_onset, onset, names[unit]),
            tolerance,
            _ONE_VORTEX,
        )
        for case, unit, known, source, onset, tolerance in values
    ]


def wing_values() -> list[KnownValue]:
    """Known lift slopes and flutter of rectangular wings."""
    slopes = [
        KnownValue(
            "Rectangular wing in free air",
            f"lift slope, aspect ratio {aspect:g}",
            "1/rad",
            value,
            _LATTICE,
            partial(lift_slope, aspect),
            0.02,
            _ONE_VORTEX,
        )
        for aspect, value in ((4.0, 3.614), (6.0, 4.216), (7.4, 4.492), (8.0, 4.587))
    ]
    return [*slopes, *_flutter()]
