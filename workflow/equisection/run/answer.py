"""The answer of a run in a few lines: the critical speed, by what, and how sure that is.

It is read from ``comparison/critical_speed.csv``, and runs without a verdict from
``comparison/onset.csv``, so it takes no solver and says nothing that the tables do not say.
"""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from equisection.errors import EquisectionError, ResultFileError
from equisection.keys.shown import rounded, shown
from equisection.keys.written_number import LARGEST, is_plain_number, number_in

#: The table with the answer, as seen from the folder of a run.
CRITICAL_SPEEDS = Path("comparison") / "critical_speed.csv"
#: The table with the brackets of the onsets.
_BRACKETS = Path("comparison") / "onset.csv"
#: Columns of runs inside a bracket that have no verdict, and what they are.
_WITHOUT_VERDICT = {"failed_inside": "failed", "undecided_inside": "undecided"}
#: What speeds rest on that are runs, each with a verdict.
_RUNS = ("cfd", "time", "experiment")
#: Columns without which a table is none of critical speeds.
_NEEDED = ("model", "incidence_deg", "speed", "speed_low", "speed_high", "mechanism", "basis")
#: Columns of numbers, with the least and the largest that each may have; infinity is no bound.
_BOUNDS = {
    "incidence_deg": (-180.0, 180.0),
    **dict.fromkeys(("speed_low", "frequency_hz", "margin", "growth_error_rms"), (0.0, LARGEST)),
    **dict.fromkeys(("speed", "speed_high", "k_star"), (0.0, math.inf)),
    "growth_error": (-LARGEST, LARGEST),
}
#: Columns of text.
_TEXTS = ("model", "mechanism", "basis", "errs")
#: What speeds rest on, in words, the nearest to the beam in its flow first.
_BASES = {
    "experiment": "histories of an experiment",
    "cfd": "CFD runs",
    "time": "runs in time",
    "given": "recorded histories",
    "model": "a model learnt from a release",
    "eigenvalue": "eigenvalues of small motions",
    "derivatives": "flutter derivatives",
}
#: What speeds rest on that is no run with a verdict.
_WITHOUT_RUNS = ("model", "eigenvalue", "derivatives")
_PLACE = ("model", "incidence_deg")
_MECHANISMS = (*("none", "divergence", "flutter", "stall-flutter", "galloping", "unknown"),)
_SIDES = {
    "unsafe": ", so that the speed is too high",
    "safe": ", so that the speed is too low",
    "either": ", to either side",
}


class AnswerError(EquisectionError):
    """A run has no answer that can be read."""


