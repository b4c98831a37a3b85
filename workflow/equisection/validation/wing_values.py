"""Known lift of finite wings."""

from __future__ import annotations

import math
from functools import partial

from equisection.aerodynamics.lifting_line import LiftingLine
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.vortex_rings import SpanGeometry
from equisection.validation.known_values import KnownValue, Source

_LATTICE = Source(
    "independent",
    "vortex lattice of a flat rectangular wing, extrapolated from 4 by 12 and 8 by 24 rings a half "
    "(that of `tests/physics/test_unsteady_induction.py`)",
)


def lift_slope(aspect_ratio: float) -> float:
    """dC_L/dalpha (1/rad) of a rectangular thin wing in free air by Weissinger's line."""
    strips = cosine_strips(60, root_on_wall=False)
    span = SpanGeometry.of(strips, 1.0, aspect_ratio, root_on_wall=False)
    wing = LiftingLine.of(Polar.flat_plate(0.5), strips, span)
    return wing.solve(math.radians(1.0)).lift / math.radians(1.0)


def wing_values() -> list[KnownValue]:
    """Known lift slopes of rectangular wings."""
    return [
        KnownValue(
            "Rectangular wing in free air",
            f"lift slope, aspect ratio {aspect:g}",
            "1/rad",
            value,
            _LATTICE,
            partial(lift_slope, aspect),
            0.02,
            "one bound vortex along the chord in the place of a lattice of them",
        )
        for aspect, value in ((4.0, 3.614), (6.0, 4.216), (7.4, 4.492), (8.0, 4.587))
    ]
