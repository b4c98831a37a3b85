"""Kinds of values that keys take, read the way a person writes them.

YAML 1.1 reads ``3.3e9`` as text, and everything given with ``--config`` on the command line
arrives as text too, so text that is a number is one; ``true`` is none.
"""

from __future__ import annotations

from typing import Annotated

from pydantic import BeforeValidator, Field

from equisection.keys.written_number import is_of_sensible_size, number_in

#: How YAML writes nothing; on the command line Snakemake leaves the word as it is.
NULL_WORDS = frozenset({"null", "Null", "NULL", "~"})
_TRUTHS = {"true": True, "yes": True, "on": True, "false": False, "no": False, "off": False}

#: Letters, digits, '_', '-' and single dots inside: safe in file names on any system.
NAME_PATTERN = r"^[A-Za-z0-9](\.?[A-Za-z0-9_-])*$"


def _number(value: object) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float, str)):
        raise ValueError("not a number")
    try:
        number = number_in(value) if isinstance(value, str) else float(value)
    except OverflowError:
        raise ValueError("too large for a number") from None
    if not is_of_sensible_size(number):
        raise ValueError("of a size that no quantity has")
    return number


def _whole(value: object) -> int:
    number = _number(value)
    if not number.is_integer():
        raise ValueError("not a whole number")
    return int(number)


def _truth(value: object) -> bool:
    if isinstance(value, bool):
        return value
    if isinstance(value, str) and value.lower() in _TRUTHS:
        return _TRUTHS[value.lower()]
    raise ValueError("neither true nor false")


def _null(value: object) -> object:
    return None if isinstance(value, str) and value in NULL_WORDS else value


#: To follow the bounds in an annotation, so that these stay in the JSON schema.
NUMBER = BeforeValidator(_number)
WHOLE = BeforeValidator(_whole)
#: A text that may be left empty: Snakemake's `--config key=""` hands over null.
EMPTY = BeforeValidator(lambda value: "" if value is None else value)
#: For keys that may be null.
NULLABLE = BeforeValidator(_null)

Number = Annotated[float, Field(allow_inf_nan=False), NUMBER]
Positive = Annotated[float, Field(gt=0, allow_inf_nan=False), NUMBER]
NotNegative = Annotated[float, Field(ge=0, allow_inf_nan=False), NUMBER]
Angle = Annotated[float, Field(gt=-90, lt=90, allow_inf_nan=False), NUMBER]
Truth = Annotated[bool, BeforeValidator(_truth)]
Name = Annotated[str, Field(pattern=NAME_PATTERN, max_length=64)]
