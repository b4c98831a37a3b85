"""Flutter derivatives as comma-separated files, read and written.

The convention is in the comments above the header, one a line, and has no default: tables of
flutter derivatives look alike whatever they mean.

    # convention: Scanlan
    # force: rho V^2 B/2        or: rho V^2 B
    # heave: down               or: up
    # axis: 0.5
    reduced_velocity,H1,H2,H3,H4,A1,A2,A3,A4

*Scanlan* is that of Simiu and Scanlan (*Wind Effects on Structures*, 3rd ed., 1996, chapter 6),
with B the whole chord, K = omega B/V, h heave and lift L positive down, alpha and M nose up:

    L = (1/2) rho V^2 B   (K H1 h'/V + K H2 B alpha'/V + K^2 H3 alpha + K^2 H4 h/B)
    M = (1/2) rho V^2 B^2 (K A1 h'/V + K A2 B alpha'/V + K^2 A3 alpha + K^2 A4 h/B)

``force`` is what stands before the brackets: older tables have rho V^2 B, which makes derivatives
half as large. ``heave`` is the positive direction of both h and L. ``axis`` is the point (x/c from
the leading edge) whose heave h is, and that moments are about. The first column is the reduced
velocity V/(f B), or K, or k = K/2. ``incidence_deg``, the mean incidence (deg), and ``source`` may
be given. A column such as ``H1_spread`` holds the standard deviation of its derivative.
"""

from __future__ import annotations

import csv
import io
import itertools
import math
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from equisection.errors import DerivativesFileError
from equisection.io.plain_text import plain_text
from equisection.io.polar_text import decimal, quoted, shortened

#: Names of the derivatives, in the order of every table here.
DERIVATIVES = ("H1", "H2", "H3", "H4", "A1", "A2", "A3", "A4")
#: Reduced velocities V/(f B) that make sense, and the largest derivative: quasi-steady ones grow
#: with the square of the reduced velocity, H3 to 2 pi (V/(2 pi f B))^2 of a thin airfoil.
LEAST_VELOCITY, LARGEST_VELOCITY, LARGEST = 1e-2, 1e4, 1e8
#: Rows that a table needs, and bytes that its file has at most.
FEWEST_ROWS, MOST_BYTES = 4, 10_000_000
#: Reduced velocity V/(f B) from the value of a first column, by its name.
_FROM_COLUMN: dict[str, Callable[[float], float]] = {
    "reduced_velocity": lambda value: value,
    "K": lambda value: math.tau / value,
    "k": lambda value: math.pi / value,
}
#: Factor on derivatives by what stands before the brackets.
_FORCES = {"rhoV^2B/2": 1.0, "1/2rhoV^2B": 1.0, "rhoV^2B": 2.0}
#: Factor on the derivatives that join a vertical and an angular quantity (H2, H3, A1, A4).
_HEAVES = {"down": 1.0, "up": -1.0}
_MIXED = (1.0, -1.0, -1.0, 1.0, -1.0, 1.0, 1.0, -1.0)
_SPREAD = "_spread"
_EXAMPLE = "# convention: Scanlan, # force: rho V^2 B/2, # heave: down, # axis: 0.5"
_ZASSO = (
    "are those of Zasso (J. Wind Eng. Ind. Aerodyn. 60, 1996), with other factors, signs and "
    "reduced velocities; write the table in Scanlan's form, H1 to A4 of K^2"
)


@dataclass(frozen=True)
class DerivativeRows:
    """Table of derivatives in Scanlan's convention with (1/2) rho V^2 B, heave down.

    Attributes
    ----------
    reduced_velocity
        V/(f B), ascending, length n.
    values
        H1 to A4, n rows of 8.
    spread
        Their standard deviations, n rows of 8; empty where the file has none.
    axis
        Point whose heave it is and that moments are about (x/c from the leading edge).
    incidence_deg
        Mean incidence (deg); NaN where the file does not say.
    source
        Where they come from; empty where the file does not say.
    """

    reduced_velocity: tuple[float, ...]
    values: tuple[tuple[float, ...], ...]
    spread: tuple[tuple[float, ...], ...]
    axis: float
    incidence_deg: float
    source: str = ""


