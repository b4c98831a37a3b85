"""Onset around the outline, and that of both meshers."""

import math
from dataclasses import replace

import pytest
from tests.unit.test_onset_by_direction import of_growth, plates
from tests.workflow.project import ROOT

from equisection.analysis.grid_limit import GridLimit
from equisection.paper.mesh_convergence.convergence_page import page
from equisection.paper.mesh_convergence.kept_releases import (
    FROM_EQUILIBRIUM,
    MeshRelease,
    mesh_releases,
)
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, MeshValue, as_table
from equisection.paper.mesh_convergence.onset_by_difference import onsets_by_difference
from equisection.paper.mesh_convergence.onset_by_direction import ReleasesByDirection
from equisection.paper.mesh_convergence.onset_by_mesh import BY_MODEL, ONSET
from equisection.paper.mesh_convergence.onset_by_mesher import (
    BOTH_MESHERS,
    limit_of_both,
    onsets_of_both_meshers,
    plate_around_outline,
    section_around_outline,
)
from equisection.paper.mesh_convergence.onset_from_equilibrium import (
    AROUND_OUTLINE,
    BY_EQUILIBRIUM,
    GrowthCurve,
    curve_from_equilibrium,
)
from equisection.paper.mesh_convergence.onset_targets import best_limit

REFERENCE = ROOT / "results" / "reference"
#: Growth (V/c) for each unit of k*.
SLOPE = -0.005


@pytest.fixture(scope="module")
def section() -> MeshRelease:
    kept = REFERENCE / "outline-equilibrium-coarse"
    return mesh_releases(kept, FROM_EQUILIBRIUM, with_outlines=True)[0]


@pytest.fixture(scope="module")
def plate() -> MeshRelease:
    kept = mesh_releases(REFERENCE / "plate-equilibrium", FROM_EQUILIBRIUM)
    return next(one for one in kept if one.case.k_star == 8.0)


@pytest.fixture(scope="module")
def curve(plate: MeshRelease) -> GrowthCurve:
    """Return the growth on blocks, a line over k* with the onset at 9."""
    line = [of_growth(plate, "coarse", SLOPE * (k - 9.0), k) for k in (5.0, 8.0, 12.0)]
    found = curve_from_equilibrium(line, [])
    assert found is not None
    return found


def interval(low: float, high: float) -> GridLimit:
    return GridLimit(0.5 * (low + high), low, high, 3, 2.0)


@pytest.mark.parametrize(
    ("narrow", "wide", "expected"),
    [
        ((7.0, 8.0), (6.0, 9.0), (7.0, 8.0)),  # the other limit is inside
        ((7.0, 8.0), (7.5, 9.9), (7.0, 8.7)),  # beside it
        ((7.0, 8.0), (3.0, 7.2), (5.1, 8.0)),
        ((7.0, 8.0), (8.5, 9.9), (7.0, 9.9)),  # they do not meet
        ((7.0, 8.0), (4.0, 6.9), (4.0, 8.0)),
    ],
)
def test_interval_of_both_meshers_holds_both_limits(
    narrow: tuple[float, float], wide: tuple[float, float], expected: tuple[float, float]
) -> None:
    one, other = interval(*narrow), interval(*wide)
    found = limit_of_both(one, other)
    assert (found.low, found.high) == pytest.approx(expected)
    assert found.value == pytest.approx(sum(expected) / 2)
    assert found == limit_of_both(other, one)
    assert all(found.low <= each.value <= found.high for each in (one, other))


def test_section_has_its_onset_where_its_growth_around_the_outline_is_zero(
    section: MeshRelease,
) -> None:
    releases = [
        of_growth(section, "coarse", -0.04 * math.log(k / 7.5), k, cells=11000)
        for k in (6.0, 7.0, 8.0)
    ]
    releases.append(of_growth(section, "medium", -0.04 * math.log(8.0 / 7.7), 8.0, cells=22000))
    (series,) = section_around_outline(releases, 0.0)
    assert series.basis == BY_EQUILIBRIUM + AROUND_OUTLINE
    assert [value.value for value in series.values] == pytest.approx([7.5, 7.7], abs=0.02)
    # half of the cells: half of the error of coarse is left on medium
    assert series.limit.value == pytest.approx(7.9, abs=0.03)
    assert not list(section_around_outline(releases[:2], 0.0))  # no curve


