"""Onset of the plate from releases at static equilibrium: by growth over the meshes, and learnt."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy
from tests.workflow.project import ROOT

from equisection.analysis.grid_convergence import SAFETY
from equisection.analysis.grid_limit import SAFETY_OF_TWO
from equisection.analysis.recorded_beam import on_strips, read_recorded_beam
from equisection.analysis.reduced_beam import growth_of_pitch
from equisection.analysis.reduced_model import onset_of
from equisection.cases import UnsteadyCase
from equisection.motion.beam_lesson import learn_strips
from equisection.motion.learnt_beams import LearntBeams
from equisection.paper.mesh_convergence.convergence_page import page
from equisection.paper.mesh_convergence.kept_releases import (
    FROM_EQUILIBRIUM,
    OWN_RATIOS,
    MeshLoads,
    MeshRelease,
    mesh_releases,
    rigid_loads,
    strip_polars_of,
)
from equisection.paper.mesh_convergence.mesh_series import LIMIT, MeshSeries, MeshValue, as_table
from equisection.paper.mesh_convergence.onset_by_direction import ReleasesByDirection
from equisection.paper.mesh_convergence.onset_by_mesh import BEAMS_AT, ONSET, beam_at
from equisection.paper.mesh_convergence.onset_from_equilibrium import (
    AROUND_OUTLINE,
    BY_EQUILIBRIUM,
    LEARNT_FROM_EQUILIBRIUM,
    change_of_shift,
    growth_from_equilibrium,
    learnt_from_equilibrium,
    onsets_from_equilibrium,
    sections_from_equilibrium,
)
from equisection.paper.mesh_convergence.onset_targets import WANTED, best_limit, foreseen, targets
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.solvers.verdicts import Judge, TipMotion
from equisection.verdict.growth import Growth

REFERENCE = ROOT / "results" / "reference"
KEPT_SECTION = REFERENCE / "paper-plate-openfoam-fine"
#: Growth of the made-up releases (V/c) for each unit of ln k*, and the k* where coarse has none.
SLOPE, ZERO = -0.03, 10.0
#: Error of a growth rate (V/c) by what the waves leave and by what is lost between samples.
FIT = 1e-4
#: Growth (V/c) of a section on coarse at k* 5.5, 6.44, 7.5, 8.5 and 14.
RATES = (0.02, 0.01, 0.004, -0.001, -0.014)


@pytest.fixture(scope="module")
def at_equilibrium() -> MeshRelease:
    """Return the plate's kept release from equilibrium on coarse, with two iterations."""
    kept = mesh_releases(REFERENCE / "plate-equilibrium", FROM_EQUILIBRIUM)
    return next(
        one
        for one in kept
        if (one.mesh, one.iterations, one.case.k_star) == ("coarse", 2, 6.44) and one.model == "3d"
    )


@pytest.fixture(scope="module")
def plate() -> list[MeshLoads]:
    runs = ("paper-plate-openfoam-3d", "paper-plate-openfoam-3d-grid", "plate-equilibrium-medium")
    found = [one for run in runs for one in rigid_loads(REFERENCE / run, "3d")]
    return sorted(found, key=lambda one: (one.cells, one.incidence_deg))


def on_mesh(release: MeshRelease, mesh: str, k_star: float) -> UnsteadyCase:
    """Return its case on another mesh, at another k*."""
    case = release.case
    assert case.beam is not None
    solver = case.solver.model_copy(update={"settings": case.solver.settings | {"mesh": mesh}})
    beam = beam_at(case.beam, k_star / case.k_star, 0.0)
    return case.model_copy(update={"solver": solver, "k_star": k_star, "beam": beam})


