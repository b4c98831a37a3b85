"""Write the page of validation, or check that it is up to date.

python -m equisection.validation           writes docs/validation.md
python -m equisection.validation --check   tells whether it is up to date
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path

from equisection.clone import CLONE
from equisection.generated import write_or_check
from equisection.validation.attached_values import attached_values
from equisection.validation.flutter_values import flutter_values
from equisection.validation.known_values import (
    DIGITS,
    ORIGINS,
    OWN_CODE,
    OWN_JONES,
    KnownValue,
)
from equisection.validation.outline_values import outline_values
from equisection.validation.pazy_values import pazy_values
from equisection.validation.structure_values import structure_values
from equisection.validation.wing_values import wing_values

COMMAND = "python -m equisection.validation"
PAGE = Path("docs/validation.md")

_INTRODUCTION = f"""# Validation

Numbers known from elsewhere, and what this package computes.

```
make validation        # {COMMAND}, about twenty seconds; writes this page
```

`tests/physics/test_validation.py` asserts each number within its
tolerance: the digits of the known value, unless the table names another.

| origin | is |
|---|---|
"""

#: Problems that have no row, and the reason.
_WITHOUT = (
    (
        "square prism, amplitude of galloping (Parkinson and Smith, 1964)",
        "coefficients beyond A_1 were not at hand",
    ),
    (
        "square cylinder at Re 100, rms of the lift (Sohankar and others, 1998)",
        "0.177 on one mesh here, 0.139 to 0.156 in the source: not known why",
    ),
    (
        "rectangle of 5:1 (BARC; Bruno, Salvetti and Ricciardelli, 2014)",
        "not run; drags by unsteady RANS spread from 0.965 to 1.295",
    ),
    (
        "Pazy wing, flutter at an incidence",
        "it bends by a tenth of its span and more; linear here",
    ),
    (
        "NACA 0012 of SU2's tutorial by CFD",
        "compressible there",
    ),
    (
        "embedded plate with separation",
        "nothing published; independent assembly in `tests/physics/test_stability.py`",
    ),
)


def known_values() -> list[KnownValue]:
    """Every known value, in the order of the page."""
    return [
        *flutter_values(),
        *attached_values(),
        *structure_values(),
        *pazy_values(),
        *wing_values(),
        *outline_values(),
    ]


def page(values: Sequence[KnownValue]) -> str:
    """Return the page of validation as Markdown."""
    cases = list(dict.fromkeys(value.case for value in values))
    text = _INTRODUCTION
    text += "".join(f"| {origin} | {words} |\n" for origin, words in ORIGINS.items())
    for case in cases:
        text += f"\n## {case}\n\n" + _table([value for value in values if value.case == case])
    text += "\n## Without a row\n\n| case | reason |\n|---|---|\n"
    return text + "".join(f"| {case} | {reason} |\n" for case, reason in _WITHOUT)


def _table(values: Sequence[KnownValue]) -> str:
    origins = dict.fromkeys(value.source.origin for value in values)
    several = len(origins) > 1
    lines = [["quantity", "known", "here", "difference, %", "origin"][: 4 + several]]
    lines.append(["---"] * len(lines[0]))
    for value in values:
        known = f"{value.known:.9g} {_unit(value)}".rstrip()
        line = [value.quantity, known, f"{value.computed:.6g}", _percent(value.difference)]
        lines.append(line + [value.source.origin] * several)
    table = "".join(f"| {' | '.join(line)} |\n" for line in lines)
    return f"{table}\n{notes}" if (notes := _notes(values, alone=not several)) else table


def _notes(values: Sequence[KnownValue], *, alone: bool) -> str:
    """Return sources and reasons; an origin that is alone is named without a source, too."""
    sources = dict.fromkeys((value.source.origin, value.source.words) for value in values)
    named = [
        f"- {origin}: {words}.\n" for origin, words in sources if words not in (OWN_CODE, OWN_JONES)
    ]
    if alone and not named:
        named = [f"- {values[0].source.origin}.\n"]
    reasons = dict.fromkeys(value.reason for value in values)
    if list(reasons) != [DIGITS]:
        named.append(f"- tolerance: {'; '.join(reasons)}.\n")
    return "".join(named)


def _unit(value: KnownValue) -> str:
    return "" if value.unit == "-" else value.unit


def _percent(difference: float) -> str:
    """Return a relative difference in per cent, to a thousandth of one per cent."""
    rounded = round(100.0 * difference, 3)
    return f"{rounded + 0.0:+.3f}" if rounded else "0.000"


def main(arguments: Sequence[str] | None = None, root: Path = CLONE) -> int:
    """Write or check the page; return the exit status."""
    about = "Known values, computed here."
    return write_or_check({PAGE: page(known_values())}, root, COMMAND, about, arguments)


if __name__ == "__main__":
    sys.exit(main())
