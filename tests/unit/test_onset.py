import io
import math

import numpy as np
import pandas as pd
import pytest

from equisection.analysis.growth_onset import zero_of_line
from equisection.analysis.linear_theory import ONSET_COLUMNS, with_linear_theory
from equisection.analysis.onset import (
    next_points,
    onset_bracket,
    onset_table,
    points_beyond,
    refinement_points,
    with_speeds,
)
from equisection.analysis.summary import columns, summarise, with_both
from equisection.study.axes import INCIDENCE, K_STAR, SPEED, AsGiven, Axis

S, L, G, F = "settled", "limit-cycle", "growing", "failed"


def sides(bracket):
    return bracket.unstable, bracket.stable


def test_monotone_sweep_in_any_order():
    bracket = onset_bracket([21, 5, 6, 5.5, 10], [S, G, S, L, S])
    assert sides(bracket) == (5.5, 6)
    assert bracket.closed
    assert bracket.relative_width == pytest.approx(0.5 / 5.5)


@pytest.mark.parametrize(("regimes", "known"), [([S, S], (math.nan, 5)), ([G, L], (6, math.nan))])
def test_open_brackets(regimes, known):
    bracket = onset_bracket([5, 6], regimes)
    assert sides(bracket) == pytest.approx(known, nan_ok=True)
    assert not bracket.closed
    assert refinement_points(bracket, 0.01, 3) == []


def test_no_runs():
    assert not onset_bracket([], []).closed


def test_table_of_no_runs_has_its_columns_and_no_lines():
    summary = pd.read_csv(io.StringIO(summarise([]).to_csv(index=False)))
    table = with_linear_theory(onset_table(summary), {}, "consistent")
    assert tuple(table.columns) == (
        *("model", "k_star_stable", "k_star_unstable", "failed_inside", "stable_below"),
        *("undecided_inside", "in_doubt", "k_star_growth", "k_star_growth_low"),
        *("k_star_growth_high", "growth_runs"),
        *ONSET_COLUMNS,
    )
    assert table.empty


def test_speeds_of_the_bracket_have_its_dynamic_pressures():
    """k* = 8 at 20 m/s is 2 at 40 m/s: a quarter of the k*, four times the dynamic pressure."""
    rows = [("2d", {"k_star": k, "regime": r}) for k, r in ((2.0, G), (4.5, S), (6.0, S))]
    rows += [("3d", {"k_star": 2.0, "regime": S})]
    known = dict.fromkeys(columns(), math.nan) | {"mean_known": 1}
    table = onset_table(summarise((model, known | found) for model, found in rows))
    section, beam = with_speeds(table, AsGiven(8.0, 20.0)).to_dict("records")
    assert section["k_star_given"] == 8.0
    assert section["speed_unstable"] == pytest.approx(40.0)
    assert section["speed_stable"] == pytest.approx(20.0 * 4 / 3)
    assert beam["speed_stable"] == pytest.approx(40.0)
    assert math.isnan(beam["speed_unstable"])


def test_islands_of_stability_do_not_count():
    bracket = onset_bracket([3, 4, 5, 6, 7], [G, S, G, S, S])
    assert sides(bracket) == (5, 6)
    assert bracket.islands == (4,)


def test_failed_runs_are_left_out_and_named_inside_the_bracket():
    bracket = onset_bracket([4, 5, 6, 7, 8], [F, G, F, S, F])
    assert sides(bracket) == (5, 7)
    assert bracket.failed == (6,)


def test_a_failed_run_that_was_repeated_is_forgotten():
    assert onset_bracket([5, 6, 6, 7], [G, F, S, S]).failed == ()


def test_small_limit_cycles_are_stable():
    bracket = onset_bracket([4, 5, 6], [L, L, S], [3.0, 0.2, 0.0], threshold_deg=0.5)
    assert sides(bracket) == (4, 5)
    assert sides(onset_bracket([4, 5], [L, S], [math.nan, 0.0])) == (4, 5)


