"""Releases at the edges of a map of stability, and at the design speed.

Eigenvalues tell of small motions. A body may be stable to them and still be carried off by a large
one (a *subcritical* cycle), or be unstable to them and end in a small cycle. So at each incidence
the body is let go close below and above its onset, displaced from its static equilibrium along the
motion at the onset, by a small and by a large angle of the tip.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from equisection.analysis.loads_in_use import is_there, loads_at_rest
from equisection.analysis.mapped_models import MappedModel
from equisection.config import Config
from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.critical import critical_of
from equisection.motion.equilibrium_path import SectionPath, systems_of_sections
from equisection.motion.march import Failure, Recording, march
from equisection.motion.mechanism import Mechanism
from equisection.motion.mode_tracking import Spectrum
from equisection.motion.stability_map import MapLine
from equisection.motion.steady_states import consistent_deficits
from equisection.motion.strip_system import StripSystem
from equisection.results.unsteady_result import STABLE, UNKNOWN
from equisection.solvers.verdicts import (
    BENDING_MODES,
    Judge,
    TipMotion,
    growths_of_tips,
    monitor_of,
)
from equisection.verdict import Criteria

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

ASIDE = 0.05
"""Part of the critical speed by which a release is below or above it."""
FIRST_MODES = 2
"""Modes of a kind that the damping in use is of; higher ones have little but the structure's."""
SMALL_DEG, LARGE_DEG = 0.1, 3.0
"""Twist of the tip (deg) beyond equilibrium from which the body is let go."""
#: Lanes that are marched together.
_TOGETHER = 400

RELEASES = {
    "below_small": (1.0 - ASIDE, SMALL_DEG),
    "below_large": (1.0 - ASIDE, LARGE_DEG),
    "above_small": (1.0 + ASIDE, SMALL_DEG),
    "above_large": (1.0 + ASIDE, LARGE_DEG),
}


@dataclass(frozen=True)
class MapRelease:
    """A release at an incidence of a map.

    Attributes
    ----------
    line
        Motions of the body at that incidence.
    speed
        V (m/s).
    amplitude_deg
        Twist of the tip (deg) beyond that of equilibrium at the start, or its deflection (a radian
        for each chord) where that is larger.
    """

    line: MapLine
    speed: float
    amplitude_deg: float

    @property
    def moved(self) -> Floats:
        """States Y by which the start is off equilibrium: those of the motion at the onset.

        Without an onset they are those of the least damped mode at the speed.
        """
        line = self.line
        if line.onset is None:
            _, vector = line.least_damped_mode_at(line.place(self.speed))
        else:
            _, vector = line.mode_at(line.place(line.onset.speed))
        twist, deflection = line.body.tip(vector)
        turned = twist if abs(twist) >= abs(deflection) else deflection
        return np.asarray((math.radians(self.amplitude_deg) * vector / turned).real)


def checked_in_time(
    table: pd.DataFrame, models: Sequence[MappedModel], config: Config
) -> pd.DataFrame:
    """Return ``comparison/stability.csv`` with the regimes of releases next to each onset.

    Columns :data:`RELEASES` have regime and amplitude of the twist (deg); ``in_time`` is
    ``agrees``, or says what a release contradicts; empty where there is no onset by eigenvalues.
    """
    words: dict[str, list[str]] = {name: [] for name in (*RELEASES, "in_time")}
    for model in models:
        wanted = [
            MapRelease(line, factor * line.onset.speed, twist)
            for line in model.lines
            if line.onset is not None
            for factor, twist in RELEASES.values()
        ]
        verdicts = iter(released(wanted, config))
        for line in model.lines:
            if line.onset is None:
                for column in words.values():
                    column.append("")
                continue
            by_name = {name: next(verdicts) for name in RELEASES}
            for name, verdict in by_name.items():
                words[name].append(_regime(verdict))
            words["in_time"].append(_agreement(by_name, line))
        if model.refusal:
            for column in words.values():
                column.append("")
    note = table.pop("note")
    return table.assign(**words, note=note)


def _regime(verdict: dict[str, Any]) -> str:
    amplitude = verdict["twist_amplitude_deg"]
    if verdict["regime"] == "limit-cycle" and math.isfinite(amplitude):
        return f"limit-cycle {amplitude:.2g} deg"
    return str(verdict["regime"])


