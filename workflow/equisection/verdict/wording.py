"""Numbers as the reasons of a verdict word them."""

from __future__ import annotations

import math

from equisection.verdict.observation import Observation


def change(seen: Observation) -> str:
    """Change of the amplitude over the window as text."""
    change = math.expm1(min(seen.trend.growth_rate * 0.5 * seen.used * seen.period, 100.0))
    return f"{100.0 * change:+.2g} % over the last {seen.used / 2:g} periods"


def degrees(angle: float) -> str:
    """Angle (rad) as text in degrees."""
    return f"{math.degrees(angle):.3g} deg"
