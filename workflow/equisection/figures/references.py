"""Values to draw next to those of a run, for instance published ones.

A table of them has the columns ``quantity,at,value,label``: the quantity, its place (an incidence
in degrees, or nothing), its value, and its label in the legend.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import pandas as pd

from equisection.errors import ResultFileError

COLUMNS = ("quantity", "at", "value", "label")


def read_references(paths: Sequence[Path], quantity: str) -> pd.DataFrame:
    """Return the values of a quantity in some tables, one row each.

    Raises
    ------
    ResultFileError
        A table lacks a column.
    """
    tables = [pd.read_csv(path) for path in paths]
    for path, table in zip(paths, tables, strict=True):
        lacking = [name for name in COLUMNS if name not in table]
        if lacking:
            raise ResultFileError(
                f"{path}: no column {', '.join(lacking)}; a table of references has "
                f"{','.join(COLUMNS)}"
            )
    every = pd.concat(tables) if tables else pd.DataFrame(columns=list(COLUMNS))
    return every[every["quantity"] == quantity]