def read_derivative_rows(path: Path) -> DerivativeRows:
    """Read a table of flutter derivatives.

    Raises
    ------
    DerivativesFileError
        The file cannot be used; the message names file, line and what is wanted.
    """
    try:
        text = plain_text(path, "derivatives", MOST_BYTES, DerivativesFileError)
    except FileNotFoundError:
        raise DerivativesFileError(
            f"{path}: no such file (looked from {Path.cwd()}); wanted a CSV file of flutter "
            "derivatives"
        ) from None
    lines = text.split("\n")
    used = [
        (number, line.strip())
        for number, line in enumerate(lines, start=1)
        if line.strip() and not line.strip().startswith("#")
    ]
    if not used:
        raise DerivativesFileError(
            f"{path}: no table; wanted a header reduced_velocity,{','.join(DERIVATIVES)} and "
            f"{FEWEST_ROWS} or more rows"
        )
    (line, header), *rows = used
    names = [name.strip().rstrip("*") for name in header.split(",")]
    _check_columns(path, line, names)
    said = _said(lines)
    factor, sign, axis, incidence = _convention(path, said)
    signs = [factor * (sign if mixed < 0.0 else 1.0) for mixed in _MIXED]
    table = sorted((_numbers(path, number, text, names) for number, text in rows), key=_velocity)
    if len(table) < FEWEST_ROWS:
        raise DerivativesFileError(
            f"{path}: {len(table)} rows; wanted {FEWEST_ROWS} or more, between which the "
            "derivatives are interpolated"
        )
    velocities = tuple(map(_velocity, table))
    for low, high in itertools.pairwise(velocities):
        if not high > low * (1.0 + 1e-9):
            raise DerivativesFileError(
                f"{path}: two rows at the reduced velocity {high:.6g}; wanted each once (average "
                "repeated measurements, and give their scatter as H1_spread, ...)"
            )
    has_spread = f"{DERIVATIVES[0]}{_SPREAD}" in names

    def of(suffix: str) -> tuple[tuple[float, ...], ...]:
        return tuple(
            tuple(s * row[f"{name}{suffix}"] for name, s in zip(DERIVATIVES, signs, strict=True))
            for row in table
        )

    spread = tuple(tuple(map(abs, row)) for row in of(_SPREAD)) if has_spread else ()
    return DerivativeRows(velocities, of(""), spread, axis, incidence, said.get("source", ""))


def _check_columns(path: Path, line: int, names: list[str]) -> None:
    """Refuse a header without the eight derivatives, or in another notation."""
    lower = [name.lower() for name in DERIVATIVES]
    if any(name in names for name in lower) and not any(name in names for name in DERIVATIVES):
        raise DerivativesFileError(
            f"{path}, line {line}: columns h1 to a4 in small letters {_ZASSO}"
        )
    twice = sorted(name for name, count in Counter(names).items() if count > 1)
    if twice:
        raise DerivativesFileError(
            f"{path}, line {line}: more than one column is {shortened(twice)}; wanted each once"
        )
    if names[0] not in _FROM_COLUMN:
        raise DerivativesFileError(
            f"{path}, line {line}: the first column is {quoted(names[0])}; wanted "
            "reduced_velocity, which is V/(f B) with f in Hz and B the whole chord, or K (omega "
            "B/V), or k (omega B/(2 V))"
        )
    missing = [name for name in DERIVATIVES if name not in names]
    if missing:
        raise DerivativesFileError(
            f"{path}, line {line}: no column {', '.join(missing)}; found {shortened(names)}; "
            f"wanted {', '.join(DERIVATIVES)}, separated by commas (a column of zeros leaves a "
            "derivative out)"
        )
    spread = [name for name in DERIVATIVES if f"{name}{_SPREAD}" in names]
    if spread and len(spread) < len(DERIVATIVES):
        without = ", ".join(f"{name}{_SPREAD}" for name in DERIVATIVES if name not in spread)
        raise DerivativesFileError(
            f"{path}, line {line}: no column {without}; wanted the spread of all derivatives or "
            "of none"
        )


def _said(lines: Iterable[str]) -> dict[str, str]:
    """Return what the comments say, by key."""
    said = {}
    for line in lines:
        key, colon, value = line.strip().removeprefix("#").partition(":")
        if line.strip().startswith("#") and colon:
            said[key.strip().lower()] = value.strip()
    return said


