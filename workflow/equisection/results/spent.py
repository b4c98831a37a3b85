"""Time that a case took, over all starts of its run."""

from __future__ import annotations

import os
from dataclasses import dataclass


@dataclass(frozen=True)
class Spent:
    """Time that a case took (s): of all its processors together, and by the clock."""

    cpu_seconds: float
    wall_seconds: float


def cpu_seconds_so_far() -> float:
    """Return the time (s) of this process and of the programs that it ran, on all processors."""
    used = os.times()
    return used.user + used.system + used.children_user + used.children_system
