"""Verification of a run: hashes of all files that its figures and tables are made of.

A case is hashed again from its case file, a result by its content and by the case that it holds,
and each file that a job has made, or made something from, by its content
(:mod:`equisection.store.made_from`). A file that is made from an unsound one is unsound itself.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from pathlib import Path
from typing import Any

from equisection.cases import KINDS
from equisection.errors import ResultFileError
from equisection.files import TEMPORARY
from equisection.keys.shown import printable
from equisection.provenance import file_hash
from equisection.results.netcdf import read_attributes
from equisection.results.whole import fault_of
from equisection.run.listing import Listed, cases_of_run
from equisection.run.status import find_runs
from equisection.store.index import indices_of_run, read_index
from equisection.store.kept import holds_its_case
from equisection.store.made_from import FOLDER, ProvenanceRecord, read_record


class Fault(StrEnum):
    """Fault of a file."""

    STALE = "stale"  # what it was made from has changed since
    FOREIGN = "foreign"  # not what its job made, or not the result of its case
    MISSING = "missing"
    BROKEN = "broken"  # cannot be read


@dataclass
class Verified:
    """Findings on a run, or on a folder of kept results.

    Attributes
    ----------
    name
        The folder.
    checked
        Number of files that were checked.
    faults
        Fault and its reason, by file as seen from the folder.
    unrecorded
        Files without a record of their inputs, made before records were kept.
    makers
        Number of files that each version, with its commit, has made.
    waiting
        Number of cases without a result from which nothing has been made yet.
    """

    name: str
    checked: int = 0
    faults: dict[str, tuple[Fault, str]] = field(default_factory=dict)
    unrecorded: list[str] = field(default_factory=list)
    makers: Counter[str] = field(default_factory=Counter)
    waiting: int = 0

    def find(self, file: str, fault: Fault, why: str) -> None:
        """Note the fault of a file; the first one counts."""
        self.faults.setdefault(file, (fault, why))


_CASE_CHANGED = "its case has changed since it was made; run again"
#: What a run's figures and tables are, and what they are made of, apart from results of cases.
_MADE = (
    *("structure/*.nc", "steady/*.nc"),
    *("comparison/*.csv", "tables/*.csv", "figures/*", "cases/*/*/*.json"),
)


def verify_folder(folder: Path) -> list[Verified]:
    """Check a run, or every run and the kept results in a folder.

    Raises
    ------
    StatusError
        There is no such folder.
    """
    runs = find_runs(folder)
    if runs == [folder]:
        return [verify_run(folder)]
    kept = [path for path in sorted(folder.glob("*")) if path.is_dir() and path not in runs]
    kept = [path for path in kept if not path.name.startswith(".") and any(path.rglob("*.nc"))]
    if not runs and not kept and any(folder.rglob("*.nc")):
        kept = [folder]
    return [*map(verify_run, runs), *map(verify_kept, kept)]


def words(found: Verified) -> list[str]:
    """Return the findings: a line for each fault, then the remarks, then the sum."""
    lines = [
        printable(f"{fault:8}{found.name}/{name}: {why}")
        for name, (fault, why) in sorted(found.faults.items())
    ]
    if found.unrecorded:
        lines.append(
            f"{found.name}: {len(found.unrecorded)} files have no record of what they are made "
            "from: they are copies, or from before records were kept, and judged by the hashes of "
            "cases alone"
        )
    if found.waiting:
        lines.append(f"{found.name}: {found.waiting} cases have no result yet")
    lines += [f"{found.name}: {number} made by {maker}" for maker, number in found.makers.items()]
    sum_of = Counter(str(fault) for fault, _ in found.faults.values())
    what = ", ".join(f"{number} {fault}" for fault, number in sum_of.items()) or "all well"
    return [*lines, f"{found.name}: {found.checked} files checked, {what}"]


def verify_run(run: Path) -> Verified:
    """Check all files that a run's figures and tables are made of."""
    found = Verified(run.name)
    listed = {case.result: case for case in cases_of_run(run)}
    records = [record for record in _records(run, found) if not _left_behind(run, record, listed)]
    made = {name: digest for record in records for name, digest in record.outputs.items()}
    seen = {name: _now(run, name) for name in sorted({*made, *_inputs(records)})}
    as_made = {name for name, digest in made.items() if seen[name] == digest}
    _check_cases(run, found, listed, made, as_made)
    for name, digest in made.items():
        if not seen[name]:
            found.find(name, Fault.MISSING, "a job has made it; run again")
        elif seen[name] != digest:
            found.find(name, Fault.FOREIGN, "it is not as its job has made it; run again")
    for record in records:
        _check_inputs(record, found, seen)
    _spread(records, found)
    _check_others(run, found, {*seen, *listed})
    kept = [*indices_of_run(run), *(path for part in _MADE for path in run.glob(part))]
    there = {path.relative_to(run).as_posix() for path in kept}
    found.unrecorded = sorted(there - set(made))
    found.checked = len({name for name in {*seen, *there} if seen.get(name, True)})
    for record in records:
        found.makers[_maker(record.made_by)] += len(record.outputs)
    return found


