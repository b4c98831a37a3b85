"""Result of a case, of whatever kind, as a solver returns it."""

from __future__ import annotations

from typing import Any, Protocol

import xarray as xr

from equisection.results.spent import Spent


class CaseResult(Protocol):
    """What the results of all kinds of case have in common."""

    @property
    def spent(self) -> Spent | None:
        """Cost of the case, where the solver knows it better than its job does."""
        ...

    def of_case(self, case: Any) -> xr.Dataset:
        """Return the data set that is written to the file of a case."""
        ...
