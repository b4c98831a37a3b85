"""Findings on a claim, and the words for its numbers."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

import pandas as pd

from equisection.paper.mesh_convergence.convergence_page import CONVERGED
from equisection.verdict.zigzag import LARGEST_ZIGZAG


class ClaimVerdict(StrEnum):
    """Verdict on a claim of the paper, or on a part of it."""

    AGREES = "agrees"  # the interval here is narrow enough to tell, and meets the paper's
    DIFFERS = "differs"  # it does not
    NOT_CONVERGED = "not converged"  # it is too wide for either, or not known
    PARTLY = "partly"  # a part agrees
    OPEN = "not run yet"


@dataclass(frozen=True)
class Known:
    """A value with its interval.

    Attributes
    ----------
    value, low, high
        Value and interval; the ends are NaN where the interval is not known.
    """

    value: float
    low: float = math.nan
    high: float = math.nan

    @property
    def half_width(self) -> float:
        """Half of the interval; NaN where it is not known."""
        return 0.5 * (self.high - self.low)

    def words(self, form: str = ".3g") -> str:
        """Return value and interval in words."""
        if math.isnan(self.half_width):
            return f"{self.value:{form}} (interval unknown)"
        return f"{self.value:{form}} ({self.low:{form}} to {self.high:{form}})"

    def over(self, other: Known) -> Known:
        """Return the quotient of two positive values, the errors taken to be independent."""
        quotient = self.value / other.value
        part = math.hypot(self.half_width / self.value, other.half_width / other.value)
        return Known(quotient, quotient * (1.0 - part), quotient * (1.0 + part))

    def meets(self, paper: Known) -> ClaimVerdict:
        """Return the verdict on a value of the paper with its interval.

        An interval wider than +- 10 % of the value is too wide for any verdict: it would meet
        nearly everything.
        """
        if not self.half_width <= CONVERGED * abs(self.value):
            return ClaimVerdict.NOT_CONVERGED
        apart = self.low > paper.high or self.high < paper.low
        return ClaimVerdict.DIFFERS if apart else ClaimVerdict.AGREES

    def is_above(self, bound: float) -> ClaimVerdict:
        """Return the verdict on the claim that the value is above a bound."""
        if self.low > bound:
            return ClaimVerdict.AGREES
        return ClaimVerdict.DIFFERS if self.high < bound else ClaimVerdict.NOT_CONVERGED

    def is_below(self, bound: float) -> ClaimVerdict:
        """Return the verdict on the claim that the value is below a bound."""
        if self.high < bound:
            return ClaimVerdict.AGREES
        return ClaimVerdict.DIFFERS if self.low > bound else ClaimVerdict.NOT_CONVERGED


def together(verdicts: Iterable[ClaimVerdict]) -> ClaimVerdict:
    """Return the verdict on a claim of several parts.

    They are of one mind, or a part agrees; where none agrees and one is not converged, the claim is
    not.
    """
    found = set(verdicts)
    if len(found) == 1:
        return found.pop()
    return ClaimVerdict.PARTLY if ClaimVerdict.AGREES in found else ClaimVerdict.NOT_CONVERGED


@dataclass(frozen=True)
class Finding:
    """Finding on a claim.

    Attributes
    ----------
    verdict
        Verdict on the claim.
    here
        Finding of this project, in words with numbers.
    how
        Resolution and cost.
    why
        Reason why it agrees or not, as far as it is known.
    """

    verdict: ClaimVerdict
    here: str
    how: str = ""
    why: str = ""


def open_finding(what: str, here: str = "") -> Finding:
    """Return the finding on a claim that cannot be judged yet, with the runs that it needs."""
    return Finding(ClaimVerdict.OPEN, f"{here} Needs {what}.".strip())


def percent(difference: float) -> str:
    """Return a relative difference with its sign in percent."""
    return f"{100 * difference:+.2g} %" if abs(difference) < 0.1 else f"{100 * difference:+.0f} %"


def resolution_of(summary: pd.DataFrame, *models: str) -> str:
    """Return mesh and number of runs of some models of a ``summary.csv`` in words."""
    runs = summary[summary["model"].isin(models)]
    if runs.empty:
        return ""
    meshes = ", ".join(sorted(set(runs["resolution"])))
    solvers = ", ".join(sorted(set(runs["solver"])))
    words = f"{solvers}, {meshes}, {len(runs)} runs"
    return words + _not_converged_in_time(runs)


def _not_converged_in_time(runs: pd.DataFrame) -> str:
    """Say how many runs are not converged in their time step, by the zigzag of their loads."""
    if "loads_zigzag" not in runs:
        return ""
    count = int((runs["loads_zigzag"] > LARGEST_ZIGZAG).sum())
    if not count:
        return ""
    words = "not converged in time step"
    return f", {count} [{words}](openfoam-sweep.md#loads-that-zigzag)"
