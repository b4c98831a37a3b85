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
from equisection.aerodynamics.learnt_loads import LearntLoads, learn
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.beam.section import Section
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
        return f"model learnt from {self.source} at k* = {self.k_star:g}"

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
    last = float(history.time[-1])
    early, middle, late = ENDS if last >= ENDS[-1] - 1e-6 else (last - 5.0, last, last - 2.5)
    return ReducedModel(
        loads=learn(history, polar, middle),
        refits=tuple(learn(history, polar, end) for end in (early, late)),
        learnt_from=history.name,
        k_star=history.k_star,
        source=history.source,
    )


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
    rows = [_Released.of(loads, sections, windows, start) for loads in (model.loads, *model.refits)]
    rates = np.array([row.rates for row in rows])
    frequencies = np.array([row.frequencies for row in rows])
    band = np.maximum(_spread(rates), SMALLEST_BAND)
    spread = _spread(frequencies)
    away = np.isinf(rates).any(axis=0)  # a refit that runs away
    least, most = rows[0].histories.farthest.T
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
            "extrapolated": (least < model.loads.seen[0]) | (most > model.loads.seen[1]),
        }
    )


def _spread(values: Floats) -> Floats:
    """Return the largest finite distance of refits (1, 2, ...) from the model (0), shape (N,)."""
    with np.errstate(invalid="ignore"):  # infinite rates have no distance
        distance = np.abs(values - values[0])
    known: Floats = np.where(np.isfinite(distance), distance, 0.0)
    return np.asarray(known.max(axis=0))


@dataclass(frozen=True, eq=False)
class _Released:
    """Releases of some sections with one model of the loads, and their growth."""

    histories: LearntHistories
    growths: list[Growth]
    windows: Floats

    @classmethod
    def of(
        cls,
        loads: LearntLoads,
        sections: Sequence[Section],
        windows: Sequence[tuple[float, float]] | None,
        start: tuple[float, float],
    ) -> _Released:
        natural = np.array([natural_frequencies(section) for section in sections])
        if windows is None:
            spans = np.array([growth_window(DURATION, pitch) for pitch, _ in natural])
        else:
            spans = np.array(windows, dtype=float)
        histories = LearntSections(sections, loads).released(float(spans[:, 1].max()), start=start)
        spans[:, 1] = np.minimum(spans[:, 1], histories.ends)
        growths = growths_of(
            histories.time,
            np.nan_to_num(np.array([histories.twist.T, histories.deflection.T])),
            natural,
            spans,
        )
        return cls(histories, growths, spans)

    @property
    def rates(self) -> Floats:
        """Growth rates (V/c), infinite where the release left the polar at once."""
        left = self.histories.ends < self.histories.time[-1]
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
            late = (self.histories.time >= end - (end - start) / 3.0) & (self.histories.time <= end)
            twist = self.histories.twist[late, lane]
            found.append(0.5 * math.degrees(float(np.ptp(twist))) if twist.size else math.nan)
        return np.array(found)


def limit_cycles(
    loads: LearntLoads, sections: Sequence[Section], duration: float = LONG
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

    Returns
    -------
    pd.DataFrame
        ``twist_amplitude_deg``, half the range of the twist over its last two periods; NaN
        where the motion leaves the polar. ``extrapolated``: the incidence goes more than
        :data:`BEYOND` outside what the model has seen.
    """
    histories = LearntSections(sections, loads).released(duration)
    least, most = histories.farthest.T
    amplitudes = []
    for lane, section in enumerate(sections):
        late = histories.time > duration - 2.0 / natural_frequencies(section)[0]
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


def natural_frequencies(section: Section) -> tuple[float, float]:
    """Return the uncoupled natural frequencies f c/V of pitch and heave of a section in a flow."""
    pitch = math.sqrt(section.torsional_stiffness / section.inertia)
    heave = math.sqrt(section.flexural_stiffness / section.mass)
    return pitch / (2.0 * math.pi), heave / (2.0 * math.pi)


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


def next_release(model: ReducedModel, onset: PredictedOnset) -> float | None:
    """Return the k* to release at next, or None where the model is near enough to the onset.

    A model that was learnt far from the onset that it predicts is not to be trusted; the next
    release is at 0.8 of that onset, where the motion grows and says most.
    """
    if not math.isfinite(onset.k_star):
        return None
    if TRUSTED[0] <= model.k_star / onset.k_star <= TRUSTED[1]:
        return None
    return float(f"{NEXT_RELEASE * onset.k_star:.4g}")
