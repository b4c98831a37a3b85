"""Known errors of an onset: in the tables, in words, and unknown where nobody knows them."""

from __future__ import annotations

import math
from dataclasses import replace

import pandas as pd
import pytest
from tests.benchmarks.beam_growth import DEFAULT, SAME_CELLS, errors_of, growth_of_plate
from tests.workflow.project import ROOT

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import IDENTIFIED_LAGS, SeparationLags
from equisection.analysis.known_growth_error import (
    COLUMNS,
    in_words,
    known_errors_of,
    with_known_errors,
)
from equisection.solvers.embedded.adapter import Adapter
from equisection.solvers.embedded.known_errors import known_error, known_errors
from equisection.solvers.known_error import EIGENVALUE, TIME, KnownError

LATE = KnownError("3d", "mine", TIME, "a plate in CFD", 6, 2, -0.01, 0.013)


PLATE = Polar.read(ROOT / f"config/polars/{DEFAULT}.csv")


def adapter(polar: Polar = PLATE, lags: SeparationLags = IDENTIFIED_LAGS) -> Adapter:
    return Adapter(polar, 12, lags, 0.75)


@pytest.mark.parametrize("label", [DEFAULT, SAME_CELLS])
def test_kept_table_is_that_of_the_kept_releases(label: str) -> None:
    growth = growth_of_plate(label)
    kept = [each for each in known_errors() if (each.dimension, each.polar) == ("3d", label)]
    for here, there in zip(errors_of(growth, "3d", label, kept[0].against), kept, strict=True):
        assert here.basis == there.basis
        assert here.wrong_side == there.wrong_side
        assert here.mean == pytest.approx(there.mean, abs=2e-4)
        assert here.rms == pytest.approx(there.rms, abs=2e-4)


def test_default_run_errs_to_the_unsafe_side_and_says_so() -> None:
    error = known_error("3d", TIME, DEFAULT)
    assert error is not None
    assert error.errs == "unsafe"
    assert "too low" in str(error)
    assert "errs to the unsafe side" in str(error)


@pytest.mark.parametrize(
    ("mean", "errs"), [(-0.01, "unsafe"), (0.01, "safe"), (-0.006, "either"), (0.001, "either")]
)
def test_side_is_told_where_the_mean_stands_out_of_the_scatter(mean: float, errs: str) -> None:
    assert replace(LATE, mean=mean).errs == errs


def test_of_another_polar_or_other_lags_nothing_is_known() -> None:
    assert adapter().known_error("3d", TIME) is not None
    assert adapter(Polar.flat_plate(0.5)).known_error("3d", TIME) is None
    assert adapter(lags=SeparationLags.none()).known_error("3d", TIME) is None


def test_table_has_the_error_of_each_row_by_model_and_basis() -> None:
    table = pd.DataFrame({"model": ["2d", "3d", "3d"], "basis": [EIGENVALUE, TIME, "cfd"]})
    found = with_known_errors(table, {("3d", TIME): LATE}, list(table["basis"]))
    assert list(found.columns) == ["model", "basis", *COLUMNS]
    assert found["errs"].tolist() == ["unknown", "unsafe", "unknown"]
    assert found["growth_error"].tolist()[1] == -0.01
    assert math.isnan(found["growth_error"][0])
    assert in_words({("3d", TIME): LATE})[0].startswith("3d (time): growth 0.0100 V/c too low")


def test_runs_of_another_solver_have_no_error_of_this_one() -> None:
    summary = pd.DataFrame({"model": ["2d", "3d"], "solver": ["embedded", "openfoam"]})
    found = known_errors_of(adapter(), {"2d": "2d", "3d": "3d"}, summary)
    assert set(found) == {("2d", TIME), ("2d", EIGENVALUE), ("3d", EIGENVALUE)}


def test_empty_table_keeps_its_columns() -> None:
    found = with_known_errors(pd.DataFrame({"model": []}), {})
    assert list(found.columns) == ["model", *COLUMNS]
