"""Course of a run whose onset is learnt: what is run next, and when runs contradict."""

import json
import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from equisection.analysis.learning import Course, Lessons
from equisection.analysis.reduced_model import PredictedOnset
from equisection.config import load_config
from equisection.errors import ConfigError
from equisection.study import plan
from equisection.study.axes import K_STAR, Point


def config_of(**sweep):
    given = {"onset": "model", "models": ["2d", "2d-corrected"], "k_star": [4.0, 9.0, 16.0]}
    return load_config({"sweep": {**given, **sweep}})


def index_of(folder: Path, name: str, regimes: dict[str, str]) -> Path:
    """Write an index of results with some regimes."""
    path = folder / name / "round2.json"
    path.parent.mkdir(exist_ok=True)
    results = {
        case: {"regime": regime, "twist_amplitude_deg": 1.0} for case, regime in regimes.items()
    }
    path.write_text(json.dumps({"schema_version": 1, "results": results}))
    return path


def table() -> pd.DataFrame:
    k_star = np.linspace(4.0, 16.0, 25)
    rate = 0.004 * (8.0 - k_star)
    return pd.DataFrame(
        {
            "k_star": k_star,
            "growth_rate": rate,
            "growth_low": rate - 0.002,
            "growth_high": rate + 0.002,
        }
    )


def course(**changes) -> Course:
    given = {
        "model": None,
        "table": table(),
        "onset": PredictedOnset(8.0, 7.5, 8.5),
        "checked": 0,
        "contradicted": False,
        "at_odds": "",
    }
    return Course(**{**given, **changes})


def test_first_release_is_the_middle_of_the_sweep_or_as_given():
    assert plan.sweep_cases(config_of(), "2d") == ["k8"]
    config = load_config(
        {"sweep": {"onset": "model", "models": ["2d"]}, "rom": {"learn_from": [6.44, 8.0]}}
    )
    assert plan.sweep_cases(config, "2d") == ["k6.44"]


def test_all_sections_are_learnt_from_the_uncorrected_one():
    config = config_of(models=["2d-corrected", "2d", "2d-paper"])
    assert {plan.learner(config, name) for name in config.sweep.models} == {"2d"}
    assert plan.sweep_cases(config, "2d-corrected") == []
    alone = config_of(models=["2d-corrected"])
    assert plan.learner(alone, "2d-corrected") == "2d-corrected"


def test_beam_is_learnt_from_its_own_release():
    config = config_of(models=["2d", "2d-corrected", "3d"])
    assert [plan.learner(config, name) for name in config.sweep.models] == ["2d", "2d", "3d"]
    assert plan.sweep_cases(config, "3d") == ["k8"]


@pytest.mark.parametrize(
    ("rate", "released", "wanted"),
    [(-0.01, "k8", [4.0]), (0.01, "k8", [16.0]), (-0.01, "k4", [])],
)
def test_model_without_an_onset_in_reach_asks_for_the_end_of_the_sweep(
    tmp_path, rate, released, wanted
):
    lessons = Lessons(config_of(), "2d", {}, [index_of(tmp_path, "2d", {released: "settled"})])
    found = lessons._towards_onset(table().assign(growth_rate=rate))
    assert [point[K_STAR] for point in found] == wanted
    assert lessons._towards_onset(table()) == []


def test_runs_that_confirm_are_at_both_ends_of_the_interval():
    lessons = Lessons(config_of(), "2d-corrected", {}, [])
    assert [point[K_STAR] for point in lessons.confirming_points(course())] == [7.5, 8.5]
    unknown = course(onset=PredictedOnset(8.0, math.nan, 8.5))
    assert lessons.confirming_points(unknown) == []


def test_run_on_the_wrong_side_contradicts_and_one_in_the_interval_does_not(tmp_path):
    lessons, onset = Lessons(config_of(), "2d", {}, []), PredictedOnset(8.0, 7.5, 8.5)
    right = index_of(tmp_path, "2d", {"k7.5": "growing", "k8.5": "settled", "k8": "growing"})
    assert lessons.contradiction(onset, right) is None
    # at the very end of the interval, on its wrong side
    for case, regime in (("k7.5", "settled"), ("k8.5", "growing")):
        found = lessons.contradiction(onset, index_of(tmp_path, "2d", {case: regime}))
        assert found is not None
        assert found.point == Point.named(case)
    nearest = index_of(tmp_path, "2d", {"k6": "settled", "k9": "growing", "k12": "growing"})
    found = lessons.contradiction(onset, nearest)
    assert found is not None
    assert found.point == Point.named("k9")
    failed = index_of(tmp_path, "2d", {"k12": "failed"})
    assert lessons.contradiction(onset, failed) is None


def test_words_never_pass_a_model_for_runs():
    assert course().confirmation == "not confirmed by runs"
    assert course(checked=2).confirmation == "not contradicted by 2 runs"
    assert "k9" in course(checked=2, at_odds="k9").confirmation


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"rom": {"learn_from": [5.0, 6.0, 7.0]}}, "rom.learn_from"),
        ({"rom": {"confirm": 3}}, "rom.confirm"),
        (
            {
                "sweep": {"onset": "model", "models": ["3d"]},
                "steady": {"beam_polar": "config/polars/paper_plate_3d.csv"},
            },
            "steady.beam_polar",
        ),
        (
            {"sweep": {"onset": "model", "models": ["3d"]}, "beam": {"elastic_axis": 0.4}},
            "beam.elastic_axis",
        ),
        (
            {"sweep": {"onset": "model", "models": ["2d-corrected"]}, "beam": {"mass_axis": 0.6}},
            "sweep.models",
        ),
        ({"sweep": {"onset": "model", "models": ["2d"]}, "compute": False}, "sweep.onset"),
    ],
)
def test_what_cannot_be_learnt_is_refused(changes, message):
    with pytest.raises(ConfigError, match=message):
        load_config(changes)
