"""Limit of the plate's growth and onset from meshes that are finer in one direction."""

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace

import pytest
from tests.workflow.project import ROOT

from equisection.paper.mesh_convergence.convergence_page import page
from equisection.paper.mesh_convergence.kept_releases import (
    FROM_EQUILIBRIUM,
    MeshRelease,
    mesh_releases,
)
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, MeshValue
from equisection.paper.mesh_convergence.onset_by_direction import (
    BY_DIRECTION,
    GrowthByDirection,
    ReleasesByDirection,
    hides_error,
    onset_by_direction,
)
from equisection.paper.mesh_convergence.onset_by_mesh import ONSET
from equisection.paper.mesh_convergence.onset_from_equilibrium import (
    BY_EQUILIBRIUM,
    GrowthCurve,
    curve_from_equilibrium,
)
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.verdict.growth import Growth

#: Growth (V/c) in the limit at k* 8, and what an error of the order 2 is on the coarse mesh.
LIMIT, IN_PLANE, ALONG = -0.004, 0.006, 0.002
#: The section's own growth in the limit, and its error on the coarse mesh.
OF_SECTION, ERROR_OF_SECTION = -0.01, 0.005
NAMES = ("coarse", "medium", "fine")
#: Name of the mesh of the plate that has the cells of one in the plane, and of one along the span.
MESHES = {
    ("coarse", "sparse"): "coarse-sparse-span",
    ("coarse", "coarse"): "coarse",
    ("coarse", "medium"): "coarse-medium-span",
    ("medium", "coarse"): "medium-coarse-span",
    ("fine", "coarse"): "fine-coarse-span",
    ("medium", "medium"): "medium",
}


@dataclass(frozen=True, eq=False)
class OfKnownGrowth(MeshRelease):
    """A release whose growth is known."""

    rate: float = math.nan

    def growth(self, start: float, end: float, waves: int = 3) -> Growth:
        return Growth(rate=self.rate, standard_error=1e-6, start=start, end=end, periods=8)


@pytest.fixture(scope="module")
def plate() -> MeshRelease:
    kept = mesh_releases(ROOT / "results/reference/plate-equilibrium", FROM_EQUILIBRIUM)
    return next(one for one in kept if one.case.k_star == 8.0)


@pytest.fixture(scope="module")
def section() -> MeshRelease:
    kept = ROOT / "results/reference/plate-cells-equilibrium-coarse"
    (found,) = mesh_releases(kept, FROM_EQUILIBRIUM, ["plate-coarse"])
    return found


def of_growth(
    some: MeshRelease,
    mesh: str,
    rate: float,
    k_star: float = 8.0,
    *,
    cells: int = 1000,
    iterations: int = 4,
) -> OfKnownGrowth:
    solver = some.case.solver.model_copy(update={"settings": {"mesh": mesh}})
    case = some.case.model_copy(update={"k_star": k_star, "solver": solver})
    own = {field.name: getattr(some, field.name) for field in fields(MeshRelease)}
    own |= {"case": case, "cells": cells, "iterations": iterations}
    return OfKnownGrowth(**own, rate=rate)


def by_direction(plates: Sequence[MeshRelease]) -> list[GrowthByDirection]:
    return list(ReleasesByDirection(tuple(plates), ()).growths())


def layers(mesh: str) -> int:
    return PRESETS[mesh].plate_layers


def along(name: str) -> float:
    """Return the square of the cell size along the span over that of coarse."""
    return (layers("coarse") / layers("coarse-sparse-span" if name == "sparse" else name)) ** 2


def in_plane(name: str) -> float:
    cells = {one: PRESETS[f"plate-{one}"].cells for one in ("coarse", name)}
    return cells["coarse"] / cells[name]


