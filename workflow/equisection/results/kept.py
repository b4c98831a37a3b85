"""Results that are kept with the project, so that whoever has it need not compute them again.

They are the results of cases as a run leaves them, one file each, found by the case's hash.
"""

from __future__ import annotations

import shutil
from pathlib import Path

from equisection.errors import ResultFileError
from equisection.files import written_whole
from equisection.results.netcdf import read_attributes

#: Where a run has the results of its cases.
_KINDS = ("steady", "unsteady")


def kept_results(folder: Path) -> dict[str, Path]:
    """Return the whole results below a folder by the hash of their case."""
    found = {}
    for path in sorted(folder.rglob("*.nc")):
        case_hash = _case_hash(path)
        if case_hash:
            found[case_hash] = path
    return found


def keep_results(run: Path, folder: Path) -> list[Path]:
    """Copy the results of a run's cases to a folder, laid out as in the run.

    Returns
    -------
    list of Path
        The copies; a failed case is none, for it may be cured.

    Raises
    ------
    ResultFileError
        The run has no result of a case.
    """
    copies = []
    for kind in _KINDS:
        for path in sorted((run / kind).rglob("*.nc")):
            if _case_hash(path) and not _has_failed(path):
                copy = folder / path.relative_to(run)
                copy.parent.mkdir(parents=True, exist_ok=True)
                with written_whole(copy) as aside:
                    shutil.copyfile(path, aside)
                copies.append(copy)
    if not copies:
        raise ResultFileError(f"{run}: no result of a case to keep; give the folder of a run")
    return copies


def _case_hash(path: Path) -> str:
    """Return the hash of a result's case; empty for what is none or is broken."""
    try:
        return str(read_attributes(path).get("case_hash", ""))
    except ResultFileError:
        return ""


def _has_failed(path: Path) -> bool:
    attributes = read_attributes(path)
    return attributes.get("regime") == "failed" or bool(attributes.get("failure"))
