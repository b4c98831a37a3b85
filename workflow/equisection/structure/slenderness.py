"""Slenderness up to which solid elements resolve a plate in double precision.

The lowest eigenvalue of the solid goes with E h^2/(rho_s L^4), the highest with E n^2/(rho_s h^2),
n elements through the thickness h. Rounding is a part of the highest, so that it is eps (L/h)^4 n^2
of the lowest, times a number of order one.
"""

from __future__ import annotations

import sys

#: Rounding, as a part of the lowest eigenvalue, beyond which modes are refused: the frequency of
#: the first bending mode is then off by up to five times as much.
MOST_ROUNDING = 1e-4


def most_slender(through: int) -> float:
    """Return the largest L/h (-) of a plate on so many elements through its thickness."""
    return float((MOST_ROUNDING / (sys.float_info.epsilon * through**2)) ** 0.25)
