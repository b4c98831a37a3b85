"""How far sections are from the beam: on tables whose deviations are known."""

import numpy as np
import pandas as pd
import pytest

from equisection.analysis.deviations import deviations, root_mean_square
from equisection.figures import section_and_beam

K_STAR = (5.0, 10.0)


def runs(model: str, **changes: object) -> pd.DataFrame:
    columns = {
        "model": model,
        "k_star": K_STAR,
        "regime": "settled",
        "mean_twist_deg": [0.8, 0.4],
        "mean_deflection_chords": [0.4, 0.2],
        "frequency_strouhal": [0.12, 0.18],
        "growth_rate": [0.01, -0.005],
        "solver": "made-up",
        "resolution": "coarse",
    }
    return pd.DataFrame({**columns, **changes})


def test_section_that_moves_as_the_beam_does_has_no_deviation() -> None:
    table = deviations(pd.concat([runs("2d"), runs("3d")]))
    assert list(table["model"]) == ["2d", "2d"]
    assert np.all(table[["twist", "deflection", "frequency", "growth"]] == 0.0)


def test_ratios_are_of_the_section_over_the_beam_and_growth_is_a_difference() -> None:
    section = runs("2d-corrected", mean_twist_deg=[1.0, 0.3], growth_rate=[0.03, -0.005])
    table = deviations(pd.concat([section, runs("3d")])).set_index("k_star")
    assert table["twist"].to_dict() == pytest.approx({5.0: 0.25, 10.0: -0.25})
    assert table["growth"].to_dict() == pytest.approx({5.0: 0.02, 10.0: 0.0})
    over_all = root_mean_square(table.reset_index()).loc["2d-corrected"]
    assert over_all["twist"] == pytest.approx(0.25)
    assert over_all["growth"] == pytest.approx(0.02 / np.sqrt(2))


def test_what_failed_or_was_run_on_one_side_only_is_left_out() -> None:
    beam = runs("3d", k_star=[5.0, 21.0])
    section = runs("2d", regime=["failed", "settled"])
    assert deviations(pd.concat([section, beam])).empty


def test_number_that_a_run_does_not_have_does_not_spoil_the_others() -> None:
    section = runs("2d", frequency_strouhal=[np.nan, 0.36])
    over_all = root_mean_square(deviations(pd.concat([section, runs("3d")])))
    assert over_all.loc["2d", "frequency"] == pytest.approx(1.0)
    assert over_all.loc["2d", "twist"] == 0.0


def test_section_that_failed_where_it_is_hardest_is_not_the_closer_for_it() -> None:
    twist = {"2d": [1.2, 0.408], "2d-paper": [1.2, 0.44]}  # +50 % at 5; +2 % and +10 % at 10
    regime = {"2d": "settled", "2d-paper": ["failed", "settled"]}
    sections = [runs(name, mean_twist_deg=twist[name], regime=regime[name]) for name in twist]
    over_all = root_mean_square(deviations(pd.concat([*sections, runs("3d")])))["twist"]
    assert over_all.to_dict() == pytest.approx({"2d": 0.02, "2d-paper": 0.1})


def test_section_without_a_number_at_any_k_star_takes_it_from_no_other() -> None:
    silent = runs("2d-paper", frequency_strouhal=np.nan)
    table = deviations(pd.concat([silent, runs("2d", frequency_strouhal=0.24), runs("3d")]))
    over_all = root_mean_square(table)["frequency"]
    assert np.isnan(over_all["2d-paper"])
    assert over_all["2d"] == pytest.approx(np.hypot(1.0, 1.0 / 3.0) / np.sqrt(2))


def test_means_that_are_nil_by_symmetry_have_no_ratio() -> None:
    """What is left of an oscillation about zero says nothing of a mean."""
    left = {"mean_twist_deg": [2e-4, -3e-4], "mean_deflection_chords": [1e-6, 8e-5]}
    growing = runs("2d", regime=["growing", "settled"], mean_twist_deg=[-0.9, 1e-4])
    summary = pd.concat([growing, runs("3d", **left)])
    table = deviations(summary)
    assert table[["twist", "deflection"]].isna().all(axis=None)
    assert np.all(table[["frequency", "growth"]] == 0.0)
    figure = section_and_beam.draw(table, summary)
    assert [axes.texts[0].get_text()[:9] for axes in figure.axes[:2]] == ["Means are"] * 2
    assert len(figure.legends[0].get_texts()) == 1
    inclined = pd.concat([runs("2d"), runs("3d")]).assign(incidence_deg=2.0)
    both = pd.concat([summary.assign(incidence_deg=0.0), inclined])
    table = deviations(both).set_index("incidence_deg")
    assert table.loc[0.0, "twist"].isna().all()
    assert np.all(table.loc[2.0, "twist"] == 0.0)


def test_beam_that_is_moved_a_little_has_its_means_compared() -> None:
    summary = pd.concat([runs("2d"), runs("3d", mean_twist_deg=[0.001, 0.006])])
    assert deviations(summary)["twist"].notna().all()


def test_figure_has_a_line_for_each_section_and_its_root_mean_square() -> None:
    summary = pd.concat([runs("2d", mean_twist_deg=[0.88, 0.44]), runs("2d-corrected"), runs("3d")])
    figure = section_and_beam.draw(deviations(summary), summary)
    twist = figure.axes[0]
    assert [tuple(line.get_ydata()) for line in twist.get_lines()[1:]] == [
        pytest.approx((10.0, 10.0)),
        pytest.approx((0.0, 0.0)),
    ]
    assert [text.get_text() for text in twist.texts] == ["0 %", "10 %"]
    assert len(figure.legends[0].get_texts()) == 2


def test_deviation_beyond_a_hundred_per_cent_is_no_power_of_ten() -> None:
    summary = pd.concat([runs("2d", mean_twist_deg=[1.704, 0.852]), runs("3d")])
    figure = section_and_beam.draw(deviations(summary), summary)
    assert [text.get_text() for text in figure.axes[0].texts] == ["110 %"]


def test_figure_without_a_common_k_star_says_so() -> None:
    summary = pd.concat([runs("2d"), runs("3d", k_star=[4.0, 21.0])])
    figure = section_and_beam.draw(deviations(summary), summary)
    assert "No section and beam" in figure.axes[0].texts[-1].get_text()