def made_up(
    release: MeshRelease,
    mesh: str = "coarse",
    k_star: float = 6.44,
    *,
    iterations: int = 2,
    shift: float = 0.0,
) -> MeshRelease:
    """Return a release of 30 c/V whose pitch grows at the rate of the line, and a shift (V/c)."""
    case = on_mesh(release, mesh, k_star)
    time = np.arange(0.0, 30.0, 0.05)
    growths = (SLOPE * math.log(k_star / ZERO) + shift, -0.05, -0.04)
    omegas = 2.0 * math.pi * np.array(Judge.of(case).waves)
    waves = np.exp(np.outer(growths, time)) * np.cos(np.outer(omegas, time))
    other = 1e-4 * np.cos(3.1 * omegas[0] * time)  # what the waves leave
    modes = np.array([[1.0, 0.02, 0.1], [0.1, 1.0, 0.1], [0.2, 0.1, 1.0]]) @ waves + other
    tip = TipMotion(time, 0.01 * modes[0], 0.3 + 0.1 * modes[1], modes)
    cells = {"coarse": 85284, "medium": 300912, "fine": 1003392}[mesh]
    return replace(release, case=case, cells=cells, tip=tip, iterations=iterations)


def over_k_star(release: MeshRelease, *k_star: float) -> list[MeshRelease]:
    return [made_up(release, k_star=one) for one in k_star]


@dataclass(frozen=True, eq=False)
class OfKnownGrowth(MeshRelease):
    """A release whose growth is known."""

    rate: float = math.nan

    def behind_release(self, end: float = math.inf) -> Growth:
        return Growth(rate=self.rate, standard_error=1e-6, end=end, periods=8)


def _fields(release: MeshRelease) -> tuple[Any, ...]:
    return tuple(getattr(release, field.name) for field in fields(MeshRelease))


def of_section(changes: Sequence[float], rates: Sequence[float]) -> list[MeshRelease]:
    """Return releases of the section on coarse with growth rates, and on medium with changes."""
    some = mesh_releases(KEPT_SECTION)[0]
    found: list[MeshRelease] = []
    for k_star, change, rate in zip((5.5, 6.44, 7.5, 8.5, 14.0), changes, rates, strict=True):
        for mesh, growth in (("coarse", rate), ("medium", rate + change)):
            settings = some.case.solver.settings | {"mesh": mesh}
            solver = some.case.solver.model_copy(update={"settings": settings})
            case = some.case.model_copy(update={"k_star": k_star, "solver": solver})
            found.append(OfKnownGrowth(some.path, case, 100, some.tip, 8, 0.0, growth))
    return found


#: Cells of the section's meshes.
CELLS = {"coarse": 11136, "medium": 22548, "fine": 56592, "extra-fine": 111808}


def section_on(
    mesh: str, k_star: float, shift: float = 0.0, folder: str = "run/unsteady/2d"
) -> MeshRelease:
    """Return a release of the section on a mesh whose growth is that of the line, and a shift."""
    some = mesh_releases(KEPT_SECTION)[0]
    settings = some.case.solver.settings | {"mesh": mesh}
    solver = some.case.solver.model_copy(update={"settings": settings})
    case = some.case.model_copy(update={"k_star": k_star, "solver": solver})
    rate = SLOPE * math.log(k_star / ZERO) + shift
    time = np.arange(0.0, 30.0, 0.1)
    omegas = 2.0 * math.pi * np.array(Judge.of(case).waves)
    pitch, heave = np.exp(np.outer((rate, -0.05), time)) * np.cos(np.outer(omegas, time))
    records = np.stack((pitch + 0.02 * heave, 0.1 * pitch + heave))
    tip = TipMotion(time, 0.01 * records[0], 0.3 + 0.1 * records[1], records)
    return OfKnownGrowth(Path(folder, "k1.nc"), case, CELLS[mesh], tip, 8, 0.0, rate)


def at_mesh(series: MeshSeries, mesh: str) -> MeshValue:
    return next(value for value in series.values if value.mesh == mesh)


