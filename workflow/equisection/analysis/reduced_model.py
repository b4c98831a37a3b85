"""A model learnt from one release in the place of a sweep: growth over k*, and the onset.

The loads of a release (:mod:`..aerodynamics.learnt_loads`) are learnt three times, from records
that end five convective times apart. The middle one predicts the release at every other k*, with
any correction, since a correction changes masses and stiffnesses and not the loads under a given
motion. The farthest of the three from it, but no less than :data:`SMALLEST_BAND`, is the band of
the growth rate, and the onset is where that band crosses zero: an interval.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from equisection.aerodynamics.filled_polar import missing_angles
from equisection.aerodynamics.learnt_loads import TERMS, LearntLoads, learn
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.beam.section import Section
from equisection.motion.learnt_beams import LearntSwings
from equisection.motion.learnt_motion import LearntHistories, LearntSections
from equisection.verdict.growth import Growth, growth_window, growths_of

Floats = NDArray[np.float64]

#: Ends (c/V) of the records of the refits, that of the model itself in the middle.
ENDS = (40.0, 45.0, 50.0)
#: Smallest band of a growth rate (V/c): that to which predictions agree with CFD at best.
SMALLEST_BAND = 0.002
#: Duration (c/V) of a predicted release.
DURATION = 100.0
#: Duration (c/V) after which a release has come to its limit cycle.
LONG = 400.0
#: Part of the range of incidence seen by which a limit cycle may go beyond it.
BEYOND = 0.1
#: Range of k* of a release, over that of the onset that it predicts, in which it is trusted.
TRUSTED = (0.64, 1.05)
#: Place of the next release, over the k* of the predicted onset (-).
NEXT_RELEASE = 0.8

#: Columns of a prediction after k*.
COLUMNS = (
    "growth_rate",
    "growth_low",
    "growth_high",
    "frequency_strouhal",
    "frequency_low",
    "frequency_high",
    "twist_amplitude_deg",
    "extrapolated",
)


@dataclass(frozen=True, eq=False)
class ReducedModel:
    """Loads learnt from one release, with refits.

    Attributes
    ----------
    loads
        The model.
    refits
        Models learnt from other lengths of the record.
    learnt_from
        Name of the release.
    k_star
        Its k*.
    source
        Solver of the release in words.
    """

    loads: LearntLoads
    refits: tuple[LearntLoads, ...]
    learnt_from: str
    k_star: float
    source: str

    @property
    def words(self) -> str:
        """Return what the model is, for every table and figure with its numbers."""
        return words_of(self.source, self.k_star)

    @property
    def terms(self) -> tuple[str, ...]:
        """Return the terms of its loads in words."""
        return TERMS

    @property
    def missing_angles(self) -> list[float]:
        """Return the angles (deg) that the polar lacks where the release moves."""
        return missing_angles(self.loads.polar, self.loads.seen)


@dataclass(frozen=True)
class PredictedOnset:
    """Onset over k* by a model: the value, and the interval; NaN where there is none in reach."""

    k_star: float
    low: float
    high: float

    @property
    def known(self) -> bool:
        """Tell whether the value and both ends of the interval are known."""
        return all(map(math.isfinite, (self.k_star, self.low, self.high)))


def words_of(source: str, k_star: float) -> str:
    """Return what a model is that was learnt from a solver's release at a k*."""
    return f"model learnt from {source} at k* = {k_star:g}"


def learnt_model(history: ReferenceHistory, polar: Polar) -> ReducedModel:
    """Learn a model from a release.

    Parameters
    ----------
    history
        The release. Of a record shorter than 50 c/V the refits end at its end, and 2.5 and 5 c/V
        before.
    polar
        Steady polar by the same solver on the same mesh.

    Raises
    ------
    ResultFileError
        The release cannot be learnt from.
    """
    early, middle, late = ends_of_records(history.time)
    return ReducedModel(
        loads=learn(history, polar, middle),
        refits=tuple(learn(history, polar, end) for end in (early, late)),
        learnt_from=history.name,
        k_star=history.k_star,
        source=history.source,
    )


def ends_of_records(time: Floats) -> tuple[float, float, float]:
    """Return the ends (c/V) of a refit, of the model and of another refit, by a record's times.

    Of a record shorter than 50 c/V they are 5 c/V before its end, its end, and 2.5 before. The last
    sample may be one interval before 50.
    """
    last, step = float(time[-1]), float(np.diff(time[-2:]).sum())
    return ENDS if last + step >= ENDS[-1] - 1e-6 else (last - 5.0, last, last - 2.5)


