"""Histories that are known: judged by other criteria, and gone on with, not computed again."""

import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from tests.sample_cases import UNSTEADY

from equisection.cases import SolverBlock, UnsteadyCase, case_hash, history_hash
from equisection.results.netcdf import read_dataset
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers.protocol import Allocation, Capability, Progress
from equisection.solvers.registry import SOLVERS, SolverEntry
from equisection.solvers.verdicts import LOOKS_EVERY, TipMotion, is_decided, judge
from equisection.store.job import run_cases
from equisection.store.kept import keep_results

PERIOD, DECAY, STEP = 6.0, -0.02, 0.1


class Adapter:
    """A solver of sections that die out at a known rate, looked at every 5 c/V."""

    name = "stand-in"
    version = "1"
    provides: frozenset[Capability] = frozenset()
    ran: list[tuple[Path, float]]

    @classmethod
    def from_settings(cls, settings: dict[str, Any], allocation: Allocation) -> "Adapter":
        del settings
        return cls()

    def describe(self, dimension: str) -> str:
        return "stand-in"

    def run_unsteady(
        self, cases: Sequence[UnsteadyCase], work: Path, progress: Progress
    ) -> list[UnsteadyResult]:
        del progress
        (case,) = cases
        end = LOOKS_EVERY
        while end < case.duration and not is_decided(case, motion(end)):
            end = min(end + LOOKS_EVERY, case.duration)
        type(self).ran.append((work, end))
        tip = motion(end)
        rest = np.zeros_like(tip.time)
        return [
            UnsteadyResult(
                time=tip.time,
                twist=tip.twist,
                deflection=tip.deflection,
                tip_twist=tip.twist,
                tip_deflection=tip.deflection,
                lift=rest,
                moment=rest,
                incidence=tip.twist,
                verdict=judge(case, tip),
            )
        ]


def motion(end: float) -> TipMotion:
    time = np.arange(round(end / STEP) + 1) * STEP
    twist = 0.01 * np.exp(DECAY * time) * np.cos(2 * np.pi * time / PERIOD)
    return TipMotion(time, twist, 0.3 + 2.0 * twist)


def case(duration: float = 300.0, **criteria: float) -> UnsteadyCase:
    return UNSTEADY.model_copy(
        update={
            "duration": duration,
            "time_step": STEP,
            "output_interval": STEP,
            "criteria": UNSTEADY.criteria.model_copy(update=criteria),
            "solver": SolverBlock(name="stand-in", version="1", settings={}),
        }
    )


@pytest.fixture(autouse=True)
def solver(monkeypatch: pytest.MonkeyPatch) -> type[Adapter]:
    monkeypatch.setitem(sys.modules, "stand_in", SimpleNamespace(Adapter=Adapter))  # type: ignore[arg-type]
    monkeypatch.setitem(SOLVERS, "stand-in", SolverEntry("stand_in", Adapter.provides))
    monkeypatch.setattr(Adapter, "ran", [], raising=False)
    return Adapter


Run = Callable[..., dict[str, Any]]


@pytest.fixture
def run(tmp_path: Path) -> Run:
    def run(wanted: UnsteadyCase, run: str = "run", **reuse: Path) -> dict[str, Any]:
        place = tmp_path / run
        progress = tmp_path / "progress.json"
        output = place / "unsteady" / "2d"
        return run_cases({"k": wanted}, output, place / "store", progress, **reuse)["k"]

    return run


def test_other_criteria_are_answered_by_the_history_that_is_there(
    run: Run, solver: type[Adapter], tmp_path: Path
) -> None:
    long = run(case(periods=9))
    short = run(case(periods=4))
    assert len(solver.ran) == 1
    assert short["end_time"] < long["end_time"]
    assert short["end_time"] % LOOKS_EVERY == pytest.approx(0.0, abs=1e-9)
    assert short["cpu_seconds"] == pytest.approx(
        long["cpu_seconds"] * short["end_time"] / long["end_time"]
    )
    published = read_dataset(tmp_path / "run/unsteady/2d/k.nc", case_hash(case(periods=4)))
    assert float(published["time"][-1]) == short["end_time"]
    # it is what a run of its own would have given
    alone = run(case(periods=4), run="alone")
    cost = {"wall_seconds", "cpu_seconds", "taken_from"}
    assert {name: value for name, value in short.items() if name not in cost} == pytest.approx(
        {name: value for name, value in alone.items() if name not in cost}
    )


def test_history_that_is_too_short_is_gone_on_with_in_its_own_folder(
    run: Run, solver: type[Adapter], tmp_path: Path
) -> None:
    run(case(duration=20.0))
    run(case(duration=300.0))
    place = tmp_path / "run/store" / history_hash(case())
    assert [folder for folder, _ in solver.ran] == [place, place]
    # the longer one answers for the shorter from now on
    assert float(read_dataset(place / "history.nc")["time"][-1]) == solver.ran[1][1] > 20.0
    shortened = run(case(duration=30.0))
    assert shortened["end_time"] == 30.0
    assert shortened["regime"] == "undecided"
    assert "too short to be judged" in shortened["reason"]
    assert len(solver.ran) == 2


def test_kept_history_answers_other_criteria(
    run: Run, solver: type[Adapter], tmp_path: Path
) -> None:
    run(case(periods=9))
    keep_results(tmp_path / "run", tmp_path / "kept")
    run(case(periods=4), run="other", reuse=tmp_path / "kept")
    assert len(solver.ran) == 1


def test_kept_result_is_found_from_a_machine_that_rounds_otherwise(
    run: Run, solver: type[Adapter], tmp_path: Path
) -> None:
    assert UNSTEADY.section is not None
    run(case())
    keep_results(tmp_path / "run", tmp_path / "kept")
    for difference, computed in ((1e-5, 1), (1e-3, 2)):
        inertia = UNSTEADY.section.inertia * (1 + difference)
        section = UNSTEADY.section.model_copy(update={"inertia": inertia})
        other = case().model_copy(update={"section": section})
        assert case_hash(other) != case_hash(case())
        place = f"other{difference:g}"
        found = run(other, run=place, reuse=tmp_path / "kept")
        assert len(solver.ran) == computed
        assert found["case_hash"] == case_hash(other)


def test_broken_history_is_computed_again(
    run: Run, solver: type[Adapter], tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    run(case(periods=9))
    path = tmp_path / "run/store" / history_hash(case()) / "history.nc"
    whole = path.read_bytes()
    path.unlink()
    path.write_bytes(whole[:400])
    run(case(periods=4))
    assert len(solver.ran) == 2
    assert "history.nc: truncated or not NetCDF-4" in caplog.text