def test_releases_of_another_start_are_not_among_them(at_equilibrium: MeshRelease) -> None:
    folder = at_equilibrium.path.parent
    assert mesh_releases(folder, FROM_EQUILIBRIUM)
    assert not mesh_releases(folder)  # from rest
    assert not mesh_releases(folder, FROM_EQUILIBRIUM | {"twist_deg": 1.0})
    assert not mesh_releases(KEPT_SECTION, FROM_EQUILIBRIUM)


def test_meshes_around_the_outline_are_a_family_of_their_own() -> None:
    folders = [REFERENCE / f"outline-equilibrium-{mesh}" for mesh in ("coarse", "medium")]
    assert not any(mesh_releases(folder, FROM_EQUILIBRIUM) for folder in folders)
    found = [
        one
        for folder in folders
        for one in mesh_releases(folder, FROM_EQUILIBRIUM, with_outlines=True)
    ]
    assert all(one.is_around_outline for one in found)
    series = list(growth_from_equilibrium(found, "2d"))
    assert all(one.basis.endswith(AROUND_OUTLINE) for one in series)
    assert [value.mesh for value in series[-1].values] == ["coarse", "medium"]  # at k* 8
    assert not list(ReleasesByDirection.of(found).series())
    assert "around the outline" in page(series, "")
    blocks = mesh_releases(
        REFERENCE / "section-equilibrium-medium", FROM_EQUILIBRIUM, with_outlines=True
    )
    assert not any(one.is_around_outline for one in blocks)
    assert "around the outline" not in page(list(growth_from_equilibrium(blocks, "2d")), "")


def test_growth_is_that_of_the_mesh_with_the_most_iterations(at_equilibrium: MeshRelease) -> None:
    releases = [
        *over_k_star(at_equilibrium, 6.44, 8.0),
        made_up(at_equilibrium, iterations=4, shift=-0.001),
        made_up(at_equilibrium, "medium", iterations=4, shift=-0.006),
    ]
    low, high = growth_from_equilibrium(releases)
    line = [SLOPE * math.log(k_star / ZERO) for k_star in (6.44, 8.0)]
    assert [value.value for value in low.values] == pytest.approx(
        [line[0] - 0.001, line[0] - 0.006], abs=FIT
    )
    assert [value.note for value in low.values] == ["4 iterations", "4 iterations"]
    assert [value.value for value in high.values] == pytest.approx([line[1]], abs=FIT)
    assert low.limit.meshes == 2
    assert math.isnan(high.limit.half_width)  # of one mesh it is not known


def test_onset_is_where_the_shifted_growth_of_coarse_is_zero(at_equilibrium: MeshRelease) -> None:
    shift, change = -0.006, 0.2
    releases = [
        *over_k_star(at_equilibrium, 6.44, 7.0, 7.5, 8.0, 8.5, 9.0, 10.5),
        made_up(at_equilibrium, "medium", iterations=4, shift=shift),
    ]
    sections = of_section((-0.1, -0.005, -0.005 * (1.0 + change), -0.005, -0.1), RATES)
    (found,) = onsets_from_equilibrium(releases, sections)
    coarse, medium = (at_mesh(found, mesh) for mesh in ("coarse", "medium"))
    assert coarse.value == pytest.approx(ZERO, rel=FIT / -SLOPE)
    assert medium.value == pytest.approx(ZERO * math.exp(-shift / SLOPE), rel=FIT / -SLOPE)
    # as far as it is from the release to the onset
    part = change * (medium.value - 6.44) / (7.5 - 6.44)
    ends = [ZERO * math.exp(-shift * (1.0 + sign * part) / SLOPE) for sign in (1.0, -1.0)]
    assert [medium.low, medium.high] == pytest.approx(ends, rel=2.0 * FIT / -SLOPE)
    ratio = (300912 / 85284) ** (1.0 / 3.0)
    drop = (medium.value - coarse.value) / (ratio**2 - 1.0)  # order 2 is assumed
    assert found.limit.value == pytest.approx(medium.value + drop)
    assert found.limit.half_width >= 3.0 * abs(drop)


