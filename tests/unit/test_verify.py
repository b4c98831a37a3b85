"""``equisection verify``: what it finds of a run that was tampered with, and of kept results."""

import hashlib
import json
import shutil
import subprocess
import time
from pathlib import Path

import pytest
import xarray as xr
from tests.sample_cases import UNSTEADY

import equisection
from equisection.cases import canonical, case_hash, write_cases
from equisection.provenance import (
    ATTRIBUTES,
    COMMAND_VARIABLE,
    command_line,
    commit_of,
    config_hash,
    config_text,
    made_by_this,
)
from equisection.results.netcdf import read_attributes, read_dataset, write_dataset
from equisection.run.command_line import main
from equisection.run.verify import Fault, verify_made, verify_run
from equisection.store.index import write_index
from equisection.store.made_from import write_record

CASE = UNSTEADY
RESULT = "unsteady/2d/k6.44.nc"
CASES = "cases/unsteady/2d/sweep.json"
INDEX = "unsteady/2d/sweep.json"
SUMMARY = "comparison/summary.csv"
FIGURE = "figures/response.png"


def write_result(path: Path, **attributes: str) -> dict[str, object]:
    data = xr.Dataset({"cl": ((), 0.5, {"units": "1", "long_name": "lift coefficient"})})
    return write_dataset(path, data.assign_attrs(attributes))


@pytest.fixture
def run(tmp_path: Path) -> Path:
    """A run of one case with its figure, as the jobs leave it behind."""
    folder = tmp_path / "results" / "beam"
    (folder / "logs").mkdir(parents=True)

    def record(job: str, inputs: list[str], outputs: list[str]) -> None:
        log = folder / "logs" / f"{job}.log"
        write_record(log, [folder / name for name in inputs], [folder / name for name in outputs])

    write_cases(folder / CASES, {"k6.44": CASE})
    record("unsteady_cases_2d_sweep", [], [CASES])
    attributes = write_result(folder / RESULT, case_hash=case_hash(CASE), case=canonical(CASE))
    write_index(folder / INDEX, {"k6.44": attributes})
    record("unsteady_2d_sweep", [CASES], [INDEX])
    for name, text in {SUMMARY: "model,k_star\n", FIGURE: "a picture"}.items():
        (folder / name).parent.mkdir()
        (folder / name).write_text(text)
    record("summary", [INDEX], [SUMMARY])
    record("response", [SUMMARY], [FIGURE])
    return folder


def faults(run: Path) -> dict[str, Fault]:
    return {name: fault for name, (fault, _) in verify_run(run).faults.items()}


