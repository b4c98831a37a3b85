"""Values and text as a message shows them: a value in one line, short, in YAML's words."""

from __future__ import annotations

import math
import reprlib
from collections.abc import Mapping
from typing import Any

_LONGEST = 60
_MOST_BITS = 10_000
#: From here on a number is shorter with its exponent.
_LONG_NUMBER = 1e6


def rounded(number: float, digits: int) -> str:
    """Return a number of some digits for a sentence: 110 for 113 of two digits, not 1.1e+02."""
    text = f"{number:.{digits}g}"
    return f"{float(text):.0f}" if "e+" in text and abs(number) < _LONG_NUMBER else text


class _Shown(reprlib.Repr):
    def __init__(self) -> None:
        super().__init__()
        self.maxlist = self.maxtuple = 8
        self.maxdict = 4
        self.maxlevel = 3
        self.maxstring = self.maxother = _LONGEST

    def repr1(self, x: Any, level: int) -> str:
        if x is None:
            return "null"
        if isinstance(x, bool):
            return str(x).lower()
        if isinstance(x, int | float):
            return self._number(x, level)
        if isinstance(x, list | tuple):
            return self.repr_list(list(x), level)
        if isinstance(x, Mapping):
            return self._mapping(x, level)
        return super().repr1(x, level)

    def _number(self, x: float, level: int) -> str:
        if isinstance(x, float):
            return _float(x)
        if x.bit_length() > _MOST_BITS:  # Python writes no more digits
            return f"a number of {x.bit_length() * math.log10(2):.0f} digits"
        return super().repr1(x, level)

    def _mapping(self, x: Mapping[Any, Any], level: int) -> str:
        if level <= 0 and x:
            return "{...}"
        pairs = [
            f"{key if isinstance(key, str) else self.repr1(key, level - 1)}: "
            f"{self.repr1(value, level - 1)}"
            for key, value in list(x.items())[: self.maxdict]
        ]
        if len(x) > self.maxdict:
            pairs.append("...")
        return "{" + ", ".join(pairs) + "}"


def _float(value: float) -> str:
    if math.isnan(value):
        return ".nan"
    if math.isinf(value):
        return ".inf" if value > 0 else "-.inf"
    return f"{value:g}" if float(f"{value:g}") == value else repr(value)


def shown(value: object) -> str:
    """Return a value for a message, for instance ``null``, ``'abc'`` or ``[1, 2]``."""
    return " ".join(_Shown().repr1(value, 3).split())


def printable(text: str) -> str:
    """Return text without characters that would steer a terminal; line breaks stay."""
    return "".join(c if c.isprintable() or c in "\n\t" else " " for c in text)