def predicted(
    model: ReducedModel,
    k_star: Sequence[float],
    sections: Sequence[Section],
    windows: Sequence[tuple[float, float]] | None = None,
    start: tuple[float, float] = (0.0, 0.0),
) -> pd.DataFrame:
    """Return growth and frequency of a release at each k*.

    Parameters
    ----------
    model
        The model.
    k_star
        k* of the beams (-), shape (N,).
    sections
        Their sections in the flow, shape (N,).
    windows
        Part of each release (c/V) that growth is read from; by default that of
        :func:`equisection.verdict.growth.growth_window` of 100 c/V.
    start
        Twist (rad) and heave rate (over V) of the tip from which it is released.

    Returns
    -------
    pd.DataFrame
        ``k_star`` and :data:`COLUMNS`: rates in V/c, frequencies f c/V. The amplitude is half the
        range of the section's twist over the last part of the release. A release that leaves the
        polar before growth can be read has NaN numbers and an infinite growth rate.
        ``extrapolated`` tells that the release goes to an incidence that the model has not seen.
    """
    rows = [released(loads, sections, windows, start) for loads in (model.loads, *model.refits)]
    return prediction_of(k_star, rows, model.loads.seen, SMALLEST_BAND)


def prediction_of(
    k_star: Sequence[float],
    rows: Sequence[PredictedReleases],
    seen: tuple[float, float],
    smallest_band: float,
) -> pd.DataFrame:
    """Return the table of :func:`predicted` of releases with a model and with its refits.

    Parameters
    ----------
    k_star
        k* of the beams (-), shape (N,).
    rows
        Releases of the N beams with the model, then with each refit.
    seen
        Least and greatest incidence (rad) of what the model was learnt from.
    smallest_band
        Smallest band of a growth rate (V/c).
    """
    rates = np.array([row.rates for row in rows])
    frequencies = np.array([row.frequencies for row in rows])
    band = np.maximum(spread_of_refits(rates), smallest_band)
    spread = spread_of_refits(frequencies)
    away = np.isinf(rates).any(axis=0)  # a refit that runs away
    least, most = rows[0].farthest.T
    return pd.DataFrame(
        {
            "k_star": np.asarray(k_star, dtype=float),
            "growth_rate": rates[0],
            "growth_low": rates[0] - band,
            "growth_high": np.where(away, np.inf, rates[0] + band),
            "frequency_strouhal": frequencies[0],
            "frequency_low": frequencies[0] - spread,
            "frequency_high": frequencies[0] + spread,
            "twist_amplitude_deg": rows[0].amplitudes_deg,
            "extrapolated": (least < seen[0]) | (most > seen[1]),
        }
    )


def spread_of_refits(values: Floats) -> Floats:
    """Return the largest finite distance of refits (1, 2, ...) from the model (0), shape (N,)."""
    with np.errstate(invalid="ignore"):  # infinite rates have no distance
        distance = np.abs(values - values[0])
    known: Floats = np.where(np.isfinite(distance), distance, 0.0)
    return np.asarray(known.max(axis=0))


@dataclass(frozen=True, eq=False)
class PredictedReleases:
    """Releases of N sections or beams with one model of the loads, and their growth.

    Attributes
    ----------
    time
        s (c/V), shape (n,).
    twist
        Twist (rad), shape (n, N).
    farthest
        Least and greatest incidence (rad), shape (N, 2).
    ends
        End of each history (c/V), shape (N,).
    growths, windows
        Growth of each, and the window that it is read from (c/V), shape (N, 2).
    """

    time: Floats
    twist: Floats
    farthest: Floats
    ends: Floats
    growths: list[Growth]
    windows: Floats

    @property
    def rates(self) -> Floats:
        """Growth rates (V/c), infinite where the release left the polar at once."""
        left = self.ends < self.time[-1]
        found = np.array([growth.rate for growth in self.growths])
        return np.where(np.isnan(found) & left, np.inf, found)

    @property
    def frequencies(self) -> Floats:
        """Frequencies f c/V."""
        return np.array([growth.frequency for growth in self.growths])

    @property
    def amplitudes_deg(self) -> Floats:
        """Half the range of the twist (deg) over the last third of each window."""
        found = []
        for lane, (start, end) in enumerate(self.windows):
            late = (self.time >= end - (end - start) / 3.0) & (self.time <= end)
            twist = self.twist[late, lane]
            found.append(0.5 * math.degrees(float(np.ptp(twist))) if twist.size else math.nan)
        return np.array(found)


def released(
    loads: LearntLoads,
    sections: Sequence[Section],
    windows: Sequence[tuple[float, float]] | None,
    start: tuple[float, float] = (0.0, 0.0),
) -> PredictedReleases:
    """Return releases of sections with learnt loads (:func:`predicted` has the parameters)."""
    natural = np.array([section.uncoupled_frequencies for section in sections])
    spans = windows_of(natural, windows)
    histories = LearntSections(sections, loads).released(float(spans[:, 1].max()), start=start)
    records = np.array([histories.twist.T, histories.deflection.T])
    return with_growth(histories, records, histories.twist, natural, spans)


