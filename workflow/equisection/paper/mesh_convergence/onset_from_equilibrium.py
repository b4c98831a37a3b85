"""Growth and onset of plate and section over the cell size, from releases at static equilibrium.

Flow and heave have nothing to settle there, so that the growth of small motions is known from 30
c/V. A mesh with releases on both sides of its onset has it where the growth rate is zero. A mesh
with one release has the growth curve over k* of the coarsest one (from equilibrium, or else from
rest), shifted by the difference of both from equilibrium at that k*; how far such a shift changes
with k* is known of the section, which has releases at several k* on two meshes.

A second way needs the one release alone: a model of the loads is learnt from it
(:mod:`equisection.motion.beam_lesson`), and the eigenvalues of the small motions about the
equilibrium at each k* are those of the beam with that model. Motions of half a degree say little of
the bends of the steady loads, but their slope, so that it is learnt too.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
import pandas as pd

from equisection.analysis.growth_onset import GrowthOnset, onset_by_growth
from equisection.analysis.recorded_beam import on_strips, read_recorded_beam
from equisection.analysis.reduced_beam import SMALLEST_BAND_OF_BEAM, growth_of_pitch
from equisection.analysis.reduced_model import ends_of_records, onset_of, spread_of_refits
from equisection.errors import ResultFileError
from equisection.motion.beam_lesson import learn_strips
from equisection.motion.learnt_beams import LearntBeams
from equisection.paper.mesh_convergence.kept_releases import (
    MeshLoads,
    MeshRelease,
    alike_sections,
    growth_table,
    polars_of,
    strip_polars_of,
)
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, MeshValue
from equisection.paper.mesh_convergence.onset_by_mesh import (
    BEAMS_AT,
    EARLY,
    GROWTH,
    LEARNT_AT,
    ONSET,
    PLATE_ITERATIONS,
    SECTIONS,
    beam_at,
    curve_of_plate,
    half_width,
    moved_onset,
    onset_on,
)
from equisection.study.axes import K_STAR
from equisection.verdict.growth import AFTER_RELEASE, Growth

#: Bases of growth and onset.
BY_EQUILIBRIUM, LEARNT_FROM_EQUILIBRIUM = "releases from equilibrium", "learnt from equilibrium"
#: End of the basis of a growth on meshes around the outline.
AROUND_OUTLINE = ", around the outline"
#: Fewest k* of a curve that is moved: fewer do not show its bend.
FEWEST_OF_CURVE = 3
#: Shortest release (c/V) from equilibrium that a model is learnt from.
SHORTEST_FROM_EQUILIBRIUM = 30.0


@dataclass(frozen=True)
class _Runs:
    """Releases of a model on one mesh with one number of iterations of a time step."""

    mesh: str
    iterations: int
    runs: tuple[MeshRelease, ...]

    @property
    def cells(self) -> int:
        return self.runs[0].cells

    def at(self, k_star: float) -> MeshRelease | None:
        return next((one for one in self.runs if one.case.k_star == k_star), None)


class MovedOnset(NamedTuple):
    """Onset of a growth curve that is moved to a growth at one k*.

    Attributes
    ----------
    ends
        The onset (k*) and its interval.
    shift, half
        The shift and half of its interval (V/c).
    away
        Distance of the onset from the k*; infinite without an onset.
    """

    ends: tuple[float, float, float]
    shift: float
    half: float
    away: float


@dataclass(frozen=True)
class GrowthCurve:
    """Growth over k* on one mesh.

    Attributes
    ----------
    runs
        Releases on the mesh, from equilibrium.
    table
        Growth rates (:func:`.kept_releases.growth_table`).
    base
        Onset on the mesh.
    """

    runs: _Runs
    table: pd.DataFrame
    base: MeshValue

    def moved(
        self, k_star: float, growth: tuple[float, float], change: float, end: float = math.inf
    ) -> MovedOnset:
        """Return the onset of the curve that is moved to a growth at a k*.

        Parameters
        ----------
        k_star
            The k*, at which there is a release on the mesh.
        growth
            Growth rate there and half of its interval (V/c).
        change
            Part of the shift by which it changes over a k* of 1 (:func:`change_of_shift`).
        end
            End (c/V) up to which the release on the mesh is compared.
        """
        known = self.runs.at(k_star)
        assert known is not None
        there = _growth(known, end)
        shift = growth[0] - there.rate
        onset = moved_onset(self.table, (shift, 0.0), self.base.half_width)[0]
        away = abs(onset - k_star) if math.isfinite(onset) else math.inf
        half = math.hypot(growth[1], half_width(there), change * away * shift)
        ends = moved_onset(self.table, (shift, half), self.base.half_width)
        return MovedOnset(ends, shift, half, away)


def _groups(releases: Sequence[MeshRelease], model: str = "3d") -> list[_Runs]:
    """Return the releases of a model by mesh and iterations, the coarsest mesh first."""
    own = [one for one in releases if one.model == model]
    keys = sorted({(one.cells, one.iterations, one.mesh) for one in own})
    return [
        _Runs(
            mesh,
            iterations,
            tuple(one for one in own if (one.cells, one.iterations) == (cells, iterations)),
        )
        for cells, iterations, mesh in keys
    ]


def _most_iterations(releases: Sequence[MeshRelease], model: str = "3d") -> list[_Runs]:
    """Return the group of each mesh with the most iterations, the coarsest mesh first."""
    return list({one.mesh: one for one in _groups(releases, model)}.values())


def _growth(release: MeshRelease, end: float = math.inf) -> Growth:
    return release.growth(AFTER_RELEASE, min(release.end, end))


def early_growth(release: MeshRelease) -> MeshValue:
    """Return the growth (V/c) of a release from 10 to 30 c/V."""
    growth = _growth(release, EARLY)
    return MeshValue(release.mesh, release.cells, growth.rate, *growth.interval)


def growth_from_equilibrium(
    releases: Sequence[MeshRelease], model: str = "3d"
) -> Iterator[MeshSeries]:
    """Yield the growth of a model at each k* on the meshes that have a release from equilibrium.

    The meshes are of one family. It is that from 10 to 30 c/V. Of a mesh that has several the one
    with the most iterations of a time step is taken.
    """
    own = [one for one in releases if one.model == model]
    for k_star in sorted({one.case.k_star for one in own}):
        values = []
        for group in _most_iterations([one for one in own if one.case.k_star == k_star], model):
            note = f"{group.iterations} iterations"
            values.append(replace(early_growth(group.runs[0]), note=note))
        basis = f"{BY_EQUILIBRIUM}, {AFTER_RELEASE:.0f} to {EARLY:.0f} c/V"
        basis += AROUND_OUTLINE if own[0].is_around_outline else ""
        dimensions = int(own[0].case.dimension[0])
        yield MeshSeries(GROWTH, model, f"k* = {k_star:g}", basis, dimensions, tuple(values))


def sections_from_equilibrium(
    releases: Sequence[MeshRelease], from_rest: Sequence[MeshRelease]
) -> Iterator[MeshSeries]:
    """Yield the onset of each section over the meshes, the finer ones by releases from equilibrium.

    Meshes with releases from rest on both sides of their onset have it by these, and finer ones by
    those from equilibrium. Where the latter are on one side alone, the growth curve of the finest
    mesh from rest is moved by the difference to it, of both from equilibrium.

    Parameters
    ----------
    releases
        Releases from equilibrium.
    from_rest
        Releases from rest.
    """
    for model in SECTIONS:
        values = _section_by_mesh(_groups(releases, model), _groups(from_rest, model), from_rest)
        if values:
            yield MeshSeries(ONSET, model, "", BY_EQUILIBRIUM, 2, tuple(values))


def _section_by_mesh(
    own: Sequence[_Runs], of_rest: Sequence[_Runs], from_rest: Sequence[MeshRelease]
) -> list[MeshValue]:
    """Return the onset on each mesh; nothing where no finer mesh has it from equilibrium."""
    values: list[MeshValue] = []
    curve: _Runs | None = None
    for group in of_rest:
        found = onset_by_growth(growth_table(group.runs), K_STAR)
        if math.isfinite(found.value):
            values.append(_onset_of(group, found, "from rest"))
            curve = group
    if curve is None:
        return []
    base = values[-1]
    start = next((group for group in own if group.mesh == curve.mesh), None)
    for group in own:
        if group.cells <= curve.cells:
            continue
        if math.isfinite((found := _zero(group)).value):
            values.append(_onset_of(group, found))
        elif start is not None:
            moved = GrowthCurve(start, growth_table(curve.runs), base)
            values += _shifted(moved, group, change_of_shift(from_rest))
    return values if values[-1] is not base else []


def onsets_from_equilibrium(
    releases: Sequence[MeshRelease], from_rest: Sequence[MeshRelease]
) -> Iterator[MeshSeries]:
    """Yield the onset of the plate over the meshes, by releases from equilibrium.

    Parameters
    ----------
    releases
        Releases from equilibrium.
    from_rest
        Releases from rest. The section's tell how far the difference of two meshes changes with k*;
        the plate's on coarse are the curve where those from equilibrium are fewer than three, or of
        one sign.
    """
    curve = curve_from_equilibrium(releases, from_rest)
    if curve is not None:
        values = onsets_on_meshes(releases, "3d", curve, change_of_shift(from_rest))
        yield MeshSeries(ONSET, "3d", "", BY_EQUILIBRIUM, 3, tuple(values))


def onsets_on_meshes(
    releases: Sequence[MeshRelease], model: str, curve: GrowthCurve, change: float
) -> Iterator[MeshValue]:
    """Yield the onset of a model on each mesh: its own, or that of a curve that is moved.

    Parameters
    ----------
    releases
        Releases from equilibrium.
    model
        The model.
    curve
        Growth over k* on one mesh.
    change
        Part of a shift by which it changes over a k* of 1 (:func:`change_of_shift`).
    """
    for group in _most_iterations(releases, model):
        if group == curve.runs:
            yield curve.base
        elif math.isfinite((found := _zero(group)).value):
            yield _onset_of(group, found)
        else:
            yield from _shifted(curve, group, change)


def curve_from_equilibrium(
    releases: Sequence[MeshRelease], from_rest: Sequence[MeshRelease]
) -> GrowthCurve | None:
    """Return the plate's growth over k* on the coarsest mesh that shows it; None without one."""
    if own := curve_of(releases, "3d"):
        return own
    of_rest = curve_of_plate(from_rest)
    table = growth_table(of_rest)
    found = onset_by_growth(table, K_STAR)
    keys = [(one.mesh, one.iterations) for one in of_rest]
    groups = [one for one in _groups(releases) if (one.mesh, one.iterations) in keys]
    if not groups or not math.isfinite(found.value):
        return None
    (runs,) = groups
    return _curve(runs, table, found, "growth curve of releases from rest")


