"""A model learnt from one kept release by OpenFOAM in the place of a sweep: onset, growth, cost."""

import math
import time
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import numpy as np

from equisection.aerodynamics.filled_polar import filled
from equisection.aerodynamics.finite_span import FiniteSpan
from equisection.aerodynamics.learnt_loads import learn
from equisection.aerodynamics.lifting_line import LiftingLine
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.strip_polars import StripPolars
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.aerodynamics.vortex_rings import SpanGeometry
from equisection.analysis.recorded_beam import on_strips, read_recorded_beam
from equisection.analysis.reduced_beam import (
    growth_of_pitch,
    learnt_beam,
    predicted_beams,
)
from equisection.analysis.reduced_model import (
    ENDS,
    ReducedModel,
    learnt_model,
    limit_cycles,
    next_release,
    onset_of,
    predicted,
    predicted_onset,
)
from equisection.beam.section import Section
from equisection.cases import BeamModes, UnsteadyCase
from equisection.motion.beam_lesson import BeamRelease, learn_strips
from equisection.motion.beams import BeamParameters, release_beams
from equisection.motion.learnt_beams import LearntBeams
from equisection.motion.learnt_motion import LearntSections
from equisection.motion.sections import release_sections
from equisection.results.netcdf import read_dataset
from equisection.results.recorded_history import read_reference_history
from equisection.solvers.embedded.releases import beam_parameters
from equisection.verdict.growth import AFTER_RELEASE, Growth, growth_of, growth_window
from tests.benchmarks.measure import Row, limit
from tests.workflow.project import ROOT

REFERENCE = ROOT / "results" / "reference"
Sweep = dict[float, ReferenceHistory]
#: k* between which growth rates are compared.
COMPARED = (5.5, 14.0)
#: Growth of CFD and model is read from the last 5.4 natural periods of the pitch before this time
#: (c/V).
UNTIL = 100.0
#: Parts (c/V) of the records of 100 c/V of beams in which growth is read, early to late.
PARTS_OF_LONG = ((10.0, 60.0), (20.0, 60.0), (35.0, 80.0), (50.0, 100.0), (65.0, 100.0))
#: k* of the kept beams that a model is learnt from.
LEARNT_BEAMS = (5.5, 6.44, 8.0, 10.0)
#: k* of embedded beams with a limit cycle, the first of which is learnt from, and time (c/V) after
#: which all have come to theirs.
CYCLES_OF_BEAMS, UNTIL_CYCLE = (5.7, 5.8, 5.9), 1600.0


def rows() -> Iterator[Row]:
    """Compare predictions of single releases with the kept sweeps."""
    coarse = polar_of("paper-plate-openfoam", "coarse")
    medium = filled(polar_of("paper-plate-openfoam-grid", "medium"), coarse)
    sections, corrected = (
        sweep_of("paper-plate-openfoam", name) for name in ("2d", "2d-corrected")
    )
    finer = sweep_of("paper-plate-openfoam-medium", "2d")
    learnt = learnt_model(sections[6.44], coarse)
    for name, sweep in (("2d", sections), ("2d-corrected", corrected)):
        yield from _compared(f"{name} from k* 6.44", learnt, sweep, 3.0)
    yield _small_motions(learnt, sections[6.44].section)
    far = learnt_model(sections[10.0], coarse)
    again = next_release(far.k_star, predicted_onset(over(sections, far)))
    assert again is not None, "a release at k* 10 is too far from the onset"
    second = learnt_model(sections[_nearest(sections, again)], coarse)
    for name, sweep in (("2d", sections), ("2d-corrected", corrected)):
        words = f"{name} from k* 10, which asks for {again:g}, and {second.k_star:g}"
        yield from _compared(words, second, sweep, 3.0)
    of_medium = learnt_model(finer[6.44], medium)
    yield from _compared("medium mesh from k* 6.44", of_medium, finer, 3.5)
    spent = sum(float(history.time[-1]) for history in sections.values())
    yield limit("simulated time over that of the sweep of 2d", ENDS[-1] / spent, 0.05, "")
    held = [
        found
        for sweep, polar, others in (
            (sections, coarse, (sections, corrected)),
            (corrected, coarse, (corrected,)),
            (finer, medium, (finer,)),
        )
        for found in _trials(sweep, polar, others)
    ]
    part = sum(held) / len(held)
    yield Row(
        f"intervals that hold the sweep's onset, of {len(held)} trials",
        f"{sum(held)}",
        ">= 9 of 10",
        part >= 0.9,
    )
    yield from _limit_cycle(sections, coarse)
    yield from _beam()
    yield from _cycles_of_beams(coarse)
    yield from _embedded(sections[6.44].section, coarse)
    start = time.process_time()
    k_star = np.geomspace(4.0, 25.0, 1000)
    predicted(
        learnt_model(sections[6.44], coarse),
        k_star,
        [sections[6.44].section.scaled(k / 6.44) for k in k_star],
    )
    yield limit("fit and 1,000 k*, processor time", time.process_time() - start, 10.0, "s")