def test_contradiction_counts_as_unstable():
    assert sides(onset_bracket([5, 5, 6], [S, G, S])) == (5, 6)


def test_regime_that_is_none_is_refused():
    with pytest.raises(ValueError, match="'asleep' is not known; allowed are 'settled'"):
        onset_bracket([5], ["asleep"])


def test_undecided_run_is_on_no_side_and_named_inside_the_bracket():
    regimes = [G, "undecided", "undecided", "decaying", "undecided"]
    bracket = onset_bracket([5, 5.5, 6, 7, 8], regimes)
    assert sides(bracket) == (5, 7)
    assert bracket.undecided == (5.5, 6)
    assert bracket.failed == ()
    # the middle has been run and said nothing: around it, at another division
    assert refinement_points(bracket, 0.01) not in ([], [5.5], [6.0])
    assert not onset_bracket([5], ["undecided"]).closed


def swept(k_star, rates, errors, regimes):
    """Summary of one model; the intervals are two standard errors."""
    known = dict.fromkeys(columns(), math.nan) | {"mean_known": 1}
    return summarise(
        ("2d", known | {
            "k_star": k, "regime": regime, "growth_rate": rate, "growth_standard_error": error,
            "growth_low": rate - 2 * error, "growth_high": rate + 2 * error,
        })
        for k, rate, error, regime in zip(k_star, rates, errors, regimes, strict=True)
    )  # fmt: skip


def test_onset_by_growth_is_where_the_line_is_zero_and_its_interval_holds_it():
    """Rates on a line in ln k* with normal errors: 95 % of the intervals hold the zero."""
    k_star = np.array([5.0, 6.0, 7.5, 9.0, 11.0])
    true, error = 0.05 * np.log(7.0 / k_star), np.full(5, 0.001)
    onset = zero_of_line(k_star, true, error)
    assert onset.value == pytest.approx(7.0)
    assert onset.low < 7.0 < onset.high
    # a small error goes through as delta sigma over the slope
    half = 0.001 * 1.96 / 0.05 * 7.0 / math.sqrt(5)
    assert onset.high - onset.low == pytest.approx(2 * half, rel=0.05)
    random = np.random.default_rng(3)
    held = [
        found.low <= 7.0 <= found.high
        for found in (
            zero_of_line(k_star, true + error * random.standard_normal(5), error)
            for _ in range(200)
        )
    ]
    assert 0.91 < np.mean(held) <= 1.0
    level = zero_of_line(k_star[:2], np.array([0.0001, -0.0001]), error[:2])
    assert math.isnan(level.low)


def test_zero_of_a_line_that_is_nearly_level_is_far_away_and_no_error():
    """At equal rates of one sign there is no zero, and the interval has no ends."""
    k_star, error = np.array([5.0, 10.0]), np.full(2, 1e-6)
    for slope in (0.0, 1e-9, -1e-9, 1.4e-6 * 1.9600001):
        found = zero_of_line(k_star, np.array([-0.01, -0.01 + slope]), error)
        assert not 1.0 < found.value < 50.0
        assert not np.isinf([found.low, found.high]).any()


def test_onset_by_growth_is_between_the_runs_on_both_sides_of_it():
    """Growth that dips again beyond the onset: the line through four runs is nearly level."""
    summary = swept(
        (5.0, 6.0, 8.0, 10.0),
        (-0.0101, 0.0001, -0.01, -0.01),
        (0.004, 0.002, 0.006, 0.006),
        (S, "undecided", S, S),
    )
    row = onset_table(summary).iloc[0]
    assert 6.0 < row["k_star_growth"] < 8.0
    assert row["growth_runs"] == 2


