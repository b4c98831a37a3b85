"""Results read as those of their cases; one that is not is set aside and made anew.

A result may be whole and yet belong to another case, for instance after copying files by hand.
That is seen when it is read, long after Snakemake has decided what to run; so the job that
reads it sets it aside and fails, and the next run makes it anew, from the store if it has it.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import xarray as xr

from equisection.cases.store import case_hash, read_case
from equisection.errors import ResultFileError
from equisection.results.netcdf import read_attributes, read_dataset
from equisection.results.whole import set_aside

Read = TypeVar("Read")


def dataset_of_case(case: Path, result: Path) -> xr.Dataset:
    """Return the result of a case file.

    Raises
    ------
    ResultFileError
        The file is missing, or was set aside since it is not the whole result of the case.
    """
    return _checked(read_dataset, case, result)


def attributes_of_case(case: Path, result: Path) -> dict[str, Any]:
    """Return the attributes of the result of a case file.

    Raises
    ------
    ResultFileError
        As :func:`dataset_of_case`.
    """
    return _checked(read_attributes, case, result)


def _checked(read: Callable[[Path, str], Read], case: Path, result: Path) -> Read:
    wanted = case_hash(read_case(case))
    try:
        return read(result, wanted)
    except ResultFileError as error:
        if not result.exists():
            raise
        aside = set_aside(result)
        raise ResultFileError(
            f"{error} (it is set aside as {aside.name} already: just run again)"
        ) from None
