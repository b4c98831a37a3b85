"""A job with a solver that is none of the project's: what the protocol alone must do."""

import logging
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
import xarray as xr
from tests.sample_cases import STEADY, UNSTEADY

from equisection.cases import Case, SolverBlock, SteadyCase, UnsteadyCase, case_hash
from equisection.errors import CaseFileError, SolverError
from equisection.results.netcdf import read_dataset
from equisection.results.steady_result import SteadyResult
from equisection.results.unsteady_result import VERDICT_ATTRIBUTES, UnsteadyResult
from equisection.solvers.protocol import Allocation, Capability, Progress, Solver
from equisection.solvers.registry import SOLVERS, SolverEntry, solver_from_case
from equisection.store.job import run_cases

NOTHING = np.empty(0)


class Adapter:
    """A solver whose lift is twice the incidence, and whose section never moves."""

    name = "stand-in"
    version = "7"
    provides = frozenset({Capability.BATCH})
    calls: list[list[float]]

    def __init__(self, factor: float) -> None:
        self._factor = factor

    @classmethod
    def from_settings(cls, settings: dict[str, Any], allocation: Allocation) -> "Adapter":
        return cls(settings["factor"])

    def settings(self, dimension: str) -> dict[str, Any]:
        return {"factor": self._factor}

    def describe(self, dimension: str) -> str:
        return f"stand-in with factor {self._factor:g}"

    def run_steady(
        self, cases: Sequence[SteadyCase], work: Path, progress: Progress
    ) -> list[SteadyResult]:
        type(self).calls.append([case.incidence_deg for case in cases])
        assert work.is_dir()
        progress(len(cases), len(cases))
        return [
            SteadyResult(
                0.1, self._factor * case.incidence_deg, 0.0, NOTHING, NOTHING, NOTHING, "stand-in"
            )
            for case in cases
        ]

    def run_unsteady(
        self, cases: Sequence[UnsteadyCase], work: Path, progress: Progress
    ) -> list[UnsteadyResult]:
        type(self).calls.append([case.k_star for case in cases])
        time = np.linspace(0.0, 1.0, 11)
        still = np.zeros(11)
        verdict: dict[str, str | float | int] = dict.fromkeys(VERDICT_ATTRIBUTES, 0.0)
        verdict |= {"regime": "settled", "reason": "it never moves"}
        return [
            UnsteadyResult(time, still, still, still, still, still, still, still, verdict)
            for _ in cases
        ]


def block(factor: float = 2.0, version: str = "7") -> SolverBlock:
    return SolverBlock(name="stand-in", version=version, settings={"factor": factor})


def steady(incidence_deg: float, factor: float = 2.0) -> SteadyCase:
    return STEADY.model_copy(update={"incidence_deg": incidence_deg, "solver": block(factor)})


def unsteady(k_star: float, refusal: str = "") -> UnsteadyCase:
    return UNSTEADY.model_copy(update={"k_star": k_star, "solver": block(), "refusal": refusal})


@pytest.fixture(autouse=True)
def solver(monkeypatch: pytest.MonkeyPatch) -> type[Adapter]:
    """Register the stand-in, as a third solver would be."""
    monkeypatch.setitem(sys.modules, "stand_in", SimpleNamespace(Adapter=Adapter))  # type: ignore[arg-type]
    monkeypatch.setitem(SOLVERS, "stand-in", SolverEntry("stand_in", Adapter.provides))
    monkeypatch.setattr(Adapter, "calls", [], raising=False)
    return Adapter


@pytest.fixture
def run(tmp_path: Path) -> Callable[..., dict[str, dict[str, Any]]]:
    def run(**cases: Case) -> dict[str, dict[str, Any]]:
        return run_cases(cases, tmp_path / "out", tmp_path / "store", tmp_path / "progress.json")

    return run


Run = Callable[..., dict[str, dict[str, Any]]]


def test_stand_in_fulfils_the_protocol() -> None:
    plugged: Solver = solver_from_case(block())
    assert plugged.settings("2d") == {"factor": 2.0}


def test_results_of_a_third_solver_come_with_case_and_provenance(run: Run, tmp_path: Path) -> None:
    attributes = run(low=steady(1.0), high=steady(5.0))
    for name, lift in (("low", 2.0), ("high", 10.0)):
        data = read_dataset(tmp_path / "out" / f"{name}.nc")
        assert float(data["cl"]) == lift
        assert data.attrs["solver"] == "stand-in"
        assert data.attrs["solver_version"] == "7"
        assert data.attrs["solver_description"] == "stand-in with factor 2"
        assert data.attrs["batch_cases"] == 2
        assert attributes[name]["case_hash"] == data.attrs["case_hash"]
    assert read_dataset(tmp_path / "out" / "low.nc").attrs["case_hash"] == case_hash(steady(1.0))


def test_case_in_the_store_is_not_run_again(run: Run, solver: type[Adapter]) -> None:
    run(low=steady(1.0))
    run(other_name=steady(1.0), high=steady(5.0))
    run(high=steady(5.0))
    assert solver.calls == [[1.0], [5.0]]