def test_release_nearest_to_the_onset_says_where_it_is(at_equilibrium: MeshRelease) -> None:
    """Of two on one side of it; the shift is another at the farther one."""
    curve = over_k_star(at_equilibrium, 6.44, 7.0, 8.0, 9.0, 10.5)
    near = made_up(at_equilibrium, "medium", 8.0, iterations=4, shift=-0.004)
    far = made_up(at_equilibrium, "medium", 6.44, iterations=4, shift=-0.007)
    sections = of_section((-0.1, -0.005, -0.006, -0.005, -0.1), RATES)
    (both,) = onsets_from_equilibrium([*curve, far, near], sections)
    (alone,) = onsets_from_equilibrium([*curve, near], sections)
    (farther,) = onsets_from_equilibrium([*curve, far], sections)
    assert at_mesh(both, "medium") == at_mesh(alone, "medium")
    assert "the difference at k* = 8" in at_mesh(both, "medium").note
    assert at_mesh(both, "medium").half_width < at_mesh(farther, "medium").half_width


def test_iterations_of_a_time_step_move_the_onset_of_their_mesh(
    at_equilibrium: MeshRelease,
) -> None:
    two = over_k_star(at_equilibrium, 6.44, 7.5, 8.5, 9.0, 9.5, 10.5)
    four = made_up(at_equilibrium, iterations=4, shift=-0.001)
    (alone,) = onsets_from_equilibrium(two, [])
    (both,) = onsets_from_equilibrium([*two, four], [])
    assert alone.values[0].value == pytest.approx(ZERO, rel=FIT / -SLOPE)
    assert both.values[0].value == pytest.approx(ZERO * math.exp(0.001 / SLOPE), rel=FIT / -SLOPE)
    assert "growth of 2 iterations -0.0010" in both.values[0].note
    assert "loads zigzag" in alone.values[0].note


def test_mesh_with_releases_on_both_sides_has_an_onset_of_its_own(
    at_equilibrium: MeshRelease,
) -> None:
    curve = over_k_star(at_equilibrium, 6.44, 8.0, 9.0, 11.0)
    of_medium = [
        made_up(at_equilibrium, "medium", k_star, iterations=4, shift=-0.006)
        for k_star in (6.44, 7.5, 9.0)
    ]
    (found,) = onsets_from_equilibrium([*curve, *of_medium], [])
    expected = ZERO * math.exp(-0.006 / -SLOPE)
    assert at_mesh(found, "medium").value == pytest.approx(expected, rel=FIT / -SLOPE)
    assert not at_mesh(found, "medium").note
    elsewhere = [made_up(at_equilibrium, "medium", 7.0, iterations=4)]  # at no k* of the curve
    (without,) = onsets_from_equilibrium([*curve, *elsewhere], [])
    assert [value.mesh for value in without.values] == ["coarse"]
    assert not list(onsets_from_equilibrium(over_k_star(at_equilibrium, 6.44, 8.0), []))


def test_section_has_its_onset_on_finer_meshes_by_the_shift_of_the_finest_curve() -> None:
    shifts = {"medium": -0.004, "fine": -0.006, "extra-fine": -0.007}
    from_rest = [
        section_on(mesh, k_star, shift)
        for mesh, shift in (("coarse", 0.0), ("medium", shifts["medium"]))
        for k_star in (6.44, 7.5, 8.5, 9.5, 11.0)
    ]
    at_equilibrium = [section_on(mesh, 6.44, shift) for mesh, shift in shifts.items()]
    (found,) = sections_from_equilibrium(at_equilibrium, from_rest)
    assert (found.model, found.basis) == ("2d", BY_EQUILIBRIUM)
    expected = [ZERO * math.exp(-shift / SLOPE) for shift in (0.0, *shifts.values())]
    assert [value.mesh for value in found.values] == list(CELLS)
    assert [value.value for value in found.values] == pytest.approx(expected, rel=2 * FIT / -SLOPE)
    assert all(value.low < value.value < value.high for value in found.values)
    assert "growth of medium -0.0030" in at_mesh(found, "extra-fine").note
    assert found.limit.meshes == 3  # the finest
    assert found.limit.value < expected[-1]
    # without a release from equilibrium on the mesh of the curve nothing tells the shift
    assert not list(sections_from_equilibrium(at_equilibrium[1:], from_rest))
    assert not list(sections_from_equilibrium(at_equilibrium, []))


