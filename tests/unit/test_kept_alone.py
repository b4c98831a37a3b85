"""Cases answered from kept results alone."""

from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from tests.sample_cases import STEADY, UNSTEADY

from equisection.cases import Case, UnsteadyCase, canonical, case_hash
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.store import kept
from equisection.store.index import read_index, read_missing, write_index
from equisection.store.kept_alone import Answers, answer_from_kept

OPENFOAM = UNSTEADY.solver.model_copy(
    update={"name": "openfoam", "version": "3", "settings": {"outer_correctors": 3}}
)
RUN = UNSTEADY.model_copy(update={"solver": OPENFOAM, "duration": 100.0})


def keep(path: Path, case: Case, **attributes: object) -> None:
    path.parent.mkdir(parents=True, exist_ok=True)
    data = xr.Dataset({"cl": ((), 0.5, {"units": "1", "long_name": "lift coefficient"})})
    own = {"case_hash": case_hash(case), "case": canonical(case)}
    write_dataset(path, data.assign_attrs(own, **attributes))


def keep_history(path: Path, case: UnsteadyCase, end: float, growth: float) -> None:
    """Keep an oscillation of 0.5 deg at release that grows at a rate (V/c)."""
    time = np.arange(0.0, end + 0.05, 0.1)
    twist = np.radians(0.5) * np.exp(growth * time) * np.cos(0.98 * time)
    histories = {
        name: ("time", values, {"units": "1", "long_name": name})
        for name, values in (("tip_twist", twist), ("tip_deflection", 0.1 * twist))
    }
    axis = {"time": ("time", time, {"units": "c/V", "long_name": "time"})}
    write_dataset(
        path,
        xr.Dataset(histories, axis).assign_attrs(
            case_hash=case_hash(case),
            case=canonical(case),
            chord=0.1,
            regime="growing",
            end_time=end,
            cpu_seconds=60.0,
            wall_seconds=60.0,
        ),
    )


def answers(cases: dict[str, Case], place: Path) -> Answers:
    return answer_from_kept(cases, place / "out", place / "store", place / "kept")


def test_result_of_the_case_is_published_and_the_other_is_named(tmp_path: Path) -> None:
    keep(tmp_path / "kept/steady/2d/coarse_a2.5.nc", STEADY, failure="")
    other = STEADY.model_copy(update={"incidence_deg": 5.0})
    found = answers({"there": STEADY, "not": other}, tmp_path)
    assert set(found.found) == {"there"}
    assert read_dataset(tmp_path / "out/there.nc", case_hash(STEADY))["cl"] == 0.5
    assert found.missing == {"not": f"nothing of it is kept in {tmp_path / 'kept'}"}
    assert not (tmp_path / "out/not.nc").exists()


def test_result_that_is_no_longer_kept_does_not_stay(tmp_path: Path) -> None:
    kept = tmp_path / "kept/steady/2d/coarse_a2.5.nc"
    keep(kept, STEADY, failure="")
    answers({"a": STEADY}, tmp_path)
    kept.unlink()
    assert answers({"a": STEADY}, tmp_path).missing
    assert not (tmp_path / "out/a.nc").exists()


def test_history_that_is_no_longer_kept_is_not_judged(tmp_path: Path) -> None:
    """Not even where an earlier answer has left it in the store."""
    path = tmp_path / "kept/k.nc"
    keep_history(path, RUN, 60.0, 0.012)
    shorter = RUN.model_copy(update={"duration": 55.0})
    assert answers({"k": shorter}, tmp_path).found["k"]["growth_rate"] > 0
    keep_history(path, RUN, 60.0, -0.02)
    assert answers({"k": shorter}, tmp_path).found["k"]["growth_rate"] < 0
    path.unlink()
    assert answers({"k": shorter}, tmp_path).missing


@pytest.mark.parametrize("growth", [0.012, -0.0005], ids=["growing", "hardly decaying"])
def test_shorter_history_is_judged_as_far_as_it_goes(growth: float, tmp_path: Path) -> None:
    other = RUN.criteria.model_copy(update={"periods": 7})
    kept = RUN.model_copy(update={"duration": 60.0, "criteria": other})
    keep_history(tmp_path / "kept/k.nc", kept, 60.0, growth)
    found = answers({"k": RUN}, tmp_path).found["k"]
    assert found["end_time"] == pytest.approx(60.0)
    assert found["growth_rate"] == pytest.approx(growth, abs=2e-4)


def test_reason_says_in_what_the_kept_case_differs(tmp_path: Path) -> None:
    keep_history(tmp_path / "kept/k.nc", RUN, 100.0, 0.01)
    tighter = OPENFOAM.model_copy(update={"settings": {"outer_correctors": 5}})
    case = RUN.model_copy(update={"solver": tighter})
    reason = answers({"k": case}, tmp_path).missing["k"]
    assert reason.endswith("has solver.settings.outer_correctors 3 (wanted 5)")


def test_index_names_what_is_missing_beside_the_results(tmp_path: Path) -> None:
    write_index(tmp_path / "sweep.json", {"k5": {"regime": "growing"}}, {"k6": "not kept"})
    assert set(read_index(tmp_path / "sweep.json")) == {"k5"}
    assert read_missing(tmp_path / "sweep.json") == {"k6": "not kept"}


@pytest.mark.parametrize("others", [1, 12])
def test_a_case_is_written_as_often_however_many_results_are_kept(
    others: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The mode shapes of a beam make that dear."""
    for number in range(others):
        angle = 5.0 + number
        keep(tmp_path / f"kept/a{angle:g}.nc", RUN.model_copy(update={"incidence_deg": angle}))
    written = []
    monkeypatch.setattr(kept, "canonical", lambda case: written.append(case) or canonical(case))
    assert answers({"not": RUN}, tmp_path).missing
    # is it alike, has it its history (asked twice: by how long, and to be judged again)
    assert len(written) == 3
