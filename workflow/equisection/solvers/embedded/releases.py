"""Releases of many sections or beams at once, each until its verdict is in."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any, TypedDict

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.finite_span import FiniteSpan
from equisection.aerodynamics.span_strips import SpanStrips
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.beam import MID_CHORD
from equisection.beam.section import Section
from equisection.cases import BeamModes, FittedModes, UnsteadyCase
from equisection.motion.beams import BeamHistories, BeamParameters, Fittings, release_beams
from equisection.motion.march import Failure
from equisection.motion.sections import SectionHistories, release_sections
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers.embedded.equilibrium_start import (
    equilibria_of_beams,
    equilibria_of_sections,
)
from equisection.solvers.protocol import Progress
from equisection.solvers.verdicts import (
    Judge,
    TipMotion,
    first_modes,
    growths_of_tips,
    monitor_of,
    told_without_equilibrium,
)

Floats = NDArray[np.float64]


class ReleaseSettings(TypedDict):
    """Settings that the sections or beams of one release share.

    Rigid incidence (rad), twist (rad) and heave rate (over V) of the tip at the start, and times
    (c/V).
    """

    incidence_rad: float
    tip_twist: float
    tip_heave_rate: float
    duration: float
    time_step: float
    output_interval: float


def release_judged(
    sections: Sequence[Section],
    judges: Sequence[Judge],
    loads: UnsteadyLoads,
    settings: ReleaseSettings,
    *,
    progress: Progress | None = None,
    load_factors: Floats | None = None,
    from_equilibrium: bool = False,
) -> list[UnsteadyResult]:
    """Release sections in their flow, each until its own judge has decided.

    Parameters
    ----------
    sections
        The sections in their flow (:meth:`equisection.beam.section.Section.in_flow`).
    judges
        Judge of each.
    loads, settings
        Loads and settings of all.
    progress
        Called with the time that has been reached and the last one (c/V).
    load_factors
        Factors of c_l and c_m of each (:func:`equisection.motion.sections.section_system`).
    from_equilibrium
        Start from static equilibrium, where there is one, in the place of the undeformed section.
    """

    def tip_of(histories: SectionHistories, lane: int, part: slice) -> TipMotion:
        return _section_tip(histories, sections[lane], lane, part)

    about, is_without = None, np.zeros(len(sections), dtype=bool)
    if from_equilibrium:
        about, is_without = _with_rigid(
            equilibria_of_sections(sections, loads, settings["incidence_rad"], load_factors)
        )
    histories = release_sections(
        sections,
        loads,
        settings["incidence_rad"],
        settings["duration"],
        time_step=settings["time_step"],
        output_interval=settings["output_interval"],
        load_factors=load_factors,
        twist=settings["tip_twist"] * np.array([each.twist_recovery for each in sections]),
        heave_rate=settings["tip_heave_rate"]
        * np.array([each.deflection_recovery for each in sections]),
        about=about,
        monitor=monitor_of(judges, tip_of),
        progress=progress,
    )
    ends = map(int, histories.samples)
    tips = [tip_of(histories, lane, slice(end)) for lane, end in enumerate(ends)]
    growths = growths_of_tips(judges, tips)
    return [
        _saying(
            _section_result(
                histories,
                section,
                lane,
                settings["incidence_rad"],
                judge.attributes(tip, _failure(histories.failures, lane), growth),
            ),
            bool(is_without[lane]),
        )
        for lane, (section, judge, tip, growth) in enumerate(
            zip(sections, judges, tips, growths, strict=True)
        )
    ]


def _with_rigid(equilibria: Floats) -> tuple[Floats, NDArray[np.bool_]]:
    """Return structural states, undeformed where there is no equilibrium, and where that is."""
    is_without = np.asarray(~np.isfinite(equilibria).all(axis=1), dtype=np.bool_)
    return np.where(is_without[:, None], 0.0, equilibria), is_without


def _saying(result: UnsteadyResult, is_without: bool) -> UnsteadyResult:
    """Return a result whose verdict says that it has no equilibrium, if it has none."""
    return told_without_equilibrium(result) if is_without else result


def release_all_sections(
    cases: list[UnsteadyCase], loads: UnsteadyLoads, progress: Progress
) -> list[UnsteadyResult]:
    """Release the sections of some cases that share all but their structure."""
    sections = [case.section for case in cases if case.section]
    judges = [Judge.of(case) for case in cases]
    factors = np.array([(case.lift_factor, case.moment_factor) for case in cases])
    settings = _common_settings(cases[0])
    return release_judged(
        sections,
        judges,
        loads,
        settings,
        progress=progress,
        load_factors=factors,
        from_equilibrium=cases[0].start.state == "equilibrium",
    )


def release_all_beams(
    cases: list[UnsteadyCase],
    loads: UnsteadyLoads,
    strips: SpanStrips,
    finite_span: FiniteSpan,
    progress: Progress,
) -> list[UnsteadyResult]:
    """Release the beams of some cases that share all but their frequencies.

    ``finite_span`` is what the ``strips`` do to each other.
    """
    judges = [Judge.of(case) for case in cases]
    modes = [case.beam for case in cases if case.beam]
    parameters = beam_parameters(modes, strips, finite_span)
    about, is_without = None, np.zeros(len(cases), dtype=bool)
    if cases[0].start.state == "equilibrium":
        alone = [beam_parameters([one], strips, finite_span) for one in modes]
        rigid = math.radians(cases[0].incidence_deg)
        about, is_without = _with_rigid(equilibria_of_beams(alone, loads, rigid))
    histories = release_beams(
        parameters,
        loads,
        **_common_settings(cases[0]),
        about=about,
        monitor=monitor_of(judges, _beam_tip),
        progress=progress,
    )
    ends = map(int, histories.samples)
    tips = [_beam_tip(histories, lane, slice(end)) for lane, end in enumerate(ends)]
    growths = growths_of_tips(judges, tips)
    return [
        _saying(
            _beam_result(
                case,
                histories,
                lane,
                judge.attributes(tip, _failure(histories.failures, lane), growth),
            ),
            bool(is_without[lane]),
        )
        for lane, (case, judge, tip, growth) in enumerate(
            zip(cases, judges, tips, growths, strict=True)
        )
    ]


def beam_parameters(
    modes: list[BeamModes], strips: SpanStrips, finite_span: FiniteSpan | None
) -> BeamParameters:
    """Return the modes of some beams at strips, with what these do to each other, if anything."""
    return BeamParameters.from_modes(
        span=np.array(modes[0].span),
        torsion_shapes=np.array(modes[0].torsion_shape),
        torsion_frequencies=np.array([beam.torsion_frequency for beam in modes]),
        inertia=np.array([beam.inertia for beam in modes]),
        bending_shapes=np.array(modes[0].bending_shape),
        bending_frequencies=np.array([beam.bending_frequency for beam in modes]),
        mass=np.array([beam.mass for beam in modes]),
        stations=strips.stations,
        weights=strips.weights,
        finite_span=finite_span,
        imbalance=np.array([beam.imbalance for beam in modes]),
        damping_ratios=(modes[0].bending_damping, modes[0].torsion_damping),
        axis=modes[0].elastic_axis - MID_CHORD,
        fittings=_fittings(modes),
    )


def _fittings(modes: list[BeamModes]) -> Fittings | None:
    """Return lumped masses and dashpots of some beams that all have them, or none."""
    fitted = [beam.fittings for beam in modes if beam.fittings]
    if not fitted:
        return None
    return Fittings(
        **{
            name: np.array([getattr(one, name) for one in fitted])
            for name in FittedModes.model_fields
        }
    )


def _common_settings(case: UnsteadyCase) -> ReleaseSettings:
    return {
        "incidence_rad": math.radians(case.incidence_deg),
        "tip_twist": math.radians(case.start.twist_deg),
        "tip_heave_rate": case.start.heave_rate,
        "duration": case.duration,
        "time_step": case.time_step,
        "output_interval": case.output_interval,
    }


def _section_tip(
    histories: SectionHistories, section: Section, lane: int, part: slice
) -> TipMotion:
    return TipMotion(
        histories.time[part],
        histories.twist[part, lane] / section.twist_recovery,
        histories.deflection[part, lane] / section.deflection_recovery,
    )


def _beam_tip(histories: BeamHistories, lane: int, part: slice) -> TipMotion:
    return TipMotion(
        histories.time[part],
        histories.tip_twist[part, lane],
        histories.tip_deflection[part, lane],
        first_modes(
            histories.torsion_amplitudes[part, lane].T, histories.bending_amplitudes[part, lane].T
        ),
    )


def _section_result(
    histories: SectionHistories,
    section: Section,
    lane: int,
    incidence_rad: float,
    verdict: dict[str, Any],
) -> UnsteadyResult:
    end = int(histories.samples[lane])
    tip = _section_tip(histories, section, lane, slice(end))
    twist = histories.twist[:end, lane]
    about_axis = histories.axis_moment_coefficient
    is_offset = about_axis is not None and section.axis_behind_mid_chord != 0.0
    return UnsteadyResult(
        time=tip.time,
        twist=twist,
        deflection=histories.deflection[:end, lane],
        tip_twist=tip.twist,
        tip_deflection=tip.deflection,
        lift=histories.lift_coefficient[:end, lane],
        moment=histories.moment_coefficient[:end, lane],
        incidence=incidence_rad + twist,
        verdict=verdict,
        axis_moment=about_axis[:end, lane] if is_offset and about_axis is not None else np.empty(0),
    )


def _beam_result(
    case: UnsteadyCase, histories: BeamHistories, lane: int, verdict: dict[str, Any]
) -> UnsteadyResult:
    end = int(histories.samples[lane])
    about_axis = histories.axis_moment_coefficient
    tip = _beam_tip(histories, lane, slice(end))
    return UnsteadyResult(
        time=tip.time,
        twist=tip.twist,
        deflection=tip.deflection,
        tip_twist=tip.twist,
        tip_deflection=tip.deflection,
        lift=histories.lift_coefficient[:end, lane],
        moment=histories.moment_coefficient[:end, lane],
        incidence=math.radians(case.incidence_deg) + tip.twist,
        verdict=verdict,
        axis_moment=np.empty(0) if about_axis is None else about_axis[:end, lane],
        torsion_amplitudes=histories.torsion_amplitudes[:end, lane].T,
        bending_amplitudes=histories.bending_amplitudes[:end, lane].T,
    )


def _failure(failures: Iterable[Failure], lane: int) -> str:
    """Return why a lane ended early, or nothing."""
    for failure in failures:
        if failure.lane == lane and failure.time == 0:
            return (
                "no steady flow to be released from was found: the incidence leaves the section "
                "polar, or alternates from strip to strip where the lift falls too steeply; extend "
                "the polar or take fewer embedded.strips"
            )
        if failure.lane == lane:
            return (
                f"at {failure.time:.4g} c/V an incidence of "
                f"{math.degrees(failure.incidence_rad):.4g} deg left the section polar; extend "
                "the polar or lower unsteady.verdict.growing_amplitude_deg"
            )
    return ""