def windows_of(natural: Floats, windows: Sequence[tuple[float, float]] | None) -> Floats:
    """Return the windows (c/V) that growth is read from, shape (N, 2): those given, or the usual.

    ``natural`` are frequencies f c/V, that of the pitch first, shape (N, W).
    """
    if windows is None:
        return np.array([growth_window(DURATION, float(pitch)) for pitch in natural[:, 0]])
    return np.array(windows, dtype=float)


def with_growth(
    run: LearntHistories | LearntSwings,
    records: Floats,
    twist: Floats,
    natural: Floats,
    windows: Floats,
) -> PredictedReleases:
    """Return releases with their growth, read up to their ends (:class:`PredictedReleases`).

    ``records`` (C, N, n) and ``natural`` (N, W) are those of
    :func:`equisection.verdict.growth.growths_of`, ``twist`` (n, N) is that of section or tip.
    """
    spans = np.stack([windows[:, 0], np.minimum(windows[:, 1], run.ends)], axis=1)
    growths = growths_of(run.time, np.nan_to_num(records), natural, spans)
    return PredictedReleases(run.time, twist, run.farthest, run.ends, growths, spans)


def limit_cycles(
    loads: LearntLoads,
    sections: Sequence[Section],
    duration: float = LONG,
    start: tuple[float, float] = (0.0, 0.0),
) -> pd.DataFrame:
    """Return the amplitude that a release comes to in the end, of each section.

    A model knows the amplitudes that it has been learnt from. So it is learnt from the whole of a
    release that grows (:func:`equisection.aerodynamics.learnt_loads.learn`), and what goes beyond
    is marked.

    Parameters
    ----------
    loads
        The learnt loads.
    sections
        Sections in the flow, shape (N,).
    duration
        Time after which the amplitude is read (c/V).
    start
        Twist (rad) and heave rate (over V) of the tip from which they are released.

    Returns
    -------
    pd.DataFrame
        ``twist_amplitude_deg``, half the range of the twist over its last two periods; NaN
        where the motion leaves the polar. ``extrapolated``: the incidence goes more than
        :data:`BEYOND` outside what the model has seen.
    """
    histories = LearntSections(sections, loads).released(duration, start=start)
    least, most = histories.farthest.T
    amplitudes = []
    for lane, section in enumerate(sections):
        late = histories.time > duration - 2.0 / section.uncoupled_frequencies[0]
        swing = float(np.ptp(histories.twist[late, lane]))
        amplitudes.append(0.5 * math.degrees(swing))
    low, high = loads.seen
    margin = BEYOND * (high - low)
    return pd.DataFrame(
        {
            "twist_amplitude_deg": amplitudes,
            "extrapolated": ~((least >= low - margin) & (most <= high + margin)),
        }
    )


def onset_of(k_star: Sequence[float], growth_rate: Sequence[float]) -> float:
    """Return the k* of the onset: the last zero of the growth rate on the way up, interpolated.

    Parameters
    ----------
    k_star
        k*, ascending, shape (n,).
    growth_rate
        Growth rates (V/c), shape (n,); infinite of a motion that ran away, NaN of one unknown.

    Returns
    -------
    float
        NaN where all are stable, all unstable, or those above the last unstable one are unknown.
    """
    k, rate = np.asarray(k_star, dtype=float), np.asarray(growth_rate, dtype=float)
    unstable = np.flatnonzero(rate > 0.0)
    if not unstable.size or unstable[-1] + 1 == k.size:
        return math.nan
    low = int(unstable[-1])
    high = low + 1
    if not math.isfinite(rate[high]):
        return math.nan
    part = 0.5 if math.isinf(rate[low]) else rate[low] / (rate[low] - rate[high])
    return float(k[low] + part * (k[high] - k[low]))


def predicted_onset(prediction: pd.DataFrame) -> PredictedOnset:
    """Return the onset that a prediction has, with the interval where its band crosses zero."""
    k_star = prediction["k_star"].to_numpy()
    return PredictedOnset(
        *(
            onset_of(k_star, prediction[name].to_numpy())
            for name in ("growth_rate", "growth_low", "growth_high")
        )
    )


def next_release(learnt_at: float, onset: PredictedOnset) -> float | None:
    """Return the k* to release at next, or None where the model is near enough to the onset.

    A model that was learnt far from the onset that it predicts is not to be trusted; the next
    release is at 0.8 of that onset, where the motion grows and says most.

    Parameters
    ----------
    learnt_at
        k* of the release that the model was learnt from.
    onset
        The onset that it predicts.
    """
    if not math.isfinite(onset.k_star):
        return None
    if TRUSTED[0] <= learnt_at / onset.k_star <= TRUSTED[1]:
        return None
    return float(f"{NEXT_RELEASE * onset.k_star:.4g}")