def plates(some: MeshRelease, mixed: float = 0.0) -> list[MeshRelease]:
    """Return the plate on every mesh, with errors of the order 2 and one of both directions."""
    found: list[MeshRelease] = []
    for (plane, span), mesh in MESHES.items():
        rate = LIMIT + IN_PLANE * in_plane(plane) + ALONG * along(span)
        found.append(of_growth(some, mesh, rate + mixed * in_plane(plane) * along(span)))
    return found


def sections(some: MeshRelease) -> list[MeshRelease]:
    return [
        of_growth(
            some,
            f"plate-{name}",
            OF_SECTION + ERROR_OF_SECTION * in_plane(name),
            cells=PRESETS[f"plate-{name}"].cells,
        )
        for name in NAMES
    ]


def test_errors_that_add_up_leave_the_limit(plate: MeshRelease) -> None:
    (found,) = by_direction(plates(plate))
    value, half = found.limit
    assert value == pytest.approx(LIMIT, abs=2e-5)
    assert found.missed == pytest.approx(0.0, abs=1e-9)
    # the grid convergence index of what is left beyond the finest mesh of either direction
    left = 1.25 * math.hypot(ALONG * along("medium"), IN_PLANE * in_plane("fine"))
    assert half == pytest.approx(left, rel=0.05)


@pytest.mark.parametrize("mixed", [-0.002, 0.002])
def test_errors_that_do_not_add_up_are_in_the_interval(plate: MeshRelease, mixed: float) -> None:
    (found,) = by_direction(plates(plate, mixed))
    # the change in the plane is that with the layers of coarse
    missed = mixed * (1.0 - along("medium")) * (1.0 - in_plane("medium"))
    assert found.missed == pytest.approx(missed, abs=1e-9)
    value, half = found.limit
    assert half > 3 * abs(missed)
    assert value - half < LIMIT < value + half


@pytest.mark.parametrize("without", sorted(set(MESHES.values())))
def test_every_mesh_is_needed(plate: MeshRelease, without: str) -> None:
    rest = [one for one in plates(plate) if one.mesh != without]
    assert not by_direction(rest)
    few = of_growth(plate, without, 0.0, iterations=2)
    assert not by_direction([*rest, few])
    elsewhere = of_growth(plate, without, 0.0, 10.0)
    assert not by_direction([*rest, elsewhere])


#: Growth over k* on the coarse mesh (V/c): its slope over ln k*, and where it is zero.
SLOPE, ZERO = -0.03, 10.0


@pytest.fixture
def curve(plate: MeshRelease) -> GrowthCurve:
    found = curve_from_equilibrium(
        [
            of_growth(plate, "coarse", SLOPE * math.log(k / ZERO), k, iterations=2)
            for k in (4.5, 5.0, 5.5, 6.0, 6.5, 7.0, 8.0, 9.0, 11.0)
        ],
        [],
    )
    assert found is not None
    return found


@pytest.fixture
def of_meshes() -> MeshSeries:
    value = MeshValue("medium", 300912, 8.4, 8.2, 8.6)
    return MeshSeries(ONSET, "3d", "", BY_EQUILIBRIUM, 3, (value,))


def test_sections_on_cells_of_their_own_are_left_out(plate: MeshRelease) -> None:
    releases = mesh_releases(
        ROOT / "results/reference/section-equilibrium-medium", FROM_EQUILIBRIUM
    )
    assert {one.model for one in releases} == {"2d"}
    series = list(ReleasesByDirection.of([*releases, *plates(plate)]).series())
    assert {one.model for one in series} == {"3d"}


def test_growth_in_one_direction_is_there_without_the_other(
    plate: MeshRelease, section: MeshRelease
) -> None:
    few = [one for one in plates(plate) if one.mesh in ("coarse", "coarse-medium-span", "medium")]
    span, plane = ReleasesByDirection(tuple(few), tuple(sections(section))).series()
    assert (span.basis, [value.mesh for value in span.values]) == ("along the span", [*NAMES[:2]])
    assert (plane.basis, [value.mesh for value in plane.values]) == ("in the plane", [*NAMES])
    assert (span.model, plane.model) == ("3d", "2d")
    assert plane.limit.order == pytest.approx(2.0)
    assert plane.limit.value == pytest.approx(OF_SECTION)
    assert not hides_error(plane)


