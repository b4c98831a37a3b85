"""Result of a case, of whatever kind, as a solver returns it."""

from __future__ import annotations

from typing import Any, Protocol

import xarray as xr

from equisection.results.spent import Spent


class CaseResult(Protocol):
    """Protocol of the results of all kinds of case."""

    @property
    def spent(self) -> Spent | None:
        """Time that the case took, where the solver knows it better than its job."""
        ...

    def of_case(self, case: Any) -> xr.Dataset:
        """Return the data set that is written to the file of a case."""
        ...
