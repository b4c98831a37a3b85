"""What a case took, over all starts of its run."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Spent:
    """Time that a case took (s): of all its processors together, and by the clock."""

    cpu_seconds: float
    wall_seconds: float
