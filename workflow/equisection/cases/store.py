"""Case files: canonical JSON, so that the same case is the same bytes and the same hash."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field, TypeAdapter, ValidationError

from equisection.cases.model import SCHEMA_VERSION, Case
from equisection.errors import CaseFileError
from equisection.files import write_text

#: Significant digits of a number in a case. Eigenvectors differ in the last digits from one
#: machine to the next; more digits would ask for new runs without a new case.
SIGNIFICANT_DIGITS = 8

_CASE: TypeAdapter[Case] = TypeAdapter(Annotated[Case, Field(discriminator="kind")])


def canonical(case: Case) -> str:
    """Return the case as canonical JSON: sorted keys, numbers rounded."""
    return json.dumps(_rounded(case.model_dump(mode="json")), sort_keys=True, indent=1) + "\n"


def case_hash(case: Case) -> str:
    """Return the SHA-256 of the canonical case (64 hexadecimal digits)."""
    return hashlib.sha256(canonical(case).encode()).hexdigest()


def write_case(path: Path, case: Case) -> None:
    """Write the case file, whole or not at all."""
    write_text(path, canonical(case))


def read_case(path: Path) -> Case:
    """Read a case file.

    Raises
    ------
    CaseFileError
        The file is missing, malformed, or of another schema version.
    """
    try:
        raw = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, json.JSONDecodeError) as error:
        raise CaseFileError(
            f"{path}: cannot be read as a case ({error}); delete it and run again"
        ) from None
    found = raw.get("schema_version") if isinstance(raw, dict) else None
    if found != SCHEMA_VERSION:
        raise CaseFileError(
            f"{path}: schema version {found}; version {SCHEMA_VERSION} is read here. "
            "It was not written by this version of the workflow: delete it and run again"
        )
    try:
        return _CASE.validate_python(raw)
    except ValidationError as error:
        problem = error.errors()[0]
        where = ".".join(str(part) for part in problem["loc"])
        raise CaseFileError(f"{path}: {where}: {problem['msg']}; delete it and run again") from None


def _rounded(value: Any) -> Any:
    if isinstance(value, float):
        return float(f"{value:.{SIGNIFICANT_DIGITS}g}") + 0.0
    if isinstance(value, dict):
        return {key: _rounded(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_rounded(item) for item in value]
    return value
