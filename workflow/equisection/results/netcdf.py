"""NetCDF files that appear whole or not at all, and describe their contents.

Every variable has ``units`` and ``long_name``. Every file has its schema version, its origin and,
for the result of a case, the case's hash. Attributes are strings and numbers.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import netCDF4
import numpy as np
import xarray as xr

from equisection.errors import ResultFileError
from equisection.files import written_whole
from equisection.provenance import made_by_this
from equisection.results.whole import append_digest, fault_of

SCHEMA_VERSION = 1


def write_dataset(
    path: Path, dataset: xr.Dataset, made_by: Mapping[str, str] | None = None
) -> dict[str, Any]:
    """Write a data set as NetCDF-4, whole or not at all; return its attributes as written.

    Its origin is this process, or else ``made_by`` (:mod:`equisection.provenance`).

    The variables go to the netCDF library one by one: for the thousands of small files of a sweep
    that takes half the time of ``Dataset.to_netcdf``.

    Raises
    ------
    ResultFileError
        A variable lacks ``units`` or ``long_name``, or holds a value that is not finite without
        the attribute ``missing_allowed``; or the file cannot be written.
    """
    for name, variable in dataset.variables.items():
        for wanted in ("units", "long_name"):
            if wanted not in variable.attrs:
                raise ResultFileError(f"{path}: variable '{name}' has no {wanted}")
    _require_finite(path, dataset)
    attributes = {
        **{str(name): value for name, value in dataset.attrs.items()},
        "schema_version": SCHEMA_VERSION,
        **(made_by_this() if made_by is None else made_by),
    }
    try:
        with written_whole(path) as aside:
            with netCDF4.Dataset(aside, "w", format="NETCDF4") as file:
                for dimension, size in dataset.sizes.items():
                    file.createDimension(str(dimension), size)
                for name, variable in dataset.variables.items():
                    _write_variable(file, str(name), variable)
                file.setncatts(attributes)
            append_digest(aside)
    except (OSError, RuntimeError) as error:  # the library does not say why
        raise ResultFileError(
            f"{path}: cannot be written ({error}); the disk may be full: free some space and run "
            "again"
        ) from None
    return attributes


def _write_variable(file: netCDF4.Dataset, name: str, variable: xr.Variable) -> None:
    values = np.asarray(variable.values)
    is_text = values.dtype.kind in "UO"
    written = file.createVariable(
        name, str if is_text else values.dtype, tuple(map(str, variable.dims))
    )
    written.setncatts({str(key): value for key, value in variable.attrs.items()})
    written[...] = values.astype(object) if is_text else values


def read_dataset(path: Path, case_hash: str | None = None) -> xr.Dataset:
    """Read a data set into memory and check that it is whole, finite and of the wanted case.

    Raises
    ------
    ResultFileError
        The file is missing, truncated, not as it was written, of another schema version, of
        another case, or holds values that are not finite.
    """
    _require_sound(path)
    return _load(path, case_hash)


def read_without_digest(path: Path) -> xr.Dataset:
    """Read a data set that has no digest, with all other checks of :func:`read_dataset`.

    Raises
    ------
    ResultFileError
        As :func:`read_dataset`.
    """
    return _load(path, None)


def _load(path: Path, case_hash: str | None) -> xr.Dataset:
    try:
        with xr.open_dataset(path, engine="netcdf4") as opened:
            dataset = opened.load()
    except (OSError, ValueError, RuntimeError) as error:
        raise ResultFileError(
            f"{path}: cannot be read ({error}); delete it and run again"
        ) from None
    _require_provenance(path, dataset.attrs, case_hash)
    _require_finite(path, dataset)
    return dataset


def read_attributes(path: Path, case_hash: str | None = None) -> dict[str, Any]:
    """Read the attributes alone, with the same checks but for the values.

    Raises
    ------
    ResultFileError
        As :func:`read_dataset`.
    """
    _require_sound(path)
    try:
        with netCDF4.Dataset(path) as opened:
            attributes = {name: opened.getncattr(name) for name in opened.ncattrs()}
    except (OSError, RuntimeError) as error:
        raise ResultFileError(
            f"{path}: cannot be read ({error}); delete it and run again"
        ) from None
    _require_provenance(path, attributes, case_hash)
    return attributes


def _require_sound(path: Path) -> None:
    """Refuse a file whose bytes are not as they were written, before the library opens it."""
    if not path.is_file():
        raise ResultFileError(f"{path}: missing; run again")
    fault = fault_of(path)
    if fault:
        raise ResultFileError(f"{path}: {fault}; delete it and run again")


def _require_provenance(path: Path, attributes: dict[str, Any], case_hash: str | None) -> None:
    found = attributes.get("schema_version")
    if found != SCHEMA_VERSION:
        raise ResultFileError(
            f"{path}: schema version {found}; version {SCHEMA_VERSION} is read here. "
            "It was not written by this version of the workflow: delete it and run again"
        )
    if case_hash is not None and attributes.get("case_hash") != case_hash:
        raise ResultFileError(
            f"{path}: foreign: it is the result of case {str(attributes.get('case_hash'))[:12]}, "
            f"wanted is {case_hash[:12]}; delete it and run again"
        )


def _require_finite(path: Path, dataset: xr.Dataset) -> None:
    for name, variable in dataset.variables.items():
        values = variable.values
        if (
            np.issubdtype(values.dtype, np.floating)
            and not variable.attrs.get("missing_allowed")
            and not np.isfinite(values).all()
        ):
            raise ResultFileError(f"{path}: variable '{name}' holds values that are not finite")
