"""Onset of the paper's plate and of its sections over the cell size, and over the damping.

The onset of a mesh comes from its releases, whose growth rates have zero between two k*; where a
mesh has a release at one k* alone, from the growth curve of the next coarser one, shifted by the
difference of both there; and from the model that is learnt from one release
(:mod:`equisection.analysis.reduced_model`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pandas as pd

from equisection.aerodynamics.polar import Polar
from equisection.analysis.growth_onset import onset_by_growth
from equisection.analysis.recorded_beam import on_strips, read_recorded_beam
from equisection.analysis.reduced_beam import ReducedBeam, learnt_beam, predicted_beams
from equisection.analysis.reduced_model import (
    PredictedOnset,
    learnt_model,
    onset_of,
    predicted,
    predicted_onset,
)
from equisection.beam.section import Section
from equisection.cases import BeamModes
from equisection.config.groups.openfoam_keys import ON_CELLS_OF_PLATE
from equisection.errors import ResultFileError
from equisection.paper.mesh_convergence.kept_releases import (
    OWN_RATIOS,
    MeshLoads,
    MeshRelease,
    alike_sections,
    growth_table,
    is_on_cells_of_plate,
    polars_of,
    strip_polars_of,
)
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, MeshValue
from equisection.reduction.corrected_section import corrected_section
from equisection.reduction.correction import CorrectionFactors
from equisection.results.recorded_history import read_reference_history
from equisection.study.axes import K_STAR
from equisection.verdict.growth import AFTER_RELEASE, Growth

#: Names of the quantities.
ONSET, GROWTH, GROWTH_EARLY = (
    "onset k*",
    "growth, V/c",
    "growth over the first 30 c/V",
)
#: Bases of an onset.
BY_RELEASES, BY_MODEL = "releases", "learnt model"
#: Models of the section.
SECTIONS = ("2d", "2d-corrected", OWN_RATIOS)
#: Start of a note on the polar that a model rests on.
POLAR_OF = "polar of "
#: End of a note on the growth of the plate.
WITHOUT_SECOND = "without the second bending mode"
#: k* of the release that models are learnt from.
LEARNT_AT = 6.44
#: Structural damping (of critical) in both motions.
DAMPING = (0.0, 0.005, 0.01, 0.02)
#: k* at which models predict, of sections and of the plate.
_SECTIONS_AT = np.geomspace(3.9, 11.0, 16)
BEAMS_AT = np.geomspace(4.0, 20.0, 13)
#: End (c/V) of the shortest releases of the plate, up to which its meshes are compared.
EARLY = 30.0
#: Iterations of a time step of the plate that are enough.
PLATE_ITERATIONS = 4


def growth_series(releases: Sequence[MeshRelease]) -> Iterator[MeshSeries]:
    """Yield the growth rates of the section at each k* that two meshes have, over one window."""
    for k_star, alike, end in alike_sections(releases):
        values = []
        for one in alike:
            growth = one.behind_release(end)
            low, high = growth.interval
            values.append(MeshValue(one.mesh, one.cells, growth.rate, low, high))
        start, last = growth.start, growth.end
        basis = f"releases, {start:.0f} to {last:.0f} c/V"
        yield MeshSeries(GROWTH, "2d", f"k* = {k_star:g}", basis, 2, tuple(values))


def early_growth_of_plate(releases: Sequence[MeshRelease]) -> MeshSeries:
    """Return the growth of the plate over 30 c/V at k* = 6.44 on each mesh, with four iterations.

    It is no growth rate of the plate: over so short a time the release shows, and fits with one and
    with two bending modes differ by more than their errors. That is in the notes and not in the
    intervals: the difference of two meshes over the same window is what the values are for.
    """
    values = []
    for run, growth, without in _early_growths(releases):
        half = half_width(growth)
        values.append(
            MeshValue(
                run.mesh,
                run.cells,
                growth.rate,
                growth.rate - half,
                growth.rate + half,
                f"{without.rate:+.4f} {WITHOUT_SECOND}",
            )
        )
    at = f"k* = {LEARNT_AT:g}"
    return MeshSeries(GROWTH_EARLY, "3d", at, "releases, 10 to 30 c/V", 3, tuple(values))


def _early_growths(
    releases: Sequence[MeshRelease],
) -> Iterator[tuple[MeshRelease, Growth, Growth]]:
    """Yield the plate's releases that are compared, with their growth over 30 c/V.

    It is fitted with two bending modes, and with the first alone.
    """
    for one in releases:
        is_compared = one.case.k_star == LEARNT_AT and one.iterations == PLATE_ITERATIONS
        if one.model == "3d" and is_compared:
            first, both = (one.growth(AFTER_RELEASE, min(EARLY, one.end), n) for n in (2, 3))
            yield one, both, first


def half_width(growth: Growth) -> float:
    """Return half of the interval of a growth rate (V/c)."""
    return 0.5 * float(np.ptp(growth.interval))


def onsets_by_releases(releases: Sequence[MeshRelease]) -> Iterator[MeshSeries]:
    """Yield the onset of each model over the meshes, from releases."""
    for model in (*SECTIONS, "3d"):
        own = [one for one in releases if one.model == model]
        values = _of_plate(own) if model == "3d" else _of_section(own)
        if values:
            dimensions = 3 if model == "3d" else 2
            yield MeshSeries(ONSET, model, "", BY_RELEASES, dimensions, tuple(values))


def _by_mesh(releases: Sequence[MeshRelease]) -> dict[str, list[MeshRelease]]:
    meshes = dict.fromkeys(one.mesh for one in sorted(releases, key=lambda release: release.cells))
    return {mesh: [one for one in releases if one.mesh == mesh] for mesh in meshes}


def _of_section(releases: Sequence[MeshRelease]) -> list[MeshValue]:
    values: list[MeshValue] = []
    curve: list[MeshRelease] = []
    for mesh, runs in _by_mesh(releases).items():
        found = onset_by_growth(growth_table(runs), K_STAR)
        if math.isfinite(found.value):
            ends = found.low, found.high
            values.append(onset_on(mesh, runs[0].cells, (found.value, *ends)))
            curve = runs
        elif curve:
            values += _shifted(curve, runs, values[-1])
    return values


def _shifted(
    curve: Sequence[MeshRelease], runs: Sequence[MeshRelease], base: MeshValue
) -> list[MeshValue]:
    """Return the onset of a mesh with few releases, by the shift of the growth of a coarser one."""
    found = []
    for run in runs:
        for known in curve:
            if known.case.k_star == run.case.k_star:
                end = min(known.end, run.end)
                here, there = run.behind_release(end), known.behind_release(end)
                half = math.hypot(*map(half_width, (here, there)))
                found.append((run, known, here.rate - there.rate, half))
    if not found:
        return []
    run, known, shift, half = min(found, key=lambda one: abs(one[0].case.k_star - base.value))
    note = f"growth of {known.mesh} {shift:+.4f} V/c, the difference at k* = {run.case.k_star:g}"
    onset = moved_onset(growth_table(curve), (shift, half), base.half_width)
    return [onset_on(run.mesh, run.cells, onset, note)]


def moved_onset(
    curve: pd.DataFrame, shift: tuple[float, float], error: float
) -> tuple[float, float, float]:
    """Return the k* where a growth curve is zero that is moved by a shift, and its interval.

    Parameters
    ----------
    curve
        Growth rates of a mesh over k* (:func:`.kept_releases.growth_table`).
    shift
        The shift and half of its interval (V/c).
    error
        Half of the interval of the onset on that mesh, which is added as an independent error.
    """
    ordered = curve.sort_values("k_star")
    k_star, rates = ordered["k_star"].tolist(), ordered["growth_rate"].to_numpy()
    moved, half = shift
    value, low, high = (onset_of(k_star, rates + by) for by in (moved, moved - half, moved + half))
    return value, value - math.hypot(value - low, error), value + math.hypot(high - value, error)


def onset_on(mesh: str, cells: int, onset: tuple[float, float, float], note: str = "") -> MeshValue:
    """Return an onset and its interval on a mesh; an end out of reach (NaN) is infinitely far."""
    value, low, high = onset
    low, high = -math.inf if math.isnan(low) else low, math.inf if math.isnan(high) else high
    return MeshValue(mesh, cells, value, low, high, note)


def curve_of_plate(releases: Sequence[MeshRelease]) -> list[MeshRelease]:
    """Return the plate's releases on coarse over k*, which have two iterations of a time step."""
    plate = [one for one in releases if (one.model, one.mesh) == ("3d", "coarse")]
    return [one for one in plate if one.iterations < PLATE_ITERATIONS]