def _small_motions(model: ReducedModel, section: Section) -> Row:
    """Compare the onset of small motions, by eigenvalues, with that of releases by one model."""
    k_star = np.geomspace(5.0, 14.0, 60)
    scaled = [section.scaled(one / 6.44) for one in k_star]
    growth = np.nanmax(LearntSections(scaled, model.loads).eigenvalues().real, axis=1)
    small, released = onset_of(k_star, growth), predicted_onset(predicted(model, k_star, scaled))
    faster = 100.0 * (math.sqrt(released.k_star / small) - 1.0)
    return Row(
        "2d from k* 6.44: onset of small motions by eigenvalues",
        f"{small:.2f}, {faster:+.1f} % in speed from {released.k_star:.2f} of releases",
    )


def _limit_cycle(sections: Sweep, polar: Polar) -> Iterator[Row]:
    """Compare the limit cycle at k* 6.44 with those of models of growing releases."""
    (kept,) = sweep_of("paper-plate-openfoam-cycle", "2d").values()
    factor = kept.section.twist_recovery
    late = kept.time > kept.time[-1] - 2.0 / kept.section.uncoupled_frequencies[0]
    recorded = 0.5 * math.degrees(float(np.ptp(kept.twist[late]))) / factor
    for k_star, until in ((5.5, math.inf), (5.0, math.inf), (5.5, 45.0), (6.44, 45.0)):
        loads = learn(sections[k_star], polar, until)
        found = limit_cycles(loads, [kept.section]).iloc[0]
        amplitude = found["twist_amplitude_deg"] / factor
        off = 100.0 * (amplitude / recorded - 1.0)
        beyond = ", extrapolated" if found["extrapolated"] else ""
        yield Row(
            f"limit cycle at k* 6.44, learnt from {loads.learnt_until:g} c/V at {k_star:g}",
            f"{amplitude:.2f} deg, {off:+.1f} %{beyond}",
            f"{recorded:.2f} deg +- 10 %" if math.isinf(until) else "",
            abs(off) <= 10.0 if math.isinf(until) else None,
        )


def _embedded(section: Section, polar: Polar) -> Iterator[Row]:
    """Learn from releases by the embedded solver, whose loads have several lags."""
    k_star = [6.0, 7.0, 8.0, 9.0, 10.0]
    sections = [section.scaled(one / 6.44) for one in k_star]
    angle, whole = math.radians(2.5), polar.continued
    loads = UnsteadyLoads.from_polar(whole)
    run = release_sections(sections, loads, angle, UNTIL)
    sweep = {
        one: ReferenceHistory(
            run.time,
            run.twist[:, lane],
            run.deflection[:, lane],
            run.lift_coefficient[:, lane],
            run.moment_coefficient[:, lane],
            angle,
            k_star=one,
            section=sections[lane],
            name=f"k{one:g}",
            source="embedded solver",
        )
        for lane, one in enumerate(k_star)
    }
    onset = onset_of_sweep(sweep)
    for one in (6.0, 7.0, 8.0):
        found = predicted_onset(over(sweep, learnt_model(sweep[one], polar)))
        off = 100.0 * (found.k_star / onset - 1.0)
        yield Row(
            f"embedded solver, onset {onset:.2f}, learnt at k* {one:g}",
            f"{found.k_star:.2f} [{found.low:.2f}, {found.high:.2f}], {off:+.1f} %",
        )


