"""Cases that no kept result, or no file of a record, answers, from the indices of a run."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import pandas as pd

from equisection.store.index import read_missing

#: Columns of ``comparison/missing.csv``, in order.
COLUMNS = ("kind", "model", "case", "reason")


def missing_table(indices: Iterable[Path]) -> pd.DataFrame:
    """Return ``comparison/missing.csv``; ``model`` is the dimension of a steady case.

    Parameters
    ----------
    indices
        Indices of a run, ``<kind>/<model>/<batch>.json``.
    """
    rows = [
        (index.parent.parent.name, index.parent.name, case, reason)
        for index in indices
        for case, reason in read_missing(index).items()
    ]
    return pd.DataFrame(rows, columns=list(COLUMNS))
