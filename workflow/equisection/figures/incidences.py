"""Choice of the incidences that a figure shows."""

from __future__ import annotations

from collections.abc import Sequence


def nearest_incidences(available_deg: Sequence[float], wanted_deg: Sequence[float]) -> list[float]:
    """Return the incidences (deg) nearest to those wanted, each once, ascending.

    Of two that are equally near the larger one is taken, since at zero there is nothing to see.
    """
    if not available_deg:
        return []
    nearest = (min(available_deg, key=lambda a: (abs(a - w), -a)) for w in wanted_deg)
    return sorted(set(nearest))
