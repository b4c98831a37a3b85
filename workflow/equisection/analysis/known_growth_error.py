"""Known error of the growth behind an onset, in the tables of onsets."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import pandas as pd

from equisection.solvers.known_error import EIGENVALUE, TIME, KnownError
from equisection.solvers.protocol import HasKnownError, Solver

#: Columns that :func:`with_known_errors` adds to a table.
COLUMNS = ("growth_error", "growth_error_rms", "errs")
#: Side of an error that nobody knows.
UNKNOWN = "unknown"

KnownErrors = Mapping[tuple[str, str], KnownError]
"""Known errors by model and basis."""


def known_errors_of(
    solver: Solver, dimensions: Mapping[str, str], summary: pd.DataFrame
) -> dict[tuple[str, str], KnownError]:
    """Return what a solver knows of the error of models.

    Parameters
    ----------
    solver
        The configured solver.
    dimensions
        Dimension of each model, ``2d`` or ``3d``.
    summary
        ``comparison/summary.csv``: runs of a model that another solver has made are left out.
    """
    if not isinstance(solver, HasKnownError):
        return {}
    others = set(summary.loc[summary["solver"] != solver.name, "model"])
    found = {}
    for model, dimension in dimensions.items():
        for basis in (TIME, EIGENVALUE):
            error = solver.known_error(dimension, basis)
            if error is not None and not (basis == TIME and model in others):
                found[model, basis] = error
    return found


def with_known_errors(
    table: pd.DataFrame, known: KnownErrors, bases: Sequence[str] | None = None
) -> pd.DataFrame:
    """Return a table of onsets by model with what is known of their error.

    Parameters
    ----------
    table
        Table with a column ``model``.
    known
        Known errors.
    bases
        Basis of each row; None for runs in time.

    Returns
    -------
    pd.DataFrame
        The table with :data:`COLUMNS`: mean and root mean square of the growth (V/c) less that by a
        flow solver, NaN where nobody knows them, and the side to which the speed of the onset errs
        by the mean: ``unsafe`` (too high), ``safe``, ``either`` or ``unknown``.
    """
    models = table["model"].astype(str)
    pairs = zip(models, [TIME] * len(table) if bases is None else bases, strict=True)
    errors = [known.get(pair) for pair in pairs]
    return table.assign(
        growth_error=pd.Series([one.mean if one else None for one in errors], table.index, float),
        growth_error_rms=pd.Series(
            [one.rms if one else None for one in errors], table.index, float
        ),
        errs=pd.Series([one.errs if one else UNKNOWN for one in errors], table.index, str),
    )


def in_words(known: KnownErrors) -> list[str]:
    """Return a line for each model and basis of which something is known."""
    return [f"{model} ({basis}): {error}" for (model, basis), error in known.items()]