def test_failed_case_in_the_store_is_run_again(
    run: Run, solver: type[Adapter], monkeypatch: pytest.MonkeyPatch
) -> None:
    failed = SteadyResult(np.nan, np.nan, np.nan, NOTHING, NOTHING, NOTHING, "none", "it blew up")
    with monkeypatch.context() as patch:
        patch.setattr(Adapter, "run_steady", lambda self, cases, work, progress: [failed])
        assert run(low=steady(1.0))["low"]["failure"] == "it blew up"
    assert run(low=steady(1.0))["low"]["failure"] == ""
    assert solver.calls == [[1.0]]


def test_damaged_result_in_the_store_is_computed_again(
    run: Run, solver: type[Adapter], tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    run(low=steady(1.0))
    stored = tmp_path / "store" / case_hash(steady(1.0)) / "result.nc"
    stored.write_bytes(stored.read_bytes()[:500])
    run(low=steady(1.0))
    assert solver.calls == [[1.0], [1.0]]
    assert "result.nc: truncated or not NetCDF-4" in caplog.text


def test_equal_cases_are_computed_once_and_published_under_each_name(
    run: Run, solver: type[Adapter], tmp_path: Path
) -> None:
    run(a=steady(1.0), b=steady(1.0))
    assert solver.calls == [[1.0]]
    assert (tmp_path / "out" / "a.nc").read_bytes() == (tmp_path / "out" / "b.nc").read_bytes()


def test_cases_of_different_settings_are_run_with_their_own(
    run: Run, solver: type[Adapter], tmp_path: Path
) -> None:
    run(a=steady(1.0), b=steady(1.0, factor=3.0))
    assert solver.calls == [[1.0], [1.0]]
    assert float(read_dataset(tmp_path / "out" / "b.nc")["cl"]) == 3.0


def test_refused_case_fails_with_its_reason_and_the_others_run(
    run: Run, solver: type[Adapter], tmp_path: Path
) -> None:
    attributes = run(soft=unsteady(1.0, refusal="it diverges"), stiff=unsteady(9.0))
    assert solver.calls == [[9.0]]
    assert attributes["soft"]["regime"] == "failed"
    assert attributes["soft"]["reason"] == "it diverges"
    assert attributes["stiff"]["regime"] == "settled"
    assert read_dataset(tmp_path / "out" / "soft.nc").sizes["time"] == 0


def test_refused_cases_alone_need_no_solver(run: Run, solver: type[Adapter]) -> None:
    run(soft=unsteady(1.0, refusal="it diverges"))
    assert solver.calls == []


def test_no_case_is_no_work(run: Run, solver: type[Adapter]) -> None:
    assert run() == {}
    assert solver.calls == []


def test_result_that_is_missing_is_an_error_and_nothing_is_published(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Adapter, "run_steady", lambda self, cases, work, progress: [])
    with pytest.raises(SolverError, match="'stand-in' returned 0 results for 1 cases"):
        run(low=steady(1.0))
    assert not (tmp_path / "out").exists()


def test_solver_that_breaks_down_leaves_no_output_and_the_store_without_the_case(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def break_down(self: Adapter, *arguments: object) -> list[SteadyResult]:
        raise SolverError("no licence")

    monkeypatch.setattr(Adapter, "run_steady", break_down)
    with pytest.raises(SolverError, match="no licence"):
        run(low=steady(1.0))
    assert not (tmp_path / "out").exists()
    assert list((tmp_path / "store").rglob("result.nc")) == []
    monkeypatch.undo()


def test_value_that_is_not_finite_is_no_result(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    nan = SteadyResult(0.1, float("nan"), 0.0, NOTHING, NOTHING, NOTHING, "stand-in")
    monkeypatch.setattr(Adapter, "run_steady", lambda self, cases, work, progress: [nan])
    with pytest.raises(Exception, match="'cl' holds values that are not finite"):
        run(low=steady(1.0))
    assert not (tmp_path / "out").exists()


def test_steady_and_unsteady_cases_do_not_mix(run: Run) -> None:
    with pytest.raises(SolverError, match="one kind is allowed"):
        run(a=steady(1.0), b=unsteady(5.0))


def test_progress_file_is_gone_after_the_job(run: Run, tmp_path: Path) -> None:
    run(low=steady(1.0))
    assert not (tmp_path / "progress.json").exists()


def test_store_on_another_file_system_is_copied_from(
    run: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*paths: object) -> None:
        raise OSError("invalid cross-device link")

    monkeypatch.setattr("os.link", refuse)
    run(low=steady(1.0))
    xr.testing.assert_identical(
        read_dataset(tmp_path / "out" / "low.nc"),
        read_dataset(tmp_path / "store" / case_hash(steady(1.0)) / "result.nc"),
    )


def test_case_of_another_version_of_the_solver_says_what_to_do() -> None:
    with pytest.raises(CaseFileError, match=r"version 6 of solver 'stand-in', installed is 7; "):
        solver_from_case(block(version="6"))


def test_case_of_an_unknown_solver_names_those_that_are_known() -> None:
    with pytest.raises(CaseFileError, match="'other' is not known; allowed are embedded"):
        solver_from_case(SolverBlock(name="other", version="1", settings={}))


def test_first_words_of_the_log_say_how_much_is_to_be_computed(
    run: Run, caplog: pytest.LogCaptureFixture
) -> None:
    caplog.set_level(logging.INFO)
    run(low=steady(1.0))
    caplog.clear()
    run(low=steady(1.0), high=steady(5.0))
    assert "2 cases, 1 of them to be computed" in caplog.text
