import io
import math

import pandas as pd
import pytest

from equisection.analysis.linear_theory import ONSET_COLUMNS, with_linear_theory
from equisection.analysis.onset import (
    COLUMNS,
    onset_bracket,
    onset_table,
    refinement_points,
    with_speeds,
)
from equisection.analysis.summary import COLUMNS as SUMMARY_COLUMNS
from equisection.analysis.summary import summarise

S, L, G, F = "settled", "limit-cycle", "growing", "failed"


def sides(bracket):
    return bracket.k_unstable, bracket.k_stable


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
    assert tuple(table.columns) == (*COLUMNS, *ONSET_COLUMNS)
    assert table.empty


def test_speeds_of_the_bracket_have_its_dynamic_pressures():
    """k* = 8 at 20 m/s is 2 at 40 m/s: a quarter of the k*, four times the dynamic pressure."""
    rows = [("2d", {"k_star": k, "regime": r}) for k, r in ((2.0, G), (4.5, S), (6.0, S))]
    rows += [("3d", {"k_star": 2.0, "regime": S})]
    known = dict.fromkeys(SUMMARY_COLUMNS, math.nan) | {"mean_known": 1}
    table = onset_table(summarise((model, known | found) for model, found in rows))
    section, beam = with_speeds(table, 8.0, 20.0).to_dict("records")
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


def test_undecided_runs_are_refused():
    with pytest.raises(ValueError, match="undecided"):
        onset_bracket([5], ["undecided"])


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
    assert bracket.k_unstable < 5.5432 < bracket.k_stable
    assert bracket.relative_width <= 0.01