def test_an_untouched_run_is_sound(run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verify", str(run)]) == 0
    assert "beam: 5 files checked, all well" in capsys.readouterr().out


def test_it_is_sound_in_another_place(run: Path, tmp_path: Path) -> None:
    shutil.move(run, tmp_path / "elsewhere")
    assert faults(tmp_path / "elsewhere") == {}


def test_an_edited_table_is_foreign_and_what_is_drawn_from_it_stale(run: Path) -> None:
    (run / SUMMARY).write_text("model,k_star\n2d,1\n")
    assert faults(run) == {SUMMARY: Fault.FOREIGN, FIGURE: Fault.STALE}


def test_a_result_of_the_same_case_with_other_numbers_is_foreign(run: Path) -> None:
    data = read_dataset(run / RESULT)
    write_dataset(run / RESULT, data.assign_attrs(growth_rate=1.5))
    assert faults(run)[RESULT] is Fault.FOREIGN


def test_a_result_whose_bytes_were_altered_is_broken(run: Path) -> None:
    content = bytearray((run / RESULT).read_bytes())
    content[len(content) // 2] ^= 1
    (run / RESULT).write_bytes(content)
    assert faults(run)[RESULT] is Fault.BROKEN


def test_a_lost_result_is_missing(run: Path) -> None:
    (run / RESULT).unlink()
    assert faults(run)[RESULT] is Fault.MISSING


def test_a_case_that_was_changed_makes_all_that_follows_stale(run: Path) -> None:
    write_cases(run / CASES, {"k6.44": CASE.model_copy(update={"duration": 10.0})})
    write_record(run / "logs/unsteady_cases_2d_sweep.log", [], [run / CASES])
    assert faults(run) == dict.fromkeys((RESULT, INDEX, SUMMARY, FIGURE), Fault.STALE)


def test_without_records_the_hash_of_the_case_tells(
    run: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    shutil.rmtree(run / "provenance")
    assert main(["verify", str(run)]) == 0
    assert "have no record of what they are made from" in capsys.readouterr().out
    other = CASE.model_copy(update={"duration": 10.0})
    write_result(run / RESULT, case_hash=case_hash(other), case=canonical(other))
    assert main(["verify", str(run)]) == 1
    assert f"foreign {run.name}/{RESULT}" in capsys.readouterr().out


def test_a_case_that_waits_is_no_fault(run: Path, capsys: pytest.CaptureFixture[str]) -> None:
    write_cases(run / "cases/unsteady/2d/k9.json", {"k9": CASE.model_copy(update={"k_star": 9.0})})
    assert main(["verify", str(run)]) == 0
    assert "1 cases have no result yet" in capsys.readouterr().out


UNHASHABLE = '{"made_by": {}, "inputs": {}, "outputs": {"a": {}}, "cpu_seconds": 1}'


@pytest.mark.parametrize("text", ["", "{}", "[]", '{"made_by": 1}', UNHASHABLE])
def test_a_record_that_is_none_is_broken(run: Path, text: str) -> None:
    (run / "provenance" / "summary.json").write_text(text)
    assert faults(run)["provenance/summary.json"] is Fault.BROKEN


def test_a_kept_result_is_checked_by_the_case_that_it_holds(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    kept = tmp_path / "kept"
    kept.mkdir()
    write_result(kept / "k6.44.nc", case_hash=case_hash(CASE), case=canonical(CASE))
    assert main(["verify", str(kept)]) == 0
    write_result(kept / "k6.44.nc", case_hash="0" * 64, case=canonical(CASE))
    assert main(["verify", str(kept)]) == 1
    assert "the case that it holds is not that of its hash" in capsys.readouterr().out


def test_a_missing_folder_is_an_error(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["verify", "nowhere"]) == 1
    assert capsys.readouterr().err.startswith("error: nowhere: no such folder")


class TestProvenance:
    def test_every_file_says_what_made_it(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setenv(COMMAND_VARIABLE, "snakemake --cores 2")
        made_by_this.cache_clear()
        write_result(tmp_path / "a.nc")
        made_by_this.cache_clear()
        attributes = read_attributes(tmp_path / "a.nc")
        assert attributes.keys() >= set(ATTRIBUTES)
        assert attributes["command"] == "snakemake --cores 2"
        assert attributes["equisection_version"] == equisection.__version__

    def test_hash_of_the_configuration_is_that_of_its_file(self, tmp_path: Path) -> None:
        resolved = {"run": "beam", "flow": {"speed": 20.0}}
        file = tmp_path / "config.resolved.yaml"
        file.write_text(config_text(resolved))
        assert config_hash(resolved) == hashlib.sha256(file.read_bytes()).hexdigest()

    def test_a_command_is_quoted_and_names_no_folder(self) -> None:
        words = ["--config", "sweep={k_star: [1]}"]
        wanted = "snakemake --config 'sweep={k_star: [1]}'"
        assert command_line(["/opt/bin/snakemake", *words]) == wanted
        assert command_line(["/opt/lib/snakemake/__main__.py", *words]) == wanted

    def test_commit_of_a_clone_and_no_other(self, tmp_path: Path) -> None:
        package = tmp_path / "workflow" / "equisection"
        stranger = tmp_path / "lib" / "equisection"
        for folder in (package, stranger):
            folder.mkdir(parents=True)
            (folder / "__init__.py").touch()
        assert commit_of(package) == ""

        def git(*arguments: str) -> str:
            person = ("-c", "user.name=a", "-c", "user.email=a@example.org")
            command = ["git", *person, "-C", str(tmp_path), *arguments]
            return subprocess.run(command, check=True, capture_output=True, text=True).stdout

        git("init", "--quiet")
        git("add", "workflow")
        git("commit", "--quiet", "--message", "first")
        commit = git("rev-parse", "HEAD").strip()
        assert commit_of(package) == commit
        assert commit_of(stranger) == ""
        (package / "__init__.py").write_text("changed = True\n")
        assert commit_of(package) == f"{commit}-modified"

    def test_records_hold_names_seen_from_the_run(self, run: Path) -> None:
        record = json.loads((run / "provenance" / "unsteady_2d_sweep.json").read_text())
        assert set(record["inputs"]) == {CASES}
        assert set(record["outputs"]) == {INDEX, RESULT}


def test_what_a_run_has_made_is_checked_at_its_end(run: Path) -> None:
    (sum_of,) = verify_made(run, 0.0)[-1:]
    assert sum_of.endswith("files checked, all well")
    assert verify_made(run, time.time() + 60.0) == []
    (run / SUMMARY).write_text("spoilt by a full disk")
    content = bytearray((run / RESULT).read_bytes())
    content[len(content) // 2] ^= 1
    (run / RESULT).write_bytes(content)
    lines = verify_made(run, 0.0)
    assert any(line.startswith("broken") and RESULT in line for line in lines)
    assert any(line.startswith("foreign") and SUMMARY in line for line in lines)


def test_broken_file_that_nothing_of_the_run_names_is_found(run: Path) -> None:
    for name in ("stray.nc", ".tmp-written-now.nc"):
        (run / "unsteady" / "2d" / name).write_bytes(b"no NetCDF")
    faults = verify_run(run).faults
    assert list(faults) == ["unsteady/2d/stray.nc"]
    assert faults["unsteady/2d/stray.nc"][0] == Fault.BROKEN


@pytest.mark.parametrize("name", [CASES, INDEX, "provenance/unsteady_2d_sweep.json"])
def test_json_that_is_nested_without_end_is_one_broken_file(
    name: str, run: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    (run / name).write_text("[" * 100_000)
    assert main(["verify", str(run)]) == 1
    assert f"broken  beam/{name}: " in capsys.readouterr().out
    assert main(["status", str(run)]) == 0
