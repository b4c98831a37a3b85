"""Results that are kept with the project, so that they need not be computed again.

They are the results of cases as a run leaves them, one file each, found by the hash of the case or,
where the file has the case itself, by the case.
"""

from __future__ import annotations

import hashlib
import json
import logging
import shutil
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import Any

from equisection.cases import KINDS, STEADY, Case, are_alike, canonical
from equisection.cases.kinds import ends_of
from equisection.errors import ResultFileError
from equisection.files import written_whole
from equisection.results.failures import failure_of
from equisection.results.netcdf import read_attributes

logger = logging.getLogger(__name__)

#: Meshes of section and plate in the folder of a run, which are results of no case.
SECTION_MESH = Path(STEADY.folder, "section_mesh.nc")
PLATE_MESH = Path(STEADY.folder, "plate_mesh.nc")


@dataclass(frozen=True)
class Kept:
    """A result that is kept, with its attributes."""

    path: Path
    attributes: dict[str, Any]

    @property
    def end_time(self) -> float:
        """Length of the history (c/V); 0 of a case without one."""
        return float(self.attributes.get("end_time", 0.0))

    @cached_property
    def case(self) -> dict[str, Any]:
        """The case, empty where the file does not have it."""
        found: dict[str, Any] = json.loads(self.attributes.get("case", "{}"))
        return found


def kept_of(kept: Iterable[Kept], case: Case) -> Iterator[Kept]:
    """Yield the kept results whose case is this one within the scatter between machines."""
    wanted = json.loads(canonical(case))
    return (one for one in kept if are_alike(one.case, wanted))


def with_history_of(kept: Iterable[Kept], case: Case) -> Iterator[Kept]:
    """Yield those whose case is this one in the same way but for the end of its history."""
    wanted = _without_end(json.loads(canonical(case)))
    return (one for one in kept if are_alike(_without_end(one.case), wanted))


def _without_end(case: dict[str, Any]) -> dict[str, Any]:
    return {key: value for key, value in case.items() if key not in ends_of(case)}


def kept_results(folder: Path) -> list[Kept]:
    """Return the whole results of cases below a folder that have not failed, the longest first."""
    found = []
    for path in sorted(folder.rglob("*.nc")):
        attributes = _attributes(path)
        if attributes.get("case_hash") and not failure_of(attributes):
            found.append(Kept(path, attributes))
    return sorted(found, key=lambda kept: -kept.end_time)


def keep_results(run: Path, folder: Path) -> list[Path]:
    """Copy the results of a run's cases, and its section mesh, to a folder laid out as the run.

    Returns
    -------
    list of Path
        The copies of results; a failed case is none, for it may be cured.

    Raises
    ------
    ResultFileError
        The run has no result of a case.
    """
    copies = []
    for kind in KINDS:
        for path in sorted((run / kind).rglob("*.nc")):
            attributes = _attributes(path)
            is_mesh = path in (run / SECTION_MESH, run / PLATE_MESH)
            if is_mesh or (attributes.get("case_hash") and not failure_of(attributes)):
                copy = folder / path.relative_to(run)
                copy.parent.mkdir(parents=True, exist_ok=True)
                with written_whole(copy) as aside:
                    shutil.copyfile(path, aside)
                copies += [] if is_mesh else [copy]
    if not copies:
        raise ResultFileError(f"{run}: no result of a case to keep; give the folder of a run")
    return copies


def kept_mesh(folder: Path, name: Path, case: Case, **attributes: Any) -> Path | None:
    """Return the first mesh of a name below a folder that is of a rigid case, if there is one.

    Parameters
    ----------
    folder
        Folder with what is kept.
    name
        :data:`SECTION_MESH` or :data:`PLATE_MESH`.
    case
        The case, which the file holds as its attribute ``mesh_of``.
    **attributes
        Further attributes that the file has to have, with their values.
    """
    wanted = json.loads(canonical(case))
    for path in sorted(folder.rglob(str(name))):
        found = _attributes(path)
        if are_alike(json.loads(found.get("mesh_of", "{}")), wanted) and all(
            found.get(name) == value for name, value in attributes.items()
        ):
            return path
    return None


def holds_its_case(attributes: Mapping[str, Any]) -> bool:
    """Tell whether the case that a result holds has its hash; True if it holds none."""
    case = attributes.get("case")
    return case is None or (
        hashlib.sha256(str(case).encode()).hexdigest() == attributes.get("case_hash")
    )


def _attributes(path: Path) -> dict[str, Any]:
    """Return a file's attributes; none of what is broken, which a warning names."""
    try:
        return read_attributes(path)
    except ResultFileError as error:
        logger.warning("%s; it is left out", str(error).removesuffix("; delete it and run again"))
        return {}