def _of_plate(own: Sequence[MeshRelease]) -> list[MeshValue]:
    """Return the onset of the plate on coarse, and on finer meshes as far as 30 c/V tell."""
    coarse = curve_of_plate(own)
    table = growth_table(coarse)
    found = onset_by_growth(table, K_STAR)
    if not math.isfinite(found.value):
        return []
    least, most = min(one.zigzag for one in coarse), max(one.zigzag for one in coarse)
    note = f"two iterations a step: loads zigzag by {100 * least:.2g} to {100 * most:.2g} %"
    base = onset_on("coarse", coarse[0].cells, (found.value, found.low, found.high), note)
    early = {one[0].mesh: one for one in _early_growths(own)}
    if "coarse" not in early:
        return [base]
    _, there, there_without = early.pop("coarse")
    values = [base]
    for run, here, without in early.values():
        shift = here.rate - there.rate
        spread = without.rate - there_without.rate - shift
        half = math.hypot(*map(half_width, (here, there)), spread)
        words = f"growth of coarse {shift:+.4f} +- {half:.4f} V/c, the difference over 30 c/V"
        onset = moved_onset(table, (shift, half), base.half_width)
        values.append(onset_on(run.mesh, run.cells, onset, words))
    return values


def sections_by_model(
    releases: Sequence[MeshRelease],
    section_loads: Sequence[MeshLoads],
    plate: Polar,
    own: CorrectionFactors | None,
) -> Iterator[MeshSeries]:
    """Yield the onset of the sections by a model learnt on each mesh, without damping and with it.

    Parameters
    ----------
    releases
        Kept releases.
    section_loads
        Rigid section on its meshes; one is learnt from where it has a release and a polar.
    plate
        Polar of the rigid plate of the paper's Table 1.
    own
        Factors of this project's section and plate on equal cells; None where they are not kept.
    """
    polars = polars_of([one for one in section_loads if not is_on_cells_of_plate(one)])
    onsets: dict[tuple[str, float], list[MeshValue]] = {}
    for run in releases:
        if run.model != "2d" or run.case.k_star != LEARNT_AT or run.mesh not in polars:
            continue
        polar = polars[run.mesh]
        model = learnt_model(read_reference_history(run.path), polar)
        base = run.case.section
        assert base is not None, "a case of a section"
        kinds: dict[str, CorrectionFactors | None] = {
            "2d": None,
            "2d-corrected": CorrectionFactors(polar, plate),
        }
        if own is not None:
            kinds[OWN_RATIOS] = own
        places = [(kind, zeta) for kind in kinds for zeta in DAMPING]
        lanes = [lane for kind, zeta in places for lane in _sections(base, kinds[kind], zeta, run)]
        table = predicted(model, [k for k, _ in lanes], [section for _, section in lanes])
        lacking = "the polar lacks angles" if model.missing_angles else ""
        filled_in = f"{POLAR_OF}{polar.label}" if polar.label != run.mesh else ""
        note = "; ".join(filter(None, (lacking, filled_in)))
        count = _SECTIONS_AT.size
        for number, place in enumerate(places):
            found = predicted_onset(table.iloc[number * count : (number + 1) * count])
            ends = found.k_star, found.low, found.high
            onsets.setdefault(place, []).append(onset_on(run.mesh, run.cells, ends, note))
    for (kind, zeta), values in onsets.items():
        yield MeshSeries(ONSET, kind, damped(zeta), BY_MODEL, 2, tuple(values), True)


