"""Find results that were cut short, altered, exchanged or lost, and have them made again.

Runs at every start of the workflow, so it must be cheap: the digest of a file's bytes tells, which
takes a millisecond a megabyte; a file is opened only if it is younger than the index that names it.
"""

from __future__ import annotations

import contextlib
import functools
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from equisection.errors import ResultFileError
from equisection.files import TEMPORARY
from equisection.provenance import file_hash
from equisection.results.whole import fault_of
from equisection.store.index import indices_of_run, read_index, result_file
from equisection.store.made_from import FOLDER, ProvenanceRecord, read_record

#: Folder of the case files, which have the places of the indices of their results.
CASES = "cases"
#: Cheap files that jobs make besides results and figures; they are made again if they were edited.
_CHEAP = {".csv", ".json", ".yaml"}
#: Files that a person gives: polars, outlines, tables and histories.
_GIVEN = {".csv", ".dat", ".pol", ".txt"}


@dataclass(frozen=True)
class Unsound:
    """A file of a run that is not to be used.

    Attributes
    ----------
    path
        The file.
    why
        What is wrong with it.
    kept
        Whether it is kept beside as ``<name>.broken``; else it is deleted.
    """

    path: Path
    why: str
    kept: bool

    @property
    def aside(self) -> Path:
        """Name under which it is kept."""
        return self.path.with_name(self.path.name + ".broken")

    def words(self, *, done: bool = True) -> str:
        """Return a line for the terminal; without ``done`` it says what a run would do."""
        if not self.kept:
            return f"{self.path}: {self.why}" + ("" if done else "; a run would make it again")
        if done:
            return f"{self.path}: {self.why}; kept as {self.aside.name}, made again"
        return (
            f"{self.path}: {self.why}; a run would keep it as {self.aside.name} and make it again"
        )

    def put_aside(self) -> None:
        """Rename or delete it, so that the workflow makes it anew."""
        if self.kept:
            self.path.replace(self.aside)
        else:
            self.path.unlink()


def put_aside(found: Sequence[Unsound]) -> list[str]:
    """Put unsound files aside; return a line for each, also where the folder is read-only."""
    lines = []
    for file in found:
        try:
            file.put_aside()
        except OSError as error:
            lines.append(f"{file.words(done=False)} (it cannot here: {error.strerror})")
        else:
            lines.append(file.words())
    return lines


def unsound_files(run: Path) -> list[Unsound]:
    """Find the files of a run's folder that are not to be used.

    They are NetCDF files that are not as they were written; results that were exchanged after the
    index that names them and are not of that case; indices that name a file that is not there, for
    the job that writes one takes sound results from the store; and tables, indices and case files
    that were edited since their job made them, or were made from a file outside of the run in whose
    place another one is of an older time. Files that a job is writing at this moment (``.tmp-...``)
    are left alone.
    """
    found = [
        Unsound(path, fault, kept=True)
        for path in run.glob("**/*.nc")
        if not path.name.startswith(TEMPORARY) and (fault := fault_of(path))
    ]
    found += _edited(run)
    unsound = {file.path for file in found}
    outdated = {file.path: file for file in _outdated(run) if file.path not in unsound}
    found += outdated.values()
    unsound |= outdated.keys()
    for index in indices_of_run(run):
        if run / CASES / index.relative_to(run) in unsound:
            found.append(Unsound(index, "its cases are made again, and so is it", kept=False))
        elif index not in unsound:
            found += _unsound_results(index, unsound)
    return found


def _unsound_results(index: Path, unsound: set[Path]) -> Iterator[Unsound]:
    try:
        results = read_index(index)
    except ResultFileError as error:
        yield Unsound(index, str(error).removeprefix(f"{index}: "), kept=False)
        return
    written = index.stat().st_mtime_ns
    lost = False
    for name, attributes in results.items():
        path = result_file(index, name)
        try:
            exchanged = path.stat().st_mtime_ns > written
        except FileNotFoundError:
            lost = True
            continue
        if path in unsound:
            lost = True
        elif exchanged and not _belongs(path, str(attributes.get("case_hash"))):
            yield Unsound(path, "not the result of its case", kept=True)
            lost = True
    if lost:
        why = "names results that are not there; they are made again"
        yield Unsound(index, why, kept=False)


def _belongs(path: Path, case_hash: str) -> bool:
    from equisection.results.netcdf import read_attributes  # noqa: PLC0415, costly, seldom needed

    try:
        read_attributes(path, case_hash)
    except ResultFileError:
        return False
    return True


def _outdated(run: Path) -> Iterator[Unsound]:
    """Yield the outputs of jobs that were given a file in whose place another one is.

    They are those that are younger than that file, which Snakemake takes for made from it: a copy
    keeps its time (``cp -p``, ``rsync -a``, a clock that was wrong).
    """
    digest_of = functools.cache(file_hash)
    for record in _records(run):
        for name, digest in record.inputs.items():
            given = Path(name)
            of_run = not given.is_absolute() and (run / given).exists()
            if of_run or given.suffix not in _GIVEN or not given.is_file():
                continue
            if digest_of(given) == digest:
                continue
            time = given.stat().st_mtime_ns
            why = f"made from another {given} than there is, whose time is older"
            for output, before in record.outputs.items():
                file = run / output
                # another job may have made it since
                if file.is_file() and time < file.stat().st_mtime_ns and file_hash(file) == before:
                    yield Unsound(file, f"{why}; it is made again", kept=False)


def _edited(run: Path) -> Iterator[Unsound]:
    """Yield the cheap files that differ from the record of the job that made them."""
    for record in _records(run):
        for name, digest in record.outputs.items():
            file = run / name
            if file.suffix in _CHEAP and file.is_file() and file_hash(file) != digest:
                yield Unsound(file, "edited since its job made it", kept=True)


def _records(run: Path) -> Iterator[ProvenanceRecord]:
    """Yield what the jobs of a run made from what."""
    for path in sorted((run / FOLDER).glob("*.json")):
        with contextlib.suppress(ResultFileError):  # 'equisection verify' names it
            yield read_record(path)
