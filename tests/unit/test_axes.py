"""Axes of a study: names of cases, their order, and the case of a point."""

import itertools
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from equisection.config import load_config
from equisection.study.axes import (
    AXES,
    INCIDENCE,
    K_STAR,
    RIGID_PATTERN,
    SPEED,
    SWEEP_PATTERN,
    Axis,
    Point,
    axes_of,
    onset_axis,
    sweep_points,
)


def six_digits(low: float, high: float) -> st.SearchStrategy[float]:
    return st.floats(low, high).map(lambda value: float(f"{value:.6g}"))


VALUES = {INCIDENCE: six_digits(-89, 89), K_STAR: six_digits(1e-3, 1e6), SPEED: six_digits(0.1, 99)}
points = st.fixed_dictionaries({}, optional=VALUES).filter(bool).map(Point.at)
resolutions = st.from_regex(r"[A-Za-z0-9](\.?[A-Za-z0-9_-]){0,8}", fullmatch=True)
#: Names that could be taken for parts of axes.
confusing = st.sampled_from(["a5", "k6.44", "x_a3", "v30_", "a1_k2", "k1e-05", "a-2.5"])


@given(points)
def test_name_of_a_case_says_its_point(point: Point) -> None:
    assert Point.named(point.name) == point
    assert re.fullmatch(SWEEP_PATTERN, point.name)
    assert not re.fullmatch(RIGID_PATTERN, point.name)


@given(st.one_of(resolutions, confusing), VALUES[INCIDENCE], st.one_of(st.none(), VALUES[SPEED]))
def test_name_of_a_rigid_case_says_resolution_and_point(
    resolution: str, incidence: float, speed: float | None
) -> None:
    values = {INCIDENCE: incidence} | ({} if speed is None else {SPEED: speed})
    point = Point.at(values, resolution)
    assert Point.named(point.name) == point
    assert re.fullmatch(RIGID_PATTERN, point.name)


@pytest.mark.parametrize(
    ("name", "values", "resolution"),
    [
        ("k6.44", {K_STAR: 6.44}, ""),
        ("a5_k6.44", {INCIDENCE: 5.0, K_STAR: 6.44}, ""),
        ("a-2.5_v30", {INCIDENCE: -2.5, SPEED: 30.0}, ""),
        ("coarse_a2.5", {INCIDENCE: 2.5}, "coarse"),
        ("k5_a2", {INCIDENCE: 2.0}, "k5"),
        ("a3_a2.5_v30", {INCIDENCE: 2.5, SPEED: 30.0}, "a3"),
    ],
)
def test_names_as_files_have_them(name: str, values: dict[Axis, float], resolution: str) -> None:
    assert Point.named(name) == Point.at(values, resolution)
    assert Point.at(dict(reversed(values.items())), resolution).name == name


@pytest.mark.parametrize(
    "name",
    ["", "k", "7", "sweep", "round1", "k6/../k7", "K6", "k6_k7", "coarse_k6", "k6_", "k6.", "_a5"],
)
def test_other_names_are_no_cases(name: str) -> None:
    with pytest.raises(ValueError, match="no name of a case"):
        Point.named(name)
    assert not re.fullmatch(SWEEP_PATTERN, name)
    assert not re.fullmatch(RIGID_PATTERN, name)


def test_letters_and_names_of_axes_are_their_own() -> None:
    for one, other in itertools.combinations(AXES, 2):
        assert one.letter != other.letter
        assert one.name != other.name


@given(st.lists(points, max_size=6))
def test_axes_of_a_study_are_those_of_its_points(those: list[Point]) -> None:
    axes = axes_of(those)
    assert list(axes) == [axis for axis in AXES if axis in axes]
    assert set(axes) == ({axis for point in those for axis in point.axes} or {K_STAR})


def test_cases_sort_by_resolution_and_then_by_value() -> None:
    names = ["k10", "k6.44", "b_a10", "a_a2.5", "a_a-5", "b_a2"]
    ordered = sorted(names, key=lambda name: Point.named(name).order)
    assert ordered == ["k6.44", "k10", "a_a-5", "a_a2.5", "b_a2", "b_a10"]


def test_stable_side_is_that_of_high_k_star_and_of_low_speed() -> None:
    assert K_STAR.stability(7.0) > K_STAR.stability(6.0)
    assert SPEED.stability(20.0) > SPEED.stability(30.0)
    assert onset_axis((INCIDENCE, SPEED)) is SPEED
    with pytest.raises(ValueError, match="no onset over incidence_deg"):
        onset_axis((INCIDENCE,))


def test_heading_and_label_have_the_unit() -> None:
    assert (K_STAR.heading, SPEED.heading) == ("k*", "V (m/s)")
    assert (K_STAR.label, SPEED.label) == ("$k^*$", "$V$ (m/s)")
    assert SPEED.typeset(30.0) == "$V$ = 30 m/s"


def test_a_point_takes_the_place_of_incidence_and_speed_alone() -> None:
    config = load_config({"sweep": {"k_star": [4, 21]}})
    there = Point.at({INCIDENCE: 5.0, SPEED: 30.0}).of_config(config)
    assert (there.flow.incidence_deg, there.flow.speed) == (5.0, 30.0)
    assert there.flow.density == config.flow.density
    assert there.model_copy(update={"flow": config.flow}) == config
    assert Point.at({K_STAR: 5.0}).of_config(config) == config
    assert [point.name for point in sweep_points(config)] == ["k4", "k21"]
