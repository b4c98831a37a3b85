"""Criteria for the judgement of a history of motion, and the verdict.

Time is the convective time s = t V/c throughout, twist is in rad, deflection in chords
(conventions.py).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from equisection.verdict.growth import NO_GROWTH, Growth

Regime = Literal["settled", "decaying", "limit-cycle", "growing", "undecided"]


@dataclass(frozen=True)
class Criteria:
    """Criteria for the regime of a run.

    Attributes
    ----------
    periods : int
        Whole periods of the twist over which an oscillation is judged.
    steadiness : float
        Largest spread of the cycle amplitudes over those periods, as a fraction of their
        mean, in a limit cycle (0.02: the criterion of solids4foam's FSI verification).
    settled_amplitude_deg : float
        Twist amplitude (deg) below which a section counts as at rest.
    growing_amplitude_deg : float
        Twist amplitude (deg) beyond which a growing oscillation is called so.
    decay_factor : float
        An oscillation still above ``settled_amplitude_deg`` may be called settled once its
        amplitude has fallen from its largest by this factor.
    mean_tolerance_deg, mean_tolerance_chords : float
        Tolerances within which the means of twist (deg) and deflection (chords) must be known
        before a run may end.
    discard_time : float
        Time from the release (c/V) whose cycles are not judged.
    minimal_time : float
        Time from the release (c/V) before which only ``growing`` is called, at the end of a
        run too: a section released from rest looks settled at first.
    """

    periods: int = 5
    steadiness: float = 0.02
    settled_amplitude_deg: float = 0.05
    growing_amplitude_deg: float = 6.0
    decay_factor: float = 5.0
    mean_tolerance_deg: float = 0.02
    mean_tolerance_chords: float = 0.002
    discard_time: float = 10.0
    minimal_time: float = 30.0

    def __post_init__(self) -> None:
        """Refuse criteria that no signal could meet."""
        if self.periods < 2:
            raise ValueError(f"periods = {self.periods}: at least 2 are needed to see a change")
        if self.decay_factor <= 1.0:
            raise ValueError(f"decay_factor = {self.decay_factor}: must be greater than 1")
        for name in (
            "steadiness",
            "settled_amplitude_deg",
            "growing_amplitude_deg",
            "mean_tolerance_deg",
            "mean_tolerance_chords",
        ):
            if not getattr(self, name) > 0.0:
                raise ValueError(f"{name} = {getattr(self, name)}: must be greater than 0")
        if self.growing_amplitude_deg <= self.settled_amplitude_deg:
            raise ValueError(
                f"growing_amplitude_deg = {self.growing_amplitude_deg}: must be greater than "
                f"settled_amplitude_deg = {self.settled_amplitude_deg}"
            )


@dataclass(frozen=True)
class Verdict:
    """Regime, means, amplitudes and growth of a history, from a window at its end.

    Attributes
    ----------
    regime : {'settled', 'decaying', 'limit-cycle', 'growing', 'undecided'}
        ``undecided`` at the end of a run that does not tell.
    reason : str
        A sentence for the person who reads it.
    periods_used : float
        Periods of the twist in the window; 0 without an oscillation.
    start_time, end_time : float
        The window (c/V).
    mean_twist : float
        Mean of the twist (rad).
    mean_deflection : float
        Mean of the deflection (chords).
    mean_known : bool
        Whether both means are settled; otherwise they are averages over the window, of a motion
        that still grows or drifts.
    twist_amplitude : float
        Half peak-to-peak of the twist (rad): the mean over the window's cycles in a limit
        cycle, that of the last cycle otherwise.
    deflection_amplitude : float
        Half peak-to-peak of the deflection (chords) over the last period of the window, its
        straight drift taken out.
    frequency : float
        f c/V of the twist; the hint given, or NaN, without an oscillation.
    growth : Growth
        Growth rate (per c/V) of the motion with its standard error and window: fitted to twist and
        deflection together where that is known (:mod:`equisection.verdict.growth`), else
        d ln A/ds of the twist amplitude A; NaN without an oscillation.
    heave_grows : bool
        True where the motion is growing by its heave, beneath a twist that does not grow.
    turns : int
        Number of times that the twist turned in the whole record; -1 where nobody counted.
    """

    regime: Regime
    reason: str
    periods_used: float = 0.0
    start_time: float = math.nan
    end_time: float = math.nan
    mean_twist: float = math.nan
    mean_deflection: float = math.nan
    mean_known: bool = False
    twist_amplitude: float = math.nan
    deflection_amplitude: float = math.nan
    frequency: float = math.nan
    growth: Growth = NO_GROWTH
    heave_grows: bool = False
    turns: int = -1

    @property
    def growth_rate(self) -> float:
        """Growth rate (per c/V); NaN without an oscillation."""
        return self.growth.rate

    @property
    def decided(self) -> bool:
        """Tell whether the run may end."""
        return self.regime != "undecided"
