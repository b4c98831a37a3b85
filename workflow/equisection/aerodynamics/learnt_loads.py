r"""Unsteady loads learnt from one release: a steady polar, one lag, and polynomials of both.

With the incidence alpha = theta_0 + theta - w' at mid-chord, counted as a = alpha - theta_0, and a
lag x of it, x' = g (a - x) with h = a - x,

    c_m = c_m,polar(alpha) + B_m . T(a, theta', h) - (pi/64) theta'',
    c_l = c_l,polar(alpha) + B_l . T(a, theta', h) + (pi/2) (theta' - w''),
    T   = (theta', a theta', h, a h, h^2, a^2 h, a h^2, h^3).

The last terms are the apparent mass of a thin plate (Theodorsen, NACA Report 496, 1935). Every term
of T vanishes at rest, so that the steady loads are those of the polar. A linear model would not
do: a release sweeps the incidence over the bends of the polar.

B_m and B_l are found by linear least squares from the histories of loads and motion, for which
derivatives come from a quintic spline. They are bound by a ridge of 1e-4 on columns scaled to a
largest value of 1, and the rate g of the lag makes the rest smallest, that of the moment counting
for more than that of the lift. This is the identification of indicial functions with a state
(Leishman, *Principles of Helicopter Aerodynamics*, 2006, chapter 8) with the coefficients left
free, as in Volterra series of low order (Silva, J. Aircr. 30, 1993).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.aerodynamics.load_balance import load_balance
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.aerodynamics.unsteady_loads import APPARENT_INERTIA, APPARENT_MASS
from equisection.errors import ArgumentError, ResultFileError

Floats = NDArray[np.float64]

#: Time (c/V) after the release that is not learnt from: loads jump at the release.
LEARN_FROM = 3.0
#: Shortest record (c/V) that says enough.
SHORTEST_RECORD = 35.0
#: Longest interval of samples (c/V) whose derivatives are good enough.
LONGEST_INTERVAL = 0.25
TERMS = ("theta'", "a theta'", "h", "a h", "h^2", "a^2 h", "a h^2", "h^3")
RIDGE = 1e-4
#: End (c/V) of the part of a record whose motion is weighed against its loads.
CHECKED_UNTIL = 50.0
#: Smallest swing of the incidence in the last third of a record, over that in its first third (-).
SMALLEST_SWING = 0.02
_RECORDS = ("time", "twist", "deflection", "lift_coefficient", "moment_coefficient")
#: Weight of what the lift leaves, to that of the moment, in the search for the rate (-).
LIFT_WEIGHT = 0.3
_RATES = (0.05, 4.0)
_FIRST_RATES = 14


@dataclass(frozen=True, eq=False)
class LearntLoads:
    """Loads of a section, learnt from a release.

    Attributes
    ----------
    polar
        Steady coefficients.
    incidence_rad
        Rigid incidence theta_0 (rad) that the model was learnt at.
    rate
        g, rate of the lag (V/c).
    moment, lift
        B_m and B_l, shape (8,).
    residual_moment, residual_lift
        Standard deviation of what the model leaves, over that of what the polar and the apparent
        mass leave (-).
    seen
        Least and greatest incidence alpha (rad) of what it was learnt from.
    learnt_until
        End of the record (c/V).
    """

    polar: Polar
    incidence_rad: float
    rate: float
    moment: Floats
    lift: Floats
    residual_moment: float
    residual_lift: float
    seen: tuple[float, float]
    learnt_until: float

    def coefficients(self, a: Floats, twist_rate: Floats, lag: Floats) -> tuple[Floats, Floats]:
        """Return c_l and c_m about mid-chord without apparent mass; NaN beyond the polar.

        Parameters
        ----------
        a, twist_rate, lag
            alpha - theta_0 (rad), theta' and x (rad), shape (N,).
        """
        terms = terms_of(a, twist_rate, a - lag)
        alpha = self.incidence_rad + a
        return (
            self.polar.lift_coefficient(alpha) + self.lift @ terms,
            self.polar.moment_coefficient(alpha) + self.moment @ terms,
        )

    def slopes(self, a: float) -> tuple[Floats, Floats]:
        """Return the slopes of c_l and c_m by (a, theta', x) at rest at an incidence.

        At rest h = 0 and theta' = 0, so of T only theta', a theta', h, a h and a^2 h have a slope.
        """
        alpha = self.incidence_rad + a
        found = []
        for cubic, b in (
            (self.polar.lift_cubic, self.lift),
            (self.polar.moment_cubic, self.moment),
        ):
            by_lag = b[2] + a * b[3] + a * a * b[5]
            found.append(np.array([float(cubic(alpha, 1)) + by_lag, b[0] + a * b[1], -by_lag]))
        return found[0], found[1]


def terms_of(a: Floats, twist_rate: Floats, h: Floats) -> Floats:
    """Return T, shape (8, ...), of incidence a (rad), theta' and h (rad)."""
    ah = a * h
    return np.array([twist_rate, a * twist_rate, h, ah, h * h, a * ah, ah * h, h * h * h])


def lagged(signal: Floats, step: float, rate: float) -> Floats:
    """Return x of x' = g (u - x), exact for a signal u that is linear between samples.

    Parameters
    ----------
    signal
        u at even times, shape (n, ...); x starts at u.
    step
        Interval (c/V).
    rate
        g (V/c).
    """
    decay = math.exp(-rate * step)
    mean = (1.0 - decay) / (rate * step)
    found, _ = scipy.signal.lfilter(
        [1.0 - mean, mean - decay], [1.0, -decay], signal, axis=0, zi=mean * signal[:1]
    )
    return np.asarray(found)


@dataclass(frozen=True, eq=False)
class Lesson:
    """Motion and loads of one release, prepared for a fit at any rate of the lag.

    Attributes
    ----------
    step
        Interval of the samples (c/V).
    a, twist_rate
        Incidence (rad) without theta_0, and theta', shape (n,).
    lift, moment
        Loads that polar and apparent mass leave, shape (n,).
    used
        Samples that count, shape (n,).
    """

    step: float
    a: Floats
    twist_rate: Floats
    lift: Floats
    moment: Floats
    used: NDArray[np.bool_]

    @classmethod
    def of(cls, history: ReferenceHistory, polar: Polar, until: float) -> Lesson:
        """Prepare a history up to a time (c/V).

        Raises
        ------
        ResultFileError
            The history cannot be learnt from.
        """
        require_lesson(history.name, history.time)
        s, axis = history.time, history.section.axis_behind_mid_chord
        twist = scipy.interpolate.make_interp_spline(s, history.twist, 5)
        heave = scipy.interpolate.make_interp_spline(
            s, history.deflection + axis * history.twist, 5
        )
        a, rate = twist(s) - heave(s, 1), twist(s, 1)
        alpha = history.incidence_rad + a
        lift = history.lift_coefficient - polar.lift_coefficient(alpha)
        moment = history.moment_coefficient - polar.moment_coefficient(alpha)
        used = (s >= LEARN_FROM) & (s <= until * (1.0 + 1e-9)) & np.isfinite(moment)
        require_swing(history.name, a[used])  # what has settled is noise, balances with nothing
        require_consistent(history, polar)
        return cls(
            step=history.time_step,
            a=a,
            twist_rate=rate,
            lift=lift - APPARENT_MASS * (rate - heave(s, 2)),
            moment=moment + APPARENT_INERTIA * twist(s, 2),
            used=used,
        )

    def fitted(self, rate: float) -> tuple[Floats, Floats, float, float]:
        """Return B_m, B_l and their residuals at a rate of the lag (V/c)."""
        terms = terms_of(self.a, self.twist_rate, self.a - lagged(self.a, self.step, rate))
        wanted = np.stack([self.moment[self.used], self.lift[self.used]], axis=1)
        found, left = bound_fit(terms[:, self.used].T, wanted)
        return found[:, 0], found[:, 1], float(left[0]), float(left[1])


def learn(history: ReferenceHistory, polar: Polar, until: float = math.inf) -> LearntLoads:
    """Learn the loads of a section from a release.

    Parameters
    ----------
    history
        Motion and loads of the release.
    polar
        Steady polar by the same solver on the same mesh.
    until
        Part of the history that is used, from the release on (c/V).

    Raises
    ------
    ResultFileError
        The history is too short, has gaps, or is too coarse in time.
    """
    whole = polar.continued
    lesson = Lesson.of(history, whole, until)
    rate = rate_of_least(lesson.fitted)
    moment, lift, left_moment, left_lift = lesson.fitted(rate)
    seen = history.incidence_rad + lesson.a[lesson.used]
    return LearntLoads(
        polar=whole,
        incidence_rad=history.incidence_rad,
        rate=rate,
        moment=moment,
        lift=lift,
        residual_moment=left_moment,
        residual_lift=left_lift,
        seen=(float(seen.min()), float(seen.max())),
        learnt_until=min(until, float(history.time[-1])),
    )


def bound_fit(columns: Floats, wanted: Floats) -> tuple[Floats, Floats]:
    """Return coefficients by least squares with a ridge, and what they leave.

    Parameters
    ----------
    columns
        Terms, shape (n, T), bound by :data:`RIDGE` when scaled to a largest value of 1.
    wanted
        Loads, shape (n,) or (n, K).

    Returns
    -------
    tuple
        Coefficients, shape (T,) or (T, K), and the standard deviation of what they leave over that
        of the loads (-), shape () or (K,).
    """
    scale = np.abs(columns).max(axis=0)
    scale[scale == 0.0] = 1.0
    terms = scale.size
    ridge = math.sqrt(RIDGE * len(columns)) * np.eye(terms)
    found, *_ = np.linalg.lstsq(
        np.vstack([columns / scale, ridge]),
        np.concatenate([wanted, np.zeros((terms, *wanted.shape[1:]))]),
        rcond=None,
    )
    found = (found.T / scale).T
    left = (wanted - columns @ found).std(axis=0) / np.maximum(wanted.std(axis=0), 1e-300)
    return found, left


def rate_of_least(fitted: Callable[[float], tuple[Floats, Floats, float, float]]) -> float:
    """Return the rate of a lag (V/c) that leaves least: the best of a grid, refined around it.

    ``fitted`` gives B_m, B_l and the residuals of moment and lift at a rate.
    """

    def misfit(rate: float) -> float:
        _, _, moment, lift = fitted(rate)
        return moment**2 + LIFT_WEIGHT * lift**2

    low, high = map(math.log, _RATES)
    grid = np.linspace(low, high, _FIRST_RATES)
    best = int(np.argmin([misfit(math.exp(value)) for value in grid]))
    around = (grid[max(best - 1, 0)], grid[min(best + 1, grid.size - 1)])
    log_rate = scipy.optimize.minimize_scalar(
        lambda value: misfit(math.exp(value)),
        bounds=around,
        method="bounded",
        options={"xatol": 1e-4},
    ).x
    return math.exp(float(log_rate))


def require_lesson(name: str, time: Floats, shortest: float = SHORTEST_RECORD) -> None:
    """Refuse a history that cannot be learnt from.

    Parameters
    ----------
    name
        Its name.
    time
        Its times (c/V), shape (n,).
    shortest
        Shortest record (c/V) that is learnt from.

    Raises
    ------
    ResultFileError
        It is too short, has gaps or uneven samples, or is too coarse in time. A sample stands for
        its interval: a solver that writes none at the end of 35 c/V has recorded 35 c/V.
    """
    steps = np.diff(time)
    step = float(np.median(steps)) if steps.size else 0.0
    length = float(time[-1] - time[0]) + step if time.size else 0.0
    if length < shortest * (1.0 - 1e-9):
        raise ResultFileError(
            f"{name}: a record of {length:.3g} c/V is too short to learn from; "
            f"{shortest:g} c/V or more are needed (unsteady.duration)"
        )
    if np.any(np.abs(steps - step) > 1e-3 * step):
        place = int(np.argmax(np.abs(steps - step)))
        raise ResultFileError(
            f"{name}: samples are {steps[place]:.4g} c/V apart at s = {time[place]:.4g} and "
            f"{step:.4g} elsewhere; a record to learn from has no gaps, and even samples"
        )
    if step > LONGEST_INTERVAL:
        raise ResultFileError(
            f"{name}: samples are {step:.3g} c/V apart; at most {LONGEST_INTERVAL:g} are "
            "allowed in a record to learn from (unsteady.output_interval)"
        )


def require_swing(name: str, a: Floats) -> None:
    """Refuse a motion that settles before it has said anything of its growth.

    Parameters
    ----------
    name
        Name of the release.
    a
        Incidence (rad) of what is learnt from: of a section (n,), or of the strips of a beam
        (n, S), of which the strip that swings most counts.

    Raises
    ------
    ResultFileError
        It has settled.
    """
    first, _, last = np.array_split(a, 3)
    early, late = (float(np.ptp(part, axis=0).max()) for part in (first, last))
    if early == 0.0 or late < SMALLEST_SWING * early:
        raise ResultFileError(
            f"{name}: the motion has settled: the incidence swings by "
            f"{math.degrees(late):.2g} deg at the end of what is learnt from, "
            f"{math.degrees(early):.2g} deg at its begin ({100 * SMALLEST_SWING:g} % or more are "
            "wanted); learn from a softer beam (rom.learn_from), or with less damping"
        )


def require_consistent(history: ReferenceHistory, polar: Polar) -> None:
    """Refuse a history whose motion does not follow from its loads and the section.

    Degrees taken for radians, a moment about another point, or properties of another section show
    in the balance of motion and loads (:mod:`equisection.aerodynamics.load_balance`). What has
    settled after :data:`CHECKED_UNTIL` is noise, and is not weighed.

    Raises
    ------
    ResultFileError
        The balance leaves more of a load unexplained than is allowed.
    """
    checked = (history.time >= LEARN_FROM) & (history.time <= CHECKED_UNTIL)
    part = replace(history, **{name: getattr(history, name)[checked] for name in _RECORDS})
    axis = history.section.axis_behind_mid_chord
    moment = part.moment_coefficient
    if axis:
        heave = np.gradient(part.deflection + axis * part.twist, part.time_step)
        normal = polar.normal_rise(history.incidence_rad + part.twist - heave)
        moment = moment + axis * (part.lift_coefficient + normal)
    try:
        balance = load_balance(part, moment)
    except ArgumentError as error:
        raise ResultFileError(f"{history.name}: {error}") from error
    if not balance.is_explained:
        raise ResultFileError(
            f"{history.name}: the recorded motion does not follow from the recorded loads: "
            f"{balance.text}"
        )
