"""Findings on a claim, and the words for its numbers."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import pandas as pd


class ClaimVerdict(StrEnum):
    """Verdict on a claim of the paper."""

    AGREES = "agrees"
    PARTLY = "partly"
    DIFFERS = "is not borne out"
    OPEN = "not run yet"


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


def graded(differences: Sequence[float], good: float, fair: float) -> ClaimVerdict:
    """Return the verdict on relative differences from the paper, by the largest of them."""
    largest = float(np.max(np.abs(differences)))
    if largest <= good:
        return ClaimVerdict.AGREES
    return ClaimVerdict.PARTLY if largest <= fair else ClaimVerdict.DIFFERS


def percent(difference: float) -> str:
    """Return a relative difference with its sign in percent."""
    return f"{100 * difference:+.2g} %" if abs(difference) < 0.1 else f"{100 * difference:+.0f} %"


def resolution_of(summary: pd.DataFrame, *models: str) -> str:
    """Return mesh and cost of some models of a ``summary.csv`` in words."""
    runs = summary[summary["model"].isin(models)]
    if runs.empty:
        return ""
    meshes = ", ".join(sorted(set(runs["resolution"])))
    solvers = ", ".join(sorted(set(runs["solver"])))
    hours = runs["cpu_seconds"].sum() / 3600
    return f"{solvers}, mesh {meshes}; {len(runs)} runs, {hours:.2g} h of one core"
