"""Numbers that describe the end of a history; nothing is decided here."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from equisection.verdict.cycles import Array, Cycles, find_cycles, peak_to_peak
from equisection.verdict.trend import Trend, exponential_trend
from equisection.verdict.verdict import Criteria

# Error of a cycle's amplitude in standard deviations of the noise: five extrema, each the top
# of a parabola through three or more samples.
_AMPLITUDE_NOISE = 0.5
# An oscillation has grown when it is this many times what it was.
GROWN = 1.1
# A rate goes on undiminished when it keeps this part of what it was before.
UNDIMINISHED = 0.8
# A load that sets in and stays moves the twist three times as far in the second half of the time
# as in the first, an oscillation less far; an exponential departure further in the end.
RUNS_AWAY = 4.0
# A release swings from rest to about twice its equilibrium, and less far from then on: a half swing
# of more than this many times all before it is no part of that.
DEPARTS = 2.0
# Creep of less than this part of the steadiness, per window, is no creep.
_NEGLIGIBLE_CREEP = 0.25
# Largest of some hundred samples of white noise, in standard deviations.
_LARGEST_NOISE = 4.0
# A range of less than this part of what counts as an oscillation is rounding.
_UNMOVED = 1e-6
# The oscillation has died when no extremum stands out for this many periods.
_SILENT_PERIODS = 1.5


@dataclass(frozen=True)
class Observation:
    """A history with its cycles, seen through the window of the last periods.

    Attributes
    ----------
    time, twist, deflection : ndarray, shape (n,)
        s (c/V), twist (rad), deflection (chords).
    cycles : Cycles
        Cycles of the twist.
    criteria : Criteria
    natural_frequency : float
        Hint (f c/V) or NaN.
    """

    time: Array
    twist: Array
    deflection: Array
    cycles: Cycles
    criteria: Criteria
    natural_frequency: float

    @cached_property
    def first_judged(self) -> int:
        """Index of the first amplitude after the discarded transient."""
        after = float(self.time[0]) + self.criteria.discard_time
        return int(np.searchsorted(self.cycles.amplitude_time, after))

    @cached_property
    def available(self) -> int:
        """Half cycles from the first judged extremum to the last."""
        judged = self.cycles.amplitude.size - self.first_judged
        return judged + 1 if judged > 0 else 0

    @cached_property
    def used(self) -> int:
        """Half cycles in the window: of `Criteria.periods` or, if fewer, all whole periods."""
        return min(2 * self.criteria.periods, self.available - self.available % 2)

    @property
    def enough(self) -> bool:
        """Tell whether the window has as many periods as are asked for."""
        return self.used == 2 * self.criteria.periods

    @cached_property
    def amplitude(self) -> Array:
        """Amplitudes (rad) of the cycles centred in the window."""
        return self.cycles.amplitude[-(self.used - 1) :] if self.used else np.empty(0)

    @cached_property
    def amplitude_time(self) -> Array:
        """Times (c/V) of these amplitudes."""
        return self.cycles.amplitude_time[-(self.used - 1) :] if self.used else np.empty(0)

    @property
    def amplitude_noise(self) -> float:
        """Standard deviation (rad) that noise gives an amplitude."""
        return _AMPLITUDE_NOISE * self.cycles.noise

    @property
    def fallen(self) -> bool:
        """Tell whether the amplitude has fallen from its largest by the factor that is enough."""
        largest = float(self.cycles.amplitude.max())
        return float(self.amplitude[-1]) * self.criteria.decay_factor <= largest

    @property
    def little_is_left(self) -> bool:
        """Tell whether a decaying amplitude has fallen far enough, or counts as none."""
        least = math.radians(self.criteria.settled_amplitude_deg)
        return self.fallen or float(self.amplitude[-1]) < least

    @property
    def has_moved(self) -> bool:
        """Tell whether twist or deflection has changed by enough to be told from nothing."""
        criteria = self.criteria
        least = (
            _UNMOVED * math.radians(criteria.settled_amplitude_deg),
            _UNMOVED * criteria.mean_tolerance_chords,
        )
        motions = (self.twist, self.deflection)
        return any(float(np.ptp(one)) > some for one, some in zip(motions, least, strict=True))

    @cached_property
    def ringing(self) -> bool:
        """Tell whether the twist still oscillates at the end of the record."""
        if self.cycles.time.size < 3:
            return False
        quiet = float(self.time[-1] - self.cycles.time[-1])
        return quiet < _SILENT_PERIODS * self.cycles.period(2 * self.criteria.periods)

    @cached_property
    def half_swings(self) -> Array:
        """Half the swings (rad) from the release to the first extremum, on, and to the end."""
        turns = np.concatenate((self.twist[:1], self.cycles.value, self.twist[-1:]))
        swings: Array = 0.5 * np.abs(np.diff(turns))
        return swings

    @property
    def swings_rise(self) -> bool:
        """Tell whether each of the last three half swings is larger, the last beyond the bound."""
        last = self.half_swings[-3:]
        bound = math.radians(self.criteria.growing_amplitude_deg)
        return bool(last.size == 3 and (np.diff(last) > 0.0).all() and last[-1] > bound)

    @property
    def faster_by(self) -> float:
        """Ratio of the twist's change in the second half of the time to that in the first (-).

        0 if the twist turned on its way.
        """
        if self.cycles.time.size:
            return 0.0
        first, middle, last = np.interp(
            np.linspace(self.time[0], self.time[-1], 3), self.time, self.twist
        )
        return float(abs(last - middle) / max(abs(middle - first), np.finfo(float).tiny))

    @cached_property
    def period(self) -> float:
        """Period of the twist (c/V): observed, else the hint's, else a guess from the record.

        The motion of a twist before it came to rest gives no period.
        """
        observed = self.cycles.period(max(self.used, 2))
        if self.natural_frequency > 0.0 and not (self.ringing and math.isfinite(observed)):
            return 1.0 / self.natural_frequency
        if math.isfinite(observed):
            return observed
        return float(self.time[-1] - self.time[0]) / (2 * self.criteria.periods)

    @cached_property
    def window(self) -> tuple[float, float]:
        """Start and end (c/V) of the window: whole periods of the twist, or as long a time."""
        if self.ringing and self.used:
            return float(self.cycles.time[-1 - self.used]), float(self.cycles.time[-1])
        end = float(self.time[-1])
        return max(float(self.time[0]), end - self.criteria.periods * self.period), end

    @cached_property
    def trend(self) -> Trend:
        """Trend of the amplitude over the window."""
        return self._trend(0, self.amplitude.size)

    @cached_property
    def halves(self) -> tuple[Trend, Trend]:
        """Trends over the first and the last half of the window."""
        middle = self.amplitude.size // 2
        return self._trend(0, middle + 1), self._trend(middle, self.amplitude.size)

    @property
    def since_transient(self) -> Array:
        """All judged amplitudes (rad)."""
        return self.cycles.amplitude[self.first_judged :]

    @property
    def time_since_transient(self) -> Array:
        """Times (c/V) of these amplitudes."""
        return self.cycles.amplitude_time[self.first_judged :]

    @cached_property
    def before(self) -> Array:
        """Amplitudes (rad) of the window before this one, or as much as there is of it."""
        judged = self.since_transient
        return judged[max(judged.size - 2 * self.amplitude.size, 0) : -self.amplitude.size]

    @property
    def long_before(self) -> Array:
        """Amplitudes (rad) of the two windows before this one, or as much as there is."""
        judged = self.since_transient
        return judged[max(judged.size - 3 * self.amplitude.size, 0) : -self.amplitude.size]

    @cached_property
    def trend_before(self) -> Trend:
        """Trend over the window before."""
        last = self.cycles.amplitude_time.size - self.amplitude.size
        at = self.cycles.amplitude_time[last - self.before.size : last]
        return exponential_trend(at, self.before, self.amplitude_noise)

    @property
    def window_distance(self) -> float:
        """Time (c/V) from the middle of the window before to that of this one."""
        at = self.cycles.amplitude_time
        size = self.amplitude.size
        return float(at[-size:].mean() - at[-size - self.before.size : -size].mean())

    @property
    def negligible_change(self) -> float:
        """Relative change of the amplitude over a window that counts as no change (-)."""
        return _NEGLIGIBLE_CREEP * self.criteria.steadiness

    @cached_property
    def creeps(self) -> bool:
        """Tell whether the amplitude changed at an undiminished rate over two windows.

        A limit cycle is approached ever more slowly. A motion that goes on at the same
        exponential rate, however small, approaches none.
        """
        if not (
            self.trend_before.clear(self.negligible_change)
            and self.trend.clear(self.negligible_change)
        ):
            return False
        return self.trend.growth_rate / self.trend_before.growth_rate > UNDIMINISHED

    def _trend(self, first: int, last: int) -> Trend:
        part = slice(first, last)
        return exponential_trend(
            self.amplitude_time[part], self.amplitude[part], self.amplitude_noise
        )

    @cached_property
    def spread(self) -> float:
        """Largest minus smallest amplitude of the window over their mean, less the noise's."""
        if self.amplitude.size == 0:
            return math.inf
        spread = float(np.ptp(self.amplitude)) - 4.0 * self.amplitude_noise
        return max(spread, 0.0) / float(np.mean(self.amplitude))

    @cached_property
    def half_range(self) -> float:
        """Half the largest minus the smallest twist (rad) in the window, less the noise's.

        The drift is part of it.
        """
        start = int(np.searchsorted(self.time, self.window[0]))
        half = 0.5 * float(np.ptp(self.twist[start:]))
        return max(half - _LARGEST_NOISE * self.cycles.noise, 0.0)

    @cached_property
    def deflection_amplitude(self) -> float:
        """Half peak-to-peak (chords) over the last period of the window."""
        end = self.window[1]
        start = max(end - self.period, float(self.time[0]))
        return 0.5 * peak_to_peak(self.time, self.deflection, start, end)


def observe(
    time: Array, twist: Array, deflection: Array, criteria: Criteria, natural_frequency: float
) -> Observation:
    """Take a history apart; arguments as in `judgement.assess`."""
    return Observation(
        time, twist, deflection, find_cycles(time, twist), criteria, natural_frequency
    )
