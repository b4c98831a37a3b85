"""The answer of a run in a few lines: the critical speed, by what, and how sure that is.

It is read from ``comparison/critical_speed.csv`` alone, so it takes no solver and says nothing that
the table does not say.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from equisection.errors import EquisectionError

if TYPE_CHECKING:  # what reads a table is imported where it is needed
    import pandas as pd

#: The table with the answer, as seen from the folder of a run.
CRITICAL_SPEEDS = Path("comparison") / "critical_speed.csv"
#: Columns without which a table is none of critical speeds.
_NEEDED = ("model", "incidence_deg", "speed", "speed_low", "speed_high", "mechanism", "basis")
#: Models and what they rest on, the nearest to the beam in its flow first.
_MODELS = ("3d", "2d-corrected", "2d")
_BASES = ("experiment", "cfd", "time", "model", "eigenvalue", "derivatives")
_BASIS_WORDS = {
    "experiment": "histories of an experiment",
    "cfd": "CFD runs below and above it",
    "time": "runs in time below and above it",
    "model": "a model learnt from a release",
    "eigenvalue": "eigenvalues of the section's equations",
    "derivatives": "flutter derivatives",
}
_SIDES = {
    "unsafe": "the true speed is probably lower",
    "safe": "the true speed is probably higher",
    "either": "on either side",
}


class AnswerError(EquisectionError):
    """A run has no answer that can be read."""


@dataclass(frozen=True)
class Answer:
    """Critical speeds of a run, and the one that answers for the beam.

    Attributes
    ----------
    run
        Name of the run.
    rows
        Lines of the table: names of columns and values (speeds in m/s, frequencies in Hz), None
        where a value is not there.
    chosen
        The line that answers: of the model nearest to the beam (the beam itself, then the corrected
        section), on its strongest basis, at the incidence with the lowest speed.
    """

    run: str
    rows: tuple[Mapping[str, Any], ...]
    chosen: Mapping[str, Any]

    def lines(self) -> Iterator[str]:
        """Yield the answer, a line each: speed, mechanism, margin, how sure, other models."""
        yield f"critical speed  {_speed(self.chosen)}{self._incidence()}"
        yield f"mechanism       {_mechanism(self.chosen)}"
        yield f"margin          {_margin(self.chosen)}"
        yield f"how sure        {_sure(self.chosen)}"
        others = [row for row in self.rows if self._is_of_another_model(row)]
        if others:
            yield "other models    " + "; ".join(
                f"{row['model']} {_speed(row)} ({row['basis']})" for row in others
            )

    def as_json(self) -> str:
        """Return run, the line that answers, and all lines of the table as JSON."""
        return json.dumps({"run": self.run, "answer": self.chosen, "all": self.rows}, indent=2)

    def _incidence(self) -> str:
        angles = sorted({row["incidence_deg"] for row in self.rows})
        at = f", at {self.chosen['incidence_deg']:g} deg"
        if len(angles) == 1:
            return at
        return (
            f"{at}, the lowest of {len(angles)} incidences from {angles[0]:g} to {angles[-1]:g} deg"
        )

    def _is_of_another_model(self, row: Mapping[str, Any]) -> bool:
        return row["incidence_deg"] == self.chosen["incidence_deg"] and (
            row["model"],
            row["basis"],
        ) != (self.chosen["model"], self.chosen["basis"])


def answer_of(run: Path) -> Answer:
    """Read the answer of a run.

    Parameters
    ----------
    run
        Folder of the run.

    Raises
    ------
    AnswerError
        There is no such folder, no table of critical speeds, or none that can be read.
    """
    path = run / CRITICAL_SPEEDS
    if not run.is_dir():
        raise AnswerError(f"{run}: no such folder; 'equisection status' lists the runs")
    if not path.is_file():
        raise AnswerError(
            f"{path}: not there yet; 'equisection status {run}' says how far the run is, and the "
            f"same command of snakemake that started it goes on"
        )
    table = _table(path)
    rows = tuple(
        {name: None if value != value else value for name, value in row.items()}  # noqa: PLR0124
        for row in table.astype(object).to_dict("records")
    )
    return Answer(run.resolve().name, rows, min(rows, key=_rank))


def _table(path: Path) -> pd.DataFrame:
    # Imported here, so that --help and --version come at once.
    import pandas as pd  # noqa: PLC0415

    try:
        table = pd.read_csv(path)
    except (ValueError, OSError) as error:
        raise AnswerError(f"{path}: no table that can be read ({error}); make it again") from None
    missing = [name for name in _NEEDED if name not in table]
    if missing or table.empty:
        what = f"has no column {missing[0]!r}" if missing else "has no line"
        raise AnswerError(f"{path}: {what}; delete it and run again")
    return table


def _rank(row: Mapping[str, Any]) -> tuple[int, int, float]:
    """Order of a line: nearness of its model, strength of its basis, then the lowest speed."""
    model, basis = row["model"], row["basis"]
    lowest = next((row[name] for name in ("speed_low", "speed") if row[name] is not None), 0.0)
    return (
        _MODELS.index(model) if model in _MODELS else len(_MODELS),
        _BASES.index(basis) if basis in _BASES else len(_BASES),
        lowest,
    )


def _speed(row: Mapping[str, Any]) -> str:
    low, high, speed = row["speed_low"], row["speed_high"], row["speed"]
    if low is not None and high is not None:
        if high - low < 0.005 * high:
            return f"{speed:.4g} m/s"
        return f"between {low:.3g} m/s (stable) and {high:.3g} m/s (unstable)"
    if low is not None:
        return f"above {low:.3g} m/s, up to which it is stable"
    if high is not None:
        return f"below {high:.3g} m/s, where it is unstable already"
    return "unknown: no run has a verdict"


def _mechanism(row: Mapping[str, Any]) -> str:
    words = {"none": "none found", "unknown": "unknown: beyond the stable speeds runs failed"}
    name = words.get(row["mechanism"], row["mechanism"])
    frequency = row.get("frequency_hz")
    return f"{name} at {frequency:.3g} Hz" if frequency else name


def _margin(row: Mapping[str, Any]) -> str:
    margin = row.get("margin")
    if margin is None:
        return "not asked for: flow.design_speed (m/s) is not given"
    side = "" if margin >= 1.0 else ": NOT REACHED by the stable speeds"
    return f"{margin:.3g} times the design speed{side}"


def _sure(row: Mapping[str, Any]) -> str:
    basis = _BASIS_WORDS.get(row["basis"], row["basis"])
    known = row.get("growth_error_rms")
    if known is None:
        error = "the error of polar, lags and mesh is not known and not in it"
    else:
        error = f"its growth rates are off CFD by {known:.2g} V/c (rms)"
    side = _SIDES.get(row.get("errs") or "", "")
    return f"by {basis}; {error}" + (f"; {side}" if side else "")
