"""Checks of numbers that a caller of the package's functions gives."""

from __future__ import annotations

import math
from typing import SupportsFloat

from equisection.errors import ArgumentError
from equisection.keys.written_number import LARGEST, SMALLEST


def is_finite_number(value: object) -> bool:
    """Tell whether a value is one finite number; an array of no dimension is one too."""
    if isinstance(value, str | bytes | bool) or not isinstance(value, SupportsFloat):
        return False
    try:
        return math.isfinite(value)
    except (TypeError, ValueError, OverflowError):
        return False


def require_positive(name: str, value: float, units: str) -> None:
    """Refuse what is not one number above 0 of a size that a quantity has.

    Raises
    ------
    ArgumentError
        With the argument's name, its value and its units.
    """
    if not (is_finite_number(value) and SMALLEST <= value <= LARGEST):
        raise ArgumentError(
            f"{name} is {value!r}; wanted a number above 0 ({units}), from {SMALLEST:g} to "
            f"{LARGEST:g}"
        )