def test_onset_table_tells_what_the_growth_of_its_runs_does():
    summary = swept(
        (5.0, 6.0, 8.0, 10.0, 14.0),
        (0.020, 0.010, 0.0002, -0.008, -0.020),
        (0.001, 0.001, 0.0010, 0.0010, 0.001),
        (G, G, "undecided", "decaying", S),
    )
    row = onset_table(summary).iloc[0]
    assert (row["k_star_unstable"], row["k_star_stable"]) == (6, 10)
    assert row["undecided_inside"] == "8"
    assert row["in_doubt"] == ""
    assert row["k_star_growth_low"] < row["k_star_growth"] < row["k_star_growth_high"]
    assert 7.5 < row["k_star_growth"] < 8.5
    assert row["growth_runs"] == 4
    # a growth that the error does not tell from none, on the unstable side
    doubtful = swept((6.0, 10.0), (0.001, -0.01), (0.001, 0.001), (L, S))
    assert onset_table(doubtful).iloc[0]["in_doubt"] == "6"
    # all stable: nothing to draw a line through
    stable = onset_table(swept((6.0, 10.0), (-0.01, -0.02), (0.001, 0.001), (S, S))).iloc[0]
    assert math.isnan(stable["k_star_growth"])
    # results from before there were errors
    before = onset_table(summary.drop(columns=["growth_low", "growth_high"])).iloc[0]
    assert math.isnan(before["k_star_growth"])
    assert before["in_doubt"] == ""


def test_refinement_divides_the_bracket():
    bracket = onset_bracket([5, 6], [G, S])
    assert refinement_points(bracket, 0.01) == [5.5]
    assert refinement_points(bracket, 0.01, 3) == [5.25, 5.5, 5.75]
    assert refinement_points(bracket, 0.3, 3) == []


def test_refinement_names_cases_by_four_digits_and_ends():
    bracket = onset_bracket([5.0, 5.001], [G, S])
    assert refinement_points(bracket, 1e-9, 4) == []
    points = refinement_points(onset_bracket([5, 6], [G, S]), 0.01, 2)
    assert points == [5.333, 5.667]


def test_refinement_goes_around_failed_runs():
    bracket = onset_bracket([5, 5.5, 6], [G, F, S])
    assert refinement_points(bracket, 0.01) in ([5.333], [5.667])


def test_repeated_refinement_converges():
    k_star, regimes = [1.0, 21.0], [G, S]
    for _ in range(20):
        points = refinement_points(onset_bracket(k_star, regimes), 0.01, 2)
        if not points:
            break
        k_star += points
        regimes += [G if k < 5.5432 else S for k in points]
    bracket = onset_bracket(k_star, regimes)
    assert bracket.unstable < 5.5432 < bracket.stable
    assert bracket.relative_width <= 0.01


def summary_over(axes: tuple[Axis, ...], *runs: tuple[float | str, ...]) -> pd.DataFrame:
    """Return the summary of runs of one model: values on the axes, then the regime."""
    known = dict.fromkeys(columns(axes), math.nan) | {"mean_known": 1}
    names = [*(axis.name for axis in axes), "regime"]
    return summarise((("2d", known | dict(zip(names, run, strict=True))) for run in runs), axes)


K_STARS, REGIMES = (3.0, 4.0, 5.0, 6.0, 7.0, 8.0), (S, G, G, F, S, S)


def speed_of(k_star: float) -> float:
    """Return the speed (m/s) at which a beam with k* = 8 at 20 m/s has a k*."""
    return 20.0 * math.sqrt(8.0 / k_star)


def test_bracket_over_speed_is_that_over_k_star_seen_from_the_other_side():
    over_k_star = summary_over((K_STAR,), *zip(K_STARS, REGIMES, strict=True))
    speeds = [round(speed_of(k_star), 6) for k_star in K_STARS]
    over_speed = summary_over((SPEED,), *zip(speeds, REGIMES, strict=True))
    (mine,) = with_speeds(onset_table(over_k_star), AsGiven(8.0, 20.0)).to_dict("records")
    (other,) = with_speeds(onset_table(over_speed), AsGiven(8.0, 20.0)).to_dict("records")
    for side in ("speed_stable", "speed_unstable", "k_star_stable", "k_star_unstable"):
        assert other[side] == pytest.approx(mine[side], rel=1e-6)
    assert float(other["failed_inside"]) == pytest.approx(speed_of(6.0), rel=1e-5)
    assert float(other["stable_below"]) == pytest.approx(speed_of(3.0), rel=1e-5)
    assert other["speed_stable"] < other["speed_unstable"]


