"""What was found of a claim, and the words in which numbers are put."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
import pandas as pd


class ClaimVerdict(StrEnum):
    """Whether a claim is borne out here."""

    AGREES = "agrees"
    PARTLY = "partly"
    DIFFERS = "is not borne out"
    OPEN = "not run yet"


@dataclass(frozen=True)
class Finding:
    """What was found of a claim.

    Attributes
    ----------
    verdict
        Whether it is borne out.
    here
        What was found, in words with numbers.
    how
        At which resolution and cost.
    why
        Why it agrees or not, as far as it is known.
    """

    verdict: ClaimVerdict
    here: str
    how: str = ""
    why: str = ""


def open_finding(what: str, here: str = "") -> Finding:
    """Return that a claim cannot be judged yet, and what would judge it."""
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
    """Say on what mesh some models of a ``summary.csv`` were run, and what that cost."""
    runs = summary[summary["model"].isin(models)]
    if runs.empty:
        return ""
    meshes = ", ".join(sorted(set(runs["resolution"])))
    solvers = ", ".join(sorted(set(runs["solver"])))
    hours = runs["cpu_seconds"].sum() / 3600
    return f"{solvers}, mesh {meshes}; {len(runs)} runs, {hours:.2g} h of one core"