def verify_made(run: Path, since: float) -> list[str]:
    """Check what jobs have made in a run since a time, as seconds since the epoch.

    Returns
    -------
    list of str
        A line for each file that is not as its job made it, then the sum; none if no job has made
        anything.
    """
    found, made = Verified(run.name), dict[str, str]()
    for path in (run / FOLDER).glob("*.json"):
        if path.stat().st_mtime >= since:
            for record in _records_in([path], run, found):
                made |= record.outputs
    for name, digest in sorted(made.items()):
        found.checked += 1
        now = _now(run, name)
        fault = fault_of(run / name) if now and name.endswith(".nc") else ""
        if not now:
            found.find(name, Fault.MISSING, "a job has made it; run again")
        elif fault:
            found.find(name, Fault.BROKEN, f"{fault}; run again")
        elif now != digest:
            found.find(name, Fault.FOREIGN, "it is not as its job has made it; run again")
    return words(found) if found.checked or found.faults else []


def verify_kept(folder: Path) -> Verified:
    """Check the results that are kept in a folder, each by the case that it holds."""
    found = Verified(str(folder))
    for path in sorted(folder.rglob("*.nc")):
        name = path.relative_to(folder).as_posix()
        found.checked += 1
        try:
            attributes = read_attributes(path)
        except ResultFileError as error:
            found.find(name, Fault.BROKEN, _without_path(error, path))
            continue
        found.makers[_maker(attributes)] += 1
        if "case" not in attributes:
            found.unrecorded.append(name)
        elif not holds_its_case(attributes):
            found.find(name, Fault.FOREIGN, "the case that it holds is not that of its hash")
    return found


def _records(run: Path, found: Verified) -> Iterator[ProvenanceRecord]:
    return _records_in(sorted((run / FOLDER).glob("*.json")), run, found)


def _records_in(paths: Iterable[Path], run: Path, found: Verified) -> Iterator[ProvenanceRecord]:
    for path in paths:
        try:
            yield read_record(path)
        except ResultFileError as error:
            name = path.relative_to(run).as_posix()
            found.find(name, Fault.BROKEN, _without_path(error, path))


def _inputs(records: list[ProvenanceRecord]) -> set[str]:
    return {name for record in records for name in record.inputs}


def _now(run: Path, name: str) -> str:
    """Return the hash of a file as it is now: of the run, or from where the command is given."""
    inside = file_hash(run / name)
    return inside or file_hash(Path(name))


def _left_behind(run: Path, record: ProvenanceRecord, listed: Mapping[str, Listed]) -> bool:
    """Tell whether a record is of a case of an earlier sweep whose files are gone."""
    swept = tuple(f"{kind.folder}/" for kind in KINDS.values() if kind.of_sweep)
    return bool(record.outputs) and all(
        name.removeprefix("cases/").startswith(swept)
        and f"{name.removeprefix('cases/').rpartition('.')[0]}.nc" not in listed
        and not (run / name).exists()
        for name in record.outputs
    )


