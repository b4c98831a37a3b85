"""Registry of kinds of case: a further kind is an entry, and nothing else knows of it."""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from types import SimpleNamespace
from typing import Any, Literal

import pytest
import xarray as xr
from rich.console import Console
from tests.conftest import ROOT
from tests.sample_cases import GEOMETRY, MEDIUM, STEADY, UNSTEADY

from equisection.cases import KINDS, Case, Kind, SolverBlock, case_hash, read_cases, write_cases
from equisection.cases.kinds import FREE, kind_named, kind_of, point_of
from equisection.errors import CaseFileError, SolverError
from equisection.results.netcdf import read_attributes, read_dataset
from equisection.results.spent import Spent
from equisection.run.listing import cases_of_run
from equisection.run.status import State, run_status
from equisection.run.status_text import print_status
from equisection.run.status_words import summary
from equisection.run.verify import Fault, verify_kept, verify_run
from equisection.solvers.protocol import Capability, Progress
from equisection.solvers.registry import SOLVERS, SolverEntry
from equisection.store.index import indices_of_run, is_index, read_index, write_index
from equisection.store.job import run_cases
from equisection.store.kept import keep_results, kept_results
from equisection.store.kept_alone import answer_from_kept
from equisection.store.made_from import write_record
from equisection.store.mend import put_aside, unsound_files

REFERENCE = ROOT / "results" / "reference"


class ShakenCase(Case):
    """Section that is moved to and fro."""

    kind: Literal["shaken"] = "shaken"
    reduced_frequency: float


SHAKEN = Kind(
    "shaken", ShakenCase, ("reduced_frequency",), has_history=True, title="shaken section"
)


@dataclass(frozen=True)
class ShakenResult:
    """Damping in pitch of a section that is shaken."""

    damping: float
    failure: str = ""
    spent: Spent | None = None

    def of_case(self, case: ShakenCase) -> xr.Dataset:
        """Return the data set that is written to the file of a case."""
        variable = ((), self.damping, {"units": "1", "long_name": "damping in pitch"})
        end = 4.0 / case.reduced_frequency
        attributes: dict[str, Any] = {"failure": self.failure, "end_time": end}
        return xr.Dataset({"damping": variable}, attrs=attributes)


class Shaker:
    """Solver that shakes sections one by one, and can do nothing else."""

    name, version, provides = "shaker", "1", frozenset[Capability]()

    @classmethod
    def from_settings(cls, settings: dict[str, Any], allocation: object) -> Shaker:
        del settings, allocation
        return cls()

    def describe(self, dimension: str) -> str:
        return f"shaker of {dimension}"

    def run_shaken(
        self, cases: Sequence[ShakenCase], work: Path, progress: Progress
    ) -> list[ShakenResult]:
        del work
        progress(1.0, 4.0)
        return [
            ShakenResult(-case.reduced_frequency, "too fast" if case.reduced_frequency > 1 else "")
            for case in cases
        ]


def shaken(reduced_frequency: float) -> ShakenCase:
    return ShakenCase(
        dimension="2d",
        incidence_deg=2.5,
        resolution="coarse",
        geometry=GEOMETRY,
        medium=MEDIUM,
        solver=SolverBlock(name="shaker", version="1", settings={}),
        reduced_frequency=reduced_frequency,
    )


NAMES = {"f0.1": shaken(0.1), "f0.2": shaken(0.2), "f2": shaken(2.0)}
INDEX = "shaken/2d/sweep.json"


