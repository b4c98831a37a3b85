"""Case files: canonical JSON, so that the same case is the same bytes and the same hash.

A case file holds the cases of one job, one or a thousand. Values that all share are written once,
under ``shared``, the others under the name of each case. The hash is that of the whole case, so it
does not depend on the other cases of the file.
"""

from __future__ import annotations

import hashlib
import json
import math
from collections.abc import Mapping
from functools import reduce
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from equisection.cases.case import SCHEMA_VERSION, Case
from equisection.cases.kinds import kind_named, kind_of
from equisection.errors import CaseFileError
from equisection.files import require_plain_names, write_text
from equisection.keys.shown import shown

#: Significant digits of a number in a case. Eigenvectors differ in the last digits from one
#: machine to the next; more digits would ask for new runs without a new case.
SIGNIFICANT_DIGITS = 8
#: Relative difference of two numbers up to which they ask for the same: a fifth of what the loads
#: of a converged steady run, and with them the factors of a correction, are known to.
ALIKE = 1e-4


def canonical(case: Case) -> str:
    """Return the case as canonical JSON: sorted keys, numbers rounded."""
    return json.dumps(_rounded(case.model_dump(mode="json")), sort_keys=True, indent=1) + "\n"


def case_hash(case: Case) -> str:
    """Return the SHA-256 of the canonical case (64 hexadecimal digits)."""
    return hashlib.sha256(canonical(case).encode()).hexdigest()


def history_hash(case: Case) -> str:
    """Return the SHA-256 of all that decides the history of a case: all but the fields that end it.

    Cases that differ in those fields alone have the same history; one is longer than the other.
    """
    values = _rounded(case.model_dump(mode="json", exclude=set(kind_of(case).ends)))
    return hashlib.sha256(json.dumps(values, sort_keys=True).encode()).hexdigest()


def are_alike(one: Any, other: Any, tolerance: float = ALIKE) -> bool:
    """Tell whether two cases, as JSON values, are the same within the scatter between machines.

    Numbers may differ by ``tolerance`` times their size, those of a list by that times its largest.
    From one machine to another the last digits of eigenvectors change, and the iteration at which a
    steady run is found to have converged.
    """
    if isinstance(one, dict) and isinstance(other, dict):
        return one.keys() == other.keys() and all(
            are_alike(one[key], other[key], tolerance) for key in one
        )
    if isinstance(one, list) and isinstance(other, list):
        if one and all(isinstance(value, float) for value in [*one, *other]):
            size = max(map(abs, one))
            return len(one) == len(other) and all(
                math.isclose(a, b, rel_tol=tolerance, abs_tol=tolerance * size)
                for a, b in zip(one, other, strict=True)
            )
        return len(one) == len(other) and all(
            are_alike(a, b, tolerance) for a, b in zip(one, other, strict=True)
        )
    if isinstance(one, float) and isinstance(other, float):
        return math.isclose(one, other, rel_tol=tolerance)
    return bool(one == other)


def write_cases(path: Path, cases: Mapping[str, Case]) -> None:
    """Write the cases of a job under their names, whole or not at all."""
    dumped = {name: _rounded(case.model_dump(mode="json")) for name, case in cases.items()}
    shared = reduce(_common, dumped.values()) if dumped else {}
    document = {
        "schema_version": SCHEMA_VERSION,
        "shared": shared,
        "cases": {name: _without(case, shared) for name, case in dumped.items()},
    }
    write_text(path, json.dumps(document, sort_keys=True, indent=1) + "\n")


def read_cases(path: Path) -> dict[str, Case]:
    """Read a case file: the cases by name, in the order of their names in the file.

    Raises
    ------
    CaseFileError
        The file is missing, malformed, or of another schema version.
    """
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError, RecursionError) as error:
        raise CaseFileError(
            f"{path}: cannot be read as a case file ({error}); delete it and run again"
        ) from None
    found = document.get("schema_version") if isinstance(document, dict) else None
    if found != SCHEMA_VERSION:
        raise CaseFileError(
            f"{path}: schema version {found}; version {SCHEMA_VERSION} is read here. "
            "It was not written by this version of the workflow: delete it and run again"
        )
    try:
        shared, entries = document["shared"], document["cases"]
        require_plain_names(entries)
        return {name: _case(_merged(shared, entries[name])) for name in entries}
    except (KeyError, TypeError, AttributeError):
        raise CaseFileError(
            f"{path}: 'shared' and 'cases' with a case under each name are needed. "
            "It was not written by this version of the workflow: delete it and run again"
        ) from None
    except ValidationError as error:
        problem = error.errors()[0]
        where = ".".join(str(part) for part in problem["loc"])
        raise CaseFileError(
            f"{path}: {where}: {shown(problem['input'])} is nothing that a case has there; delete "
            "it and run again"
        ) from None
    except (CaseFileError, ValueError) as error:
        raise CaseFileError(f"{path}: {error}; delete it and run again") from None


def _case(values: dict[str, Any]) -> Case:
    return kind_named(values["kind"]).case.model_validate(values)


def _common(first: dict[str, Any], second: dict[str, Any]) -> dict[str, Any]:
    """Return what two nested dictionaries have in common."""
    common: dict[str, Any] = {}
    for key in first.keys() & second.keys():
        one, other = first[key], second[key]
        if one == other:
            common[key] = one
        elif isinstance(one, dict) and isinstance(other, dict):
            common[key] = _common(one, other)
    return common


def _without(whole: dict[str, Any], shared: dict[str, Any]) -> dict[str, Any]:
    """Return what a nested dictionary has beyond the shared part."""
    own: dict[str, Any] = {}
    for key, value in whole.items():
        if key not in shared:
            own[key] = value
        elif value != shared[key]:
            own[key] = _without(value, shared[key])
    return own


def _merged(shared: dict[str, Any], own: dict[str, Any]) -> dict[str, Any]:
    merged = dict(shared)
    for key, value in own.items():
        inside = shared.get(key)
        if isinstance(value, dict) and isinstance(inside, dict):
            merged[key] = _merged(inside, value)
        else:
            merged[key] = value
    return merged


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return float(f"{value:.{SIGNIFICANT_DIGITS}g}") + 0.0
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_rounded(item) for item in value]
    return value
