"""A number known from elsewhere, and the computation that has to come to it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

Origin = Literal["published", "independent", "unconfirmed"]

OWN_CODE = "finite elements and Theodorsen's loads by Hankel functions"
"""Usual source of an independent value."""
OWN_JONES = "the same with the two states of R. T. Jones"
"""Usual source of an independent value of the embedded solver."""
DIGITS = "digits of the known value"
"""Usual reason of a tolerance."""
ORIGINS: dict[Origin, str] = {
    "published": "read in the source named",
    "independent": "another computation of the same equations, in a code of its own, not "
    f"published: unless named, {OWN_CODE}, for the embedded solver {OWN_JONES}",
    "unconfirmed": "quoted from the source named, which was not at hand",
}
"""Origin of a known value, in words."""


@dataclass(frozen=True)
class Source:
    """Place that a known value is from.

    Attributes
    ----------
    origin : str
        One of :data:`ORIGINS`.
    words : str
        Author, year and place.
    """

    origin: Origin
    words: str


@dataclass(frozen=True)
class KnownValue:
    """A value known from elsewhere.

    Attributes
    ----------
    case, quantity, unit : str
        The problem, the quantity and its unit.
    known : float
        Its value there.
    source : Source
        Place that it is from.
    compute : callable
        Computation of the same number here.
    tolerance : float
        Largest relative difference that is agreement.
    reason : str
        Reason of the tolerance.
    """

    case: str
    quantity: str
    unit: str
    known: float
    source: Source
    compute: Callable[[], float]
    tolerance: float
    reason: str

    @cached_property
    def computed(self) -> float:
        """Value here."""
        return self.compute()

    @property
    def difference(self) -> float:
        """Relative difference of the value here (-)."""
        return self.computed / self.known - 1.0

    @property
    def agrees(self) -> bool:
        """Agreement within the tolerance."""
        return abs(self.difference) <= self.tolerance