def damped(zeta: float) -> str:
    """Return the place of a structural damping (of critical); empty without it."""
    return f"zeta = {100 * zeta:g} %" if zeta else ""


def _sections(
    base: Section, factors: CorrectionFactors | None, zeta: float, run: MeshRelease
) -> Iterator[tuple[float, Section]]:
    """Yield the sections over k*, corrected by factors where there are any, with damping."""
    for k_star in _SECTIONS_AT:
        section = base.scaled(float(k_star) / run.case.k_star)
        pitch = 2.0 * zeta * math.sqrt(section.torsional_stiffness * section.inertia)
        heave = 2.0 * zeta * math.sqrt(section.flexural_stiffness * section.mass)
        damped = section.model_copy(update={"torsional_damping": pitch, "flexural_damping": heave})
        if factors is not None:
            damped, _ = corrected_section(damped, factors, math.radians(run.case.incidence_deg))
        yield float(k_star), damped


def own_factors(
    section_loads: Sequence[MeshLoads], plate_loads: Sequence[MeshLoads]
) -> tuple[CorrectionFactors | None, str]:
    """Return the factors of section and plate on equal cells, and the mesh that they are of.

    The finest mesh of the plate of which both are kept is taken.
    """
    on_cells = polars_of([one for one in section_loads if is_on_cells_of_plate(one)])
    plates = polars_of(list(plate_loads))
    for mesh in reversed(plates):
        in_plane = ON_CELLS_OF_PLATE + mesh
        if in_plane in on_cells:
            return CorrectionFactors(on_cells[in_plane], plates[mesh]), mesh
    return None, ""