def _agreement(verdicts: dict[str, dict[str, Any]], line: MapLine) -> str:
    if critical_of(line).critical_mechanism == Mechanism.DIVERGENCE:
        return _at_divergence(verdicts, line)
    regime = {name: str(verdict["regime"]) for name, verdict in verdicts.items()}
    unknown = [name for name, word in regime.items() if word in UNKNOWN]
    found = []
    if regime["below_small"] in ("growing", "limit-cycle"):
        found.append("grows below the onset from a small start")
    elif regime["below_large"] in ("growing", "limit-cycle"):
        found.append(
            f"subcritical: {100 * ASIDE:g} % below the onset a start of {LARGE_DEG:g} deg does not "
            "decay"
        )
    if regime["above_small"] in STABLE:
        found.append("decays above the onset from a small start")
    elif regime["above_large"] in STABLE:
        found.append(
            f"{100 * ASIDE:g} % above the onset a start of {LARGE_DEG:g} deg dies down towards "
            "the cycle to which a small one grows"
        )
    found += [f"{name} {regime[name]}: {verdicts[name]['reason']}" for name in unknown]
    return "; ".join(found) or "agrees"


def _at_divergence(verdicts: dict[str, dict[str, Any]], line: MapLine) -> str:
    """Say whether the body leaves its equilibrium above the speed of divergence, and to where."""
    above = verdicts["above_small"]
    if above["regime"] in UNKNOWN:
        return f"above_small {above['regime']}: {above['reason']}"
    if above["regime"] not in STABLE:
        return "agrees"
    onset = line.onset
    assert onset is not None, "there are no releases without one"
    twist, _ = line.tip(line.place(onset.speed))
    away = above["mean_twist_deg"] - math.degrees(twist)
    if abs(away) > SMALL_DEG:
        return f"agrees: it comes to rest {away:.2g} deg away from the equilibrium"
    return "stays at the equilibrium above the onset from a small start"


def in_use(models: Sequence[MappedModel], config: Config) -> pd.DataFrame:
    """Return ``comparison/in_use.csv``: each model at the design speed, incidence by incidence.

    Static twist (deg) and deflection (m) of the tip; by the static loads of the air alone the
    bending moment (N m, that lifts the tip) and the torque (N m, nose up, about the elastic axis)
    at the root, and the largest along the span with their places z/L; damping ratio and frequency
    of the least damped of the first two modes of each kind, share of the speed of divergence, and
    the regime after a release from 3 deg beyond equilibrium with the amplitude of the tip's twist
    (deg) if it is a limit cycle.
    """
    design = config.flow.design_speed
    assert design is not None, "the plan asks for it with a design speed alone"
    rows = []
    for model in models:
        there = [line for line in model.lines if is_there(line, design)]
        verdicts = released([MapRelease(line, design, LARGE_DEG) for line in there], config)
        of_line = dict(zip(map(id, there), verdicts, strict=True))
        rows += [
            {"model": model.name, **_at_design(line, design, of_line.get(id(line)), config)}
            for line in model.lines
        ]
    return pd.DataFrame(rows)


def _at_design(
    line: MapLine, speed: float, verdict: dict[str, Any] | None, config: Config
) -> dict[str, Any]:
    nan, body = math.nan, line.body
    row: dict[str, Any] = {
        "incidence_deg": round(math.degrees(line.incidence_rad), 9),
        "speed": speed,
        "tip_twist_deg": nan,
        "tip_deflection_m": nan,
        "root_bending_moment_nm": nan,
        "root_torque_nm": nan,
        "largest_bending_moment_nm": nan,
        "bending_moment_at": nan,
        "largest_torque_nm": nan,
        "torque_at": nan,
        "share_of_divergence_speed": speed / critical_of(line).divergence_speed,
        "damping_ratio": nan,
        "frequency_hz": nan,
        "regime": "",
        "cycle_twist_deg": nan,
        "note": _absence(line, speed),
    }
    if verdict is None:
        return row
    system, states, deficits = line.path.system(np.array([speed]))
    twist, deflection = body.tip(states)
    values = Spectrum.of(np.array([speed]), system, states, deficits).values[0]
    p = _least_damped(line, speed, values)
    loads = loads_at_rest(body, system, (states, deficits), config)
    row.update(
        tip_twist_deg=math.degrees(twist[0]),
        tip_deflection_m=float(deflection[0]) * body.chord,
        root_bending_moment_nm=loads.bending_moment,
        root_torque_nm=loads.torque,
        largest_bending_moment_nm=loads.largest_bending_moment,
        bending_moment_at=loads.bending_moment_at,
        largest_torque_nm=loads.largest_torque,
        torque_at=loads.torque_at,
        damping_ratio=-p.real / abs(p),
        frequency_hz=p.imag / math.tau * speed / body.chord,
        regime=str(verdict["regime"]),
        cycle_twist_deg=verdict["twist_amplitude_deg"]
        if verdict["regime"] == "limit-cycle"
        else nan,
        note=str(verdict["reason"]),
    )
    return row


def _absence(line: MapLine, speed: float) -> str:
    """Say why nothing is known of a body at a speed (m/s)."""
    if line.exists and speed < line.path.end_speed:
        return f"above {line.highest:.4g} m/s, the highest speed that was looked at"
    return f"no equilibrium at this speed: {critical_of(line).note}"