def test_each_incidence_has_a_bracket_and_points_of_its_own():
    axes = (INCIDENCE, K_STAR)
    runs = [(2.5, 5.0, G), (2.5, 6.0, S), (5.0, 5.0, G), (5.0, 6.0, G), (5.0, 8.0, S)]
    summary = summary_over(axes, *runs)
    table = onset_table(summary)
    assert list(table.columns[:4]) == [
        "model",
        "incidence_deg",
        "k_star_stable",
        "k_star_unstable",
    ]
    brackets = table[["incidence_deg", "k_star_unstable", "k_star_stable"]].to_numpy().tolist()
    assert brackets == [[2.5, 5.0, 6.0], [5.0, 6.0, 8.0]]
    assert [point.name for point in next_points(summary, 0.01, 1)] == ["a2.5_k5.5", "a5_k7"]


class TestBeyondTheEnds:
    """Values beyond a sweep that is stable, or unstable, throughout."""

    def test_a_stable_sweep_is_followed_to_lower_k_star_and_to_higher_speeds(self):
        stable = onset_bracket([5, 6], [S, S])
        found = points_beyond(stable, [5, 6], (5, 6), 2.0, 3)
        assert found == pytest.approx([5 / 1.26**3, 5 / 1.26**2, 5 / 1.26], rel=5e-4)
        fast = onset_bracket([10, 12], [S, S], axis=SPEED)
        found = points_beyond(fast, [10, 12], (10, 12), 2.0, 3, axis=SPEED)
        assert found == [15.12, 19.05, 24.0]

    def test_an_unstable_sweep_is_followed_the_other_way(self):
        unstable = onset_bracket([5, 6], [G, G])
        assert points_beyond(unstable, [5, 6], (5, 6), 2.0, 1) == [7.56]

    def test_it_ends_at_the_reach_and_at_the_highest_speed(self):
        stable = onset_bracket([2.5, 5, 6], [S, S, S])
        assert points_beyond(stable, [2.5, 5, 6], (5, 6), 2.0, 3) == []
        fast = onset_bracket([10, 12], [S, S], axis=SPEED)
        found = points_beyond(fast, [10, 12], (10, 12), 2.0, 3, axis=SPEED, highest=16.0)
        assert found == [15.12]

    @pytest.mark.parametrize("regimes", [[F, F], [G, S]])
    def test_nothing_to_follow(self, regimes):
        assert points_beyond(onset_bracket([5, 6], regimes), [5, 6], (5, 6), 2.0, 3) == []


def test_summary_over_speed_has_k_star_beside_and_stays_a_study_of_speed():
    rows = [
        ("2d", {"speed": v, "k_star": math.nan, "regime": r}) for v, r in ((20.0, S), (40.0, G))
    ]
    known = dict.fromkeys(columns((SPEED,)), math.nan) | {"mean_known": 1}
    summary = with_both(summarise(((m, known | f) for m, f in rows), (SPEED,)), AsGiven(8.0, 20.0))
    assert summary["k_star"].tolist() == pytest.approx([8.0, 2.0])  # a quarter at twice the speed
    assert list(summary.columns)[1] == "speed"
    table = onset_table(summary)
    assert table[["speed_stable", "speed_unstable"]].values.tolist() == [[20.0, 40.0]]


def test_summary_over_k_star_has_the_speed_beside():
    rows = [("2d", {"k_star": k, "regime": r}) for k, r in ((2.0, G), (8.0, S))]
    known = dict.fromkeys(columns(), math.nan) | {"mean_known": 1}
    summary = with_both(summarise((m, known | f) for m, f in rows), AsGiven(8.0, 20.0))
    assert summary["speed"].tolist() == pytest.approx([40.0, 20.0])
    assert onset_table(summary)["k_star_stable"].tolist() == [8.0]
