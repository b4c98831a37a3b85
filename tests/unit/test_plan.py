import math
import re
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory

import pytest
from hypothesis import given
from hypothesis import strategies as st

from equisection.analysis.onset import (
    OnsetBracket,
    onset_bracket,
    points_beyond,
    refinement_points,
)
from equisection.cases import FREE, STEADY
from equisection.config import Config, load_config
from equisection.errors import ConfigError
from equisection.study import plan
from equisection.study.axes import K_STAR, RIGID_PATTERN, SWEEP_PATTERN, Point, sweep_points

k_stars = st.floats(min_value=1e-3, max_value=1e6).map(lambda value: float(f"{value:.6g}"))
angles = st.floats(min_value=-89, max_value=89).map(lambda value: float(f"{value:.6g}"))
words = st.from_regex(r"[A-Za-z0-9](\.?[A-Za-z0-9_-]){0,8}", fullmatch=True)


def config(**sweep: object) -> Config:
    return load_config({"sweep": sweep})


@given(k_stars)
def test_name_of_a_case_says_its_k_star(k_star: float) -> None:
    name = Point.at({K_STAR: k_star}).name
    assert Point.named(name)[K_STAR] == k_star
    assert re.fullmatch(SWEEP_PATTERN, name)


@given(words, angles)
def test_name_of_a_steady_case_says_resolution_and_incidence(word: str, angle: float) -> None:
    name = plan.rigid_case(word, angle)
    assert plan.rigid_point(name) == (word, angle)
    assert re.fullmatch(RIGID_PATTERN, name)


@pytest.mark.parametrize("name", ["", "k", "7", "sweep", "round1", "k6/../k7", "K6"])
def test_other_names_are_no_cases(name: str) -> None:
    assert not re.fullmatch(SWEEP_PATTERN, name)


@given(k_stars)
def test_names_of_cases_and_of_batches_are_never_the_same(k_star: float) -> None:
    assert not re.fullmatch(plan.BATCH_PATTERN, K_STAR.part(k_star))


@pytest.mark.parametrize(
    ("name", "dimension", "corrected", "reduction"),
    [
        ("2d", "2d", False, "consistent"),
        ("2d-corrected", "2d", True, "consistent"),
        ("2d-paper", "2d", False, "paper"),
        ("2d-corrected-paper", "2d", True, "paper"),
        ("2d-corrected-consistent", "2d", True, "consistent"),
        ("3d", "3d", False, "consistent"),
    ],
)
def test_name_of_a_model_is_taken_apart(
    name: str, dimension: str, corrected: bool, reduction: str
) -> None:
    assert plan.model(name, "consistent") == plan.Model(name, dimension, corrected, reduction)
    assert re.fullmatch(plan.MODEL_PATTERN, name)


def test_sweep_is_in_ascending_order() -> None:
    assert plan.sweep_cases(config(k_star=[21, 4, 6.44])) == ["k4", "k6.44", "k21"]
    assert plan.stiffest_case(["k4", "k21", "k6.44"]) == "k21"
    assert plan.stiffest_case([]) is None


def test_range_of_k_star_holds_both_ends() -> None:
    names = plan.sweep_cases(config(k_star={"start": 4, "stop": 6, "number": 5}))
    assert names == ["k4", "k4.5", "k5", "k5.5", "k6"]


def test_steady_cases_are_those_of_every_resolution() -> None:
    raw = {
        "steady": {"incidence_deg": [0, 2.5, 5, 10], "resolution": "b", "study": ["a"]},
        "embedded": {"polars": {"a": "flat-plate", "b": "flat-plate"}},
    }
    names = plan.steady_cases(load_config(raw))
    assert names == [f"{word}_a{angle}" for word in "ba" for angle in ("0", "2.5", "5", "10")]


def test_further_resolutions_are_run_at_the_incidences_of_the_study() -> None:
    steady = {"incidence_deg": [0, 1, 2.5, 10], "study": ["b"], "study_incidence_deg": [0, 10]}
    raw = {
        "steady": {"resolution": "a", **steady},
        "embedded": {"polars": {"a": "flat-plate", "b": "flat-plate"}},
    }
    names = plan.steady_cases(load_config(raw))
    assert names == ["a_a0", "a_a1", "a_a2.5", "a_a10", "b_a0", "b_a10"]


def test_runs_have_a_mesh_of_their_own_where_one_is_named() -> None:
    raw = {
        "solver": "openfoam",
        "steady": {"resolution": "coarse", "beam_polar": "config/polars/paper_plate_3d.csv"},
        "sweep": {"k_star": [6.0], "models": ["2d"]},
        "unsteady": {"time_step": 0.02},
    }
    own = {**raw, "unsteady": {"time_step": 0.02, "resolution": "fine"}}
    for known, of_runs in ((raw, "coarse"), (own, "fine")):
        found = {one.kind: one.resolution for one in plan.planned_cases(load_config(known))}
        assert found == {STEADY: "coarse", FREE: of_runs}


