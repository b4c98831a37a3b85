"""Known spread of what a solver takes as given: lags and coefficients of a polar."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class KnownSpread:
    """Half-range of a parameter.

    Attributes
    ----------
    half_range
        Part of the value (-).
    source
        Where it comes from.
    """

    half_range: float
    source: str