@dataclass(frozen=True)
class Answer:
    """Critical speeds of a run, and the one that answers for the beam.

    Attributes
    ----------
    run
        Folder of the run.
    rows
        Lines of the table: names of columns and values (speeds in m/s, frequencies in Hz), None
        where a value is not there.
    chosen
        The line that answers: of the model nearest to the beam of which something is known (the
        beam itself, then the corrected section), at the incidence with the lowest speed. At each
        incidence the strongest basis answers; where it knows no stable speed, the next one that
        has an onset below its unstable speed.
    inside
        Numbers of runs inside its bracket that have no verdict, by what they are.
    """

    run: Path
    rows: tuple[Mapping[str, Any], ...]
    chosen: Mapping[str, Any]
    inside: Mapping[str, int] = field(default_factory=dict)

    def lines(self) -> Iterator[str]:
        """Yield the answer, a line each: speed, mechanism, margin, how sure, other models."""
        return (f"{name:<15} {words}" for name, words in self.parts())

    def parts(self) -> Iterator[tuple[str, str]]:
        """Yield the name and the words of each line."""
        is_open = self.chosen["speed"] is None and self.chosen["speed_low"] is None
        lower = is_open and self.chosen["speed_high"] is not None
        hint = "; run lower speeds to find it" if lower else ""
        yield "critical speed", f"{_speed(self.chosen)}{self._incidence()}{hint}"
        yield "mechanism", _mechanism(self.chosen)
        yield "margin", self._margin()
        yield "how sure", _sure(self.chosen) + self._without_verdict()
        others = [row for row in self.rows if self._is_another_there(row)]
        if others:
            words = (f"{row['model']} {_speed(row)} ({row['basis']})" for row in others)
            yield "others", "; ".join(words)

    def as_json(self) -> str:
        """Return run, the line that answers, and all lines of the table as JSON."""
        content = {"run": self.run.resolve().name, "answer": self.chosen, "all": self.rows}
        return json.dumps(content, indent=2, allow_nan=False)

    def _incidence(self) -> str:
        answers = _answers(self.rows, self.chosen["model"])
        at = f", at {self.chosen['incidence_deg']:g} deg"
        if len(answers) == 1:
            return at
        angles = [row["incidence_deg"] for row in answers]
        unknown = sum(not _is_known(row) for row in answers)
        return (
            f"{at}, the lowest of {len(answers)} incidences from {min(angles):g} to "
            f"{max(angles):g} deg" + (f"; at {unknown} of them nothing is known" if unknown else "")
        )

    def _without_verdict(self) -> str:
        if not self.inside:
            return ""
        found = " and ".join(f"{number} {what}" for what, number in self.inside.items())
        several = sum(self.inside.values()) > 1
        return (
            f"; of the runs between these speeds {found}, which leaves them wide apart: "
            f"'equisection status {self.run}' says why of {'each' if several else 'it'}"
        )

    def _is_another_there(self, row: Mapping[str, Any]) -> bool:
        return row["incidence_deg"] == self.chosen["incidence_deg"] and (
            row["model"],
            row["basis"],
        ) != (self.chosen["model"], self.chosen["basis"])

    def _margin(self) -> str:
        margin = self.chosen.get("margin")
        if margin is not None:
            side = "" if margin >= 1.0 else ": NOT REACHED by the stable speeds"
            return f"{rounded(margin, 3)} times the design speed{side}"
        if self.chosen["speed_low"] is None:
            return "unknown: no speed is known to be stable"
        return "not asked for: flow.design_speed (m/s) is not given"


def answer_of(run: Path) -> Answer:
    """Read the answer of a run.

    Parameters
    ----------
    run
        Folder of the run.

    Raises
    ------
    AnswerError
        There is no such folder, no table of critical speeds, none that can be read, or one that
        is not as its job made it.
    """
    path = run / CRITICAL_SPEEDS
    if not run.is_dir():
        raise AnswerError(f"{run}: no such folder; 'equisection status' lists the runs")
    if not path.is_file():
        raise AnswerError(
            f"{path}: not there yet; 'equisection status {run}' says how far the run is, and the "
            f"same command of snakemake that started it goes on"
        )
    made = _recorded(run)
    _require_as_made(run, path, made)
    rows = tuple(_rows(path))
    chosen = _chosen(rows)
    return Answer(run, rows, chosen, _inside(run, chosen, made))


def _inside(run: Path, chosen: Mapping[str, Any], made: Mapping[str, set[str]]) -> dict[str, int]:
    """Return the numbers of runs without a verdict inside a bracket; none where no table is."""
    path = run / _BRACKETS
    if chosen["basis"] not in _RUNS or not path.is_file():
        return {}
    _require_as_made(run, path, made)
    names, *lines = _cells(path) or [[]]
    for number, cells in enumerate(lines, start=2):
        row = dict(zip(names, cells, strict=False))
        try:
            angle = float(row.get("incidence_deg", chosen["incidence_deg"]))
        except ValueError as error:
            raise AnswerError(f"{path}: line {number}: {error}; delete it and run again") from None
        if row.get("model") == chosen["model"] and angle == chosen["incidence_deg"]:
            counts = {
                what: len(row.get(column, "").split()) for column, what in _WITHOUT_VERDICT.items()
            }
            return {what: many for what, many in counts.items() if many}
    return {}


def _recorded(run: Path) -> Mapping[str, set[str]]:
    """Return the hashes that files had when jobs made them, from one record a job."""
    # Imported here, so that --help and --version come at once.
    from equisection.store.made_from import recorded  # noqa: PLC0415

    return recorded(run)


def _require_as_made(run: Path, path: Path, made: Mapping[str, set[str]]) -> None:
    """Refuse a table that differs from the record of its job; a copy without records has none."""
    # Imported here, so that --help and --version come at once.
    from equisection.store.made_from import require_as_made  # noqa: PLC0415

    try:
        require_as_made(run, path, made)
    except ResultFileError as error:
        raise AnswerError(str(error)) from None


