"""What is in the polars that a configuration names, looked at before any job starts."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from equisection.aerodynamics.polar_rows import read_rows
from equisection.config import Config
from equisection.config.checks import Problem
from equisection.config.sections import FLAT_PLATE
from equisection.errors import ConfigError, PolarFileError

#: Incidences that the thin analytic plate covers (deg).
FLAT_PLATE_LIMIT_DEG = 30.0


def check_polars(config: Config, directory: Path | None = None) -> None:
    """Refuse polars that cannot be read, and incidences that those of the section do not cover.

    Paths are seen from ``directory`` (by default the working one).

    Raises
    ------
    ConfigError
        With one line for each such file or incidence.
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
        key = f"embedded.polars.{name}"
        low, high = -FLAT_PLATE_LIMIT_DEG, FLAT_PLATE_LIMIT_DEG
        if path != FLAT_PLATE:
            try:
                rows = read_rows(directory / path, config.embedded.symmetric)
            except PolarFileError as error:
                yield _unreadable(key, path, error)
                continue
            high = rows[-1].incidence_deg
            low = -high if config.embedded.symmetric else rows[0].incidence_deg
        for place, angle in _angles(config, name):
            if not low <= angle <= high:
                yield Problem(
                    place,
                    angle,
                    f"allowed is {low:g} to {high:g} deg, what {key} ({path}) covers",
                )


def _angles(config: Config, resolution: str) -> Iterator[tuple[str, float]]:
    """Yield key and incidence (deg) of the steady cases of a resolution."""
    steady = config.steady
    key, angles = "steady.incidence_deg", steady.incidence_deg
    if resolution in steady.study and steady.study_incidence_deg:
        key, angles = "steady.study_incidence_deg", steady.study_incidence_deg
    if resolution == steady.resolution or resolution in steady.study:
        yield from ((f"{key}.{place}", angle) for place, angle in enumerate(angles))


def _unreadable(key: str, path: str, error: PolarFileError) -> Problem:
    """Return the reader's words, which begin with the path, behind the key."""
    where, colon, reason = str(error).partition(": ")
    line = where.rpartition(", ")[2] if ", line " in where else ""
    return Problem(key, path, f"{line}{colon if line else ''}{reason}")
