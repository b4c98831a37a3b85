"""What is made of kept results on several meshes: polars, quotients, limits, and the page."""

import json
import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from tests.workflow.project import ROOT

from equisection.paper.mesh_convergence import kept_releases
from equisection.paper.mesh_convergence.convergence_figure import draw
from equisection.paper.mesh_convergence.convergence_page import is_converged, page
from equisection.paper.mesh_convergence.kept_releases import (
    OWN_RATIOS,
    MeshLoads,
    mesh_releases,
    polars_of,
    rigid_loads,
)
from equisection.paper.mesh_convergence.loads_by_mesh import (
    EQUAL_CELLS,
    iteration_series,
    load_series,
    modal_series,
    printed_limit,
    ratio_series,
)
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, MeshValue
from equisection.paper.mesh_convergence.onset_by_mesh import (
    BY_MODEL,
    BY_RELEASES,
    ONSET,
    damped,
    early_growth_of_plate,
    onset_on,
    onsets_by_releases,
    own_factors,
    plates_by_model,
)
from equisection.paper.mesh_convergence.onset_from_equilibrium import BY_EQUILIBRIUM
from equisection.paper.printed_values import PAPER_ONSET
from equisection.results.netcdf import read_attributes, read_dataset
from equisection.store.kept import Kept

DENSE = [0.0, 1.0, 2.0, 2.5, 3.0, 4.0, 5.0, 10.0]
SPARSE = [0.0, 2.5, 5.0, 10.0]


def loads(mesh: str, cells: int, angles: list[float], factor: float = 1.0) -> list[MeshLoads]:
    """Return loads of a body whose lift and moment bend at 4 deg, times a factor."""
    return [
        MeshLoads(
            mesh,
            cells,
            angle,
            {
                "cd": 0.05,
                "cl": factor * 0.1 * min(angle, 4.0),
                "cm": factor * 0.02 * min(angle, 4.0),
            },
            Path(f"{mesh}_a{angle:g}.nc"),
        )
        for angle in angles
    ]


def test_polar_of_few_angles_keeps_the_bend_of_a_denser_one() -> None:
    found = polars_of([*loads("coarse", 100, DENSE), *loads("medium", 400, SPARSE, 1.1)])
    medium = found["medium"]
    assert "in the shape of coarse" in medium.label
    at_bend = float(medium.lift_coefficient(math.radians(4.0)))
    assert at_bend == pytest.approx(1.1 * 0.4)
    straight = np.interp(4.0, [2.5, 5.0], [1.1 * 0.25, 1.1 * 0.4])
    assert at_bend > straight + 0.02
    assert found["coarse"].label == "coarse"


def test_polar_of_three_angles_is_none() -> None:
    assert not polars_of(loads("coarse", 100, [0.0, 2.5, 5.0]))


def test_own_ratios_are_those_of_the_finest_mesh_that_both_have() -> None:
    section = [
        *loads("plate-coarse", 30, DENSE, 1.3),
        *loads("plate-medium", 70, DENSE, 1.2),
        *loads("fine", 500, DENSE, 9.0),
    ]
    plate = [*loads("coarse", 800, DENSE), *loads("medium", 3000, DENSE)]
    factors, mesh = own_factors(section, plate)
    assert mesh == "medium"
    assert factors is not None
    assert float(factors.lift_factor(math.radians(3.0))) == pytest.approx(1.2)
    assert own_factors(section, loads("fine", 9000, DENSE)) == (None, "")
    quotients = {one.quantity: one for one in ratio_series(section, plate) if one.at == "5 deg"}
    assert [v.value for v in quotients["c_l/C_L"].values] == pytest.approx([1.3, 1.2])
    assert all(one.model == EQUAL_CELLS for one in quotients.values())


def test_loads_are_taken_at_the_incidences_of_table_1_on_similar_meshes(tmp_path: Path) -> None:
    kept = [*loads("plate-coarse", 30, DENSE), *loads("coarse", 100, DENSE)]
    found = list(load_series(kept, "2d", tmp_path))
    assert {one.at for one in found} == {"0 deg", "2.5 deg", "5 deg", "10 deg"}
    assert {value.mesh for one in found for value in one.values} == {"coarse"}
    assert [one.quantity for one in found if one.at == "0 deg"] == ["c_d"]  # the rest is nil