def plates_by_model(
    releases: Sequence[MeshRelease], plate_loads: Sequence[MeshLoads]
) -> Iterator[MeshSeries]:
    """Yield the onset of the plate by a model learnt from its release on each mesh, and damped.

    A release that is too short, or on a mesh without a polar, or whose loads zigzag beyond the
    coarse mesh, where that does little harm, is not learnt from.
    """
    models: dict[str, tuple[ReducedBeam, MeshRelease]] = {}
    with_polar = polars_of(list(plate_loads))
    for one in releases:
        is_converged = one.iterations >= PLATE_ITERATIONS or one.mesh == "coarse"
        usable = is_converged and one.mesh in with_polar
        if one.model == "3d" and one.case.k_star == LEARNT_AT and usable:
            polars = strip_polars_of(list(plate_loads), one.mesh)
            try:
                release = read_recorded_beam(one.path, polars.strips)
                models[one.mesh] = (learnt_beam(release, polars), one)
            except ResultFileError:
                continue
    for zeta in DAMPING if models else ():
        values = []
        for mesh, (model, run) in models.items():
            found = _onset_of_beam(model, run, zeta)
            values.append(onset_on(mesh, run.cells, (found.k_star, found.low, found.high)))
        yield MeshSeries(ONSET, "3d", damped(zeta), BY_MODEL, 3, tuple(values), True)


def _onset_of_beam(model: ReducedBeam, run: MeshRelease, zeta: float) -> PredictedOnset:
    base = run.case.beam
    assert base is not None, "a case of the beam"
    beams = [beam_at(base, float(k_star) / run.case.k_star, zeta) for k_star in BEAMS_AT]
    parameters = on_strips(beams, model.loads.polars.strips)
    return predicted_onset(predicted_beams(model, BEAMS_AT.tolist(), parameters))


def beam_at(base: BeamModes, scale: float, zeta: float) -> BeamModes:
    """Return a beam with its stiffness times a factor, and damped modes."""
    root = math.sqrt(scale)
    return base.model_copy(
        update={
            "torsion_frequency": tuple(root * one for one in base.torsion_frequency),
            "bending_frequency": tuple(root * one for one in base.bending_frequency),
            "torsion_damping": zeta,
            "bending_damping": zeta,
        }
    )


def plate_of_table_1(root: Path) -> Polar:
    """Return the polar of the rigid plate of the paper's Table 1."""
    return Polar.read(root / "config" / "polars" / "paper_plate_3d.csv")
