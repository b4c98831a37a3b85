"""Where a sweep over k* goes unstable, and which k* to run next to know it better.

A section is unstable below the onset and stable above it: k* is a stiffness over a dynamic
pressure. The onset that matters to whoever comes from high k* (from low speed) is the *first*
one met, so the bracket is

    k_unstable = the highest k* that is unstable,
    k_stable   = the lowest stable k* above it.

Every k* above the bracket is then stable (or failed). A sequence that is not monotone, say
unstable, stable, unstable, stable, gives the bracket of its upper change; stable k* further
down are islands and do not count.

A failed run says neither: it is left out, and when it lies inside the bracket it is named
there, since only repeating it can narrow that bracket.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd

#: Columns of :func:`onset_table`, in order.
COLUMNS = ("model", "k_star_stable", "k_star_unstable", "failed_inside", "stable_below")
_SIGNIFICANT_DIGITS = 4


@dataclass(frozen=True)
class OnsetBracket:
    """Bracket of the onset of instability.

    Attributes
    ----------
    k_stable : float
        Lowest k* known to be stable above the onset; NaN if no run above it is stable.
    k_unstable : float
        Highest k* known to be unstable; NaN if none is.
    failed : tuple of float
        k* of failed runs inside the bracket (or beyond its known side if it is open).
    islands : tuple of float
        Stable k* below ``k_unstable``: the sequence is not monotone.
    """

    k_stable: float
    k_unstable: float
    failed: tuple[float, ...] = ()
    islands: tuple[float, ...] = ()

    @property
    def closed(self) -> bool:
        """Whether both sides are known."""
        return not (math.isnan(self.k_stable) or math.isnan(self.k_unstable))

    @property
    def relative_width(self) -> float:
        """(k_stable - k_unstable)/k_unstable; NaN if open."""
        return (self.k_stable - self.k_unstable) / self.k_unstable


def is_unstable(regime: str, twist_amplitude_deg: float, threshold_deg: float) -> bool | None:
    """Whether a run is unstable; None if it says neither.

    Parameters
    ----------
    regime : str
        ``settled``, ``limit-cycle``, ``growing`` or ``failed``.
    twist_amplitude_deg : float
        Twist amplitude (deg), which decides for a limit cycle.
    threshold_deg : float
        Limit cycles above this amplitude (deg) are unstable; those below are a residue of
        the flow's own unsteadiness. NaN amplitudes count as above.
    """
    if regime == "failed":
        return None
    if regime == "limit-cycle":
        return not twist_amplitude_deg <= threshold_deg
    if regime in ("settled", "growing"):
        return regime == "growing"
    raise ValueError(
        f"regime {regime!r} is not one of 'settled', 'limit-cycle', 'growing', 'failed'; "
        "let the run end before it is compared"
    )


def onset_bracket(
    k_star: Sequence[float],
    regimes: Sequence[str],
    twist_amplitude_deg: Sequence[float] | None = None,
    threshold_deg: float = 0.5,
) -> OnsetBracket:
    """Bracket the onset of one model.

    Parameters
    ----------
    k_star : sequence of float, shape (n,)
        k* of the runs (-), in any order. Of a k* that was run twice the unstable run counts.
    regimes : sequence of str, shape (n,)
        Their regimes, see `is_unstable`.
    twist_amplitude_deg : sequence of float, shape (n,), optional
        Their twist amplitudes (deg); without them every limit cycle is unstable.
    threshold_deg : float
        Amplitude (deg) above which a limit cycle is unstable.
    """
    amplitudes = [math.nan] * len(k_star) if twist_amplitude_deg is None else twist_amplitude_deg
    states = [
        (float(k), is_unstable(regime, amplitude, threshold_deg))
        for k, regime, amplitude in zip(k_star, regimes, amplitudes, strict=True)
    ]
    unstable = {k for k, state in states if state is True}
    stable = {k for k, state in states if state is False} - unstable
    k_unstable = max(unstable, default=math.nan)
    above = stable if not unstable else {k for k in stable if k > k_unstable}
    k_stable = min(above, default=math.nan)
    low = -math.inf if math.isnan(k_unstable) else k_unstable
    high = math.inf if math.isnan(k_stable) else k_stable
    failed = {k for k, state in states if state is None} - unstable - stable
    return OnsetBracket(
        k_stable=k_stable,
        k_unstable=k_unstable,
        failed=tuple(sorted(k for k in failed if low < k < high)),
        islands=tuple(sorted(stable - above)),
    )


def refinement_points(bracket: OnsetBracket, tolerance: float, count: int = 1) -> list[float]:
    """Give the k* to run next: ``count`` values that divide the bracket evenly.

    Parameters
    ----------
    bracket : OnsetBracket
    tolerance : float
        Relative width (k_stable - k_unstable)/k_unstable that is narrow enough (-).
    count : int
        Runs that go side by side.

    Returns
    -------
    list of float
        Rising values of four significant digits, so that they name cases; those that failed
        before are left out. Empty when the bracket is open or narrow enough.
    """
    if not bracket.closed or bracket.relative_width <= tolerance:
        return []
    middle = 0.5 * (bracket.k_unstable + bracket.k_stable)
    # Each failed run may be in the way of one division; the next finer one goes around it.
    for parts in range(count + 1, count + 2 + len(bracket.failed)):
        step = (bracket.k_stable - bracket.k_unstable) / parts
        points = {_rounded(bracket.k_unstable + i * step) for i in range(1, parts)}
        points -= set(bracket.failed)
        inside = [k for k in points if bracket.k_unstable < k < bracket.k_stable]
        if inside:
            return sorted(sorted(inside, key=lambda k: abs(k - middle))[:count])
    return []


def _rounded(value: float) -> float:
    """Round to the digits that a case's name carries."""
    return float(f"{value:.{_SIGNIFICANT_DIGITS}g}")


def bracket_of(summary: pd.DataFrame) -> OnsetBracket:
    """Bracket the onset of the one model of a summary."""
    return onset_bracket(
        summary["k_star"].tolist(),
        summary["regime"].tolist(),
        summary["twist_amplitude_deg"].tolist(),
    )


def onset_table(summary: pd.DataFrame) -> pd.DataFrame:
    """Return ``comparison/onset.csv``: the bracket of each model of a summary; none of no run."""
    rows = []
    for model, runs in summary.groupby("model", sort=False):
        bracket = bracket_of(runs)
        rows.append(
            {
                "model": model,
                "k_star_stable": bracket.k_stable,
                "k_star_unstable": bracket.k_unstable,
                "failed_inside": " ".join(f"{k:g}" for k in bracket.failed),
                "stable_below": " ".join(f"{k:g}" for k in bracket.islands),
            }
        )
    return pd.DataFrame(rows, columns=list(COLUMNS))


def with_speeds(onset: pd.DataFrame, k_star_given: float, speed: float) -> pd.DataFrame:
    """Return the brackets with the speeds at which the beam as given has these k*.

    k* is a stiffness over a dynamic pressure, so the beam has the k* of the onset at
    V sqrt(k*_given/k*). The polar is taken to be the same at that speed, whose Reynolds number is
    another.

    Parameters
    ----------
    onset
        :func:`onset_table`.
    k_star_given
        k* of the beam as given (-), at ``speed``.
    speed
        V (m/s).
    """
    return onset.assign(
        k_star_given=k_star_given,
        speed_stable=speed * np.sqrt(k_star_given / onset["k_star_stable"]),
        speed_unstable=speed * np.sqrt(k_star_given / onset["k_star_unstable"]),
    )
