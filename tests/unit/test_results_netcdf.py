import resource
import struct
from pathlib import Path

import netCDF4
import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

from equisection.errors import ResultFileError
from equisection.files import write_text, written_whole
from equisection.results import netcdf
from equisection.results.netcdf import read_attributes, read_dataset, write_dataset
from equisection.results.whole import (
    ALTERED,
    CUT_SHORT,
    WITHOUT_DIGEST,
    append_digest,
    fault_of,
    is_whole,
)

UNITS = {"units": "1", "long_name": "a number"}


def dataset(size: int = 10, **attrs: str) -> xr.Dataset:
    return xr.Dataset(
        {"value": ("place", np.linspace(0.0, 1.0, size), UNITS)},
        {"place": ("place", np.arange(size), UNITS)},
        attrs=attrs,
    )


@pytest.fixture
def written(tmp_path: Path) -> Path:
    path = tmp_path / "result.nc"
    write_dataset(path, dataset(case_hash="abc"))
    return path


def test_data_set_is_read_as_written(written: Path) -> None:
    data = read_dataset(written, "abc")
    xr.testing.assert_equal(data, dataset())
    assert data["value"].attrs == UNITS
    assert read_attributes(written, "abc")["case_hash"] == "abc"


def test_error_while_writing_leaves_the_old_file_and_nothing_else(
    written: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = written.read_bytes()

    def break_down(*arguments: object) -> None:
        raise OSError("no space left on device")

    monkeypatch.setattr("equisection.results.netcdf._write_variable", break_down)
    with pytest.raises(ResultFileError, match=r"cannot be written .*no space left.* the disk may"):
        write_dataset(written, dataset(5))
    assert written.read_bytes() == before
    assert list(written.parent.iterdir()) == [written]


def test_file_that_may_not_grow_is_not_taken_for_whole(written: Path) -> None:
    """The library's own error, which does not say that there is no space."""
    before = written.read_bytes()
    limits = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (10_000, limits[1]))
    try:
        with pytest.raises(ResultFileError, match=r"cannot be written .*free some space"):
            write_dataset(written, dataset(100_000))
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, limits)
    assert written.read_bytes() == before
    assert list(written.parent.iterdir()) == [written]


def test_error_while_writing_a_new_file_leaves_nothing(tmp_path: Path) -> None:
    def write_half(path: Path) -> None:
        with written_whole(path) as aside:
            aside.write_text("half")
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        write_half(tmp_path / "a" / "table.csv")
    assert list((tmp_path / "a").iterdir()) == []


def test_written_files_are_readable_as_the_umask_allows(tmp_path: Path) -> None:
    plain, whole = tmp_path / "plain.txt", tmp_path / "whole.txt"
    plain.write_text("x")
    write_text(whole, "x")
    assert whole.stat().st_mode == plain.stat().st_mode


@pytest.mark.parametrize("missing", ["units", "long_name"])
def test_variable_that_does_not_say_what_it_is_is_refused(missing: str, tmp_path: Path) -> None:
    data = dataset()
    del data["value"].attrs[missing]
    with pytest.raises(ResultFileError, match=f"variable 'value' has no {missing}"):
        write_dataset(tmp_path / "result.nc", data)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_value_that_is_not_finite_is_refused(value: float, tmp_path: Path) -> None:
    data = dataset()
    data["value"][3] = value
    with pytest.raises(ResultFileError, match="'value' holds values that are not finite"):
        write_dataset(tmp_path / "result.nc", data)
    assert list(tmp_path.iterdir()) == []


def test_missing_values_are_written_where_the_variable_allows_them(tmp_path: Path) -> None:
    data = dataset()
    data["value"][3] = np.nan
    data["value"].attrs["missing_allowed"] = "1"
    write_dataset(tmp_path / "result.nc", data)
    assert np.isnan(read_dataset(tmp_path / "result.nc")["value"][3])


def test_value_that_is_not_finite_is_refused_when_read(tmp_path: Path) -> None:
    path = tmp_path / "result.nc"
    data = dataset()
    data["value"][3] = np.nan
    data.assign_attrs(schema_version=1).to_netcdf(path)
    append_digest(path)
    with pytest.raises(ResultFileError, match=r"result\.nc: variable 'value' holds values"):
        read_dataset(path)


@pytest.mark.parametrize("read", [read_dataset, read_attributes])
def test_result_of_another_case_is_foreign(read: object, written: Path) -> None:
    with pytest.raises(ResultFileError, match=r"foreign: .* case abc, wanted is xyz"):
        read(written, "xyz")  # type: ignore[operator]


