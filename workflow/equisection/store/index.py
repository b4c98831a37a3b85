"""The index of a job's results: file, hash and verdict of each case.

The workflow waits for the index, which is written after all the result files that it names. So a
sweep of thousands of cases is one file to Snakemake, and its summary is made without opening a
result file.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from equisection.errors import ResultFileError
from equisection.files import require_plain_names, write_text

SCHEMA_VERSION = 1


def write_index(
    path: Path,
    attributes: Mapping[str, Mapping[str, Any]],
    missing: Mapping[str, str] | None = None,
) -> None:
    """Write the index into the folder of the result files.

    Parameters
    ----------
    path
        The index; result files are ``<name>.nc`` in the same folder.
    attributes
        Attributes of the result of each case, by the case's name.
    missing
        Reason for a missing result, by the name of the case; these have no file.
    """
    results = {
        name: {key: _plain(value) for key, value in sorted(found.items())}
        for name, found in attributes.items()
    }
    document: dict[str, Any] = {"schema_version": SCHEMA_VERSION, "results": results}
    if missing:
        document["missing"] = dict(missing)
    write_text(path, json.dumps(document, indent=1, allow_nan=False) + "\n")


def read_index(path: Path) -> dict[str, dict[str, Any]]:
    """Return the attributes of each result by the case's name; unknown numbers are NaN.

    Raises
    ------
    ResultFileError
        The file is missing, malformed or of another schema version.
    """
    results = read_with_missing(path)[0].items()
    return {
        name: {key: math.nan if value is None else value for key, value in attributes.items()}
        for name, attributes in results
    }


def read_missing(path: Path) -> dict[str, str]:
    """Return the reason for each missing result of an index, by the name of its case.

    Raises
    ------
    ResultFileError
        As :func:`read_index`.
    """
    return read_with_missing(path)[1]


def read_with_missing(path: Path) -> tuple[dict[str, dict[str, Any]], dict[str, str]]:
    """Return :func:`read_index` and :func:`read_missing` of an index, which is read once."""
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
        found = document["schema_version"]
        results, missing = dict(document["results"]), dict(document.get("missing", {}))
        require_plain_names(results)
        require_plain_names(missing)
    except (
        OSError,
        ValueError,
        KeyError,
        TypeError,
        AttributeError,
        RecursionError,
    ) as error:
        raise ResultFileError(
            f"{path}: cannot be read as an index of results ({error!r}); delete it and run again"
        ) from None
    if found != SCHEMA_VERSION:
        raise ResultFileError(
            f"{path}: schema version {found}; version {SCHEMA_VERSION} is read here. "
            "Delete it and run again"
        )
    return results, missing


def result_file(index: Path, name: str) -> Path:
    """Return the result file of a case."""
    return index.parent / f"{name}.nc"


def result_files(indices: Sequence[Path]) -> list[Path]:
    """Return the result files that some indices name."""
    return [result_file(index, name) for index in indices for name in read_index(index)]


def indices_of_run(run: Path) -> list[Path]:
    """Return the indices of results in the folder of a run, kind by kind."""
    from equisection.cases import KINDS  # noqa: PLC0415, costly for the jobs that make no index

    return [index for kind in KINDS for index in sorted((run / kind).glob("*/*.json"))]


def is_index(path: Path) -> bool:
    """Tell whether a file, by its place in the folder of a run, is an index of results."""
    if path.suffix != ".json" or len(path.parts) != 3:
        return False
    from equisection.cases import KINDS  # noqa: PLC0415, costly for the jobs that make no index

    return path.parts[0] in KINDS


def _plain(value: Any) -> Any:
    """Return a number of the standard library, and None for NaN, which JSON does not know."""
    value = value.item() if hasattr(value, "item") else value
    return None if isinstance(value, float) and not math.isfinite(value) else value