@pytest.mark.parametrize(
    ("solver", "resolution", "words"),
    [
        ("openfoam", "nix", "allowed is a name in openfoam.meshes: coarse, fine, medium"),
        ("embedded", "coarse", "allowed with solver 'embedded' is none"),
    ],
)
def test_resolution_of_runs_that_no_mesh_has_is_refused(
    solver: str, resolution: str, words: str
) -> None:
    unsteady = {"time_step": 0.02, "resolution": resolution}
    with pytest.raises(ConfigError, match=words):
        load_config({"solver": solver, "unsteady": unsteady})


def test_no_refinement_has_the_sweep_alone() -> None:
    assert plan.refinement_rounds(config(k_star=[4, 21], onset="sweep")) == 0
    assert plan.batches(config(k_star=[4, 21], onset="sweep")) == ["sweep"]


def test_a_sweep_that_is_narrow_enough_takes_no_round() -> None:
    assert plan.refinement_rounds(config(k_star=[7.0, 7.05], onset="refine", onset_reach=1)) == 0


def test_batches_before_a_round_are_all_that_it_can_know() -> None:
    assert plan.batches_before("round1") == ["sweep"]
    assert plan.batches_before("round3") == ["sweep", "round1", "round2"]


@given(
    unstable=st.floats(1.0, 50.0),
    width=st.floats(0.01, 10.0),
    tolerance=st.floats(0.01, 0.5),
    points=st.integers(1, 6),
    sides=st.lists(st.integers(0, 6), min_size=40, max_size=40),
)
def test_planned_rounds_are_enough_wherever_the_onset_is(
    unstable: float, width: float, tolerance: float, points: int, sides: list[int]
) -> None:
    low, high = unstable, unstable * (1 + width)
    planned = plan.refinement_rounds(
        config(k_star=[low, high], onset="refine", onset_tolerance=tolerance, onset_points=points)
    )
    for side in sides[:planned]:
        chosen = refinement_points(OnsetBracket(high, low), tolerance, points)
        if not chosen:
            break
        ends = [low, *chosen, high]
        part = side % (len(ends) - 1)
        low, high = ends[part], ends[part + 1]
    # k* are rounded to four digits, so that parts differ a little from even ones
    assert (high - low) / low <= tolerance * 1.02 + 2e-3


@given(st.lists(k_stars, max_size=5))
def test_round_of_refinement_is_read_as_written(k_star: list[float]) -> None:
    with TemporaryDirectory() as folder:
        path = Path(folder) / "2d_round1.json"
        plan.write_refinement(path, [Point.at({K_STAR: value}) for value in k_star])
        assert [Point.named(name)[K_STAR] for name in plan.read_refinement(path)] == k_star


def test_plan_needs_no_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    asked: list[Callable[[Config], object]] = [
        plan.sweep_cases,
        plan.steady_cases,
        plan.batches,
    ]
    for function in asked:
        assert function(load_config({}))
    assert list(tmp_path.iterdir()) == []


@given(
    at=st.floats(1.01, 3.9),
    towards=st.sampled_from(["lower", "higher"]),
    points=st.integers(1, 6),
    tolerance=st.floats(0.02, 0.5),
)
def test_planned_rounds_find_an_onset_beyond_the_ends(
    at: float, towards: str, points: int, tolerance: float
) -> None:
    """Whatever is within the reach is found, and its bracket as narrow as was asked for."""
    given_ends, reach = (5.0, 6.0), 4.0
    onset = given_ends[0] / at if towards == "lower" else given_ends[1] * at
    runs = list(given_ends)
    planned = plan.refinement_rounds(
        config(
            k_star=list(given_ends),
            onset="refine",
            onset_reach=reach,
            onset_tolerance=tolerance,
            onset_points=points,
        )
    )

    def bracket() -> OnsetBracket:
        return onset_bracket(runs, ["settled" if run > onset else "growing" for run in runs])

    for _ in range(planned):
        runs += refinement_points(bracket(), tolerance, points) or points_beyond(
            bracket(), runs, given_ends, reach, points
        )
    assert bracket().closed
    assert bracket().relative_width <= tolerance * 1.02 + 2e-3


def test_speeds_are_the_axis_of_a_study_in_the_place_of_k_star() -> None:
    over = config(k_star=None, speed=[30.0, 20.0])
    assert [point.name for point in sweep_points(over)] == ["v20", "v30"]
    assert plan.highest_of_sweep(over) == pytest.approx(0.3 * 340.0)
    assert math.isinf(plan.highest_of_sweep(config(k_star=[5.0, 6.0])))
