"""Check of the table of flutter derivatives that a configuration names, before any job starts."""

from __future__ import annotations

from pathlib import Path

from equisection.config import Config
from equisection.errors import ConfigError, DerivativesFileError
from equisection.io.derivative_table import read_derivative_rows
from equisection.keys.checks import Problem


def check_derivatives(config: Config, directory: Path | None = None) -> None:
    """Refuse a table that is unreadable or in another convention.

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
        read_derivative_rows(whole)
    except DerivativesFileError as error:
        text = str(error).removeprefix(str(whole)).removeprefix(", ").removeprefix(": ")
        raise ConfigError(Problem("derivatives.table", path, text).line) from error