def test_plate_has_its_onset_by_cells_in_the_plane_and_what_is_left_along_the_span(
    plate: MeshRelease, curve: GrowthCurve
) -> None:
    blocks = ReleasesByDirection(tuple(plates(plate)), ())
    span = blocks.along_span(8.0)
    left = span.limit.value - next(one.value for one in span.values if one.mesh == "coarse")
    assert left < 0.0
    around = [of_growth(plate, mesh, 0.001) for mesh in ("coarse", "medium-coarse-span")]
    (series,) = plate_around_outline(
        ReleasesByDirection(tuple(around), ()), blocks, curve, change=0.0
    )
    assert [one.mesh for one in series.values] == ["coarse", "medium"]
    assert [one.value for one in series.values] == pytest.approx([8.2, 8.2], abs=1e-3)
    assert series.limit.value == pytest.approx(8.2 - left / SLOPE, abs=1e-3)
    one_mesh = ReleasesByDirection(tuple(around[:1]), ())
    assert not list(plate_around_outline(one_mesh, blocks, curve, 0.0))
    assert not list(plate_around_outline(blocks, ReleasesByDirection((), ()), curve, 0.0))


def test_what_two_meshes_hide_in_the_plane_is_in_the_interval(
    plate: MeshRelease, curve: GrowthCurve
) -> None:
    """The section's change from medium to fine on the plate's cells, where it is the larger one."""
    around = ReleasesByDirection(
        tuple(of_growth(plate, mesh, 0.001) for mesh in ("coarse", "medium-coarse-span")), ()
    )
    some = replace(plate, path=REFERENCE / "some" / "unsteady" / "2d" / "k8.nc")
    halves = []
    for rates in ((0.004, 0.001, 0.0005), (0.004, 0.0035, -0.0005)):
        cells = zip(("coarse", "medium", "fine"), (3132, 7112, 16056), rates, strict=True)
        sections = [of_growth(some, f"plate-{mesh}", rate, cells=n) for mesh, n, rate in cells]
        blocks = ReleasesByDirection(tuple(plates(plate)), tuple(sections))
        (series,) = plate_around_outline(around, blocks, curve, change=0.0)
        halves.append(series.limit.half_width)
    plain, hiding = halves
    assert math.sqrt(hiding**2 - plain**2) == pytest.approx(0.004 / abs(SLOPE), rel=0.02)


def onsets(model: str, basis: str, low: float, high: float) -> MeshSeries:
    """Return onsets with a limit of a given interval."""
    mid = 0.5 * (low + high)
    values = tuple(
        MeshValue(mesh, cells, mid + by, mid + by - 0.1, mid + by + 0.1)
        for mesh, cells, by in (("coarse", 11136, 0.6), ("medium", 22548, 0.3))
    )
    return MeshSeries(ONSET, model, "", basis, 2, values, derived=interval(low, high))


def test_narrower_limit_of_one_mesher_does_not_count() -> None:
    series = [
        onsets("2d", BY_EQUILIBRIUM, 6.7, 7.1),
        onsets("2d", BY_EQUILIBRIUM + AROUND_OUTLINE, 7.3, 7.6),
        onsets("3d", BY_EQUILIBRIUM, 7.0, 9.0),
    ]
    (both,) = onsets_of_both_meshers(series)
    assert (both.model, both.basis) == ("2d", BOTH_MESHERS)
    best = best_limit(as_table([*series, both]), "2d")
    assert best is not None
    assert (best["low"], best["high"]) == pytest.approx((6.7, 7.6))
    plate = best_limit(as_table([*series, both]), "3d")
    assert plate is not None
    assert plate["basis"] == BY_EQUILIBRIUM
    without = replace(series[1], derived=GridLimit(7.4, math.nan, math.nan, 1))
    assert not list(onsets_of_both_meshers([series[0], without]))


def test_page_says_whether_both_meshers_meet() -> None:
    blocks = onsets("2d", BY_EQUILIBRIUM, 6.7, 7.1)
    for low, says in ((7.3, "else both (`2d`)"), (7.0, "else both.")):
        around = onsets("2d", BY_EQUILIBRIUM + AROUND_OUTLINE, low, 7.6)
        series = [blocks, around]
        series += onsets_of_both_meshers(series)
        assert says in " ".join(page(series, "").split())
    assert "both meshers" not in page([blocks], "")


def test_corrected_section_has_the_uncertainty_of_both_meshers() -> None:
    series = [
        onsets("2d", BY_EQUILIBRIUM, 6.7, 7.1),
        onsets("2d", BY_EQUILIBRIUM + AROUND_OUTLINE, 7.3, 7.6),
        onsets("2d", BY_MODEL, 6.0, 8.0),
        onsets("2d-corrected", BY_EQUILIBRIUM, 5.0, 7.0),
        onsets("2d-corrected", BY_MODEL, 5.9, 6.1),
    ]
    series += onsets_of_both_meshers(series)
    (corrected,) = onsets_by_difference(series)
    both = series[-1].limit
    assert corrected.limit.half_width > both.half_width
    best = best_limit(as_table([*series, corrected]), "2d-corrected")
    assert best is not None
    assert best["high"] - best["low"] > both.high - both.low  # the learnt model's is narrower
