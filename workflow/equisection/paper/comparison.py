"""Every number that the paper states, compared with that of a run: ``comparison/paper.csv``.

A quantity that the paper gives on several meshes has one row for each, so that the choice of one is
left to the reader; the finest is the one to judge by.
"""

from __future__ import annotations

import math

import pandas as pd

from equisection.paper.printed_values import PUBLISHED, Published, relative_difference
from equisection.paper.quantities import Here, Run, values_here

#: Columns of ``comparison/paper.csv``, in order.
COLUMNS = (
    "quantity",
    "paper",
    "here",
    "relative_difference",
    "relation",
    "source",
    "note",
)


def paper_table(run: Run) -> pd.DataFrame:
    """Return ``comparison/paper.csv`` of a run of the paper's case."""
    values = values_here(run)
    rows = [_row(published, here) for published in PUBLISHED for here in values[published.quantity]]
    table = pd.DataFrame(rows, columns=list(COLUMNS))
    return table.drop_duplicates("quantity", ignore_index=True)


def _row(published: Published, here: Here) -> dict[str, object]:
    notes = [published.note, here.note]
    difference = math.nan
    is_number = published.relation in ("equal", "about")
    if not is_number and here.comparable and math.isfinite(here.value):
        notes.insert(0, "holds" if published.holds(here.value) else "does not hold here")
    elif is_number and here.comparable:
        difference = relative_difference(published.value, here.value)
        if published.value == 0.0 and math.isfinite(here.value):
            notes.insert(0, f"absolute difference {here.value - published.value:.3g}")
    return {
        "quantity": _with_model(published.name, here),
        "paper": published.value,
        "here": here.value,
        "relative_difference": difference,
        "relation": published.relation,
        "source": published.source,
        "note": "; ".join(note for note in notes if note),
    }


def _with_model(quantity: str, here: Here) -> str:
    return f"{quantity}, {here.model}" if here.model else quantity
