"""Records of each job's inputs and outputs: their SHA-256, in ``provenance/`` of the run.

Snakemake has such records for itself, on the machine where it ran. These go with the folder of the
run, and ``equisection verify`` judges by them. They are no outputs of rules: nothing runs because
of them.
"""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass
from pathlib import Path

from equisection.errors import ResultFileError
from equisection.files import write_text
from equisection.provenance import file_hash, made_by_this
from equisection.results.spent import cpu_seconds_so_far
from equisection.store.index import is_index, result_files

FOLDER = "provenance"


@dataclass(frozen=True)
class ProvenanceRecord:
    """Record of one job.

    Attributes
    ----------
    made_by
        Version, commit, configuration and command.
    inputs, outputs
        SHA-256 by file: those of the run as seen from its folder, others from the folder in which
        the workflow was started. An index comes with the results that it names.
    cpu_seconds
        Time that the job took of all its processors (s).
    """

    made_by: dict[str, str]
    inputs: dict[str, str]
    outputs: dict[str, str]
    cpu_seconds: float


def write_record(log: Path, inputs: Iterable[Path], outputs: Iterable[Path]) -> None:
    """Write the record of a job into the run whose ``logs`` hold its log."""
    run, given, made = log.parent.parent, set(inputs), set(outputs)
    for index in [path for path in made if is_index(path.relative_to(run))]:
        made.update(set(result_files([index])) - given)
    record = ProvenanceRecord(
        made_by_this(), _hashes(given, run), _hashes(made, run), cpu_seconds_so_far()
    )
    write_text(run / FOLDER / f"{log.stem}.json", json.dumps(asdict(record), indent=1) + "\n")


def read_record(path: Path) -> ProvenanceRecord:
    """Read the record of a job.

    Raises
    ------
    ResultFileError
        The file is no record.
    """
    try:
        raw = json.loads(path.read_text(encoding="utf-8"))
        made_by, inputs, outputs = (dict(raw[name]) for name in ("made_by", "inputs", "outputs"))
        for table in (made_by, inputs, outputs):
            if not all(isinstance(text, str) for text in (*table, *table.values())):
                raise TypeError("not a table of texts")
        return ProvenanceRecord(made_by, inputs, outputs, float(raw["cpu_seconds"]))
    except (OSError, ValueError, KeyError, TypeError, RecursionError) as error:
        raise ResultFileError(
            f"{path}: cannot be read as a record of what a job has made ({error!r}); delete it"
        ) from None


def recorded(run: Path) -> dict[str, set[str]]:
    """Return the SHA-256 that files of a run had when jobs made them, by name seen from there.

    A file may be the output of several records: of a rule that had another name before.
    """
    found: dict[str, set[str]] = {}
    for path in (run / FOLDER).glob("*.json"):
        with contextlib.suppress(ResultFileError):  # 'equisection verify' names it
            for name, digest in read_record(path).outputs.items():
                found.setdefault(name, set()).add(digest)
    return found


def require_as_made(run: Path, path: Path, made: Mapping[str, set[str]]) -> None:
    """Refuse a file of a run that differs from all records of it; one without a record passes.

    Parameters
    ----------
    run
        Folder of the run.
    path
        The file, in that folder.
    made
        What :func:`recorded` returns for the run.

    Raises
    ------
    ResultFileError
        The file was edited.
    """
    digests = made.get(path.relative_to(run).as_posix())
    if digests and file_hash(path) not in digests:
        raise ResultFileError(f"{path}: edited since its job made it; run again to make it anew")


def _hashes(paths: Iterable[Path], run: Path) -> dict[str, str]:
    """Return the hash of each file, by its name seen from the run if it is the run's."""
    return {
        (path.relative_to(run) if path.is_relative_to(run) else path).as_posix(): file_hash(path)
        for path in sorted(paths)
    }
