"""Results on a shared file system whose locks fail, as HDF5 asks for them."""

import fcntl
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import pytest
import xarray as xr

from equisection.results.netcdf import read_dataset, write_dataset

DATA = xr.Dataset({"twist": ((), 0.5, {"units": "rad", "long_name": "twist"})})
#: What a program does that leaves HDF5 its locks.
AS_IT_COMES = "import sys, netCDF4; netCDF4.Dataset(sys.argv[1])"


def test_files_are_written_and_read_where_no_lock_is_to_be_had(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every file is locked by another from its first moment on, so that a lock would be refused."""
    made, held = tempfile.mkstemp, []

    def locked(**options: object) -> tuple[int, str]:
        handle, name = made(**options)  # type: ignore[call-overload]
        held.append(os.open(name, os.O_RDWR))
        fcntl.flock(held[-1], fcntl.LOCK_EX)
        return handle, name

    monkeypatch.setattr(tempfile, "mkstemp", locked)
    path = tmp_path / "result.nc"
    write_dataset(path, DATA)
    assert float(read_dataset(path)["twist"]) == 0.5

    environment = {name: text for name, text in os.environ.items() if "HDF5" not in name}
    refused = subprocess.run(
        [sys.executable, "-c", AS_IT_COMES, str(path)],
        env=environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert refused.returncode != 0, "the lock was none; the test shows nothing"
    for handle in held:
        os.close(handle)
