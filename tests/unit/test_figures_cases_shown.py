"""The cases A to F of Figs. 16 and 17."""

from __future__ import annotations

import math
from pathlib import Path

import pandas as pd
import pytest

from equisection.analysis.onset import onset_table
from equisection.errors import ResultFileError
from equisection.figures.cases_shown import cases_shown, result_at, results_of
from equisection.figures.models_shown import beam_model, section_model


def tables(*runs: tuple[float, str, float]) -> tuple[pd.DataFrame, pd.DataFrame]:
    summary = pd.DataFrame(runs, columns=["k_star", "regime", "twist_amplitude_deg"]).assign(
        model="2d", mean_twist_deg=1.0, mean_deflection_chords=0.5
    )
    return summary, onset_table(summary)


def chosen(*runs: tuple[float, str, float]) -> list[float]:
    return [case.value for case in cases_shown(*tables(*runs), "2d", "ABC")]


def test_either_side_of_the_onset_and_the_stiffest():
    runs = [(4, "growing", 6), (5, "growing", 6), (6, "limit-cycle", 0.2), (9, "settled", 0.1)]
    assert chosen(*runs) == [5.0, 6.0, 9.0]


def test_a_large_limit_cycle_is_inside_the_instability():
    runs = [(4, "growing", 6), (5, "limit-cycle", 2.0), (6, "settled", 0.1)]
    assert chosen(*runs) == [5.0, 6.0, 6.0]


def test_the_stiffest_that_did_not_fail():
    assert chosen((4, "growing", 6), (6, "settled", 0.1), (9, "failed", math.nan))[2] == 6.0


@pytest.mark.parametrize(
    ("runs", "missing"),
    [
        ([(4, "settled", 0.1)], {"A": "no run is unstable"}),
        ([(4, "growing", 6)], {"B": "no run above the onset is stable"}),
        ([(4, "failed", math.nan)], dict.fromkeys("ABC", "every run failed")),
    ],
)
def test_a_missing_case_says_why(runs, missing):
    cases = cases_shown(*tables(*runs), "2d", "ABC")
    assert {case.letter: case.regime for case in cases if not case.exists} == missing


def test_a_model_without_runs_has_no_cases():
    cases = cases_shown(*tables((4, "settled", 0.1)), "3d", "DEF")
    assert not any(case.exists for case in cases)


def test_results_are_found_by_model_and_k_star():
    paths = [Path("unsteady/2d/k6.44.nc"), Path("unsteady/3d/k6.44.nc"), Path("unsteady/2d/k7.nc")]
    files = results_of(paths, "2d")
    assert result_at(files, 6.4400001) == paths[0]
    with pytest.raises(ResultFileError, match=r"no result for k\* = 9"):
        result_at(files, 9.0)


@pytest.mark.parametrize(
    ("models", "section", "beam"),
    [
        (["2d", "2d-corrected", "3d"], "2d-corrected", "3d"),
        (["2d-paper", "2d"], "2d", None),
        (["2d-corrected-paper"], "2d-corrected-paper", None),
        (["3d"], None, "3d"),
    ],
)
def test_models_of_the_histories(models, section, beam):
    assert section_model(models) == section
    assert beam_model(models) == beam
