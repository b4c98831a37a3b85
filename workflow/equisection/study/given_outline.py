"""Check of the outline that a configuration gives, before any job starts."""

from __future__ import annotations

from pathlib import Path

from equisection.config import Config
from equisection.errors import ConfigError, OutlineError
from equisection.keys.checks import Problem


def check_outline(config: Config, directory: Path | None = None) -> None:
    """Refuse an outline that cannot be read or used.

    Its file is seen from ``directory`` (by default the working one).

    Raises
    ------
    ConfigError
        With the line of the problem.
    """
    outline = config.beam.outline
    if outline is None:
        return
    try:
        config.beam.outline_in_flow(directory or Path.cwd())
    except OutlineError as error:
        key = outline.given[0]
        value = getattr(outline, key)
        reason = str(error).removeprefix(f"{value}: ")
        raise ConfigError(Problem(f"beam.outline.{key}", value, reason).line) from None
