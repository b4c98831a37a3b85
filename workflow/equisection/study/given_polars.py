"""Check of the polars that a configuration names, before any job starts."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from equisection.config import Config
from equisection.config.groups import FLAT_PLATE
from equisection.errors import ConfigError, PolarFileError
from equisection.io.formats import read_rows
from equisection.keys.checks import Problem


def check_polars(config: Config, directory: Path | None = None) -> None:
    """Refuse polars that cannot be read, and a section's that does not hold the run's incidence.

    Any other incidence beyond them is a case that fails with a reason; the others go on. Paths are
    seen from ``directory`` (by default the working one).

    Raises
    ------
    ConfigError
        With one line for each such file.
    """
    directory = directory or Path.cwd()
    problems: list[Problem] = []
    if config.solver == "embedded":
        problems += _of_section(config, directory)
    if config.steady.beam_polar:
        try:
            read_rows(directory / config.steady.beam_polar, symmetric=False)
        except PolarFileError as error:
            problems.append(_unreadable("steady.beam_polar", config.steady.beam_polar, error))
    if problems:
        raise ConfigError("\n".join(problem.line for problem in problems))


def _of_section(config: Config, directory: Path) -> Iterator[Problem]:
    for name, path in config.embedded.polars.items():
        if path == FLAT_PLATE:
            continue
        try:
            rows = read_rows(directory / path, config.embedded.symmetric).rows
        except PolarFileError as error:
            yield _unreadable(f"embedded.polars.{name}", path, error)
            continue
        last = max(row.incidence_deg for row in rows)
        first = -last if config.embedded.symmetric else min(row.incidence_deg for row in rows)
        incidence = config.flow.incidence_deg
        if name == config.steady.resolution and not first <= incidence <= last:
            yield Problem(
                "flow.incidence_deg",
                incidence,
                f"allowed is {first:g} to {last:g} deg, what {path} covers (is it in degrees?)",
            )


def _unreadable(key: str, path: str, error: PolarFileError) -> Problem:
    """Return the reader's words, which begin with the path, behind the key."""
    where, colon, reason = str(error).partition(": ")
    line = where.rpartition(", ")[2] if ", line " in where else ""
    return Problem(key, path, f"{line}{colon if line else ''}{reason}")