@pytest.mark.parametrize(
    ("folder", "model"),
    [
        ("corrected-equilibrium-medium/unsteady/2d-corrected", "2d-corrected"),
        ("own-ratios-equilibrium-medium/unsteady/2d-corrected", OWN_RATIOS),
    ],
)
def test_section_has_its_own_onset_where_releases_from_equilibrium_are_on_both_sides(
    folder: str, model: str
) -> None:
    """It needs no release from equilibrium on the mesh of the curve then."""
    from_rest = [section_on("coarse", k, folder=folder) for k in (7.5, 8.5, 9.5, 11.0)]
    sides = [section_on("medium", k, -0.004, folder) for k in (8.0, 10.0)]
    (found,) = sections_from_equilibrium(sides, from_rest)
    assert (found.model, found.basis) == (model, BY_EQUILIBRIUM)
    assert at_mesh(found, "coarse").note == "from rest"
    expected = ZERO * math.exp(0.004 / SLOPE)
    assert at_mesh(found, "medium").value == pytest.approx(expected, rel=FIT / -SLOPE)
    one_side = [section_on("medium", k, -0.004, folder) for k in (9.0, 10.0)]
    assert not list(sections_from_equilibrium(one_side, from_rest))


@pytest.mark.parametrize("more", [(), (8.0,), (12.0,)])
def test_curve_is_that_from_rest_where_releases_from_equilibrium_show_none(
    at_equilibrium: MeshRelease, more: tuple[float, ...]
) -> None:
    """The difference of the meshes is from equilibrium, the curve not: two k* show no bend."""
    alone = [made_up(at_equilibrium, k_star=one, shift=0.002) for one in (6.44, *more)]
    medium = made_up(at_equilibrium, "medium", iterations=4, shift=-0.004)
    from_rest = [
        OfKnownGrowth(*_fields(made_up(at_equilibrium, k_star=k)), SLOPE * math.log(k / ZERO))
        for k in (5.0, 6.44, 7.5, 8.0, 8.5, 9.0, 12.0)
    ]
    (found,) = onsets_from_equilibrium([*alone, medium], from_rest)
    coarse, finer = found.values
    assert coarse.value == pytest.approx(ZERO, rel=1e-6)
    assert "growth curve of releases from rest" in coarse.note
    assert finer.value == pytest.approx(ZERO * math.exp(0.006 / SLOPE), rel=2.0 * FIT / -SLOPE)


def test_shift_changes_over_k_star_as_that_of_the_section_up_to_its_onset() -> None:
    """Far inside, where motions are large, and far above the onset it is not read."""
    changes = (-0.001, -0.004, -0.0046, -0.0038, -0.001)
    per_k_star = 0.15 / (7.5 - 6.44)
    assert change_of_shift(of_section(changes, RATES)) == pytest.approx(per_k_star)
    all_stable = (0.01, -0.001, -0.003, -0.004, -0.01)
    assert change_of_shift(of_section(changes, all_stable)) == 1.0
    assert change_of_shift([]) == 1.0