@pytest.mark.parametrize("read", [read_dataset, read_attributes])
def test_result_of_another_schema_is_refused(
    read: object, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(netcdf, "SCHEMA_VERSION", 2)
    write_dataset(tmp_path / "result.nc", dataset())
    monkeypatch.undo()
    with pytest.raises(ResultFileError, match="schema version 2; version 1 is read here"):
        read(tmp_path / "result.nc")  # type: ignore[operator]


@pytest.mark.parametrize("read", [read_dataset, read_attributes])
def test_missing_result_is_named(read: object, tmp_path: Path) -> None:
    with pytest.raises(ResultFileError, match=r"nothing\.nc: missing"):
        read(tmp_path / "nothing.nc")  # type: ignore[operator]


@pytest.mark.parametrize("share", [0.0, 0.01, 0.5, 0.999])
@pytest.mark.parametrize("read", [read_dataset, read_attributes])
def test_truncated_result_is_refused(read: object, share: float, written: Path) -> None:
    content = written.read_bytes()
    written.write_bytes(content[: int(share * len(content))])
    with pytest.raises(ResultFileError, match=r"result\.nc: .*truncated or not NetCDF-4"):
        read(written)  # type: ignore[operator]


def test_file_that_is_whole_but_damaged_inside_is_refused(written: Path) -> None:
    content = bytearray(written.read_bytes())
    content[200:-100] = bytes(len(content) - 300)
    written.write_bytes(content)
    assert is_whole(written)
    with pytest.raises(ResultFileError, match=r"result\.nc: not as it was written"):
        read_dataset(written)


@pytest.mark.parametrize("read", [read_dataset, read_attributes])
def test_no_flipped_bit_is_used(read: object, written: Path) -> None:
    """Also where the HDF5 library would return other values, raise or not return."""
    content = written.read_bytes()
    for bit in np.random.default_rng(0).integers(0, 8 * len(content), 300):
        flipped = bytearray(content)
        flipped[bit // 8] ^= 1 << (bit % 8)
        written.write_bytes(flipped)
        with pytest.raises(ResultFileError, match=r"result\.nc: .*delete it and run again"):
            read(written)  # type: ignore[operator]


def test_values_changed_by_another_program_are_refused(written: Path) -> None:
    with netCDF4.Dataset(written, "r+") as file:
        file["value"][:] = 1.5 * file["value"][:]
    assert fault_of(written) in (ALTERED, WITHOUT_DIGEST)


def test_values_changed_in_place_are_refused(written: Path) -> None:
    content = written.read_bytes()
    place = content.index(np.linspace(0.0, 1.0, 10)[4:6].tobytes())
    half_as_large_again = (1.5 * np.linspace(0.0, 1.0, 10)[4:6]).tobytes()
    written.write_bytes(content[:place] + half_as_large_again + content[place + 16 :])
    assert fault_of(written) == ALTERED


def test_file_of_another_program_has_no_digest_until_it_is_given_one(written: Path) -> None:
    xr.load_dataset(written).to_netcdf(written)
    assert fault_of(written) == WITHOUT_DIGEST
    with pytest.raises(ResultFileError, match=r"without a digest: .*equisection seal"):
        read_dataset(written)
    append_digest(written)
    xr.testing.assert_equal(read_dataset(written), dataset())


def test_other_readers_of_netcdf_open_a_file_with_a_digest(written: Path) -> None:
    for engine in ("netcdf4", "h5netcdf"):
        if engine in xr.backends.list_engines():
            xr.testing.assert_equal(xr.load_dataset(written, engine=engine), dataset())


@pytest.mark.parametrize("size", [1, 1000, 2_000_000])
def test_files_are_sound_and_cut_ones_are_not(size: int, tmp_path: Path) -> None:
    path = tmp_path / "result.nc"
    write_dataset(path, dataset(size))
    assert fault_of(path) == ""
    with path.open("r+b") as stream:
        stream.truncate(path.stat().st_size - 1)
    assert fault_of(path) == CUT_SHORT


@pytest.mark.parametrize("size", [1, 1000, 2_000_000])
def test_files_of_xarray_are_whole_and_cut_ones_are_not(size: int, tmp_path: Path) -> None:
    path = tmp_path / "result.nc"
    dataset(size).to_netcdf(path)
    assert is_whole(path)
    with path.open("r+b") as stream:
        stream.truncate(path.stat().st_size - 1)
    assert not is_whole(path)


@pytest.mark.parametrize("compression", [None, "zlib"])
def test_files_of_netcdf4_that_grow_are_whole(compression: str | None, tmp_path: Path) -> None:
    path = tmp_path / "grown.nc"
    with netCDF4.Dataset(path, "w") as file:
        file.createDimension("time", None)
        variable = file.createVariable("value", "f8", ("time",), compression=compression)
        for start in range(0, 5000, 1000):
            variable[start : start + 1000] = np.arange(1000.0)
    assert is_whole(path)


def test_netcdf_3_is_not_taken_for_whole(tmp_path: Path) -> None:
    path = tmp_path / "classic.nc"
    dataset().to_netcdf(path, format="NETCDF3_64BIT", engine="scipy")
    assert not is_whole(path)


@given(st.binary(max_size=200))
def test_no_bytes_make_the_check_fail(content: bytes) -> None:
    path = Path("/dev/shm") if Path("/dev/shm").is_dir() else Path.cwd()
    path = path / "equisection-any-bytes.nc"
    try:
        path.write_bytes(content)
        assert not is_whole(path)
        path.write_bytes(b"\x89HDF\r\n\x1a\n" + content)
        assert is_whole(path) in (True, False)
    finally:
        path.unlink(missing_ok=True)


def test_superblock_that_promises_more_than_is_there_is_not_whole(written: Path) -> None:
    content = bytearray(written.read_bytes())
    offset = {0: 40, 1: 44, 2: 28, 3: 28}[content[8]]
    (end,) = struct.unpack_from("<Q", content, offset)
    assert fault_of(written) == ""
    struct.pack_into("<Q", content, offset, end + 1)
    written.write_bytes(content)
    assert fault_of(written) == CUT_SHORT
    struct.pack_into("<Q", content, offset, len(content) + 1)
    written.write_bytes(content)
    assert not is_whole(written)