def _convention(path: Path, said: dict[str, str]) -> tuple[float, float, float, float]:
    """Return the factor of the force, the sign of heave, the axis and the mean incidence (deg)."""
    missing = [key for key in ("convention", "force", "heave", "axis") if key not in said]
    if missing:
        raise DerivativesFileError(
            f"{path}: no comment says {', '.join(missing)}; wanted above the header, one a line: "
            f"{_EXAMPLE}"
        )
    if said["convention"].lower() != "scanlan":
        advice = f"; Zasso's {_ZASSO}" if "zasso" in said["convention"].lower() else ""
        raise DerivativesFileError(
            f"{path}: convention is {quoted(said['convention'])}; allowed is Scanlan{advice}"
        )
    force = (
        said["force"].replace(" ", "").replace("*", "").replace("U", "V").replace("(1/2)", "1/2")
    )
    if force not in _FORCES:
        raise DerivativesFileError(
            f"{path}: force is {quoted(said['force'])}; allowed is rho V^2 B/2 or rho V^2 B, what "
            "stands before the bracket of L"
        )
    if said["heave"].lower() not in _HEAVES:
        raise DerivativesFileError(
            f"{path}: heave is {quoted(said['heave'])}; allowed is down or up, the positive "
            "direction of heave and lift"
        )
    axis = _said_number(path, said, "axis")
    if not 0.0 <= axis <= 1.0:
        raise DerivativesFileError(
            f"{path}: axis is {quoted(said['axis'])}; allowed is x/c from the leading edge, 0 to 1 "
            "(0.5 for mid-chord)"
        )
    incidence = _said_number(path, said, "incidence_deg") if "incidence_deg" in said else math.nan
    return _FORCES[force], _HEAVES[said["heave"].lower()], axis, incidence


def _said_number(path: Path, said: dict[str, str], key: str) -> float:
    try:
        return decimal(said[key])
    except ValueError as error:
        raise DerivativesFileError(
            f"{path}: {key} is {quoted(said[key])}; wanted a number"
        ) from error


def _velocity(row: dict[str, float]) -> float:
    return row["reduced_velocity"]


def _numbers(path: Path, line: int, text: str, names: list[str]) -> dict[str, float]:
    """Return the values of a row by the names of their columns, with the reduced velocity."""
    fields = [field.strip() for field in text.split(",")]
    if len(fields) != len(names):
        raise DerivativesFileError(
            f"{path}, line {line}: {len(fields)} values under {len(names)} column names; wanted "
            "one for each"
        )
    row = {}
    wanted = {names[0], *DERIVATIVES, *(f"{name}{_SPREAD}" for name in DERIVATIVES)}
    for name, field in zip(names, fields, strict=True):
        if name in wanted:
            try:
                row[name] = decimal(field)
            except ValueError:
                row[name] = math.nan
            if not math.isfinite(row[name]):
                raise DerivativesFileError(
                    f"{path}, line {line}: {name} is {quoted(field)}; wanted a finite number (a "
                    "row that was not measured is left out as a whole)"
                )
    first = row[names[0]]
    if not first > 0.0:
        raise DerivativesFileError(
            f"{path}, line {line}: {names[0]} is {first:g}; wanted a number above 0"
        )
    velocity = _FROM_COLUMN[names[0]](first)
    if not LEAST_VELOCITY <= velocity <= LARGEST_VELOCITY:
        raise DerivativesFileError(
            f"{path}, line {line}: {names[0]} is {first:g}; wanted a reduced velocity V/(f B) from "
            f"{LEAST_VELOCITY:g} to {LARGEST_VELOCITY:g}"
        )
    for name, value in row.items():
        if abs(value) > LARGEST:
            raise DerivativesFileError(
                f"{path}, line {line}: {name} is {value:g}; wanted a number from {-LARGEST:g} to "
                f"{LARGEST:g}"
            )
    return {**row, "reduced_velocity": velocity}


def derivative_text(rows: DerivativeRows, comments: Sequence[str] = ()) -> str:
    """Return a table as the text of a file, with its convention.

    Parameters
    ----------
    rows
        The table.
    comments
        Further lines for the top of the file.
    """
    text = io.StringIO()
    said = ["convention: Scanlan", "force: rho V^2 B/2", "heave: down", f"axis: {rows.axis:g}"]
    if rows.source:
        said.append(f"source: {rows.source}")
    if math.isfinite(rows.incidence_deg):
        said.append(f"incidence_deg: {rows.incidence_deg:g}")
    text.writelines(f"# {line}\n" for line in (*comments, *said))
    table = csv.writer(text, lineterminator="\n")
    names = [f"{name}{_SPREAD}" for name in DERIVATIVES] if rows.spread else []
    table.writerow(("reduced_velocity", *DERIVATIVES, *names))
    for place, (velocity, values) in enumerate(
        zip(rows.reduced_velocity, rows.values, strict=True)
    ):
        spread = rows.spread[place] if rows.spread else ()
        table.writerow(f"{value:.8g}" for value in (velocity, *values, *spread))
    return text.getvalue()