def _cycles_of_beams(polar: Polar) -> Iterator[Row]:
    """Compare limit cycles of embedded beams with those of models of their growing releases."""
    layout, angle = cosine_strips(12), math.radians(2.5)
    kept = read_dataset(REFERENCE / "paper-plate-openfoam-3d" / "unsteady" / "3d" / "k6.44.nc")
    case = UnsteadyCase.model_validate_json(kept.attrs["case"])
    assert case.beam is not None, "the plate"
    geometry, k_star = case.geometry, np.array(CYCLES_OF_BEAMS)
    width = None if geometry.tip_gap is None else geometry.span + geometry.tip_gap
    span = SpanGeometry.of(layout, 1.0, geometry.span, width, geometry.channel_height)
    beams = [_stiffer(case.beam, one / case.k_star) for one in k_star]
    whole = polar.continued
    run = release_beams(
        beam_parameters(beams, layout, FiniteSpan.of(span)),
        UnsteadyLoads.from_polar(whole),
        angle,
        UNTIL_CYCLE,
        time_step=0.1,
    )
    late = run.time > UNTIL_CYCLE - 20.0
    sizes = [0.5 * math.degrees(float(np.ptp(one[late]))) for one in run.tip_twist.T]
    line = LiftingLine.of(whole, layout, span)
    angles = np.radians([0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11])
    steady = [line.solve(one) for one in angles]
    polars = StripPolars(
        angles,
        layout.stations,
        np.array([one.cl_section for one in steady]),
        np.array([one.cm_section for one in steady]),
        "embedded",
    )
    learnt, others = 0, (1, 2)
    release = BeamRelease(
        run.time,
        run.torsion_amplitudes[:, learnt].T,
        run.bending_amplitudes[:, learnt].T,
        on_strips(beams[:1], polars.strips),
        angle,
        k_star=float(k_star[learnt]),
        name=f"3d/k{k_star[learnt]:g}",
        source="embedded solver",
    )
    parameters = on_strips(beams, polars.strips)
    swings = LearntBeams(parameters, learn_strips(release, polars)).released(UNTIL_CYCLE)
    twist = swings.torsion[swings.time > UNTIL_CYCLE - 20.0] @ parameters.torsion_at_tip
    for place in others:
        size = 0.5 * math.degrees(float(np.ptp(twist[:, place])))
        yield Row(
            f"embedded beam at k* {k_star[place]:g}: limit cycle, learnt from "
            f"{UNTIL_CYCLE:g} c/V at {k_star[learnt]:g}",
            f"{size:.2f} deg, {sizes[place]:.2f} in the release",
        )


def _stiffer(beam: BeamModes, factor: float) -> BeamModes:
    """Return the modes of a beam with a factor on its stiffness."""
    names = ("bending_frequency", "torsion_frequency")
    scaled = {name: tuple(math.sqrt(factor) * one for one in getattr(beam, name)) for name in names}
    return beam.model_copy(update=scaled)


def _beam() -> Iterator[Row]:
    """Show the growth of the kept beams, and compare it with models learnt from one of them."""
    polars = strip_polars_of("paper-plate-openfoam-3d", "coarse")
    kept = {
        release.k_star: release
        for run in ("", "-long")
        for path in (REFERENCE / f"paper-plate-openfoam-3d{run}" / "unsteady" / "3d").glob("k*.nc")
        for release in [read_recorded_beam(path, polars.strips)]
    }
    beams = dict(sorted(kept.items()))
    for waves in (2, 3):
        rates = {k_star: _growth_of_beam(release, waves) for k_star, release in beams.items()}
        falls = bool((np.diff([growth.rate for growth in rates.values()]) < 0.0).all())
        yield Row(
            f"beam, {waves} waves: growth (V/c) at k*",
            _in_thousandths(rates),
            "falls" if waves == 3 else "",
            falls if waves == 3 else None,
        )
        found = [growth.rate for growth in rates.values()]
        yield Row(f"beam, {waves} waves: onset", f"k* {onset_of(list(rates), found):.2f}")
    for k_star in (10.0, 12.0, 14.0):
        for waves in (2, 3):
            parts = [_growth_of_beam(beams[k_star], waves, part) for part in PARTS_OF_LONG]
            yield Row(
                f"beam at k* {k_star:g}, {waves} waves: growth (V/c) in parts of its record",
                f"{1e3 * min(part.rate for part in parts):.1f} to "
                f"{1e3 * max(part.rate for part in parts):.1f} e-3",
            )
    yield from _learnt_beams(beams, polars)


