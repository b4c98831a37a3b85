"""A value on similar meshes, from coarse to fine, with its limit."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass, field

import pandas as pd

from equisection.analysis.grid_convergence import cell_size
from equisection.analysis.grid_limit import GridLimit, grid_limit

#: Columns of the table of series, in order.
COLUMNS = (
    "quantity",
    "model",
    "at",
    "basis",
    "mesh",
    "cells",
    "value",
    "low",
    "high",
    "observed_order",
    "note",
)
#: Name of the limit in the column ``mesh``.
LIMIT = "limit"


@dataclass(frozen=True)
class MeshValue:
    """A value on one mesh.

    Attributes
    ----------
    mesh
        Name of the mesh.
    cells
        Number of its cells.
    value
        The value.
    low, high
        Its interval, apart from the mesh; NaN where there is none, infinite where it has no end.
    note
        Remark.
    """

    mesh: str
    cells: int
    value: float
    low: float = math.nan
    high: float = math.nan
    note: str = ""

    @property
    def half_width(self) -> float:
        """Half of the interval, 0 where there is none."""
        half = 0.5 * (self.high - self.low)
        return 0.0 if math.isnan(half) else half


@dataclass(frozen=True)
class MeshSeries:
    """A value on similar meshes.

    Attributes
    ----------
    quantity
        The quantity, as ``onset k*``.
    model
        Model of the sweep, or ``rigid plate``.
    at
        Place where it is taken, as ``k* = 6.44``; empty where there is none.
    basis
        Origin of the values in words.
    dimensions
        Directions in which the meshes differ, 2 or 3.
    values
        Values, coarsest mesh first.
    common_error
        True where the intervals of the values are of one error that all meshes share, so that
        the limit has it once. They are taken to be independent by default.
    derived
        The limit, where it does not come from the values.
    """

    quantity: str
    model: str
    at: str
    basis: str
    dimensions: int
    values: tuple[MeshValue, ...]
    common_error: bool = False
    derived: GridLimit | None = None
    limit: GridLimit = field(init=False)

    def __post_init__(self) -> None:
        ordered = sorted(
            (value for value in self.values if math.isfinite(value.value)),
            key=lambda value: value.cells,
        )
        object.__setattr__(self, "values", tuple(ordered))
        object.__setattr__(self, "limit", self.derived or self._limit())

    @property
    def sizes(self) -> list[float]:
        """Cell sizes h of the meshes (part of the size of the domain)."""
        return [cell_size(value.cells, self.dimensions) for value in self.values]

    def _limit(self) -> GridLimit:
        numbers = [value.value for value in self.values]
        errors = [value.half_width for value in self.values]
        if not self.common_error:
            return grid_limit(numbers, self.sizes, errors)
        found = grid_limit(numbers, self.sizes)
        half = math.hypot(found.half_width, errors[-1]) if errors else math.nan
        return GridLimit(
            found.value,
            found.value - half,
            found.value + half,
            found.meshes,
            found.order,
            found.basis,
        )


def is_part_of_another(one: MeshSeries, others: Iterable[MeshSeries]) -> bool:
    """Tell whether another series has all values of one, and further meshes."""
    own = {(value.mesh, value.value) for value in one.values}
    return any(own < {(value.mesh, value.value) for value in other.values} for other in others)


def as_table(series: Iterable[MeshSeries]) -> pd.DataFrame:
    """Return a line for each mesh of each series, and one for its limit."""
    rows: list[tuple[object, ...]] = []
    for one in series:
        head = (one.quantity, one.model, one.at, one.basis)
        rows += [
            (*head, v.mesh, v.cells, v.value, v.low, v.high, math.nan, v.note) for v in one.values
        ]
        limit = one.limit
        rows.append((*head, LIMIT, 0, limit.value, limit.low, limit.high, limit.order, limit.basis))
    return pd.DataFrame(rows, columns=list(COLUMNS))
