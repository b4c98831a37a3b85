import json
import os
import shutil
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from equisection.errors import ResultFileError
from equisection.results.netcdf import read_attributes, write_dataset
from equisection.store.index import read_index, result_files, write_index
from equisection.store.made_from import write_record
from equisection.store.mend import put_aside, unsound_files


def result(case_hash: str) -> xr.Dataset:
    units = {"units": "1", "long_name": "a number"}
    return xr.Dataset({"value": ((), float(len(case_hash)), units)}, attrs={"case_hash": case_hash})


@pytest.fixture
def run(tmp_path: Path) -> Path:
    """A run's folder with a batch of three results and their index."""
    folder = tmp_path / "unsteady" / "2d"
    for name in ("k4", "k5", "k6"):
        write_dataset(folder / f"{name}.nc", result(f"hash-of-{name}"))
    write_index(
        folder / "sweep.json",
        {name: read_attributes(folder / f"{name}.nc") for name in ("k4", "k5", "k6")},
    )
    return tmp_path


def mend(run: Path) -> list[str]:
    return put_aside(unsound_files(run))


def names(run: Path) -> list[str]:
    return sorted(path.name for path in (run / "unsteady" / "2d").iterdir())


def younger_than_index(path: Path) -> None:
    later = path.with_name("sweep.json").stat().st_mtime_ns + 10**9
    os.utime(path, ns=(later, later))


def test_sound_run_is_left_as_it_is(run: Path) -> None:
    assert mend(run) == []
    assert names(run) == ["k4.nc", "k5.nc", "k6.nc", "sweep.json"]


def test_run_that_is_not_there_yet_needs_nothing(tmp_path: Path) -> None:
    assert mend(tmp_path / "nothing") == []


@pytest.mark.parametrize("left", [0, 100])
def test_truncated_result_is_set_aside_and_its_index_asked_for_again(run: Path, left: int) -> None:
    path = run / "unsteady" / "2d" / "k5.nc"
    path.write_bytes(path.read_bytes()[:left])
    said = mend(run)
    assert names(run) == ["k4.nc", "k5.nc.broken", "k6.nc"]
    assert "k5.nc: truncated or not NetCDF-4; kept as k5.nc.broken, made again" in said[0]


def test_lost_result_makes_its_index_asked_for_again(run: Path) -> None:
    (run / "unsteady" / "2d" / "k5.nc").unlink()
    (said,) = mend(run)
    assert names(run) == ["k4.nc", "k6.nc"]
    assert "sweep.json: names results that are not there" in said


def test_exchanged_result_is_set_aside(run: Path) -> None:
    folder = run / "unsteady" / "2d"
    shutil.copyfile(folder / "k4.nc", folder / "k5.nc")
    younger_than_index(folder / "k5.nc")
    said = mend(run)
    assert names(run) == ["k4.nc", "k5.nc.broken", "k6.nc"]
    assert "k5.nc: not the result of its case; kept as k5.nc.broken" in said[0]


def test_touched_result_of_its_case_is_kept(run: Path) -> None:
    younger_than_index(run / "unsteady" / "2d" / "k5.nc")
    assert mend(run) == []


def test_index_that_cannot_be_read_is_asked_for_again(run: Path) -> None:
    (run / "unsteady" / "2d" / "sweep.json").write_text("{")
    (said,) = mend(run)
    assert names(run) == ["k4.nc", "k5.nc", "k6.nc"]
    assert "cannot be read as an index" in said


def test_file_that_is_being_written_is_left_alone(run: Path) -> None:
    (run / "unsteady" / "2d" / ".tmp-1.nc").write_bytes(b"half")
    assert mend(run) == []
    assert ".tmp-1.nc" in names(run)


def test_index_names_its_results_and_what_they_are(run: Path) -> None:
    index = run / "unsteady" / "2d" / "sweep.json"
    assert [path.name for path in result_files([index])] == ["k4.nc", "k5.nc", "k6.nc"]
    assert read_index(index)["k5"]["case_hash"] == "hash-of-k5"


