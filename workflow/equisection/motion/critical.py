"""Critical speed of a body at one incidence, with its mechanism and all reservations in words."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from equisection.aerodynamics.polar import Polar
from equisection.motion.equilibrium_path import NoPath
from equisection.motion.mechanism import Instabilities, least_stable_instabilities
from equisection.motion.stability_map import MapLine
from equisection.motion.static_branch import BranchEnd

STEEPEST = 100.0
"""Slope (1/rad) of a coefficient above which a polar has a jump; attached flow has 2 pi."""


@dataclass(frozen=True)
class Critical:
    """Critical speed of a body at one incidence; NaN where there is none.

    Attributes
    ----------
    critical_speed, speed_low, speed_high
        Onset (m/s), and the interval that it is known to: stable at the first, unstable at the
        second.
    critical_mechanism, critical_mode
        Mechanism, and name of the mode that loses its stability.
    critical_frequency
        Its frequency (Hz).
    critical_k_star
        k* (-).
    critical_twist, critical_deflection
        Static twist (rad) and deflection (m) of the tip there.
    divergence_speed
        Speed (m/s) of the fold, or of the first positive real eigenvalue.
    growth_slope
        Rise of the growth rate with the speed at the onset (1/s per m/s): small is a soft onset.
    tip_ratio, tip_phase
        Deflection in chords over twist of the tip in the motion at the onset (-), and the phase
        (deg) by which it leads.
    heave_share, twist_share, coupling_share
        Parts of the power that the air puts in (-), by :mod:`equisection.motion.mechanism`.
    unstable_to
        Speed (m/s) above which it is stable again.
    note
        All that one has to know of it in words.
    """

    critical_speed: float = math.nan
    speed_low: float = math.nan
    speed_high: float = math.nan
    critical_mechanism: str = "unknown"
    critical_mode: str = ""
    critical_frequency: float = math.nan
    critical_k_star: float = math.nan
    critical_twist: float = math.nan
    critical_deflection: float = math.nan
    divergence_speed: float = math.nan
    growth_slope: float = math.nan
    tip_ratio: float = math.nan
    tip_phase: float = math.nan
    heave_share: float = math.nan
    twist_share: float = math.nan
    coupling_share: float = math.nan
    unstable_to: float = math.nan
    note: str = ""


def critical_of(line: MapLine) -> Critical:
    """Return the critical speed of a body at one incidence."""
    if isinstance(line.path, NoPath):
        return Critical(note=line.path.reason)
    if not line.exists:
        return Critical(note="there is no equilibrium at any speed")
    notes = [*_humps_in_words(line), *_crossings_in_words(line)]
    fold = line.path.end_speed if line.path.end is BranchEnd.FOLD else math.nan
    if line.onset is not None:
        return _of_onset(line, line.onset.low, line.onset.high, fold, notes)
    return _without_crossing(line, fold, notes)


def _without_crossing(line: MapLine, fold: float, notes: list[str]) -> Critical:
    """Return what is known where no growth crosses zero from below."""
    highest = line.highest
    if line.is_unstable_at_rest:
        reason = f"unstable already at {line.lowest:.4g} m/s, the lowest speed that was looked at"
        mechanism = str(_at(line, line.lowest).mechanism[0])
        return Critical(
            speed_high=line.lowest,
            critical_mechanism=mechanism,
            note="; ".join([reason, *notes]),
        )
    last = float(line.modes.spectrum.speed[-1])
    if line.path.end is BranchEnd.FOLD and fold < highest:
        twist, deflection = line.tip(len(line.modes.spectrum.speed) - 1)
        notes.append(f"the branch from rest has a fold at {math.degrees(twist):.3g} deg of twist")
        return Critical(
            critical_speed=fold,
            speed_low=last,
            speed_high=fold,
            critical_mechanism="divergence",
            critical_frequency=0.0,
            critical_k_star=float(line.body.k_star_at(np.array(fold))),
            critical_twist=twist,
            critical_deflection=deflection,
            divergence_speed=fold,
            note="; ".join([*notes, *_jumps_in_words(line, last)]),
        )
    if line.path.end is BranchEnd.POLAR and line.path.end_speed < highest:
        least, greatest = np.degrees(line.body.loads.branches.polar.incidence_range)
        notes.append(
            f"stable up to {last:.4g} m/s, where the equilibrium leaves the polar ({least:.4g} to "
            f"{greatest:.4g} deg): extend it"
        )
        notes += _jumps_in_words(line, last)
        return Critical(speed_low=last, note="; ".join(notes))
    notes += [f"stable up to {highest:.4g} m/s", *_jumps_in_words(line, last)]
    return Critical(speed_low=highest, critical_mechanism="none", note="; ".join(notes))


def _of_onset(line: MapLine, low: float, high: float, fold: float, notes: list[str]) -> Critical:
    speed, chord = 0.5 * (low + high), line.body.chord
    system, states, deficits = line.path.system(np.array([low, high]))
    p, kinds = least_stable_instabilities(system, states, deficits)
    twist, deflection = line.body.tip(states[0])
    name, shape = line.mode_at(line.place(speed))
    turned, lifted = line.body.tip(shape)
    ratio = lifted / turned if turned != 0.0 else complex(math.nan)
    rate = (p.real[1] * high - p.real[0] * low) / chord / (high - low)
    if p[1].imag == 0.0:
        fold = speed
    return Critical(
        critical_speed=speed,
        speed_low=low,
        speed_high=high,
        critical_mechanism=str(kinds.mechanism[1]),
        critical_mode=name,
        critical_frequency=float(p[1].imag) / math.tau * speed / chord,
        critical_k_star=float(line.body.k_star_at(np.array(speed))),
        critical_twist=float(twist),
        critical_deflection=float(deflection) * chord,
        divergence_speed=_divergence(line, fold),
        growth_slope=float(rate),
        tip_ratio=float(abs(ratio)),
        tip_phase=float(np.degrees(np.angle(ratio))),
        heave_share=float(kinds.heave_share[1]),
        twist_share=float(kinds.twist_share[1]),
        coupling_share=float(kinds.coupling_share[1]),
        unstable_to=line.humps[0][1] if line.humps else math.nan,
        note="; ".join([*notes, *_jumps_in_words(line, speed)]),
    )


def _at(line: MapLine, speed: float) -> Instabilities:
    return least_stable_instabilities(*line.path.system(np.array([speed])))[1]


def _divergence(line: MapLine, fold: float) -> float:
    """Speed (m/s) of the first positive real eigenvalue, by a straight line, or of the fold."""
    real, speed = line.modes.spectrum.largest_real, line.modes.spectrum.speed
    places = np.flatnonzero((real[:-1] <= 0.0) & (real[1:] > 0.0))
    if places.size and not math.isfinite(fold):
        first = places[0]
        part = -real[first] / (real[first + 1] - real[first]) if np.isfinite(real[first]) else 1.0
        return float(speed[first] + part * (speed[first + 1] - speed[first]))
    return fold


def _humps_in_words(line: MapLine) -> list[str]:
    return [
        f"unstable from {low:.4g} to {high:.4g} m/s, then stable again" for low, high in line.humps
    ]


def _crossings_in_words(line: MapLine) -> list[str]:
    return [
        f"{one} and {other} cross at {speed:.4g} m/s, beyond which their names may be exchanged"
        for speed, one, other in line.modes.crossings
    ]


def _jumps_in_words(line: MapLine, speed: float) -> list[str]:
    """Name the jumps of the polar between the incidences at rest and at a speed (m/s)."""
    steep = jumps(line.body.loads.branches.polar)
    if not steep:
        return []
    system, states, _ = line.path.system(np.array([speed]))
    there = states[0, system.layout.lag(2)]
    low, high = min(*there, line.incidence_rad), max(*there, line.incidence_rad)
    return [
        f"the polar jumps between {math.degrees(a):.4g} and {math.degrees(b):.4g} deg, where its "
        "slopes mean nothing"
        for a, b in steep
        if a < high and b > low
    ]


def jumps(polar: Polar) -> list[tuple[float, float]]:
    """Return the intervals of incidence (rad) over which a coefficient changes too steeply."""
    step = np.diff(polar.incidence)
    steep = np.zeros(step.size, dtype=bool)
    for values in (polar.lift, polar.moment):
        steep |= np.abs(np.diff(values)) > STEEPEST * step
    return [
        (float(polar.incidence[place]), float(polar.incidence[place + 1]))
        for place in np.flatnonzero(steep)
    ]