@pytest.fixture(autouse=True)
def registered(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(KINDS, "shaken", SHAKEN)
    monkeypatch.setitem(sys.modules, "shaker", SimpleNamespace(Adapter=Shaker))  # type: ignore[arg-type]
    monkeypatch.setitem(SOLVERS, "shaker", SolverEntry("shaker", Shaker.provides))


@pytest.fixture
def waiting(tmp_path: Path) -> Path:
    """A run whose cases are written and have not run."""
    run = tmp_path / "results" / "beam"
    (run / "logs").mkdir(parents=True)
    write_cases(run / "cases" / INDEX, NAMES)
    return run


def run_all(run: Path, reuse: Path | None = None) -> dict[str, dict[str, Any]]:
    """Run the cases and index them, as a job does."""
    cases, index = run / "cases" / INDEX, run / INDEX
    log = run / "logs" / "shaken_2d_sweep.log"
    found = run_cases(
        read_cases(cases), index.parent, run.parent / ".store", log.with_suffix(".progress.json"),
        reuse,
    )  # fmt: skip
    write_index(index, found)
    write_record(log, [cases], [index])
    return found


@pytest.fixture
def run(waiting: Path) -> Path:
    run_all(waiting)
    return waiting


def test_case_files_are_read_by_the_class_of_their_kind(waiting: Path) -> None:
    assert read_cases(waiting / "cases" / INDEX) == NAMES
    assert SHAKEN.folder == "shaken"
    with pytest.raises(CaseFileError, match="kind: 'slammed' is not known; allowed are steady"):
        kind_named("slammed")


def test_job_runs_them_by_the_method_of_their_kind(run: Path) -> None:
    data = read_dataset(run / "shaken/2d/f0.2.nc", case_hash(NAMES["f0.2"]))
    assert float(data["damping"]) == -0.2
    assert data.attrs["reduced_frequency"] == 0.2
    assert read_index(run / INDEX)["f0.1"]["reduced_frequency"] == 0.1


def test_solver_without_the_method_says_so(tmp_path: Path) -> None:
    case = STEADY.model_copy(update={"solver": NAMES["f0.1"].solver})
    with pytest.raises(SolverError, match="solver 'shaker' runs no steady cases"):
        run_cases({"a": case}, tmp_path / "out", tmp_path / "store", tmp_path / "p.json")


def test_they_are_listed_behind_the_others(run: Path) -> None:
    write_cases(run / "cases/steady/2d/polar.json", {"coarse_a2.5": STEADY})
    write_cases(run / "cases/unsteady/2d/sweep.json", {"k6.44": UNSTEADY})
    listed = [(one.model, one.name, one.kind.name) for one in cases_of_run(run)]
    assert listed == [
        ("steady 2d", "coarse_a2.5", "steady"),
        ("2d", "k6.44", "free"),
        *(("shaken section 2d", name, "shaken") for name in NAMES),
    ]


def test_status_tells_of_them(waiting: Path) -> None:
    assert {entry.state for entry in run_status(waiting).entries} == {State.WAITING}
    run_all(waiting)
    status = run_status(waiting)
    states = {entry.case: entry.state for entry in status.entries}
    assert states == {"f0.1": State.DONE, "f0.2": State.DONE, "f2": State.FAILED}
    assert status.entries[0].simulated == 40.0
    assert "shaken section 2 of 3 done, 1 failed" in summary(status)
    with (console := Console(width=120)).capture() as printed:
        print_status(console, status)
    assert "f0.2" in printed.get()


def test_verification_finds_them_sound_and_a_changed_one_not(run: Path) -> None:
    sound = verify_run(run)
    assert sound.faults == {}
    assert sound.checked == 5  # three results, their index and the case file
    (run / "shaken/2d/f0.1.nc").unlink()
    assert verify_run(run).faults["shaken/2d/f0.1.nc"][0] is Fault.MISSING
    write_cases(run / "cases" / INDEX, {**NAMES, "f0.2": shaken(0.3)})
    assert verify_run(run).faults["shaken/2d/f0.2.nc"][0] is Fault.STALE


def test_lost_results_are_made_again(run: Path) -> None:
    (run / "shaken/2d/f0.1.nc").unlink()
    assert is_index(Path(INDEX))
    assert indices_of_run(run) == [run / INDEX]
    assert put_aside(unsound_files(run)) == [
        f"{run / INDEX}: names results that are not there; they are made again"
    ]


def test_kept_results_answer_them(
    run: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = tmp_path / "kept"
    copies = keep_results(run, kept)
    assert sorted(path.name for path in copies) == ["f0.1.nc", "f0.2.nc"]  # the failed one is not
    assert len(kept_results(kept)) == 2
    assert verify_kept(kept).faults == {}
    answers = answer_from_kept(NAMES, tmp_path / "out", tmp_path / "store", kept)
    assert answers.found["f0.1"]["reduced_frequency"] == 0.1
    assert list(answers.missing) == ["f2"]
    nearly = {"f": shaken(0.1 * (1 + 1e-6))}
    assert "f" in answer_from_kept(nearly, tmp_path / "out", tmp_path / "store", kept).found

    other = tmp_path / "elsewhere" / "results" / "beam"
    write_cases(other / "cases" / INDEX, {name: NAMES[name] for name in ("f0.1", "f0.2")})
    (other / "logs").mkdir()
    monkeypatch.delattr(Shaker, "run_shaken")
    assert set(run_all(other, kept)) == {"f0.1", "f0.2"}


@pytest.mark.parametrize("path", sorted(REFERENCE.rglob("*.nc")), ids=lambda path: path.stem)
def test_kept_case_has_its_hash_and_stands_in_the_folder_of_its_kind(path: Path) -> None:
    attributes = read_attributes(path)
    if "mesh_of" in attributes:
        return
    case = kind_named(json.loads(attributes["case"])["kind"]).case.model_validate_json(
        attributes["case"]
    )
    assert case_hash(case) == attributes["case_hash"]
    assert path.parent.parent.name == kind_of(case).folder
    known = [name for name in point_of(case) if name in attributes]
    assert known
    assert all(float(attributes[name]) == pytest.approx(point_of(case)[name]) for name in known)


def test_what_ends_a_history_is_known_by_the_kind() -> None:
    assert FREE.ends <= set(UNSTEADY.model_dump())
    assert SHAKEN.ends == frozenset()


def test_progress_is_in_time_where_there_is_a_history() -> None:
    assert (kind_of(STEADY).unit, kind_of(UNSTEADY).unit, SHAKEN.unit) == ("cases", "c/V", "c/V")