def curve_of(releases: Sequence[MeshRelease], model: str) -> GrowthCurve | None:
    """Return a model's growth over k* on the coarsest mesh with three on both sides of its onset.

    None where no mesh has them.
    """
    for group in _groups(releases, model):
        if len(group.runs) >= FEWEST_OF_CURVE and math.isfinite((found := _zero(group)).value):
            return _curve(group, growth_table(group.runs, _growth), found)
    return None


def _curve(runs: _Runs, table: pd.DataFrame, found: GrowthOnset, words: str = "") -> GrowthCurve:
    is_plate = runs.runs[0].model == "3d"
    zigzag = _zigzag_in_words(runs) if is_plate and runs.iterations < PLATE_ITERATIONS else ""
    note = "; ".join(filter(None, (words, zigzag)))
    return GrowthCurve(runs, table, _onset_of(runs, found, note))


def _zero(group: _Runs) -> GrowthOnset:
    return onset_by_growth(growth_table(group.runs, _growth), K_STAR)


def _onset_of(group: _Runs, found: GrowthOnset, note: str = "") -> MeshValue:
    return onset_on(group.mesh, group.cells, (found.value, found.low, found.high), note)


def _shifted(curve: GrowthCurve, group: _Runs, change: float) -> list[MeshValue]:
    """Return the onset of releases by the shift of a curve, at the k* nearest to that onset."""
    found = []
    for run in group.runs:
        known = curve.runs.at(run.case.k_star)
        if known is None:
            continue
        k_star, end = run.case.k_star, min(run.end, known.end)
        growth = _growth(run, end)
        onset = curve.moved(k_star, (growth.rate, half_width(growth)), change, end)
        is_finer, fewer = run.mesh != curve.runs.mesh, curve.runs.iterations
        of = curve.runs.mesh if is_finer else f"{fewer} iterations"
        note = f"growth of {of} {onset.shift:+.4f} +- {onset.half:.4f} V/c, the difference at "
        note += f"k* = {k_star:g}"
        if is_finer and group.iterations != fewer:
            note += f", a part of it that of {group.iterations} iterations beside {fewer}"
        found.append((onset.away, onset_on(run.mesh, run.cells, onset.ends, note)))
    return [min(found, key=lambda one: one[0])[1]] if found else []


