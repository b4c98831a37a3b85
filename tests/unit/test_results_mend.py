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
from equisection.store.mend import mend


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


def test_truncated_result_is_set_aside_and_its_index_asked_for_again(run: Path) -> None:
    path = run / "unsteady" / "2d" / "k5.nc"
    path.write_bytes(path.read_bytes()[:100])
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