@pytest.fixture(scope="module")
def of_medium(
    at_equilibrium: MeshRelease, plate: list[MeshLoads], tmp_path_factory: pytest.TempPathFactory
) -> tuple[MeshRelease, float]:
    """Return a release of a model on medium from its equilibrium, and the onset of that model.

    The model is learnt from the kept release on coarse. Its loads and the motion are those of the
    strips, in the rates of state that the eigenvalues are of.
    """
    polars = strip_polars_of(plate, "medium")
    kept = read_recorded_beam(at_equilibrium.path, polars.strips)
    loads = learn_strips(kept, polars, 30.0, free_slope=True, shortest=30.0)
    base = at_equilibrium.case.beam
    assert base is not None
    over = on_strips([beam_at(base, k / 6.44, 0.0) for k in BEAMS_AT], polars.strips)
    onset = onset_of(BEAMS_AT.tolist(), growth_of_pitch(LearntBeams(over, loads)))
    alone = LearntBeams(kept.parameters, loads)
    (rest,) = alone.equilibria()
    modes = rest.size
    start = np.concatenate([rest, np.zeros_like(rest)])
    lag = alone._incidence_of(start[None])[0]
    start[0] += math.radians(0.3) / kept.parameters.torsion_at_tip[0]
    time = np.arange(0.0, 30.0, 0.2)
    found = scipy.integrate.solve_ivp(
        lambda _, state: alone.rates(state[None])[0],
        (0.0, time[-1]),
        np.concatenate([start, lag]),
        t_eval=time,
        rtol=1e-7,
        atol=1e-10,
    ).y[:modes]
    case = on_mesh(at_equilibrium, "medium", 6.44)
    torsion = len(base.torsion_frequency)
    written = read_dataset(at_equilibrium.path).isel(time=slice(time.size))
    written["torsion_amplitude"].values = found[:torsion]
    written["bending_amplitude"].values = found[torsion:]
    written.attrs["case"] = case.model_dump_json()
    path = tmp_path_factory.mktemp("medium") / "3d" / "k6.44.nc"
    path.parent.mkdir()
    write_dataset(path, written)
    return replace(at_equilibrium, path=path, case=case, cells=300912, iterations=4), onset


def test_model_learnt_from_30_chords_has_the_onset_of_what_it_was_learnt_from(
    at_equilibrium: MeshRelease, plate: list[MeshLoads], of_medium: tuple[MeshRelease, float]
) -> None:
    medium, onset = of_medium
    (found,) = learnt_from_equilibrium([at_equilibrium, medium], plate)
    learnt = at_mesh(found, "medium")
    assert learnt.value == pytest.approx(onset, rel=0.03)
    assert learnt.low < onset < learnt.high
    assert found.limit.meshes == 2
    assert found.basis == LEARNT_FROM_EQUILIBRIUM


def test_model_is_not_learnt_on_a_mesh_without_loads_of_the_rigid_plate(
    at_equilibrium: MeshRelease, plate: list[MeshLoads], of_medium: tuple[MeshRelease, float]
) -> None:
    coarse = [one for one in plate if one.mesh == "coarse"]
    (found,) = learnt_from_equilibrium([at_equilibrium, of_medium[0]], coarse)
    assert [value.mesh for value in found.values] == ["coarse"]
    assert not list(learnt_from_equilibrium([at_equilibrium], []))


def test_miss_at_another_k_star_is_in_the_band(
    at_equilibrium: MeshRelease, plate: list[MeshLoads]
) -> None:
    """A release at k* 8 whose growth is far from the model's widens the interval."""
    others = [made_up(at_equilibrium, k_star=8.0, shift=by) for by in (0.0, 0.02)]
    near, far = (list(learnt_from_equilibrium([at_equilibrium, one], plate)) for one in others)
    assert far[0].values[0].half_width > 2.0 * near[0].values[0].half_width


def onset_of_model(model: str, basis: str, k_star: list[float], half: float) -> MeshSeries:
    meshes = zip(("coarse", "medium", "fine"), (85284, 300912, 1003392), k_star, strict=False)
    values = tuple(MeshValue(*one, one[2] - half, one[2] + half) for one in meshes)
    return MeshSeries(ONSET, model, "", basis, 3, values)