@pytest.mark.parametrize(
    ("settings", "is_taken"),
    [
        ({}, True),
        ({"mesh": "five-layers"}, False),
        ({"mesh": "finest"}, False),
        ({"turbulence_intensity": 0.05}, False),
    ],
)
def test_results_on_other_meshes_or_in_another_stream_have_no_place_in_a_series(
    settings: dict[str, object], is_taken: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = ROOT / "results" / "reference" / "paper-plate-openfoam"
    changed = []
    for path in (run / "steady/2d/coarse_a2.5.nc", run / "unsteady/2d/k14.nc"):
        attributes = read_attributes(path)
        case = json.loads(attributes["case"])
        case["solver"]["settings"] |= settings
        changed.append(Kept(path, attributes | {"case": json.dumps(case)}))
    monkeypatch.setattr(kept_releases, "kept_results", lambda _: changed)
    assert len(rigid_loads(run, "2d")) == is_taken
    assert len(mesh_releases(run)) == is_taken


def test_plate_is_compared_at_one_k_star_whatever_else_is_kept() -> None:
    """A release at another k*, or with more iterations, is no further mesh."""
    kept = [one for one in mesh_releases(ROOT / "results" / "reference") if one.model == "3d"]
    four = next(one for one in kept if one.mesh == "coarse" and one.iterations == 4)
    more = [
        replace(four, case=four.case.model_copy(update={"k_star": 5.0})),
        replace(four, iterations=8),
    ]
    alone = [early_growth_of_plate(kept), *modal_series(kept), *iteration_series(kept)]
    beside = [*more, *kept]
    found = [early_growth_of_plate(beside), *modal_series(beside), *iteration_series(beside)]
    assert len(alone) == 5
    assert [(one.quantity, one.at, one.values) for one in found] == [
        (one.quantity, "k* = 6.44", one.values) for one in alone
    ]


def test_plate_without_a_polar_on_its_mesh_is_not_learnt_from() -> None:
    kept = mesh_releases(ROOT / "results" / "reference")
    assert not list(plates_by_model(kept, []))


def test_longer_release_of_the_plate_is_compared_over_30_chords() -> None:
    kept = [one for one in mesh_releases(ROOT / "results" / "reference") if one.model == "3d"]
    long = next(one for one in kept if one.case.k_star == 6.44 and one.end > 50.0)
    with_four = replace(long, iterations=4)
    later = np.where(long.tip.time > 30.0, 2.0, 1.0)  # what follows is twice as far out
    other = replace(with_four, tip=replace(long.tip, twist=later * long.tip.twist))
    twist, _ = iteration_series([long, other])
    assert twist.values[0].value == pytest.approx(1.0)
    torsion, _ = modal_series([with_four])
    means = read_dataset(long.path)["torsion_amplitude"].sel(time=slice(10.0, 30.0)).mean("time")
    first, *others = np.abs(means.values)
    assert torsion.values[0].value == pytest.approx(first / max(others))


def test_onset_of_a_plate_on_a_finer_mesh_is_by_its_difference_from_coarse() -> None:
    """The growth curve that is moved is that of coarse, whatever other meshes there are."""
    kept = [one for one in mesh_releases(ROOT / "results" / "reference") if one.model == "3d"]
    medium = next(one for one in kept if one.mesh == "medium" and one.iterations == 4)
    solver = medium.case.solver
    named = solver.model_copy(update={"settings": solver.settings | {"mesh": "fine"}})
    case = medium.case.model_copy(update={"solver": named})
    fine = replace(medium, case=case, cells=3 * medium.cells)
    (found,) = onsets_by_releases([*kept, fine])
    assert [value.mesh for value in found.values] == ["coarse", "medium", "fine"]
    assert found.values[1].value == found.values[2].value < found.values[0].value
    without = [one for one in kept if (one.mesh, one.iterations) != ("coarse", 4)]
    (alone,) = onsets_by_releases([*without, fine])
    assert [value.mesh for value in alone.values] == ["coarse"]


def test_intervals_of_table_1_hold_its_finest_mesh() -> None:
    for name, angle, finest in (("C_L", 2.5, 0.2613), ("C_M", 5.0, 0.0697), ("C_D", 10.0, 0.1535)):
        found = printed_limit(name, angle)
        assert found.low < finest < found.high
        assert found.meshes == 3


def onset(model: str, basis: str, k_star: list[float], at: str = "") -> MeshSeries:
    meshes = zip(("coarse", "medium", "fine"), (100, 400, 1600), k_star, strict=False)
    values = tuple(MeshValue(*one, one[2] - 0.2, one[2] + 0.2) for one in meshes)
    return MeshSeries(ONSET, model, at, basis, 2, values, common_error=basis == BY_MODEL)


SERIES = [
    onset("2d", BY_MODEL, [8.4, 7.5, 7.2]),
    onset("2d-corrected", BY_MODEL, [7.2, 6.2, 5.8]),
    onset(OWN_RATIOS, BY_MODEL, [7.8, 7.0, 6.7]),
    onset("2d", BY_MODEL, [7.0, 6.3], damped(0.01)),
    onset("3d", BY_RELEASES, [10.2, 7.8]),
    onset("2d-corrected", BY_RELEASES, [7.4]),
]


def test_limit_is_converged_only_where_its_interval_is_narrow() -> None:
    assert [is_converged(one) for one in SERIES] == [True, True, True, False, False, False]


def test_interval_without_an_end_is_no_interval_of_nothing() -> None:
    """An onset that is known on one side alone, and one of a band that leaves the k* asked for."""
    values = [
        MeshValue("coarse", 100, 8.0, 7.9, 8.1),
        MeshValue("medium", 400, 7.0, 6.9, 7.1),
        onset_on("fine", 1600, (6.5, math.nan, 6.6)),
    ]
    for shared in (True, False):
        found = MeshSeries(ONSET, "2d", "", BY_MODEL, 2, tuple(values), common_error=shared)
        assert math.isinf(found.limit.half_width)
        assert not is_converged(found)
        line = next(row for row in page([found], "").splitlines() if row.startswith("| 2d |"))
        assert "| 6.50 (interval unknown) |" in line
        assert line.endswith("| none | no |")
        draw([found], PAPER_ONSET).draw_without_rendering()


def test_page_says_which_limits_are_converged() -> None:
    text = page(SERIES, "coarse")
    onsets, _, damped_onsets = text.partition("## Structural damping")
    lines = {
        line.split(" | ")[0][2:]: line for line in onsets.splitlines() if line.startswith("| 2d")
    }
    assert "| 2d | learnt model | 8.40 ± 0.20 | 7.50 ± 0.20 | 7.20 ± 0.20 |" in text
    assert "| 2d-corrected | releases | 7.40 ± 0.20 |  |  |  |  | none | no |" in text
    assert lines[OWN_RATIOS].endswith("yes |")
    assert "| damping | 0 | 1 % |" in damped_onsets
    assert "| 2d | 7.05 ± 0.27 | *6.07 ± 0.73* |" in damped_onsets
    assert "The plate's onset is not converged" in text
    first = 7.8 - 2.4 / ((400 / 100) ** (1.0 / 2.0) - 1.0)
    assert f"with the assumed order 2 ({first:.1f} with the order 1)" in text
    assert "| 2d | learnt model | ± 3.9 % | ± 5 % | yes |" in text
    assert "| 2d-corrected | learnt model | ± 7.0 % | ± 5 % | no |" in text
    assert "k*" not in text.replace("k\\*", "")


def test_quantity_of_two_models_at_one_place_has_a_line_for_each() -> None:
    values = (MeshValue("coarse", 100, 2.0), MeshValue("medium", 400, 2.0))
    series = [
        MeshSeries("mean twist, deg", model, "k* = 8", "releases", 2, values)
        for model in ("2d", "3d")
    ]
    lines = [line for line in page(series, "").splitlines() if line.startswith("| mean twist")]
    assert [line.split(" | ")[0] for line in lines] == [
        "| mean twist, deg, 2d",
        "| mean twist, deg, 3d",
    ]


def test_figure_has_each_model_with_its_limit_and_the_papers_onset() -> None:
    figure = draw(SERIES, PAPER_ONSET)
    left, right = figure.axes
    shown = {text for axes in (left, right) for text in axes.get_legend_handles_labels()[1]}
    assert {"2D", "2D corrected by Table 1", "2D corrected, own ratios", "paper"} <= shown
    # limits stand left of h = 0: four of six series have one, of which one is damped
    limits = [
        line for line in left.get_lines() if len(line.get_xdata()) and line.get_xdata()[0] < 0
    ]
    assert len(limits) >= 4
    figure.draw_without_rendering()


def test_series_that_is_part_of_another_is_not_drawn_twice() -> None:
    """Neither its onsets nor its limit, which is that of fewer meshes."""
    part, whole = onset("2d", BY_EQUILIBRIUM, [7.4, 6.2]), onset("2d", BY_RELEASES, [7.4, 6.2, 5.8])
    of_another = onset("2d-corrected", BY_RELEASES, [7.4, 6.2, 5.8])
    alone, both, apart = (
        len(draw(series, PAPER_ONSET).axes[0].containers)
        for series in ([whole], [whole, part], [part, of_another])
    )
    assert both == alone
    assert apart == 2 * alone