def _check_cases(
    run: Path,
    found: Verified,
    listed: Mapping[str, Listed],
    made: Mapping[str, str],
    as_made: set[str],
) -> None:
    """Check each result against its case file, and each index against both."""
    indexed: dict[str, str] = {}
    for path in indices_of_run(run):
        indexed |= _check_index(run, path, listed, found)
    for name, case in listed.items():
        if case.problem:
            found.find(case.file.relative_to(run).as_posix(), Fault.BROKEN, case.problem)
        elif not (run / name).exists():
            if name in indexed or name in made:
                found.find(name, Fault.MISSING, "the result of its case is gone; run again")
            else:
                found.waiting += 1
        elif name not in as_made or name not in indexed:
            _check_result(run / name, name, case.hash, name in as_made, found)
        elif indexed[name] != case.hash:
            found.find(name, Fault.STALE, _CASE_CHANGED)


def _check_others(run: Path, found: Verified, known: set[str]) -> None:
    """Find NetCDF files that are broken among those that no record and no case names."""
    for path in run.glob("**/*.nc"):
        name = path.relative_to(run).as_posix()
        if name in known or path.name.startswith(TEMPORARY):
            continue
        fault = fault_of(path)
        if fault:
            found.find(name, Fault.BROKEN, f"{fault}; delete it, nothing of the run names it")


def _check_index(
    run: Path, path: Path, listed: Mapping[str, Listed], found: Verified
) -> dict[str, str]:
    """Check an index against the case files; return the hash of each case by result file."""
    index = path.relative_to(run)
    try:
        entries = read_index(path)
    except ResultFileError as error:
        found.find(index.as_posix(), Fault.BROKEN, _without_path(error, path))
        return {}
    hashes = {
        (index.parent / f"{name}.nc").as_posix(): str(attributes.get("case_hash"))
        for name, attributes in entries.items()
    }
    changed = [
        Path(name).stem
        for name, digest in hashes.items()
        if name in listed and listed[name].hash != digest
    ]
    if changed:
        why = f"its cases have changed since ({', '.join(changed[:3])}"
        more = f" and {len(changed) - 3} more" if len(changed) > 3 else ""
        found.find(index.as_posix(), Fault.STALE, f"{why}{more}); run again")
    return hashes


def _check_result(path: Path, name: str, wanted: str, as_made: bool, found: Verified) -> None:
    """Check a result by what it says itself, where no index says it of one that is as made."""
    try:
        attributes = read_attributes(path)
    except ResultFileError as error:
        found.find(name, Fault.BROKEN, _without_path(error, path))
        return
    if not holds_its_case(attributes):
        found.find(name, Fault.FOREIGN, "the case that it holds is not that of its hash")
    elif attributes.get("case_hash") != wanted and as_made:
        found.find(name, Fault.STALE, _CASE_CHANGED)
    elif attributes.get("case_hash") != wanted:
        other = str(attributes.get("case_hash"))[:12]
        found.find(name, Fault.FOREIGN, f"it is the result of case {other}, not of its case file")


def _check_inputs(record: ProvenanceRecord, found: Verified, seen: Mapping[str, str]) -> None:
    """Find what was made from a file that has changed since, or is gone."""
    for name, digest in record.inputs.items():
        if not seen[name]:
            found.find(name, Fault.MISSING, f"{_first(record)} was made from it")
        if seen[name] != digest:
            for made in record.outputs:
                found.find(made, Fault.STALE, f"{name} has changed since; run again")


def _spread(records: list[ProvenanceRecord], found: Verified) -> None:
    """Find what was made from what is stale, and from that in turn."""
    before = -1
    while before != len(found.faults):
        before = len(found.faults)
        for record in records:
            unsound = next((name for name in record.inputs if name in found.faults), None)
            for made in record.outputs if unsound else ():
                found.find(made, Fault.STALE, f"made from {unsound}, which is not sound")


def _first(record: ProvenanceRecord) -> str:
    return next(iter(record.outputs), "a file")


def _maker(attributes: Mapping[str, Any]) -> str:
    """Return the version that made a file, with its commit if it says so."""
    commit = str(attributes.get("equisection_commit", ""))
    short = commit[:12] + ("-modified" if commit.endswith("-modified") else "")
    version = f"equisection {attributes.get('equisection_version', 'unknown')}"
    return f"{version} ({f'commit {short}' if short else 'commit not recorded'})"


def _without_path(error: Exception, path: Path) -> str:
    return str(error).removeprefix(f"{path}: ")