def test_cells_that_are_too_coarse_hide_their_error(section: MeshRelease) -> None:
    rates = {"coarse": 0.001, "medium": 0.0015, "fine": -0.002}
    of_section = [
        of_growth(section, f"plate-{name}", rate, cells=PRESETS[f"plate-{name}"].cells)
        for name, rate in rates.items()
    ]
    (plane,) = ReleasesByDirection((), tuple(of_section)).series()
    assert hides_error(plane)
    (less,) = ReleasesByDirection((), tuple(of_section[:2])).series()
    assert not hides_error(less)
    value = MeshValue("medium", 300912, 8.4, 8.2, 8.6)
    onset = MeshSeries(ONSET, "3d", "", BY_EQUILIBRIUM, 3, (value,))
    assert "do not trust the plate's limit by two meshes" in page([onset, plane], "")
    assert "do not trust" not in page([onset, less], "")


def test_onset_is_where_the_growth_is_zero_that_is_moved_to_the_limit(
    plate: MeshRelease, curve: GrowthCurve, of_meshes: MeshSeries
) -> None:
    (growth,) = by_direction(plates(plate))
    (found,) = onset_by_direction([growth], [of_meshes], curve, 0.0)
    rate, half = growth.limit
    assert found.basis == BY_DIRECTION
    expected = 8.0 * math.exp(-rate / SLOPE)
    assert found.limit.value == pytest.approx(expected, rel=2e-3)
    assert found.limit.half_width == pytest.approx(expected * half / -SLOPE, rel=0.02)
    (wider,) = onset_by_direction([growth], [of_meshes], curve, 0.5)
    assert wider.limit.value == found.limit.value
    assert wider.limit.half_width > found.limit.half_width
    assert not list(onset_by_direction([], [of_meshes], curve, 0.0))
    elsewhere = replace(growth, k_star=7.5)  # without a release of the curve
    assert not list(onset_by_direction([elsewhere], [of_meshes], curve, 0.0))
    assert not list(onset_by_direction([growth], [of_meshes], None, 0.0))


def test_growth_nearest_to_its_onset_counts(
    plate: MeshRelease, curve: GrowthCurve, of_meshes: MeshSeries
) -> None:
    (near,) = by_direction(plates(plate))
    far = [replace(near, k_star=k_star) for k_star in (5.0, 11.0)]
    (alone,) = onset_by_direction([near], [of_meshes], curve, 0.1)
    (of_three,) = onset_by_direction([far[0], near, far[1]], [of_meshes], curve, 0.1)
    assert of_three.limit == alone.limit


def test_page_has_the_growth_in_either_direction(
    plate: MeshRelease, curve: GrowthCurve, of_meshes: MeshSeries
) -> None:
    (growth,) = by_direction(plates(plate))
    onsets = onset_by_direction([growth], [of_meshes], curve, 0.1)
    text = page([of_meshes, *onsets, growth.along_span, growth.in_plane], "")
    lines = {line.rpartition(" | yes")[0] or line for line in text.splitlines()}
    (along,) = (line for line in lines if line.startswith("| 8 | along the span, `3d` | "))
    assert "| sparse | coarse | medium |" in text
    assert " | 2.0 | +0.0020 | " in along
    (plane,) = (line for line in lines if line.startswith("| 8 | in the plane, `3d` | "))
    assert " | 2.0 | -0.0020 | " in plane
    assert "its best limit (by direction) is 7.0 with" in text
    assert "limit of the growth -0.0040 +- " in text
    without = page([of_meshes], "")
    assert "along the span" not in without
    assert BY_DIRECTION not in without