def test_meshes_that_are_foreseen_narrow_the_interval_by_order_and_rule() -> None:
    two = onset_of_model("3d", BY_EQUILIBRIUM, [10.2, 8.4], 0.0)
    three = foreseen(two, [1003392])
    # order 2 leads to the same limit, and three meshes have 1.25 in the place of 3
    assert three.value == pytest.approx(two.limit.value)
    assert three.order == pytest.approx(2.0)
    left = (300912 / 1003392) ** (2 / 3)  # of the error on medium
    expected = two.limit.half_width * left * SAFETY / SAFETY_OF_TWO
    assert three.half_width == pytest.approx(expected)
    # what the values err by stays, however fine the meshes
    sharp, blurred = (foreseen(two, [1003392, 3112872], error).half_width for error in (0.0, 0.3))
    assert math.sqrt(blurred**2 - sharp**2) > 0.3
    text = page([onset_of_model("3d", BY_EQUILIBRIUM, [10.2, 8.4], 0.4)], "")
    assert "`fine` (1.0 million cells) would make it ± " in text


def test_release_around_the_outline_does_not_exclude_a_model_of_blocks() -> None:
    """Meshes of both have the same names."""
    series = [
        onset_of_model("3d", BY_EQUILIBRIUM + AROUND_OUTLINE, [10.2, 8.4], 0.4),
        onset_of_model("3d", LEARNT_FROM_EQUILIBRIUM, [10.4, 13.6], 0.4),
    ]
    assert "excludes" not in page(series, "")


@pytest.mark.parametrize(("medium", "said"), [(13.6, True), (8.6, False)])
def test_learnt_model_that_the_runs_exclude_is_named(medium: float, said: bool) -> None:
    text = page(
        [
            onset_of_model("3d", BY_EQUILIBRIUM, [10.2, 8.4], 0.4),
            onset_of_model("3d", LEARNT_FROM_EQUILIBRIUM, [10.4, medium], 0.4),
        ],
        "",
    )
    words = f"*{LEARNT_FROM_EQUILIBRIUM}* (13.60 ± 0.40) excludes *{BY_EQUILIBRIUM}* (8.40 ± 0.40)"
    assert (words in " ".join(text.split())) == said
    assert ("excludes" in text) == said


def test_targets_are_judged_by_the_narrowest_limit_of_each_model() -> None:
    table = as_table(
        [
            onset_of_model("2d", "releases", [8.0, 7.6, 7.42], 0.01),
            onset_of_model("2d", "learnt model", [8.0, 7.6, 7.42], 0.3),
            onset_of_model("2d-corrected", "releases", [6.0], 0.1),
            onset_of_model("3d", "releases", [10.0, 7.0], 0.1),
            onset_of_model("3d", BY_EQUILIBRIUM, [8.0, 7.0], 0.1),
            onset_of_model("3d", LEARNT_FROM_EQUILIBRIUM, [100.0, 97.0], 0.1),  # 7 % of its limit
        ]
    )
    found = targets(table).set_index("model")
    assert found["basis"].to_dict() == {
        "2d": "releases",
        "2d-corrected": "releases",
        "3d": BY_EQUILIBRIUM,
    }
    assert found.loc["2d", "lacking"] == 0.0
    assert math.isnan(found.loc["2d-corrected", "lacking"])
    plate = found.loc["3d"]
    half = 100.0 * 0.5 * (plate["high"] - plate["low"]) / plate["limit"]
    assert plate["interval"] == pytest.approx(half)
    assert plate["lacking"] == pytest.approx(half - 100.0 * WANTED["3d"])
    assert plate["lacking"] > 0.0
    assert best_limit(table, "2d-corrected, own ratios") is None
    best = best_limit(table, "2d")
    assert best is not None
    assert (best["mesh"], best["basis"]) == (LIMIT, "releases")