def _zigzag_in_words(group: _Runs) -> str:
    found = [100.0 * one.zigzag for one in group.runs]
    ends = dict.fromkeys(f"{one:.2g}" for one in (min(found), max(found)))
    return f"{group.iterations} iterations a step: loads zigzag by {' to '.join(ends)} %"


def change_of_shift(from_rest: Sequence[MeshRelease]) -> float:
    """Return how far the growth's difference of two meshes changes with k*, as a part of it.

    It is that of the section on its coarse and its medium mesh, over a k* of 1: the fastest change
    from k* = 6.44 up to the first k* at which the coarse one decays, over the difference at 6.44; 1
    where these do not tell.
    """
    shifts: list[tuple[float, float]] = []
    sign = 1.0
    for k_star, alike, end in alike_sections(from_rest):
        by_mesh = {one.mesh: one.behind_release(end).rate for one in alike}
        if k_star >= LEARNT_AT and {"coarse", "medium"} <= by_mesh.keys() and sign > 0.0:
            shifts.append((k_star, by_mesh["medium"] - by_mesh["coarse"]))
            sign = by_mesh["coarse"]
    if len(shifts) < 2:
        return 1.0
    start, first = shifts[0]
    return max(abs(shift / first - 1.0) / (k_star - start) for k_star, shift in shifts[1:])


