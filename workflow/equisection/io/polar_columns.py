"""Names of a polar's columns, as people and programs write them, and their units."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path

from equisection.errors import PolarFileError
from equisection.io.polar_text import quoted

#: Quantities of a point, in the order of every row here.
COLUMNS = ("incidence_deg", "cl", "cm", "cd")
#: Names of the quantities, in small letters without blanks and underscores.
_ALIASES = {
    **dict.fromkeys(
        ("incidencedeg", "incidence", "alpha", "alphadeg", "aoa", "aoadeg", "alfa", "α"),
        COLUMNS[0],
    ),
    "angleofattack": COLUMNS[0],
    "cl": "cl",
    "cm": "cm",
    "cd": "cd",
}
#: Names of an incidence in radians.
_RADIANS = {"incidencerad", "alpharad", "aoarad"}
#: Units of each quantity in which its values are read.
_DEGREES = {"deg", "°", "degree", "degrees"}
_NO_UNIT = {"", "-", "1", "/", "none"}
#: A unit in brackets at the end of a name.
_UNIT = re.compile(r"[\[(]\s*([^\])]*?)\s*[\])]$")


def quantities(names: Sequence[str], given: Mapping[str, str]) -> list[str]:
    """Return the quantity of each column, empty for a column that is not read.

    Parameters
    ----------
    names
        Names of the columns.
    given
        Names that the user gives, by quantity; the others go by their usual names.
    """
    return [_quantity(name.strip(), given) for name in names]


def _quantity(name: str, given: Mapping[str, str]) -> str:
    bare = _UNIT.sub("", name).strip()
    for quantity, own in given.items():
        if own in (name, bare):
            return quantity
    short = re.sub(r"[\s_]", "", bare.lower())
    found = COLUMNS[0] if short in _RADIANS else _ALIASES.get(short, "")
    return "" if found in given else found


def unit_of(name: str) -> str:
    """Return the unit that a name has in brackets, empty if it has none."""
    if re.sub(r"[\s_]", "", name.lower()) in _RADIANS:
        return "rad"
    found = _UNIT.search(name.strip())
    return found[1] if found else ""


def check_unit(path: Path, line: int, quantity: str, unit: str) -> None:
    """Refuse a unit in which a quantity's values are not read.

    Raises
    ------
    PolarFileError
        The unit is another one.
    """
    unit = unit.strip().strip("[]()").strip()
    allowed = _DEGREES | {""} if quantity == COLUMNS[0] else _NO_UNIT
    if unit.lower() not in allowed:
        wanted = "degrees (deg)" if quantity == COLUMNS[0] else "no unit (-)"
        raise PolarFileError(
            f"{path}, line {line}: the unit of {quantity} is {quoted(unit)}; wanted {wanted}: "
            "convert the values, and correct or delete the unit"
        )


def check_columns(
    path: Path, line: int, names: Sequence[str], found: Sequence[str], given: Mapping[str, str]
) -> None:
    """Refuse columns of which one quantity has none, or more than one.

    Raises
    ------
    PolarFileError
        With what is wanted.
    """
    shown = ", ".join(_shown(name) for name in names)
    twice = [name for name in COLUMNS if found.count(name) > 1]
    if twice:
        raise PolarFileError(
            f"{path}, line {line}: more than one column is {', '.join(twice)}; found {shown}; "
            "delete or rename those that are not to be read, or name the right one "
            "(embedded.columns)"
        )
    missing = [name for name in COLUMNS if name not in found]
    if missing:
        why = "; without its moment a section has no known twist" if missing == ["cm"] else ""
        own = [f"{name} ({quoted(given[name])})" if name in given else name for name in missing]
        raise PolarFileError(
            f"{path}, line {line}: no column {', '.join(own)}; found {shown}; wanted "
            f"{', '.join(COLUMNS)}: write these names (others are ignored), or say which column "
            f"is which: embedded.columns: {{{missing[-1]}: <name in the file>}} "
            f"(columns= in Python){why}"
        )


def _shown(name: str) -> str:
    text = quoted(name.strip())
    return text[1:-1] if re.fullmatch(r"[\w .()\[\]/-]+", name.strip()) else text