def _rows(path: Path) -> Iterator[Mapping[str, Any]]:
    """Yield the lines of the table: text, and numbers or None."""
    names, *lines = _cells(path) or [[]]
    missing = [name for name in _NEEDED if name not in names]
    if missing:
        raise AnswerError(f"{path}: has no column {missing[0]!r}; delete it and run again")
    if not lines:
        why = f"'equisection status {path.parents[1]}' says why"
        raise AnswerError(f"{path}: no run of the sweep has a result; {why}")
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise AnswerError(f"{path}: has column {shown(twice)} twice; delete it and run again")
    for number, cells in enumerate(lines, start=2):
        try:
            yield _row(names, cells)
        except ValueError as error:
            raise AnswerError(
                f"{path}: line {number}: {error}; delete the file and run again"
            ) from None


def _cells(path: Path) -> list[list[str]]:
    try:
        with path.open(encoding="utf-8", newline="") as file:
            return list(csv.reader(file, strict=True))
    except (ValueError, OSError, csv.Error) as error:
        raise AnswerError(f"{path}: no table that can be read ({error}); make it again") from None


def _row(names: Sequence[str], cells: Sequence[str]) -> dict[str, Any]:
    """Return a line of the table.

    Raises
    ------
    ValueError
        With what is wrong in it.
    """
    if len(cells) != len(names):
        raise ValueError(f"{len(cells)} values for {len(names)} columns")
    row = {name: _value(name, cell.strip(" ")) for name, cell in zip(names, cells, strict=True)}
    for name, allowed in (("mechanism", _MECHANISMS), ("basis", tuple(_BASES))):
        if row[name] not in allowed:
            raise ValueError(f"{name}: {shown(row[name])}: allowed are {', '.join(allowed)}")
    for name in ("model", "incidence_deg"):
        if row[name] in ("", None):
            raise ValueError(f"has no {name}")
    low, high = row["speed_low"], row["speed_high"]
    if low is not None and high is not None and low > high:
        raise ValueError(f"speed_low {low:g} is above speed_high {high:g}")
    return row


def _value(name: str, cell: str) -> Any:
    """Return text, or a number; None for an empty one and for a speed without a bound."""
    if not cell.isprintable():
        raise ValueError(f"{shown(name)}: {shown(cell)}: a character that cannot be shown")
    if name in _TEXTS or (name not in _BOUNDS and not is_plain_number(cell)):
        return cell
    if not cell:
        return None
    try:
        number = number_in(cell)
    except ValueError:
        raise ValueError(f"{name}: {shown(cell)}: allowed is a plain decimal number") from None
    least, most = _BOUNDS.get(name, (-math.inf, math.inf))
    is_huge = LARGEST < abs(number) < math.inf
    if not math.isnan(number) and (is_huge or not least <= number <= most):
        raise ValueError(f"{name}: {shown(cell)}: no {name} is that large or small")
    return number if math.isfinite(number) else None


def _chosen(rows: Sequence[Mapping[str, Any]]) -> Mapping[str, Any]:
    """Return the line that answers, as :class:`Answer` says."""
    models = sorted(dict.fromkeys(row["model"] for row in rows), key=_distance_from_beam)
    for model in models:
        known = [row for row in _answers(rows, model) if _is_known(row)]
        if known:
            return min(known, key=lambda row: (_or(_lowest(row), 0.0), _least_speed(rows, row)))
    return _answers(rows, models[0])[0]


def _least_speed(rows: Sequence[Mapping[str, Any]], row: Mapping[str, Any]) -> float:
    """Return the lowest onset by other bases at the model and incidence of a line."""
    others = [one for one in rows if one is not row]
    alike = [one for one in others if all(one[name] == row[name] for name in _PLACE)]
    return min((one["speed"] for one in alike if one["speed"] is not None), default=math.inf)


def _distance_from_beam(name: str) -> tuple[bool, bool]:
    """Return what puts models in order, whatever their reduction: beam, corrected, section."""
    # Imported here, so that --help and --version come at once.
    from equisection.study.plan import model  # noqa: PLC0415

    found = model(name, "")
    return found.dimension != "3d", not found.corrected


