"""Numbers as a person writes them: plain decimals, of a size that physics has."""

from __future__ import annotations

import math
import re

#: Sizes of numbers that are not zero. A bridge's bending rigidity is 1e15 N m2, the viscosity of
#: a gas 1e-5 Pa s; the sixth power of either bound is a double.
SMALLEST, LARGEST = 1e-18, 1e18
#: Most characters of a number; a double has 24.
_LONGEST = 40
_DECIMAL = re.compile(r"[-+]?(?:(?:0|[1-9][0-9]*)(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
_NOT_FINITE = re.compile(r"[-+]?\.?(?:inf|infinity|nan)", re.IGNORECASE)


def is_plain_number(text: str) -> bool:
    """Tell whether a text is a decimal number, infinity or NaN.

    No other base (``010``, ``0x5``), no underscore, no sexagesimal ``1:30``, and no digits but
    those of ASCII.
    """
    if len(text) > _LONGEST:
        return False
    return bool(_DECIMAL.fullmatch(text) or _NOT_FINITE.fullmatch(text))


def number_in(text: str) -> float:
    """Return the number that a text is; blanks around it do not count.

    Raises
    ------
    ValueError
        It is no plain number (:func:`is_plain_number`).
    """
    stripped = text.strip(" \t\r\n")
    if not is_plain_number(stripped):
        raise ValueError("not a plain decimal number")
    return float(stripped.replace(".inf", "inf").replace(".nan", "nan"))


def is_of_sensible_size(number: float) -> bool:
    """Tell whether a number is zero, or its size is within bounds in which nothing overflows."""
    if isinstance(number, float) and not math.isfinite(number):
        return True
    return number == 0 or SMALLEST <= abs(number) <= LARGEST