def _learnt_beams(beams: dict[float, BeamRelease], polars: StripPolars) -> Iterator[Row]:
    """Compare growth and onset of models of the strips with the kept beams."""
    onset = onset_of(list(beams), [_growth_of_beam(one, 3).rate for one in beams.values()])
    start = time.process_time()
    for k_star in LEARNT_BEAMS:
        model = learnt_beam(beams[k_star], polars)
        found = predicted_beams(
            model, list(beams), _together(beams), [_window_of_beam(one) for one in beams.values()]
        )
        by_model = predicted_onset(found)
        errors = found["growth_rate"] - [_growth_of_beam(one, 3).rate for one in beams.values()]
        near, far = (
            float(np.sqrt(np.mean(errors[found["k_star"].between(*ends)] ** 2)))
            for ends in ((5.0, 10.0), (10.0, 14.0))
        )
        small = growth_of_pitch(LearntBeams(_together(beams), model.loads))
        asked = k_star in (6.44, 8.0)
        yield Row(
            f"beam learnt at k* {k_star:g}: growth, rms for k* 5 to 10, and for 10 to 14",
            f"{near:.4f}, {far:.4f} V/c",
            "<= 0.002" if asked else "",
            near <= 0.002 if asked else None,
        )
        yield Row(
            f"beam learnt at k* {k_star:g}: onset, and by eigenvalues",
            f"{by_model.k_star:.2f} [{by_model.low:.2f}, {by_model.high:.2f}], "
            f"{100.0 * (by_model.k_star / onset - 1.0):+.0f} %, "
            f"{onset_of(list(beams), small):.2f}",
            f"{onset:.2f} inside",
            by_model.low <= onset <= by_model.high,
        )
    spent = time.process_time() - start
    yield from _learnt_in_parts(beams, polars)
    yield limit("beam: fit and prediction, processor time", spent / len(LEARNT_BEAMS), 10.0, "s")


def _learnt_in_parts(beams: dict[float, BeamRelease], polars: StripPolars) -> Iterator[Row]:
    """Compare models of the swing that follows a release, and of the small motions after it."""
    onset = onset_of(list(beams), [_growth_of_beam(one, 3).rate for one in beams.values()])
    whole, places = beams[10.0], {one: place for place, one in enumerate(beams)}
    for begin, end in ((0.0, 45.0), (20.0, 95.0)):
        part = (whole.time >= begin) & (whole.time <= end)
        cut = replace(
            whole,
            time=whole.time[part] - begin,
            torsion=whole.torsion[:, part],
            bending=whole.bending[:, part],
        )
        small = growth_of_pitch(LearntBeams(_together(beams), learn_strips(cut, polars)))
        found = onset_of(list(beams), small)
        yield Row(
            f"beam learnt at k* 10 from {begin:g} to {end:g} c/V: growth by eigenvalues at k* "
            "5, 10 and 12, and onset",
            ", ".join(f"{1e3 * small[places[one]]:.1f}" for one in (5.0, 10.0, 12.0))
            + f" e-3, {found:.2f}, {100.0 * (found / onset - 1.0):+.0f} %",
        )


def _in_thousandths(rates: dict[float, Growth]) -> str:
    return (
        ", ".join(
            f"{k_star:g}: {1e3 * one.rate:.1f} +- {1e3 * one.standard_error:.1f}"
            for k_star, one in rates.items()
        )
        + " e-3"
    )


def _window_of_beam(release: BeamRelease) -> tuple[float, float]:
    structure = release.parameters.structure
    pitch = math.sqrt(structure.torsion_stiffness[0, 0] / structure.torsion_inertia[0, 0])
    return growth_window(float(release.time[-1]), pitch / (2.0 * math.pi))


def _growth_of_beam(
    release: BeamRelease, waves: int, window: tuple[float, float] | None = None
) -> Growth:
    """Return the growth of the pitch, fitted with ``waves`` - 1 bending modes."""
    structure = release.parameters.structure
    stiffness = [structure.torsion_stiffness[0, :1], structure.bending_stiffness[0, : waves - 1]]
    inertia = [structure.torsion_inertia[0, :1], structure.bending_mass[0, : waves - 1]]
    natural = np.sqrt(np.concatenate(stiffness) / np.concatenate(inertia)) / (2.0 * math.pi)
    records = [release.torsion[0], *release.bending[: waves - 1]]
    return growth_of(release.time, records, natural, window or _window_of_beam(release))


def _together(beams: dict[float, BeamRelease]) -> BeamParameters:
    """Return the modes of all beams as lanes; they differ in stiffness."""
    parameters = [release.parameters for release in beams.values()]
    names = ("torsion_stiffness", "bending_stiffness", "torsion_inertia", "bending_mass")
    more = ("imbalance", "torsion_damping", "bending_damping", "axis")
    values = {
        name: np.concatenate([getattr(one.structure, name) for one in parameters])
        for name in (*names, *more, "lift_factor", "moment_factor")
    }
    return replace(parameters[0], structure=replace(parameters[0].structure, **values))