def _answers(rows: Sequence[Mapping[str, Any]], model: str) -> list[Mapping[str, Any]]:
    """Return the line of a model that answers at each incidence."""
    found: dict[float, list[Mapping[str, Any]]] = {}
    for row in rows:
        if row["model"] == model:
            found.setdefault(row["incidence_deg"], []).append(row)
    return [_answer_at(lines) for lines in found.values()]


def _answer_at(lines: Sequence[Mapping[str, Any]]) -> Mapping[str, Any]:
    places = {basis: place for place, basis in enumerate(_BASES)}
    ordered = sorted(lines, key=lambda row: places.get(row["basis"], len(places)))
    first = next(filter(_is_known, ordered), ordered[0])
    if _lowest(first) is not None or first["speed_high"] is None:
        return first
    # it is unstable at all speeds of the strongest basis: another may know where that begins
    below = [
        row
        for row in ordered
        if _lowest(row) is not None
        and max(_or(row[name], 0.0) for name in _SPEEDS) <= first["speed_high"]
        and (row["speed"] is not None or row["speed_high"] is not None)
    ]
    return below[0] if below else first


_SPEEDS = ("speed", "speed_low", "speed_high")


def _lowest(row: Mapping[str, Any]) -> float | None:
    """Return the lower end (m/s) of an onset, or the onset itself where it has no interval."""
    return next((row[name] for name in ("speed_low", "speed") if row[name] is not None), None)


def _or(value: float | None, other: float) -> float:
    return other if value is None else value


def _is_known(row: Mapping[str, Any]) -> bool:
    """Tell whether a line has any speed."""
    return any(row[name] is not None for name in _SPEEDS)


def _speed(row: Mapping[str, Any]) -> str:
    low, high, speed = row["speed_low"], row["speed_high"], row["speed"]
    if low is not None and high is not None:
        if high - low < 0.005 * high:
            return f"{rounded(_or(speed, low), 4)} m/s"
        digits = 3 if rounded(low, 3) != rounded(high, 3) else 4
        stable, unstable = rounded(low, digits), rounded(high, digits)
        return f"between {stable} m/s (stable) and {unstable} m/s (unstable)"
    if speed is not None:
        ends = (("from", low), ("up to", high))
        known = [f"{word} {rounded(end, 3)} m/s" for word, end in ends if end is not None]
        return f"{rounded(speed, 4)} m/s, " + (
            f"{known[0]}, open beyond" if known else "without an interval"
        )
    if low is not None:
        return f"above {rounded(low, 3)} m/s, up to which it is stable"
    if high is not None:
        return f"below {rounded(high, 3)} m/s, where it is unstable already"
    return f"unknown: {_why_nothing(row)}"


def _mechanism(row: Mapping[str, Any]) -> str:
    words = {"none": "none found", "unknown": f"unknown: {_why_unknown(row)}"}
    name = words.get(row["mechanism"], row["mechanism"])
    frequency = row.get("frequency_hz")
    return f"{name} at {rounded(frequency, 3)} Hz" if frequency else str(name)


def _why_unknown(row: Mapping[str, Any]) -> str:
    if row["speed"] is not None or row["speed_high"] is not None:
        return "what is unstable does not say by what"
    if row["speed_low"] is not None:
        return "what is beyond the stable speeds failed or is undecided"
    return _why_nothing(row)


def _why_nothing(row: Mapping[str, Any]) -> str:
    if row["basis"] in _WITHOUT_RUNS:
        return f"no onset by {_BASES[row['basis']]}"
    return "no run has a verdict"


def _sure(row: Mapping[str, Any]) -> str:
    basis = f"by {_BASES.get(row['basis'], row['basis'])}"
    if row["speed_low"] is not None and row["speed_high"] is not None:
        basis += " below and above it" if row["basis"] in ("cfd", "time") else ""
    error = "the error of polar, lags and mesh is not in it"
    known = row.get("growth_error_rms")
    if known is None:
        return f"{basis}; {error}, and not known"
    side = _SIDES.get(str(row.get("errs")), "")
    return (
        f"{basis}; {error}; of kept CFD, on one plate, such growth rates are off by "
        f"{known:.2g} V/c (rms){side}"
    )
