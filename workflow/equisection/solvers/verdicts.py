"""The verdict of a run, for every solver alike: judged on the motion of the tip.

The section's twist and deflection are recovered to the tip's first, so that the same criteria
mean the same motion in two and in three dimensions.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from equisection.beam.section import Section
from equisection.cases import Case, UnsteadyCase
from equisection.errors import ResultFileError
from equisection.results.unsteady_result import Regime, UnsteadyResult
from equisection.solvers.protocol import HAS_VORTICES
from equisection.solvers.registry import SOLVERS
from equisection.verdict import Criteria, Verdict, assess, heave_grows, swings_grow
from equisection.verdict.growth import (
    NO_GROWTH,
    Growth,
    growth_window,
    growths_of,
    growths_with_drifts,
)

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]
Histories = TypeVar("Histories")

#: A verdict is looked for again when the run has become this many times longer (-).
LOOK_AGAIN = 1.3
#: Interval (c/V) at which a run of its own job is looked at.
LOOKS_EVERY = 5.0
#: Time (c/V) over which a motion beyond the bound is looked for; longer than a slow period.
LATE = 20.0
#: What the reason of a verdict says of a motion that has no equilibrium to start from.
WITHOUT_EQUILIBRIUM = (
    "released from the undeformed state, since the branch from rest has no static equilibrium here"
)
#: Bending modes of a beam that are fitted with its first torsion mode.
BENDING_MODES = 2
#: A heave that is this many times faster than the pitch does not beat with it (-).
FASTEST_HEAVE = 4.0


@dataclass(frozen=True)
class TipMotion:
    """Motion of the tip over convective time, and of the first modes where they are known.

    Attributes
    ----------
    time
        s (c/V), shape (n,).
    twist, deflection
        Of the tip (rad and chords), shape (n,).
    modes
        Amplitudes of the first torsion mode and of the first two bending modes, in any unit, shape
        (C, n); empty of a section, and where they are not known.
    """

    time: Floats
    twist: Floats
    deflection: Floats
    modes: Floats = field(default_factory=lambda: np.empty((0, 0)))

    def until(self, end: float) -> TipMotion:
        """Return the part up to a time (c/V)."""
        kept = self.time <= end * (1 + 1e-9)
        modes = self.modes[:, kept] if self.modes.size else self.modes
        return TipMotion(self.time[kept], self.twist[kept], self.deflection[kept], modes)

    @property
    def records(self) -> Floats:
        """Records from which the growth is fitted, that of the torsion first, shape (C, n)."""
        return self.modes if self.modes.size else np.stack((self.twist, self.deflection))


def pitch_frequency(case: UnsteadyCase) -> float:
    """Return the natural frequency f c/V of the pitch in vacuum."""
    if case.beam is not None:
        return case.beam.torsion_frequency[0] / (2 * math.pi)
    if case.section is None:
        return math.nan
    return case.section.uncoupled_frequencies[0]


def _heaves(case: UnsteadyCase) -> tuple[float, ...]:
    """Return the natural frequencies f c/V of heave or first bending modes in vacuum."""
    if case.beam is not None:
        return tuple(one / (2 * math.pi) for one in case.beam.bending_frequency[:BENDING_MODES])
    return () if case.section is None else case.section.uncoupled_frequencies[1:]


@dataclass(frozen=True)
class Judge:
    """Judge of one motion.

    Attributes
    ----------
    criteria
        Its criteria.
    natural_frequency
        Natural frequency f c/V of its pitch in vacuum.
    heaves
        Those of its heave, or of its first bending modes. Without them no growth is fitted, and
        the twist alone is judged.
    has_vortices
        The flow may shed vortices, which beat with the motion. That of the embedded solver has
        none: its loads are those of the motion.
    """

    criteria: Criteria
    natural_frequency: float
    heaves: tuple[float, ...] = ()
    has_vortices: bool = True

    @classmethod
    def of(cls, case: UnsteadyCase) -> Judge:
        """Return the judge of a case."""
        criteria = Criteria(**case.criteria.model_dump(exclude={"rules"}))
        solver = SOLVERS.get(case.solver.name)
        usual = solver is None or solver.has_vortices
        has_vortices = bool(case.solver.settings.get(HAS_VORTICES, usual))
        return cls(criteria, pitch_frequency(case), _heaves(case), has_vortices)

    @classmethod
    def of_section(cls, section: Section, criteria: Criteria) -> Judge:
        """Return the judge of a section in the flow of the embedded solver."""
        pitch, heave = section.uncoupled_frequencies
        return cls(criteria, pitch, (heave,), has_vortices=False)

    @property
    def waves(self) -> tuple[float, ...]:
        """Natural frequencies f c/V of the motions that a fit has, that of the pitch first.

        A heave that is far faster than the pitch does not beat with it and is left out.
        """
        fastest = FASTEST_HEAVE * self.natural_frequency
        return (self.natural_frequency, *(one for one in self.heaves if 0.0 < one <= fastest))

    def attributes(
        self, tip: TipMotion, failure: str = "", growth: Growth | None = None
    ) -> dict[str, Any]:
        """Return the attributes of the verdict on a run that has ended.

        Parameters
        ----------
        tip
            Its whole history.
        failure
            Reason for an early end of the run, if there was one. The regime is then ``failed``,
            unless the motion had grown beyond the bound before.
        growth
            Growth of the motion, where it is known already (:func:`growths_of_tips`).
        """
        if growth is None:
            (growth,) = growths_of_tips([self], [tip])
        try:
            verdict = assess(
                tip.time,
                tip.twist,
                tip.deflection,
                self.criteria,
                final=True,
                natural_frequency=self.natural_frequency,
                growth=growth,
            )
        except ResultFileError as error:
            return _without_numbers(Regime.FAILED, failure or str(error))
        if failure and not self._had_grown(tip, verdict):
            return _without_numbers(Regime.FAILED, failure)
        return {
            "regime": str(Regime(verdict.regime)),
            "reason": f"{verdict.reason}; {failure}" if failure else verdict.reason,
            "periods_used": verdict.periods_used,
            "window_start": verdict.start_time,
            "mean_twist_deg": math.degrees(verdict.mean_twist),
            "mean_deflection_chords": verdict.mean_deflection,
            "mean_known": int(verdict.mean_known),
            "twist_amplitude_deg": math.degrees(verdict.twist_amplitude),
            "frequency_strouhal": verdict.frequency if verdict.periods_used else math.nan,
            **_attributes_of(verdict.growth),
            "deflection_amplitude_chords": verdict.deflection_amplitude,
            "heave_grows": int(verdict.heave_grows),
            "twist_turns": verdict.turns if verdict.turns >= 0 else math.nan,
        }

    def is_decided(self, tip: TipMotion) -> bool:
        """Tell whether there is a verdict on a run so far.

        A fall may be half a beat, which only the fit of its growth tells.
        """
        motion = (tip.time, tip.twist, tip.deflection, self.criteria)
        found = assess(*motion)
        if not self.has_vortices or found.regime not in {"settled", "decaying"}:
            return found.decided
        (growth,) = growths_of_tips([self], [tip])
        return growth.stays or assess(*motion, growth=growth).decided

    @property
    def earliest(self) -> float:
        """Time (c/V) at which a run has as many natural periods as a verdict needs."""
        return self.criteria.periods / self.natural_frequency

    def may_be_beyond_bound(self, late: TipMotion) -> bool:
        """Tell whether the last part of a motion swings so far that it may have grown enough."""
        bound = math.radians(self.criteria.growing_amplitude_deg)
        return float(np.ptp(late.twist)) > 2 * bound

    def _had_grown(self, tip: TipMotion, verdict: Verdict) -> bool:
        """Tell whether a motion was beyond the bound, not by a first swing that may be its last.

        A heave that grows has no bound.
        """
        if heave_grows(tip.time, tip.twist, tip.deflection, self.natural_frequency):
            return verdict.regime == "growing"
        bound = math.radians(self.criteria.growing_amplitude_deg)
        return (
            verdict.regime == "growing"
            and verdict.twist_amplitude > bound
            and (
                verdict.periods_used > 0
                or self.is_decided(tip)
                or swings_grow(tip.time, tip.twist, bound)
            )
        )


def first_modes(torsion: Floats, bending: Floats) -> Floats:
    """Return the amplitudes that a growth is fitted to, of all torsion and bending modes (C, n)."""
    return np.concatenate((torsion[:1], bending[:BENDING_MODES]))


def growths_of_tips(judges: Sequence[Judge], tips: Sequence[TipMotion]) -> list[Growth]:
    """Return the growth of motions that are sampled at the same times, each until its own end.

    Those with as many records and natural frequencies are fitted at once, those without vortices
    apart.
    """
    groups: dict[tuple[int, int, bool], list[int]] = {}
    for lane, (judge, tip) in enumerate(zip(judges, tips, strict=True)):
        if judge.heaves and judge.natural_frequency > 0.0 and np.isfinite(tip.records).all():
            alike = len(tip.records), len(judge.waves), judge.has_vortices
            groups.setdefault(alike, []).append(lane)
    found = [NO_GROWTH] * len(tips)
    for (*_, has_vortices), lanes in groups.items():
        chosen = [tips[lane] for lane in lanes]
        time = max((tip.time for tip in chosen), key=len)
        if not time.size:
            continue
        records = np.zeros((len(chosen[0].records), len(chosen), time.size))
        for place, tip in enumerate(chosen):
            records[:, place, : tip.time.size] = tip.records
        windows = [
            growth_window(float(tip.time[-1]) if tip.time.size else 0.0, judges[lane].waves[0])
            for lane, tip in zip(lanes, chosen, strict=True)
        ]
        fitted = growths_with_drifts if has_vortices else growths_of
        fits = fitted(time, records, [judges[lane].waves for lane in lanes], windows)
        for lane, growth in zip(lanes, fits, strict=True):
            found[lane] = growth
    return found


def _attributes_of(growth: Growth) -> dict[str, Any]:
    low, high = growth.interval
    is_known = math.isfinite(growth.rate)
    return {
        "growth_rate": growth.rate,
        "growth_standard_error": growth.error,
        "growth_low": low,
        "growth_high": high,
        "growth_start": growth.start,
        "growth_end": growth.end,
        "growth_note": growth.note if is_known else "",
    }


def judge(case: UnsteadyCase, tip: TipMotion, failure: str = "") -> dict[str, Any]:
    """Return the attributes of the verdict on a run of a case (:meth:`Judge.attributes`)."""
    return Judge.of(case).attributes(tip, failure)


def refused(case: Case) -> UnsteadyResult:
    """Return the result of a case that has no structure to move: a regime without a history."""
    assert isinstance(case, UnsteadyCase), "no other kind has cases that are not run"
    regime = Regime.GROWING if case.diverges else Regime.FAILED
    nothing = np.empty(0)
    return UnsteadyResult(
        time=nothing,
        twist=nothing,
        deflection=nothing,
        tip_twist=nothing,
        tip_deflection=nothing,
        lift=nothing,
        moment=nothing,
        incidence=nothing,
        verdict=_without_numbers(regime, case.not_run),
    )


def told_without_equilibrium(result: UnsteadyResult) -> UnsteadyResult:
    """Return a result whose verdict says that there was no equilibrium to start from."""
    reason = f"{result.verdict['reason']}; {WITHOUT_EQUILIBRIUM}"
    return replace(result, verdict={**result.verdict, "reason": reason})


def monitor_of(
    judges: Sequence[Judge], lane_of: Callable[[Any, int, slice], TipMotion]
) -> Callable[[Any, Indices], Indices]:
    """Return a monitor that ends each lane of a batch when there is a verdict on it.

    Looking for a verdict costs more than the motion in between, the more the longer the run is.
    So the first look comes after as many natural periods as a verdict needs. The times of later
    looks depend on the length of the run alone, so that they are the same in a batch and alone. A
    motion that may be beyond the bound is looked at every time, before it leaves the polar.

    Parameters
    ----------
    judges
        Judge of each lane.
    lane_of
        Gives the motion of the tip of a lane, or a part of it, from the histories of all.
    """
    due = 0.0

    def monitor(histories: Any, active: Indices) -> Indices:
        nonlocal due
        now = float(histories.time[-1])
        is_due = now >= due
        if is_due:
            due = LOOK_AGAIN * now
        late = slice(int(np.searchsorted(histories.time, now - LATE)), None)
        done = []
        for lane in map(int, active):
            judge = judges[lane]
            looks = (is_due and now >= judge.earliest) or judge.may_be_beyond_bound(
                lane_of(histories, lane, late)
            )
            if looks and judge.is_decided(lane_of(histories, lane, slice(None))):
                done.append(lane)
        return np.array(done, dtype=np.intp)

    return monitor


def is_decided(case: UnsteadyCase, tip: TipMotion) -> bool:
    """Tell whether there is a verdict on a run of a case so far."""
    return Judge.of(case).is_decided(tip)


def last_look(time: float) -> float:
    """Return the time (c/V) of the last look at a run that has come to a time."""
    return LOOKS_EVERY * math.floor(time / LOOKS_EVERY * (1 + 1e-9))


def decided_at(case: UnsteadyCase, tip: TipMotion, after: float = 0.0) -> float:
    """Return the first look (c/V) that finds a verdict on a history; infinite if none does.

    Looks up to ``after`` (c/V), itself a look, are known to have found none.

    A run ends a little later, since its solver is followed from outside. Its result ends here, so
    that it does not depend on the time at which the end was noticed.
    """
    last = float(tip.time[-1]) if tip.time.size else 0.0
    for look in np.arange(after + LOOKS_EVERY, min(last * (1 + 1e-9), case.duration), LOOKS_EVERY):
        if is_decided(case, tip.until(float(look))):
            return float(look)
    return math.inf


def _without_numbers(regime: Regime, reason: str) -> dict[str, Any]:
    unknown = (
        "window_start",
        "mean_twist_deg",
        "mean_deflection_chords",
        "twist_amplitude_deg",
        "frequency_strouhal",
        "deflection_amplitude_chords",
        "twist_turns",
    )
    return {
        "regime": str(regime),
        "reason": reason,
        "periods_used": 0.0,
        "mean_known": 0,
        "heave_grows": 0,
        **dict.fromkeys(unknown, math.nan),
        **_attributes_of(NO_GROWTH),
    }
