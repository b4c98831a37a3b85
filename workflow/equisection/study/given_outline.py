"""Check of the outline that a configuration gives, before any job starts."""

from __future__ import annotations

from pathlib import Path

from equisection.beam.beam import Beam
from equisection.beam.outline_keys import OutlineKeys
from equisection.config import Config
from equisection.config.model import release_from_equilibrium
from equisection.errors import ConfigError, OutlineError
from equisection.keys.checks import Problem


def check_outline(config: Config, directory: Path | None = None) -> None:
    """Refuse an outline that cannot be read or used, or is let go where it has no loads.

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
        found = config.beam.outline_in_flow(directory or Path.cwd())
    except OutlineError as error:
        key, value = _given(config.beam, outline)
        raise ConfigError(Problem(key, value, str(error).removeprefix(f"{value}: ")).line) from None
    is_of_flow = config.solver not in ("embedded", "given") and not config.unsteady.start.is_given
    if is_of_flow and found is not None and found.is_symmetric:
        for problem in release_from_equilibrium(
            config.flow.incidence_deg, config.sweep.incidence_deg
        ):
            raise ConfigError(problem.line)


def _given(beam: Beam, outline: OutlineKeys) -> tuple[str, object]:
    """Return the key that decides the shape, and its value."""
    if outline.rectangle is None:
        return f"beam.outline.{outline.given[0]}", outline.naca or outline.file
    if outline.rectangle.thickness is None:
        return "beam.thickness", beam.thickness
    return "beam.outline.rectangle.thickness", outline.rectangle.thickness