def test_index_keeps_numbers_and_says_unknown_ones_are_unknown(tmp_path: Path) -> None:
    path = tmp_path / "sweep.json"
    write_index(path, {"k4": {"a": np.float64(0.1), "b": np.int64(3), "c": np.nan, "d": "x"}})
    found = read_index(path)["k4"]
    assert (found["a"], found["b"], found["d"]) == (0.1, 3, "x")
    assert np.isnan(found["c"])
    assert "NaN" not in path.read_text()


@pytest.mark.parametrize("content", ["", "[]", "{}", '{"schema_version": 1, "results": 3}'])
def test_malformed_index_is_named(content: str, tmp_path: Path) -> None:
    (tmp_path / "sweep.json").write_text(content)
    with pytest.raises(ResultFileError, match=r"sweep\.json: .*delete it and run again"):
        read_index(tmp_path / "sweep.json")


def test_index_of_another_schema_is_refused(tmp_path: Path) -> None:
    document = {"schema_version": 7, "results": {}}
    (tmp_path / "sweep.json").write_text(json.dumps(document))
    with pytest.raises(ResultFileError, match="schema version 7; version 1 is read here"):
        read_index(tmp_path / "sweep.json")


def test_altered_result_is_set_aside_and_its_index_asked_for_again(run: Path) -> None:
    path = run / "unsteady" / "2d" / "k5.nc"
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 4
    path.write_bytes(content)
    said = mend(run)
    assert names(run) == ["k4.nc", "k5.nc.broken", "k6.nc"]
    assert "k5.nc: not as it was written: its content does not have its digest; kept as" in said[0]


def edited_table(run: Path) -> Path:
    """A table with the record of its job, in which a number was changed afterwards."""
    table = run / "comparison" / "summary.csv"
    table.parent.mkdir()
    table.write_text("model,k_star\n2d,5\n")
    write_record(run / "logs" / "summary.log", [], [table])
    assert mend(run) == []
    table.write_text("model,k_star\n2d,6\n")
    return table


def test_table_that_was_edited_is_made_again(run: Path) -> None:
    table = edited_table(run)
    (said,) = mend(run)
    assert "summary.csv: edited since its job made it; kept as summary.csv.broken" in said
    assert not table.exists()


@pytest.mark.parametrize(("age", "again"), [(3600, True), (-3600, False)])
def test_table_made_from_a_file_that_was_exchanged_for_an_older_one_is_made_again(
    run: Path, age: float, again: bool
) -> None:
    """Snakemake goes by times: it sees the exchange for a younger one by itself."""
    polar, table = run.parent / "polar.csv", run / "comparison" / "summary.csv"
    table.parent.mkdir()
    for path in (polar, table):
        path.write_text("a\n1\n")
    write_record(run / "logs" / "summary.log", [polar], [table])
    os.utime(polar, (table.stat().st_mtime - 3600, table.stat().st_mtime - 3600))
    assert mend(run) == []
    polar.write_text("a\n2\n")
    os.utime(polar, (table.stat().st_mtime - age, table.stat().st_mtime - age))
    said = mend(run)
    assert [f"made from another {polar} than there is, whose time is older" in s for s in said] == [
        True
    ] * again
    assert table.exists() is not again


def test_table_that_was_only_touched_stays(run: Path) -> None:
    table = edited_table(run)
    table.write_text("model,k_star\n2d,5\n")
    assert mend(run) == []


def test_looking_changes_nothing_and_says_what_a_run_would_do(run: Path) -> None:
    edited_table(run)
    (run / "unsteady" / "2d" / "k5.nc").write_bytes(b"half")
    before = sorted(run.rglob("*"))
    words = [file.words(done=False) for file in unsound_files(run)]
    assert sorted(run.rglob("*")) == before
    assert "a run would keep it as k5.nc.broken and make it again" in words[0]
    assert "edited since its job made it; a run would keep it" in words[1]
    assert words[2].endswith("they are made again; a run would make it again")


def test_folder_that_is_read_only_is_said_not_raised(
    run: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (run / "unsteady" / "2d" / "k5.nc").write_bytes(b"half")

    def refuse(*arguments: object) -> None:
        raise OSError(30, "Read-only file system")

    monkeypatch.setattr(Path, "replace", refuse)
    monkeypatch.setattr(Path, "unlink", refuse)
    said = put_aside(unsound_files(run))
    assert all(line.endswith("(it cannot here: Read-only file system)") for line in said)
