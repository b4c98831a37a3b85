"""Errors that are known of the embedded solver's growth.

``known_errors.csv`` beside this module has them; ``python -m tests.benchmarks.beam_growth --write``
writes it from the kept results. All are of one plate with sharp edges at 2.5 deg and of the default
lags: of other polars, other lags and other sections nothing is known.
"""

from __future__ import annotations

import csv
from functools import lru_cache
from pathlib import Path

from equisection.aerodynamics.separation import IDENTIFIED_LAGS, SeparationLags
from equisection.solvers.known_error import KnownError

FILE = Path(__file__).with_name("known_errors.csv")


@lru_cache(maxsize=1)
def known_errors() -> tuple[KnownError, ...]:
    """Read the errors that are known."""
    with FILE.open(encoding="utf-8", newline="") as file:
        return tuple(
            KnownError(
                row["dimension"],
                row["polar"],
                row["basis"],
                row["against"],
                int(row["releases"]),
                int(row["wrong_side"]),
                float(row["mean"]),
                float(row["rms"]),
            )
            for row in csv.DictReader(file)
        )


def known_error(
    dimension: str, basis: str, polar: str, lags: SeparationLags = IDENTIFIED_LAGS
) -> KnownError | None:
    """Return the error that is known with a polar, by its label, and with lags; None for none."""
    if lags != IDENTIFIED_LAGS:
        return None
    for each in known_errors():
        if (each.dimension, each.basis, each.polar) == (dimension, basis, polar):
            return each
    return None
