"""Recorded forced motion of a section: read, moved to mid-chord, sampled, and compared.

The motion is compared with the one that the case asks for, and the loads with those of the polar
(:mod:`equisection.aerodynamics.load_likeness`).
"""

from __future__ import annotations

import logging
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.load_balance import ANGLES, DISTANCES, FEWEST_SAMPLES, LENGTHS
from equisection.aerodynamics.load_likeness import (
    LARGEST_DIFFERENCE,
    MovedLoads,
    expected_loads,
    mistakes,
)
from equisection.aerodynamics.load_response import load_response
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.unsteady_loads import ForcedMotion
from equisection.cases import ForcedCase
from equisection.errors import ArgumentError, HistoryFileError
from equisection.io.history_file import HistoryColumns, HistoryScales, HistoryTable, read_table
from equisection.io.polar_rows import MID_CHORD
from equisection.results.forced_result import ForcedResult, signal_of
from equisection.solvers.given.recorded_release import RecordAxes, deflection_of, moment_about

Floats = NDArray[np.float64]

logger = logging.getLogger(__name__)

#: Difference of an amplitude from what the case asks for (-); a mistaken unit makes more.
_OFF = 0.1
#: Part of the motion at other frequencies than those of the case (-).
_REST = 0.1
#: Part of a harmonic, over the mean of all, below which it was not moved (-).
_WEAK = 0.1
#: Mean twist over the amplitude, beyond which the twist is counted from elsewhere (-).
_MEAN = 0.5


def recorded_motion(
    path: Path,
    columns: HistoryColumns,
    scales: HistoryScales,
    axes: RecordAxes,
    *,
    case: ForcedCase,
    polar: Polar,
) -> ForcedResult:
    """Read a forced motion and compare it with its case.

    Deflection and moment become those of mid-chord as in :mod:`.recorded_release`.

    Parameters
    ----------
    path
        The file.
    columns, scales, axes
        Meaning of its columns; both axes are given.
    case
        The case: what was to be moved, and how.
    polar
        Steady loads of the section.

    Raises
    ------
    HistoryFileError
        The file cannot be read, is too short or sampled too seldom, holds another motion, or its
        loads are those of another unit, sign or axis; the message says what to change.
    """
    raw = read_table(path, columns, scales)
    _require_samples(path, raw, scales, columns, case)
    table = raw.sampled(case.output_interval, case.duration)
    rigid = math.radians(case.incidence_deg)
    assert axes.moment is not None, "given"
    assert axes.deflection is not None, "given"
    found = ForcedResult(
        table.time,
        table.twist,
        deflection_of(MID_CHORD, table, axes.deflection, rigid),
        table.lift,
        moment_about(MID_CHORD, table, axes.moment, rigid),
    )
    late = found.time >= case.settling - 1e-9
    _require_motion(path, _part(found, late), case)
    _require_loads(path, found, late, case=case, polar=polar, about=axes.moment)
    return found


def _require_samples(
    path: Path,
    raw: HistoryTable,
    scales: HistoryScales,
    columns: HistoryColumns,
    case: ForcedCase,
) -> None:
    """Refuse a record that is too short, or has too few samples of the shortest period."""
    unit = columns.units["time"]
    of_unit = scales.factor("time", unit)
    if raw.time[-1] < case.duration - 2.0 * case.output_interval:
        raise HistoryFileError(
            f"{path}: the record ends at {raw.time[-1] / of_unit:.4g} {unit} "
            f"({raw.time[-1]:.4g} c/V) after its begin; allowed is {case.duration / of_unit:.4g} "
            f"{unit} or more: move the section for longer, make forced.settling or forced.periods "
            "smaller, or correct the unit of the time"
        )
    most = math.tau / max(one.frequency for one in case.harmonics) / FEWEST_SAMPLES
    longest = float(np.diff(raw.time).max())
    if longest > most:
        raise HistoryFileError(
            f"{path}: up to {longest / of_unit:.3g} {unit} ({longest:.3g} c/V) from one sample to "
            f"the next; allowed is {most / of_unit:.2g} {unit}, {FEWEST_SAMPLES} samples of the "
            "shortest period: write it more often, or leave out the lowest forced.reduced_velocity"
        )


def _part(found: ForcedResult, kept: NDArray[np.bool_]) -> ForcedResult:
    return replace(
        found,
        time=found.time[kept],
        twist=found.twist[kept],
        deflection=found.deflection[kept],
        lift=found.lift[kept],
        moment=found.moment[kept],
    )


def _require_motion(path: Path, record: ForcedResult, case: ForcedCase) -> None:
    """Refuse a motion that is not the one that the case asks for."""
    is_pitch = case.component == "pitch"
    quantity = "twist" if is_pitch else "deflection"
    moved = record.twist if is_pitch else record.deflection
    frequencies = signal_of(case).frequencies
    if float(np.ptp(moved)) == 0.0:
        raise HistoryFileError(
            f"{path}: the {quantity} does not change; wanted the motion in {case.component}: "
            f"correct given.columns.{quantity} or given.forced"
        )
    try:
        answer = load_response(record.time, moved, frequencies)
    except ArgumentError as error:
        raise HistoryFileError(f"{path}: {error}") from None
    if answer.rest > _REST:
        raise HistoryFileError(
            f"{path}: {100 * answer.rest:.0f} % of the {quantity} is not at the frequencies of "
            f"forced.reduced_velocity (allowed is {100 * _REST:g} %); "
            f"{_other_frequency(record.time, moved, frequencies)}"
        )
    _require_amplitude(path, np.abs(answer.response), case)
    amplitude, mean = _asked(case), float(np.mean(record.twist))
    if abs(mean) > _MEAN * amplitude:
        raise HistoryFileError(
            f"{path}: the mean twist is {math.degrees(mean):.3g} deg; wanted is 0, counted from "
            f"forced.incidence_deg ({case.incidence_deg:g} deg): subtract it, or correct that key"
        )
    _require_one_motion(path, record, case, frequencies)