def learnt_from_equilibrium(
    releases: Sequence[MeshRelease], plate_loads: Sequence[MeshLoads]
) -> Iterator[MeshSeries]:
    """Yield the onset of the plate by a model learnt from its release at 6.44 on each mesh.

    The band of the growth is the farthest of two refits from shorter records, and no less than the
    farthest miss of the models: of a mesh with releases at other k*, from the growth of these.

    Parameters
    ----------
    releases
        Releases from equilibrium.
    plate_loads
        Loads of the rigid plate on its meshes.
    """
    rates = {
        group: found
        for group in _most_iterations([one for one in releases if one.case.k_star == LEARNT_AT])
        if (found := _learnt_rates(group, plate_loads)) is not None
    }
    misses = [
        float(np.interp(one.case.k_star, BEAMS_AT, found[0])) - _growth(one).rate
        for group, found in rates.items()
        for one in releases
        if one.model == "3d" and one.mesh == group.mesh and one.case.k_star != LEARNT_AT
    ]
    least = max(map(abs, misses)) if misses else SMALLEST_BAND_OF_BEAM
    values = []
    for group, found in rates.items():
        band = np.maximum(spread_of_refits(found), least)
        k_star = BEAMS_AT.tolist()
        ends = [onset_of(k_star, rate) for rate in (found[0], found[0] - band, found[0] + band)]
        note = f"band of the growth {band.min():.4f} V/c"
        value, low, high = ends
        values.append(onset_on(group.mesh, group.cells, (value, low, high), note))
    if values:
        yield MeshSeries(ONSET, "3d", "", LEARNT_FROM_EQUILIBRIUM, 3, tuple(values), True)


def _learnt_rates(
    group: _Runs, plate_loads: Sequence[MeshLoads]
) -> np.ndarray[tuple[int, ...], np.dtype[np.float64]] | None:
    """Return the growth (V/c) at each k* by the model and by two refits; None of what is none."""
    (run,) = group.runs
    base = run.case.beam
    if base is None or group.mesh not in polars_of(list(plate_loads)):
        return None
    polars = strip_polars_of(list(plate_loads), group.mesh)
    release = read_recorded_beam(run.path, polars.strips)
    beams = [beam_at(base, float(k_star) / LEARNT_AT, 0.0) for k_star in BEAMS_AT]
    parameters = on_strips(beams, polars.strips)
    early, middle, late = ends_of_records(release.time)
    try:
        models = [
            learn_strips(release, polars, end, free_slope=True, shortest=SHORTEST_FROM_EQUILIBRIUM)
            for end in (middle, early, late)
        ]
    except ResultFileError:
        return None
    return np.array([growth_of_pitch(LearntBeams(parameters, one)) for one in models])
