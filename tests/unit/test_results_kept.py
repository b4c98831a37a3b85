"""Results that are kept, and taken instead of being computed again."""

import shutil
from pathlib import Path

import pytest
import xarray as xr
from tests.sample_cases import STEADY, UNSTEADY

from equisection.cases import Case, canonical, case_hash
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.section_mesh import no_mesh
from equisection.run.command_line import main
from equisection.store import job
from equisection.store.job import run_cases
from equisection.store.kept import SECTION_MESH, keep_results, kept_mesh, kept_results
from equisection.store.result_store import ResultStore, Task


def write(path: Path, case: Case, **attributes: str) -> None:
    """Write what stands for the result of a case."""
    path.parent.mkdir(parents=True, exist_ok=True)
    data = xr.Dataset({"cl": ((), 0.5, {"units": "1", "long_name": "lift coefficient"})})
    write_dataset(path, data.assign_attrs(case_hash=case_hash(case), **attributes))


def at(k_star: float) -> Case:
    return UNSTEADY.model_copy(update={"k_star": k_star})


@pytest.fixture
def run(tmp_path: Path) -> Path:
    folder = tmp_path / "results" / "my-beam"
    write(folder / "steady/2d/coarse_a2.5.nc", STEADY, failure="")
    write(folder / "unsteady/2d/k5.nc", at(5.0), regime="growing")
    write(folder / "unsteady/2d/k6.nc", at(6.0), regime="failed")
    write_dataset(
        folder / "structure/modes.nc",
        xr.Dataset({"f": ((), 1.0, {"units": "Hz", "long_name": "frequency"})}),
    )
    return folder


def test_results_of_cases_are_kept_but_for_failed_ones(run: Path, tmp_path: Path) -> None:
    keep_results(run, tmp_path / "kept")
    assert {
        kept.attributes["case_hash"]: kept.path for kept in kept_results(tmp_path / "kept")
    } == {
        case_hash(STEADY): tmp_path / "kept/steady/2d/coarse_a2.5.nc",
        case_hash(at(5.0)): tmp_path / "kept/unsteady/2d/k5.nc",
    }


def test_section_mesh_is_kept_and_found_by_what_it_is_of(run: Path, tmp_path: Path) -> None:
    mesh = no_mesh(2.5, 0.02).to_dataset().assign_attrs(mesh_of=canonical(STEADY))
    write_dataset(run / SECTION_MESH, mesh)
    kept = tmp_path / "kept"
    keep_results(run, kept / "my-beam")
    path = kept / "my-beam" / SECTION_MESH
    assert kept_mesh(kept, SECTION_MESH, STEADY, time_step=0.02) == path
    assert kept_mesh(kept, SECTION_MESH, STEADY, time_step=0.01) is None
    thicker = STEADY.geometry.model_copy(update={"thickness": 0.06})
    for change in ({"resolution": "fine"}, {"geometry": thicker}):
        other = STEADY.model_copy(update=change)
        assert kept_mesh(kept, SECTION_MESH, other, time_step=0.02) is None
    assert path not in {kept.path for kept in kept_results(tmp_path / "kept")}


def test_kept_result_is_taken_and_others_are_computed(
    run: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    kept = tmp_path / "kept"
    keep_results(run, kept)
    computed = []

    def compute(
        tasks: list[Task], store: ResultStore, progress: Path, threads: int
    ) -> dict[str, dict[str, object]]:
        del progress, threads
        for task in tasks:
            computed.append(task.case)
            write(store.result(task), task.case)
        return {task.hash: {} for task in tasks}

    monkeypatch.setattr(job, "_compute", compute)
    cases = {"k5": at(5.0), "k7": at(7.0)}

    def publish(store: str, reuse: Path | None) -> dict[str, dict[str, object]]:
        place = tmp_path / store
        return run_cases(cases, place / "out", place, tmp_path / "progress.json", reuse)

    attributes = publish("first", kept)
    assert computed == [at(7.0)]
    assert attributes["k5"]["regime"] == "growing"
    assert read_dataset(tmp_path / "first/out/k5.nc", case_hash(at(5.0))).attrs["regime"]
    # nothing is taken unasked, from a folder that is not there, or from a broken file
    publish("second", None)
    publish("third", tmp_path / "nowhere")
    broken = kept / "unsteady/2d/k5.nc"
    broken.write_bytes(broken.read_bytes()[:300])
    publish("fourth", kept)
    assert computed == [at(7.0)] + 3 * [at(5.0), at(7.0)]


def test_command_keeps_a_run(
    run: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["keep", "results/my-beam"]) == 0
    assert capsys.readouterr().out == ("2 results of cases are kept in results/reference/my-beam\n")
    assert len(kept_results(Path("results/reference"))) == 2
    shutil.rmtree(run)
    assert main(["keep", "results/my-beam"]) == 1
    assert "no result of a case to keep" in capsys.readouterr().err
