"""Balance of a recorded motion against the recorded loads, by the equations of the section.

A section obeys (:mod:`equisection.beam.section`, in units of rho/2, V and c)

    m* w'' - S* theta'' + c_w* w' + k_w* w           = c_l,
    I* theta'' - S* w'' + c_theta* theta' + k* theta = c_m about the elastic axis.

Both sides are compared in their weak form, weighted with a window that moves along the record. By
parts the derivatives go over to the window, so that the record is not differentiated and its noise
not amplified. The rest r = (left side) - (load) is what the motion does not explain.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.beam.section import Section
from equisection.errors import ArgumentError

Floats = NDArray[np.float64]

#: Largest share of the variance of a load that a record may leave unexplained (-). Kept releases
#: of OpenFOAM leave 0.0005 or less; a load that is twice as large as it should be, 0.25 or more.
MOST_UNEXPLAINED = 0.05
#: Length of the window over the shorter natural period (-).
_WINDOW = 1.0
#: Fewest samples in the window, and fewest windows' lengths in a record.
FEWEST_SAMPLES, FEWEST_WINDOWS = 12, 2.0
#: Part of the unexplained share that a remedy has to remove (-).
_REMOVED = 0.9
#: Changes that leave up to so many times as much as the best one are named with it (-).
_AS_GOOD = 1.5
#: Difference from 1 from which a factor of a load is a mistake (-).
_FACTOR = 0.02
#: Factors that are mistaken units: name of what to change, by the factor that mends it.
LENGTHS = {0.5: "semi-chords taken for chords", 2.0: "chords taken for semi-chords"}
DISTANCES = LENGTHS | {
    1e-3: "millimetres taken for metres",
    1e3: "metres taken for millimetres",
}
ANGLES = {
    math.radians(1.0): "degrees taken for radians",
    math.degrees(1.0): "radians taken for degrees",
}
_FORCES = {
    0.5: "a coefficient over rho V^2/4, or of half the section",
    2.0: "a coefficient over rho V^2, or half of the section",
    4.0: "a moment over (2 b)^2 taken for one over b^2",
    0.25: "a moment over b^2 taken for one over (2 b)^2",
}


@dataclass(frozen=True)
class Motion:
    """Motion and loads over convective time, each of shape (n,): what is weighed.

    Attributes
    ----------
    interval
        Time between samples (c/V).
    deflection, twist
        w of the elastic axis (chords) and theta (rad).
    lift, moment
        c_l, and c_m about the elastic axis.
    """

    interval: float
    deflection: Floats
    twist: Floats
    lift: Floats
    moment: Floats


@dataclass(frozen=True)
class LoadBalance:
    """Agreement of motion and loads of a record.

    Attributes
    ----------
    lift, moment
        Share of the variance of c_l and of c_m that the motion leaves unexplained (-): 0 of a
        record without error, 1 of one without relation.
    growth
        Growth rate of the twist that no load of the record explains (V/c): d/(2 I*), with d the
        least-squares fit of r = d theta' to the rest of the moment. A damper that the section does
        not have makes it negative.
    energy
        Work of the loads that the motion does not show, over the sum of the absolute power of the
        loads (-).
    remedy
        What would explain the record, in words; empty where it is explained or nothing does.
    """

    lift: float
    moment: float
    growth: float
    energy: float
    remedy: str = ""

    @property
    def is_explained(self) -> bool:
        """Truth of both loads being explained within what is allowed."""
        return max(self.lift, self.moment) <= MOST_UNEXPLAINED

    @property
    def text(self) -> str:
        """The balance in one sentence."""
        shares = f"{100 * self.lift:.2g} % of the lift's and {100 * self.moment:.2g} % of the "
        shares += "moment's variance"
        if self.is_explained:
            return (
                f"the motion leaves {shares} unexplained, {100 * self.energy:.2g} % of the power "
                f"and a growth of {self.growth:+.2g} V/c"
            )
        advice = self.remedy or (
            "no single unit, sign or axis explains it: compare the beam of the configuration with "
            "that of the record (mass, inertia, stiffness, dampers, k* or speed)"
        )
        return (
            f"the motion leaves {shares} unexplained (allowed is {100 * MOST_UNEXPLAINED:g} %): "
            f"{advice}"
        )


def load_balance(history: ReferenceHistory, axis_moment: Floats | None = None) -> LoadBalance:
    """Return the agreement of the motion and the loads of a release.

    Parameters
    ----------
    history
        Motion and loads at uniform times, with the section in its flow.
    axis_moment
        c_m about the elastic axis, shape (n,), where it is known; else that about mid-chord is
        moved there by the lift.

    Raises
    ------
    ArgumentError
        The record is too short, or sampled too seldom, to be weighed.
    """
    section = history.section
    if axis_moment is None:
        incidence = history.incidence_rad + history.twist
        arm = section.axis_behind_mid_chord * np.cos(incidence)
        axis_moment = history.moment_coefficient + arm * history.lift_coefficient
    record = Motion(
        history.time_step, history.deflection, history.twist, history.lift_coefficient, axis_moment
    )
    _require_enough(record, section)
    found = _weigh(record, section)
    return found if found.is_explained else replace(found, remedy=_remedy(record, section, found))


def _require_enough(record: Motion, section: Section) -> None:
    window = _window(section)
    length = record.interval * (record.twist.size - 1)
    if length < FEWEST_WINDOWS * window:
        raise ArgumentError(
            f"the record is {length:.3g} c/V long; allowed is {FEWEST_WINDOWS * window:.3g} c/V or "
            "more, two natural periods of the section: go on with the run, or correct the unit of "
            "the time"
        )
    if record.interval * FEWEST_SAMPLES > window:
        raise ArgumentError(
            f"the record has a sample every {record.interval:.3g} c/V; allowed is "
            f"{window / FEWEST_SAMPLES:.2g} c/V or less, {FEWEST_SAMPLES} a natural period: write "
            "it more often"
        )


def _window(section: Section) -> float:
    return _WINDOW * math.tau / float(section.natural_frequencies[-1])


def _weigh(record: Motion, section: Section) -> LoadBalance:
    """Return the balance, without a remedy."""
    left, loads, rates = _sides(record, section)
    rest = left - loads
    spread = np.maximum(np.var(loads, axis=1), np.finfo(float).tiny)
    lift, moment = np.mean(rest**2, axis=1) / spread
    pitching = rates[1] - rates[1].mean()
    moving = float(pitching @ pitching) or math.inf
    growth = float(pitching @ rest[1]) / moving / (2.0 * section.inertia)
    done = float(np.abs(loads * rates).sum()) or math.inf
    energy = float(np.abs((rest * rates).sum())) / done
    return LoadBalance(float(lift), float(moment), growth, energy)


def _sides(record: Motion, section: Section) -> tuple[Floats, Floats, Floats]:
    """Return left sides, loads and rates in their weak form, each of shape (2, windows)."""
    half = max(round(0.5 * _window(section) / record.interval), 2)
    u = np.arange(-half, half + 1) / half
    length = half * record.interval
    edge = 1.0 - u**2
    weight = edge**4
    total = weight.sum()
    once = -8.0 * u * edge**3 / length
    twice = (-8.0 * edge**3 + 48.0 * u**2 * edge**2) / length**2

    def over(values: Floats, kernel: Floats) -> Floats:
        return np.stack([np.convolve(one, kernel / total, mode="valid") for one in values])

    moved = np.stack([record.deflection, record.twist])
    rates = over(moved, once)
    left = (
        section.mass_matrix @ over(moved, twice)
        + section.damping_matrix @ rates
        + section.stiffness_matrix @ over(moved, weight)
    )
    return left, over(np.stack([record.lift, record.moment]), weight), rates


def _remedy(record: Motion, section: Section, found: LoadBalance) -> str:
    """Return the single changes that explain a record, in words; empty if there are none.

    Where motions do not couple, a load that is twice as large is a motion half as large, so that
    there may be several. A factor of no known unit is named where nothing else explains it.
    """
    before = max(found.lift, found.moment)
    for changes in (_changes(record, section), _factors(record, section)):
        tried = [(_unexplained(changed, section), what) for changed, what in changes]
        best = min((left for left, _ in tried), default=math.inf)
        if best <= MOST_UNEXPLAINED or best < (1.0 - _REMOVED) * before:
            return ", or ".join(what for left, what in tried if left <= _AS_GOOD * best)
    return ""


def _unexplained(record: Motion, section: Section) -> float:
    balance = _weigh(record, section)
    return max(balance.lift, balance.moment)


def _varying(record: Motion, section: Section) -> tuple[Floats, Floats]:
    """Return loads and left sides in their weak form, less their means, shape (2, windows)."""
    left, loads, _ = _sides(record, section)
    return loads - loads.mean(axis=1, keepdims=True), left - left.mean(axis=1, keepdims=True)


def _changes(record: Motion, section: Section) -> Iterator[tuple[Motion, str]]:
    """Yield records with one thing changed, and what to write for it."""
    for name in ("deflection", "twist", "lift", "moment"):
        values = getattr(record, name)
        yield replace(record, **{name: -values}), f"signs.{name}: -1 explains it"
        factors = ANGLES if name == "twist" else DISTANCES if name == "deflection" else _FORCES
        for factor, mistake in factors.items():
            said = f"a {name} {factor:.4g} times as large explains it ({mistake}): units.{name}"
            yield replace(record, **{name: factor * values}), said
    for factor, mistake in LENGTHS.items():
        said = f"a time {factor:g} times as long explains it ({mistake}): units.time"
        yield replace(record, interval=factor * record.interval), said
    (lift, moment), (_, wanted) = _varying(record, section)
    arm = float((wanted - moment) @ lift) / (float(lift @ lift) or math.inf)
    place = section.elastic_axis - arm
    if 0.0 <= place <= 1.0:
        moved = record.moment + arm * record.lift
        yield (
            replace(record, moment=moved),
            f"moments about x/c = {place:.2f}, and not about the axis that was said, explain it: "
            f"moment_axis: {place:.2f}",
        )


def _factors(record: Motion, section: Section) -> Iterator[tuple[Motion, str]]:
    """Yield records with a load of another size, whatever made it so."""
    loads, wanted = _varying(record, section)
    squares = np.maximum((loads * loads).sum(axis=1), np.finfo(float).tiny)
    lift, moment = (float(one) for one in (loads * wanted).sum(axis=1) / squares)
    cause = "units, span, speed, density or chord"
    is_off = [factor > 0.0 and abs(factor - 1.0) > _FACTOR for factor in (lift, moment)]
    if is_off[0]:
        changed = replace(record, lift=lift * record.lift)
        said = f"a lift {lift:.3g} or a deflection {1 / lift:.3g} times as large explains it: "
        yield changed, said + cause
    if is_off[1]:
        changed = replace(record, moment=moment * record.moment)
        said = f"a moment {moment:.3g} or a twist {1 / moment:.3g} times as large explains it: "
        yield changed, said + cause
    if all(is_off):
        changed = replace(record, lift=lift * record.lift, moment=moment * record.moment)
        said = f"a lift {lift:.3g} and a moment {moment:.3g} times as large explain it: "
        yield changed, said + cause
