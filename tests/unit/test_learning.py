"""Course of a run whose onset is learnt: what is run next, and when runs contradict."""

import json
import math
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from equisection.analysis import learning
from equisection.analysis.learning import Lessons, points_of_round
from equisection.analysis.learnt_course import Course
from equisection.analysis.learnt_dataset import datasets_of, onsets_of
from equisection.analysis.reduced_model import PredictedOnset
from equisection.config import load_config
from equisection.errors import ConfigError, ResultFileError
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


def test_each_incidence_has_a_release_and_a_model_of_its_own():
    config = config_of(incidence_deg=[4.0, 2.5])
    assert plan.sweep_cases(config, "2d") == ["a2.5_k8", "a4_k8"]
    assert plan.learnt_names(config) == ["model_a2.5", "model_a4"]
    assert plan.learnt_names(config_of()) == ["model"]
    # one map, that of the models, whatever the solver
    assert plan.has_learnt_map(config)
    assert not plan.has_learnt_map(config_of())
    each = Lessons(config, "2d", {}, []).at_each_incidence()
    assert [one.incidence_deg for one in each] == [2.5, 4.0]
    assert each[1].point(7.0).name == "a4_k7"


def test_run_at_another_incidence_contradicts_nothing(tmp_path):
    index = index_of(tmp_path, "2d", {"a2.5_k9": "growing", "a4_k9": "settled"})
    each = Lessons(config_of(incidence_deg=[2.5, 4.0]), "2d", {}, []).at_each_incidence()
    onset = PredictedOnset(8.0, 7.5, 8.5)
    found = [one.contradiction(onset, index) for one in each]
    assert found[0] is not None
    assert found[0].point.name == "a2.5_k9"
    assert found[1] is None


def test_incidence_without_a_release_is_named_and_the_others_go_on(tmp_path, caplog):
    (tmp_path / "1").mkdir()
    one = index_of(tmp_path / "1", "2d", {"a2.5_k8": "failed", "a4_k8": "failed"})
    lessons = Lessons(config_of(incidence_deg=[2.5, 4.0]), "2d", {}, [one])
    assert points_of_round(lessons, "round2") == []
    assert caplog.text.count("the release to learn from failed") == 2
    refused = datasets_of(lessons)
    assert [data.attrs["incidence_deg"] for data in refused] == [2.5, 4.0]
    onsets = onsets_of(refused, over_incidence=True)
    assert onsets["learnt"].str.startswith("no model: ").all()
    assert onsets["k_star_learnt"].isna().all()
    with pytest.raises(ResultFileError, match="the release to learn from failed"):
        datasets_of(Lessons(config_of(), "2d", {}, [index_of(tmp_path, "2d", {"k8": "failed"})]))


def test_runs_that_confirm_may_be_given():
    config = load_config(
        {"sweep": {"onset": "model", "models": ["2d"]}, "rom": {"confirm": [7.5, 10.0]}}
    )
    lessons = Lessons(config, "2d", {}, [])
    unknown = course(onset=PredictedOnset(8.0, math.nan, 8.5))
    assert [point[K_STAR] for point in lessons.confirming_points(unknown)] == [7.5, 10.0]


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
    # what failed or is undecided confirms nothing
    assert course(silent=1).confirmation == "not confirmed by runs; 1 failed or undecided"
    assert course(checked=1, silent=1).confirmation.endswith("by 1 runs; 1 failed or undecided")


def test_limit_cycle_is_learnt_from_the_farthest_release_that_can_be(tmp_path, monkeypatch, caplog):
    """The one that grew farthest left before there was enough to learn from."""
    index = index_of(tmp_path, "2d", {"k4": "growing", "k6": "growing", "k9": "settled"})
    found = json.loads(index.read_text())
    found["results"]["k4"]["twist_amplitude_deg"] = 20.0
    index.write_text(json.dumps(found))
    monkeypatch.setattr(Lessons, "_history", lambda _, run: run.point.name)
    monkeypatch.setattr(Lessons, "_grid", ([], []))
    monkeypatch.setattr(Lessons, "polar", None)

    def cycles(_, history, *more):
        if history == "k4":
            raise ResultFileError("a record of 20 c/V is too short to learn from")
        return history, *more

    monkeypatch.setattr(learning, "cycles_of", cycles)
    config = config_of()
    start = config.unsteady.start.model_copy(update={"twist_deg": 1.0})
    unsteady = config.unsteady.model_copy(update={"start": start})
    config = config.model_copy(update={"unsteady": unsteady})
    history, _, of_start = Lessons(config, "2d", {}, [index]).limit_cycles()
    assert history == "k6"
    assert of_start == (math.radians(1.0), 0.0)
    assert "no limit cycle is learnt from k4: a record of 20 c/V" in caplog.text


def test_limit_cycle_of_a_beam_is_unknown(tmp_path, monkeypatch):
    """Its model has too few terms for large amplitudes, whatever release grew."""
    index = index_of(tmp_path, "3d", {"k4": "growing", "k9": "settled"})
    monkeypatch.setattr(Lessons, "_grid", ([4.0, 9.0], [None, None]))
    found = Lessons(config_of(), "3d", {}, [index]).limit_cycles()
    assert found.words == ""
    assert found.table["limit_cycle_deg"].isna().all()


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
            {"sweep": {"onset": "model", "models": ["2d-corrected"]}, "beam": {"mass_axis": 0.6}},
            "sweep.models",
        ),
        ({"rom": {"confirm": [8.0, 8.0]}}, "rom.confirm"),
    ],
)
def test_what_cannot_be_learnt_is_refused(changes, message):
    with pytest.raises(ConfigError, match=message):
        load_config(changes)
