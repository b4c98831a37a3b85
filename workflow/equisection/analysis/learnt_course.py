"""Course of learning: what a model says of its onset after some runs, what speaks against it."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import pandas as pd

from equisection.analysis.reduced_beam import ReducedBeam
from equisection.analysis.reduced_model import PredictedOnset, ReducedModel, next_release

#: Model of the loads of a section, or of those of the strips of a beam.
Learnt = ReducedModel | ReducedBeam


@dataclass(frozen=True)
class Course:
    """A learnt model and what it says after the runs so far.

    Attributes
    ----------
    model
        The model.
    table
        Its prediction.
    onset
        Its onset over k*.
    checked
        Number of runs that check it.
    silent
        Number of runs that were to check it and failed, or are undecided.
    contradicted
        Whether the first ones contradicted, so that it was learnt anew.
    at_odds
        Name of a run that it still contradicts; empty if there is none.
    zigzag
        Warning of the loads of the release, if they zigzag from step to step.
    """

    model: Learnt
    table: pd.DataFrame
    onset: PredictedOnset
    checked: int
    contradicted: bool
    at_odds: str
    zigzag: str = ""
    silent: int = 0

    @property
    def reservations(self) -> str:
        """Return in words what speaks against the model; empty where nothing does."""
        found = [self.zigzag] if self.zigzag else []
        again = next_release(self.model.k_star, self.onset)
        if again is not None:
            part = self.model.k_star / self.onset.k_star
            found.append(
                f"learnt at {part:.2g} times the k* of its onset, too far from it: add "
                f"{again:g} to rom.learn_from"
            )
        if self.model.missing_angles:
            angles = ", ".join(f"{angle:g}" for angle in self.model.missing_angles)
            found.append(f"the polar has no points at {angles} deg: steady.incidence_deg")
        if self.extrapolates:
            low, high = np.degrees(self.model.loads.seen)
            found.append(
                f"the release at the onset leaves the incidences that were seen, {low:.3g} to "
                f"{high:.3g} deg"
            )
        return "; ".join(found)

    @property
    def extrapolates(self) -> bool:
        """Tell whether the release at the onset goes to an incidence that was not learnt from."""
        if not math.isfinite(self.onset.k_star):
            return False
        near = np.abs(np.log(self.table["k_star"] / self.onset.k_star)).argmin()
        return bool(self.table["extrapolated"].iloc[near])

    @property
    def words(self) -> str:
        """Return what the model is, with its incidence."""
        angle = math.degrees(self.model.loads.incidence_rad)
        return f"{self.model.words}, incidence {angle:.6g} deg"

    @property
    def confirmation(self) -> str:
        """Return in words how far runs bear the model out."""
        if self.at_odds:
            return f"contradicted by the run {self.at_odds}"
        silent = f"; {self.silent} failed or undecided" if self.silent else ""
        if not self.checked:
            return f"not confirmed by runs{silent}"
        again = (
            ", after it was learnt anew from a run that contradicted" if self.contradicted else ""
        )
        return f"not contradicted by {self.checked} runs{again}{silent}"
