"""Whether the files that a configuration names are there, looked at before any job starts."""

from __future__ import annotations

import difflib
from pathlib import Path

from equisection.config.checks import Problem
from equisection.config.model import Config
from equisection.config.sections import FLAT_PLATE
from equisection.errors import ConfigError


def check_files(config: Config, directory: Path | None = None) -> None:
    """Refuse polars that are no files, seen from ``directory`` (by default the working one).

    Raises
    ------
    ConfigError
        With one line for each missing file.
    """
    if config.solver != "embedded":
        return
    directory = directory or Path.cwd()
    problems = [
        Problem(f"embedded.polars.{name}", polar, _advice(polar, directory))
        for name, polar in config.embedded.polars.items()
        if polar != FLAT_PLATE and not _is_file(directory / polar)
    ]
    if problems:
        raise ConfigError("\n".join(problem.line for problem in problems))


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):
        return False


def _advice(polar: str, directory: Path) -> str:
    place = directory / polar
    what = "a folder" if "\0" not in polar and place.is_dir() else "no such file"
    answer = f"{what}, seen from {directory}; allowed is a CSV file or {FLAT_PLATE}"
    candidates = {FLAT_PLATE: FLAT_PLATE}
    if "\0" not in polar and place.parent.is_dir():
        candidates |= {
            str(Path(polar).with_name(other.name)): other.name
            for other in sorted(place.parent.glob("*.csv"))
        }
    near = difflib.get_close_matches(polar, candidates, n=1, cutoff=0.8)
    return f"{answer}; did you mean '{near[0]}'?" if near else answer
