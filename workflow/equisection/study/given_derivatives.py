"""Check of the table of flutter derivatives that a configuration names, before any job starts."""

from __future__ import annotations

import math
from pathlib import Path

from equisection.config import Config
from equisection.errors import ConfigError, DerivativesFileError
from equisection.io.derivative_table import read_derivative_rows
from equisection.keys.checks import Problem

#: Incidences (deg) that are the same.
_SAME = 0.05


def check_derivatives(config: Config, directory: Path | None = None) -> None:
    """Refuse a table that is unreadable, in another convention, or of another mean incidence.

    Its path is seen from ``directory`` (by default the working one).

    Raises
    ------
    ConfigError
        With a line that names the key.
    """
    path = config.derivatives.table
    if not path:
        return
    whole = (directory or Path.cwd()) / path
    try:
        rows = read_derivative_rows(whole)
    except DerivativesFileError as error:
        text = str(error).removeprefix(str(whole)).removeprefix(", ").removeprefix(": ")
        raise ConfigError(Problem("derivatives.table", path, text).line) from error
    there, here = rows.incidence_deg, config.flow.incidence_deg
    if not math.isnan(there) and abs(there - here) > _SAME:
        problem = Problem(
            "derivatives.table",
            path,
            f"allowed is a table at flow.incidence_deg, {here:g} deg; this one is at {there:g} deg",
        )
        raise ConfigError(problem.line)