def strip_polars_of(run: str, mesh: str) -> StripPolars:
    """Return the polars along the span of kept steady results of a beam."""
    rows = []
    for path in (REFERENCE / run / "steady" / "3d").glob(f"{mesh}_a*.nc"):
        data = read_dataset(path)
        loads = [data[name].values for name in ("span", "cl_section", "cm_section")]
        rows.append((math.radians(data.attrs["incidence_deg"]), *loads))
    incidence, span, lift, moment = zip(*sorted(rows, key=lambda row: row[0]), strict=True)
    return StripPolars(np.array(incidence), span[0], np.array(lift), np.array(moment), mesh)


def polar_of(run: str, mesh: str) -> Polar:
    """Return the polar of kept steady results."""
    points = []
    for path in (REFERENCE / run / "steady" / "2d").glob(f"{mesh}_a*.nc"):
        data = read_dataset(path)
        angle = math.radians(data.attrs["incidence_deg"])
        points.append((angle, *(float(data[name]) for name in ("cd", "cl", "cm"))))
    return Polar(*np.array(sorted(points)).T, mesh)


def sweep_of(run: str, model: str) -> Sweep:
    """Return the kept releases of a model by their k*."""
    paths = sorted((REFERENCE / run / "unsteady" / model).glob("k*.nc"), key=_k_star)
    return {_k_star(path): read_reference_history(path) for path in paths}


def _k_star(path: Path) -> float:
    return float(path.stem.removeprefix("k"))


def _window(history: ReferenceHistory) -> tuple[float, float]:
    end = min(UNTIL, float(history.time[-1]))
    return max(AFTER_RELEASE, end - 5.4 / history.section.uncoupled_frequencies[0]), end


def _recorded(history: ReferenceHistory) -> float:
    """Return the growth rate of a kept release (V/c)."""
    records = [history.twist, history.deflection]
    natural = np.array(history.section.uncoupled_frequencies)
    return growth_of(history.time, records, natural, _window(history)).rate


def over(sweep: Sweep, model: ReducedModel):
    """Return the prediction of a model at the k* of a sweep from 5 on."""
    chosen = [history for k_star, history in sweep.items() if k_star >= 5.0]
    return predicted(
        model,
        [history.k_star for history in chosen],
        [history.section for history in chosen],
        [_window(history) for history in chosen],
    )


def onset_of_sweep(sweep: Sweep) -> float:
    """Return the onset (k*) between the growth rates of a kept sweep."""
    chosen = [k_star for k_star in sweep if k_star >= 5.0]
    return onset_of(chosen, [_recorded(sweep[k_star]) for k_star in chosen])


def _compared(words: str, model: ReducedModel, sweep: Sweep, most: float) -> Iterator[Row]:
    found, onset = over(sweep, model), onset_of_sweep(sweep)
    by_model = predicted_onset(found)
    off = 100.0 * (by_model.k_star / onset - 1.0)
    yield Row(
        f"{words}: onset",
        f"{by_model.k_star:.2f} [{by_model.low:.2f}, {by_model.high:.2f}], {off:+.1f} %",
        f"{onset:.2f} +- {most:g} %",
        abs(off) <= most,
    )
    inside = found[(found["k_star"] >= COMPARED[0]) & (found["k_star"] <= COMPARED[1])]
    errors = [
        rate - _recorded(sweep[k_star])
        for k_star, rate in zip(inside["k_star"], inside["growth_rate"], strict=True)
    ]
    rms = float(np.sqrt(np.mean(np.square(errors))))
    yield limit(f"{words}: growth, rms", rms, 0.004, "V/c")


def _trials(sweep: Sweep, polar: Polar, others: tuple[Sweep, ...]) -> Iterator[bool]:
    """Tell of each release of a sweep whether the interval learnt from it holds each onset.

    A release that asks for another is followed by the kept one nearest to that.
    """
    onsets = [onset_of_sweep(other) for other in others]
    models: dict[float, ReducedModel] = {}
    for first in sweep:
        k_star = first
        for _ in range(2):
            if k_star not in models:
                models[k_star] = learnt_model(sweep[k_star], polar)
            again = next_release(
                models[k_star].k_star, predicted_onset(over(sweep, models[k_star]))
            )
            if again is None:
                break
            k_star = _nearest(sweep, again)
        for other, onset in zip(others, onsets, strict=True):
            found = predicted_onset(over(other, models[k_star]))
            yield found.low <= onset <= found.high


def _nearest(sweep: Sweep, k_star: float) -> float:
    return min(sweep, key=lambda kept: abs(kept - k_star))