def _rates(case: ForcedCase) -> Floats:
    """Return the factors from amplitudes to angles of incidence: heave has them by its speed."""
    frequencies = signal_of(case).frequencies
    return np.ones_like(frequencies) if case.component == "pitch" else frequencies


def _asked(case: ForcedCase) -> float:
    """Return the amplitude of incidence (rad) that a case asks for, of all harmonics together."""
    return float(np.linalg.norm(signal_of(case).amplitudes * _rates(case)))


def _require_amplitude(path: Path, amplitudes: Floats, case: ForcedCase) -> None:
    """Refuse amplitudes of the harmonics (rad or chords) that the case does not ask for."""
    is_pitch = case.component == "pitch"
    quantity, factors = ("twist", ANGLES) if is_pitch else ("deflection", DISTANCES)
    each, asked = amplitudes * _rates(case), _asked(case)
    found = float(np.linalg.norm(each))
    if abs(found / asked - 1.0) > _OFF:
        known = [
            f"({words}): units.{quantity}"
            for factor, words in factors.items()
            if abs(factor * found / asked - 1.0) < _OFF
        ]
        advice = f"(forced.amplitude_deg: {math.degrees(found):.3g} is that of the record)"
        raise HistoryFileError(
            f"{path}: the {case.component} has an amplitude of {math.degrees(found):.3g} deg of "
            f"incidence, and forced.amplitude_deg asks for {math.degrees(asked):.3g} "
            f"{known[0] if known else advice}"
        )
    weak = np.flatnonzero(each < _WEAK * found / math.sqrt(each.size))
    if weak.size:
        velocity = math.tau / signal_of(case).frequencies[weak[0]]
        raise HistoryFileError(
            f"{path}: no {case.component} at V/(f c) = {velocity:.3g}; leave it out of "
            "forced.reduced_velocity"
        )


def _require_one_motion(
    path: Path, record: ForcedResult, case: ForcedCase, frequencies: Floats
) -> None:
    """Refuse a motion that is more of the other kind."""
    angles = [
        np.abs(load_response(record.time, values, frequencies).response) * rate
        for values, rate in ((record.twist, 1.0), (record.deflection, frequencies))
    ]
    pitch, heave = (math.sqrt(float(np.sum(one**2))) for one in angles)
    own, other, name = (
        (pitch, heave, "heave") if case.component == "pitch" else (heave, pitch, "pitch")
    )
    if other > own:
        raise HistoryFileError(
            f"{path}: the motion about mid-chord is more a {name} ({math.degrees(other):.3g} deg "
            f"of incidence) than a {case.component} ({math.degrees(own):.3g}); correct "
            "given.forced or given.deflection_axis"
        )


def _other_frequency(time: Floats, moved: Floats, frequencies: Floats) -> str:
    """Return what the frequency of a motion is, in words, if it is none of those wanted."""
    for factor, mistake in LENGTHS.items():
        try:
            rest = load_response(factor * time, moved, frequencies).rest
        except ArgumentError:
            continue
        if rest <= _REST:
            return f"a time {factor:g} times as long explains it ({mistake}): units.time"
    step = float(time[1] - time[0])
    tapered = (moved - moved.mean()) * np.hanning(moved.size)
    spectrum = np.abs(np.fft.rfft(tapered))
    strongest = np.fft.rfftfreq(moved.size, step)[1 + int(np.argmax(spectrum[1:]))]
    return (
        f"it is strongest at V/(f c) = {1.0 / strongest:.3g}: correct forced.reduced_velocity, or "
        "the unit of the time, speed or chord"
    )


def _require_loads(
    path: Path,
    found: ForcedResult,
    late: NDArray[np.bool_],
    *,
    case: ForcedCase,
    polar: Polar,
    about: float,
) -> None:
    """Refuse loads that a single mistake of sign, size or axis explains."""
    rigid = math.radians(case.incidence_deg)
    motion = ForcedMotion(found.time, rigid + found.twist, found.deflection)
    loads = expected_loads(motion, polar)
    if loads is None:
        logger.warning("%s: the motion leaves the polar, so its loads are not compared", path)
        return
    recorded = MovedLoads(found.lift[late], found.moment[late])
    expected = MovedLoads(loads.lift[late], loads.moment[late])
    difference, words = mistakes(recorded, expected, case.component, about)
    if words:
        raise HistoryFileError(
            f"{path}: the loads are not those of the polar in such a motion: {words}"
        )
    if difference > LARGEST_DIFFERENCE:
        logger.warning(
            "%s: the loads differ from those of a thin section with this polar by %.2g (0 is none, "
            "4 is the other sign), and no single unit, sign or axis explains it",
            path,
            difference,
        )
