r"""Growth rate of a coupled motion: twist and deflection fitted together, with a standard error.

A released section swings in two motions at once, a pitch and a heave, each of which shows in the
twist and in the deflection; a beam has a heave for each bending mode. Each record is taken to be

    x(s) = c_x + Re[sum_j a_xj exp(lambda_j (s - s_0))],    lambda_j = sigma_j + i omega_j,

with rates that the records share (damped harmonics with common poles, as in Prony's method and in
experimental modal analysis). Constants and complex amplitudes are linear; the rates are found by
variable projection (Golub and Pereyra, SIAM J. Numer. Anal. 10, 1973) with Kaufman's Jacobian and
the damping of Levenberg and Marquardt. An envelope that is read off the twist alone shows the beat
of two motions as growth or decay.

What the waves leave is no white noise but bends, harmonics and further modes, with a memory of
about a period. So the standard error is that of a jackknife which leaves out a period at a time
(Kuensch, Ann. Statist. 17, 1989), each to first order. It rests on few periods, so the interval is
that of Student's distribution with as many degrees of freedom as there are periods, less one.

A rate that drifts within the window may be that of a beat with a motion which the fit does not have
(:mod:`equisection.verdict.beats`). Its standard error is then so large that its sign is not known.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from equisection.verdict.beats import UNKNOWN_DRIFT, Drift
from equisection.verdict.cycles import Array

#: Time (c/V) after the release that is left out: the flow around the body has to form first.
AFTER_RELEASE = 10.0
#: Longest part of a record that is fitted, its last periods of the pitch.
MOST_PERIODS = 8.0
#: Shortest part from which two motions can be told apart (periods of the pitch).
FEWEST_PERIODS = 2.5
#: Fewest periods from which the sign of a growth is judged; in fewer the release is still seen.
DECISIVE_PERIODS = 4
#: Confidence of the interval of a growth, two-sided (-).
CONFIDENCE = 0.95
#: Samples of a period of the faster motion that are enough.
_SAMPLES_A_PERIOD = 12
#: Part of the twist's variation that the waves may leave; more, and the window has beats in it.
LARGEST_RESIDUE = 0.2
_FEWEST_SAMPLES = 40
_STEPS = 60
# Difference of the frequencies, of one, below which two windows show the same motion.
_SAME_MOTION = 0.2
_SMALL_STEP = 1e-6
# Bounds of the search: growth rates (V/c), frequencies as parts of the natural ones.
_GROWTH_RANGE = (-0.3, 0.25)
_FREQUENCY_RANGE = (0.5, 1.8)


@dataclass(frozen=True)
class Growth:
    """Growth of the motion that makes most of the twist, in the last part of a record.

    Attributes
    ----------
    rate
        sigma (V/c); NaN where the record is too short to tell.
    standard_error
        Its standard error (V/c), without that of a beat.
    frequency
        f c/V of that motion.
    start, end
        The window (c/V).
    residue
        Part of the twist's variation that the waves leave (-).
    nearest
        Distance of its frequency to that of the nearest other motion (f c/V).
    periods
        Periods that the standard error rests on.
    by_amplitude
        True of a rate that was read off the twist's amplitude alone.
    drift, drift_of_all
        Drift of the rate over the window, and over the whole record where that is longer.
    """

    rate: float = math.nan
    standard_error: float = math.nan
    frequency: float = math.nan
    start: float = math.nan
    end: float = math.nan
    residue: float = math.nan
    nearest: float = math.nan
    periods: int = 0
    by_amplitude: bool = False
    drift: Drift = UNKNOWN_DRIFT
    drift_of_all: Drift = UNKNOWN_DRIFT

    @property
    def interval(self) -> tuple[float, float]:
        """Lower and upper end of the rate (V/c) with a confidence of :data:`CONFIDENCE`."""
        if self.periods < 2:
            return math.nan, math.nan
        half = _errors(self.periods) * self.error
        return self.rate - half, self.rate + half

    @property
    def error(self) -> float:
        """Standard error (V/c) with all of a decay that may be a part of a beat.

        A growth changes with its amplitude, too, and calls no speed stable: it has no more.
        """
        if not (self.beats and self.rate < 0.0):
            return self.standard_error
        return self.standard_error + abs(self.rate) / _errors(self.periods)

    @property
    def sign(self) -> int:
        """Sign of the rate, 0 if its interval holds both."""
        low, high = self.interval
        return int(low > 0.0) - int(high < 0.0)

    @property
    def beats(self) -> bool:
        """Tell whether the motion beats with one that the fit does not have."""
        by_chance = self.drift_of_all.is_surely_slow
        return (self.drift.is_of_loads and not by_chance) or self.drift_of_all.is_surely_fast

    @property
    def stays(self) -> bool:
        """Tell whether the rate stays what it is, as far as is known, so that a run may end."""
        by_chance = self.drift_of_all.is_surely_slow
        return not self.beats and (by_chance or not self.drift.is_fast)

    @property
    def may_beat(self) -> bool:
        """Tell whether there may be a motion that the fit does not have."""
        return math.isfinite(self.drift.change)

    @property
    def drift_in_words(self) -> str:
        """Drift that keeps the rate from staying, in words."""
        is_short = self.drift.is_of_loads or not self.drift_of_all.is_surely_fast
        return (self.drift if is_short else self.drift_of_all).words

    @property
    def decides(self) -> bool:
        """Tell whether the waves are the motion, over periods enough to judge its sign by."""
        return self.residue <= LARGEST_RESIDUE and self.periods >= DECISIVE_PERIODS

    @property
    def words(self) -> str:
        """Rate with the half-width of its interval, in words."""
        low, high = self.interval
        return f"growth {self.rate:+.4f} +- {0.5 * (high - low):.4f} V/c"

    @property
    def note(self) -> str:
        """Warning about how the rate was read, or about beats in its window; or an empty text."""
        if self.by_amplitude:
            return "read off the twist's amplitude alone, in which two motions beat"
        if self.residue > LARGEST_RESIDUE:
            return (
                f"beats in the window: the fitted waves leave {100 * self.residue:.0f} % of the "
                "twist's variation"
            )
        if self.beats and self.rate < 0.0:
            return f"no sign by a beat: {self.drift_in_words}"
        if self.nearest * (self.end - self.start) < 1.0:
            return "the window is shorter than a beat with the nearest other motion"
        return ""


def _errors(periods: int) -> float:
    """Return the half-width of the interval in standard errors that rest on so many periods."""
    return float(scipy.special.stdtrit(periods - 1, 0.5 + 0.5 * CONFIDENCE))


#: Growth of a record that does not tell it.
NO_GROWTH = Growth()


def growth_window(end: float, pitch_frequency: float) -> tuple[float, float]:
    """Return the part (c/V) of a record that is fitted: its last periods, without the release.

    Parameters
    ----------
    end
        End of the record (c/V).
    pitch_frequency
        Natural frequency f c/V of the pitch.
    """
    return max(AFTER_RELEASE, end - MOST_PERIODS / pitch_frequency), end


def growth_of(
    time: ArrayLike,
    records: ArrayLike,
    frequencies: ArrayLike,
    window: tuple[float, float] | None = None,
) -> Growth:
    """Growth of one motion (:func:`growths_of`), over the window of :func:`growth_window`.

    Parameters
    ----------
    time
        s (c/V), shape (n,).
    records
        Twist first, then deflection or further amplitudes, shape (C, n).
    frequencies
        Natural frequencies f c/V, that of the pitch first, shape (W,).
    """
    s, natural = np.asarray(time, dtype=float), np.asarray(frequencies, dtype=float)
    if not s.size:
        return NO_GROWTH
    return growths_of(
        s,
        np.asarray(records, dtype=float)[:, None],
        natural[None],
        [window or growth_window(float(s[-1]), float(natural[0]))],
    )[0]


def growths_of(
    time: Array,
    records: Array,
    frequencies: ArrayLike,
    windows: ArrayLike,
    *,
    drifts: bool = False,
) -> list[Growth]:
    """Growth of N motions at the same times.

    Parameters
    ----------
    time
        s (c/V), shape (n,).
    records
        Twist first, then deflection or further amplitudes, in any unit, shape (C, N, n).
    frequencies
        Natural frequencies f c/V of the W motions that swing, that of the pitch first, shape
        (N, W). Each is looked for near its own.
    windows
        Start and end of each window (c/V), shape (N, 2).
    drifts
        Determine the drift of each rate, too, by which a beat is told.
    """
    natural = 2.0 * math.pi * np.asarray(frequencies, dtype=float)
    spans = np.asarray(windows, dtype=float)
    found = [NO_GROWTH] * len(natural)
    shortest = 2.0 * math.pi * FEWEST_PERIODS / natural[:, 0]
    lanes = np.flatnonzero(spans[:, 1] - spans[:, 0] >= shortest)
    if lanes.size and time.size > 1:
        fit = _Fit.of(time, records[:, lanes], spans[lanes], natural[lanes])
        for lane, growth in zip(lanes.tolist(), fit.searched(drifts=drifts), strict=True):
            found[lane] = growth
    return found


def growths_with_drifts(
    time: Array, records: Array, frequencies: ArrayLike, windows: ArrayLike
) -> list[Growth]:
    """Growth of N motions with its drift, that of a decay also over the whole record."""
    natural, spans = np.asarray(frequencies, dtype=float), np.asarray(windows, dtype=float)
    found = growths_of(time, records, natural, spans, drifts=True)
    longer = [
        lane for lane, one in enumerate(found) if one.rate < 0.0 and one.start > AFTER_RELEASE
    ]
    if not longer:
        return found
    spans = np.column_stack((np.full(len(longer), AFTER_RELEASE), spans[longer, 1]))
    of_all = growths_of(time, records[:, longer], natural[longer], spans, drifts=True)
    for lane, whole in zip(longer, of_all, strict=True):
        if abs(whole.frequency - found[lane].frequency) < _SAME_MOTION * whole.frequency:
            found[lane] = replace(found[lane], drift_of_all=whole.drift)
    return found


@dataclass(frozen=True)
class _Fit:
    """Samples of N motions, each over its own window.

    ``at`` (N, n) are times from the middle of each window (c/V), ``values`` (N, n, C) the records
    over their standard deviations, ``natural`` (N, W) the natural frequencies (rad per c/V).
    Rates are (N, 2 W): sigma and omega of each motion in turn.
    """

    at: Array
    values: Array
    spans: Array
    natural: Array

    @classmethod
    def of(cls, time: Array, records: Array, spans: Array, natural: Array) -> _Fit:
        """Sample records evenly over their windows."""
        periods = (spans[:, 1:] - spans[:, :1]) * natural / (2.0 * math.pi)
        count = max(int(periods.max() * _SAMPLES_A_PERIOD), _FEWEST_SAMPLES)
        share = np.linspace(0.0, 1.0, count)
        at = spans[:, :1] + (spans[:, 1:] - spans[:, :1]) * share
        values = np.stack(
            [
                [np.interp(t, time, one) for t, one in zip(at, record, strict=True)]
                for record in records
            ],
            axis=2,
        )
        scale = np.maximum(values.std(axis=1, keepdims=True), np.finfo(float).tiny)
        values = (values - values.mean(axis=1, keepdims=True)) / scale
        return cls(at - spans.mean(axis=1, keepdims=True), values, spans, natural)

    def searched(self, *, drifts: bool) -> list[Growth]:
        """Return the best of two searches from near the natural frequencies."""
        best, cost = np.empty(0), np.full(len(self.natural), np.inf)
        for growth, others, nearness in ((0.0, -0.02, 0.93), (0.02, -0.08, 1.05)):
            start = np.repeat(self.natural, 2, axis=1)
            start[:, ::2] = others
            start[:, 0] = growth
            start[:, 1] *= nearness
            rates, left = self._refined(start)
            best = np.where((left < cost)[:, None], rates, best) if best.size else rates
            cost = np.minimum(left, cost)
        found = self._described(best)
        return self._with_drift(best, found) if drifts else found

    def _of(self, lanes: NDArray[np.intp]) -> _Fit:
        """Return the fit of some lanes alone."""
        return _Fit(self.at[lanes], self.values[lanes], self.spans[lanes], self.natural[lanes])

    def _refined(self, start: Array) -> tuple[Array, Array]:
        """Follow Levenberg and Marquardt in all lanes at once, each until it moves no more."""
        found, costs = start.copy(), np.full(len(start), np.inf)
        lanes, fit, rates = np.arange(len(start)), self, start
        damping = np.full(len(start), 1e-2)
        residual, jacobian = fit._projected(rates)
        cost = np.sum(residual**2, axis=(1, 2))
        eye = np.eye(start.shape[1])
        for _ in range(_STEPS):
            flat = jacobian.reshape(len(rates), -1, rates.shape[1])
            matrix = np.swapaxes(flat, 1, 2) @ flat
            slope = np.swapaxes(flat, 1, 2) @ residual.reshape(len(rates), -1, 1)
            damped = matrix + damping[:, None, None] * (matrix * eye) + 1e-12 * eye
            tried = fit._inside(rates - np.linalg.solve(damped, slope)[..., 0])
            residual_tried, jacobian_tried = fit._projected(tried)
            cost_tried = np.sum(residual_tried**2, axis=(1, 2))
            better = cost_tried < cost
            moved = np.abs(tried - rates).max(axis=1)
            rates = np.where(better[:, None], tried, rates)
            residual = np.where(better[:, None, None], residual_tried, residual)
            jacobian = np.where(better[:, None, None, None], jacobian_tried, jacobian)
            cost = np.where(better, cost_tried, cost)
            damping = np.clip(np.where(better, damping * 0.3, damping * 4.0), 1e-7, 1e7)
            found[lanes], costs[lanes] = rates, cost
            going = np.flatnonzero(moved > _SMALL_STEP)
            if not going.size:
                break
            if going.size < 0.7 * lanes.size:
                lanes, rates = lanes[going], rates[going]
                damping, cost = damping[going], cost[going]
                residual, jacobian, fit = residual[going], jacobian[going], fit._of(going)
        return found, costs

    def _inside(self, rates: Array) -> Array:
        """Return rates inside the bounds of the search."""
        low, high = (
            np.stack([np.full_like(self.natural, sigma), omega * self.natural], axis=2)
            for sigma, omega in zip(_GROWTH_RANGE, _FREQUENCY_RANGE, strict=True)
        )
        return np.clip(rates, low.reshape(rates.shape), high.reshape(rates.shape))

    def _basis(self, rates: Array) -> Array:
        """Return constant, and cosine and sine of each wave, shape (N, n, 1 + 2 W)."""
        waves = []
        for sigma, omega in zip(rates.T[::2], rates.T[1::2], strict=True):
            envelope = np.exp(np.clip(sigma[:, None] * self.at, -30.0, 30.0))
            phase = omega[:, None] * self.at
            waves += [envelope * np.cos(phase), envelope * np.sin(phase)]
        return np.stack([np.ones_like(self.at), *waves], axis=2)

    def _of_most_twist(self, rates: Array) -> NDArray[np.intp]:
        """Return the wave of each lane that makes most of the twist."""
        basis = self._basis(rates)
        weights = (np.linalg.pinv(basis) @ self.values[..., :1])[..., 0]
        sizes = [
            np.std((basis * weights[:, None])[..., first : first + 2].sum(axis=2), axis=1)
            for first in range(1, basis.shape[2], 2)
        ]
        return np.asarray(np.argmax(sizes, axis=0), dtype=np.intp)

    def _projected(self, rates: Array, *, drifts: bool = False) -> tuple[Array, Array]:
        """Return residual (N, n, C) and Jacobian (N, n, C, 2 W), linear coefficients eliminated.

        With ``drifts`` the Jacobian is that of the rates and then of their drifts (N, n, C, 4 W).
        """
        basis = self._basis(rates)
        transposed = np.swapaxes(basis, 1, 2)
        gram = transposed @ basis
        gram = gram + 1e-13 * np.trace(gram, axis1=1, axis2=2)[:, None, None] * np.eye(len(gram[0]))
        weights = np.linalg.solve(gram, transposed @ self.values)
        columns = []
        for first in range(1, basis.shape[2], 2):
            cos, sin = basis[..., first, None], basis[..., first + 1, None]
            a, b = weights[:, None, first], weights[:, None, first + 1]
            columns += [cos * a + sin * b, cos * b - sin * a]
        raw = self.at[..., None, None] * np.stack(columns, axis=3)
        if drifts:  # exp(lambda s + mu s^2/2)
            raw = np.concatenate((raw, 0.5 * self.at[..., None, None] * raw), axis=3)
        flat = raw.reshape(*raw.shape[:2], -1)
        left = flat - basis @ np.linalg.solve(gram, transposed @ flat)
        return self.values - basis @ weights, -left.reshape(raw.shape)

    def _described(self, rates: Array) -> list[Growth]:
        residual, jacobian = self._projected(rates)
        omega, chosen = rates[:, 1::2] / (2.0 * math.pi), self._of_most_twist(rates)
        length = self.at[:, -1] - self.at[:, 0]
        found = []
        for lane, wave in enumerate(chosen.tolist()):
            others = np.abs(np.delete(omega[lane], wave) - omega[lane, wave])
            periods = max(round(float(length[lane] * omega[lane, wave])), 2)
            errors = _jackknife(residual[lane], jacobian[lane], periods)
            found.append(
                Growth(
                    rate=float(rates[lane, 2 * wave]),
                    standard_error=errors[2 * wave],
                    frequency=float(omega[lane, wave]),
                    start=float(self.spans[lane, 0]),
                    end=float(self.spans[lane, 1]),
                    residue=float(residual[lane, :, 0].std()),
                    nearest=float(others.min(initial=np.inf)),
                    periods=periods,
                )
            )
        return found

    def _with_drift(self, rates: Array, found: list[Growth]) -> list[Growth]:
        """Return growths with the drift of their rates over the windows."""
        residual, jacobian = self._projected(rates, drifts=True)
        chosen = self._of_most_twist(rates).tolist()
        drifting = []
        for lane, (wave, growth) in enumerate(zip(chosen, found, strict=True)):
            length = growth.end - growth.start
            change, error = _drift(residual[lane], jacobian[lane], wave, growth.periods)
            omega = rates[lane, 2 * wave + 1] - self.natural[lane, wave]
            by_loads = math.hypot(growth.rate, omega)
            drift = Drift(growth.rate, change * length, error * length, by_loads)
            drifting.append(replace(growth, drift=drift))
        return drifting


def _drift(residual: Array, jacobian: Array, wave: int, periods: int) -> tuple[float, float]:
    """Return drift of the rate of a wave with standard error ((V/c)^2), to first order.

    Parameters
    ----------
    residual, jacobian
        Of one lane, shape (n, C) and (n, C, 4 W), of the rates and of their drifts.
    """
    waves = jacobian.shape[2] // 2
    first = waves + 2 * wave
    chosen = np.concatenate((jacobian[..., :waves], jacobian[..., first : first + 2]), axis=2)
    rows = chosen.reshape(-1, waves + 2)
    step = np.linalg.lstsq(rows, -residual.ravel(), rcond=None)[0]
    errors = _jackknife(residual + chosen @ step, chosen, periods)
    return math.hypot(*step[-2:]), math.hypot(*errors[-2:])


def _jackknife(residual: Array, jacobian: Array, periods: int) -> list[float]:
    """Return the standard errors of the rates of a lane, by leaving out one period at a time.

    Parameters
    ----------
    residual, jacobian
        Shape (n, C) and (n, C, 2 W).
    periods
        Number of periods.
    """
    rows = jacobian.reshape(len(jacobian), -1, jacobian.shape[2])
    first = np.linspace(0, len(rows), periods + 1)[:-1].astype(int)
    products = np.swapaxes(rows, 1, 2) @ np.concatenate((rows, residual[..., None]), axis=2)
    parts = np.add.reduceat(products, first)
    less = parts.sum(axis=0) - parts
    matrices = less[..., :-1] + 1e-12 * np.eye(rows.shape[2])
    shifts = np.linalg.solve(matrices, less[..., -1:])[..., 0]
    variance = (periods - 1) / periods * np.sum((shifts - shifts.mean(axis=0)) ** 2, axis=0)
    return [float(error) for error in np.sqrt(variance)]