def _least_damped(line: MapLine, speed: float, values: Complexes) -> complex:
    """Return the eigenvalue (V/c) at a speed of the least damped of the first modes of a kind."""
    over = line.modes.spectrum.speed
    near = [
        complex(np.interp(speed, over, mode.real), np.interp(speed, over, mode.imag))
        for name, mode in zip(line.modes.names, line.modes.values.T, strict=True)
        if int(name.split()[-1]) <= FIRST_MODES
    ]
    found = [complex(values[np.abs(values - guess).argmin()]) for guess in near]
    return max(found, key=lambda p: p.real / abs(p))


def released(releases: Sequence[MapRelease], config: Config) -> list[dict[str, Any]]:
    """Return the verdicts on some releases of one body (:meth:`Judge.attributes`)."""
    found: list[dict[str, Any]] = []
    for start in range(0, len(releases), _TOGETHER):
        found += _released(releases[start : start + _TOGETHER], config)
    return found


def _released(releases: Sequence[MapRelease], config: Config) -> list[dict[str, Any]]:
    body, unsteady = releases[0].line.body, config.unsteady
    system, states, deficits = _together(releases)
    states = states + np.stack([one.moved for one in releases])
    deficits = consistent_deficits(system, states, deficits)
    outputs = _tip_rows(body, system)
    criteria = Criteria(**unsteady.verdict.model_dump())
    judges = [_judge_of(one, criteria) for one in releases]
    look = monitor_of(judges, _tip_of)

    def monitor(recording: Recording, active: NDArray[np.intp]) -> NDArray[np.intp]:
        return look(_so_far(recording), active)

    recording = march(
        system,
        (states, deficits),
        outputs,
        duration=unsteady.duration,
        time_step=unsteady.time_step,
        output_interval=unsteady.output_interval,
        monitor=monitor,
    )
    tips = [_tip_of(recording, lane, slice(int(end))) for lane, end in enumerate(recording.samples)]
    return [
        judge.attributes(tip, _failure(recording.failures, lane), growth)
        for lane, (judge, tip, growth) in enumerate(
            zip(judges, tips, growths_of_tips(judges, tips), strict=True)
        )
    ]


def _judge_of(release: MapRelease, criteria: Criteria) -> Judge:
    """Return the judge of a release, whose growth is fitted to its pitch and its first heaves."""
    body = release.line.body
    per_flow = body.chord / release.speed
    heaves = per_flow * body.bending_frequencies[:BENDING_MODES]
    pitch = per_flow * body.pitch_frequency
    return Judge(criteria, pitch, tuple(heaves.tolist()), has_vortices=False)


def _together(releases: Sequence[MapRelease]) -> tuple[StripSystem, Floats, Floats]:
    """Return the system of all releases, a lane each, in equilibrium."""
    paths = [one.line.path for one in releases]
    sections = [path for path in paths if isinstance(path, SectionPath)]
    if len(sections) == len(paths):
        return systems_of_sections(sections, [np.array([one.speed]) for one in releases])
    at_rest = [one.line.path.system(np.array([one.speed])) for one in releases]
    body = releases[0].line.body
    system = body.system(
        np.array([one.speed for one in releases]),
        np.array([one.line.incidence_rad for one in releases]),
    )
    return (
        system,
        np.concatenate([states for _, states, _ in at_rest]),
        np.concatenate([deficits for _, _, deficits in at_rest]),
    )


def _tip_rows(body: BodyInFlow, system: StripSystem) -> Floats:
    """Rows that give twist (rad) and deflection (chords) of the tip.

    Of a beam the amplitudes of its first modes follow.
    """
    twist, deflection = system.layout.twist, system.layout.deflection
    first = [twist.start, *range(deflection.start, deflection.stop)[:BENDING_MODES]]
    if body.is_section:
        first = []
    rows = np.zeros((2 + len(first), system.rates.shape[2]))
    rows[0, twist] = body.twist_of_tip
    rows[1, deflection] = body.deflection_of_tip
    rows[np.arange(2, len(rows)), first] = 1.0
    return np.broadcast_to(rows, (system.rates.shape[0], *rows.shape))


def _so_far(recording: Recording) -> Recording:
    """Return the part of a recording that has been reached."""
    end = recording.recorded
    return replace(recording, time=recording.time[:end], values=recording.values[:end])


def _tip_of(recording: Recording, lane: int, part: slice) -> TipMotion:
    values = recording.values[part, lane]
    return TipMotion(recording.time[part], values[:, 0], values[:, 1], values[:, 2:].T)


def _failure(failures: Sequence[Failure], lane: int) -> str:
    for failure in failures:
        if failure.lane == lane:
            return (
                f"at {failure.time:.4g} c/V an incidence of "
                f"{math.degrees(failure.incidence_rad):.4g} deg left the section polar"
            )
    return ""
