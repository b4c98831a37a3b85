"""Find results that were cut short, exchanged or lost, and have them made again.

Runs at every start of the workflow, so it must be cheap: sizes, times and the first bytes of the
files tell; a file is opened only if it is younger than the index that names it.
"""

from __future__ import annotations

from pathlib import Path

from equisection.errors import ResultFileError
from equisection.files import TEMPORARY
from equisection.results.whole import is_whole
from equisection.store.index import indices_of_run, read_index, result_file


def mend(run: Path) -> list[str]:
    """Put aside broken files of a run's folder, so that the workflow makes them anew.

    A NetCDF file that is not as long as it says, or that was exchanged after the index that
    names it and is not the result of that case, is renamed to ``<name>.broken``. An index that
    names a file that is not there is deleted: the job that writes it runs again and takes sound
    results from the store. Files that a job is writing at this moment (``.tmp-...``) are left
    alone, so that a dry run does not disturb a run.

    Returns
    -------
    list of str
        One line for each file put aside or deleted, for the terminal.
    """
    done = []
    for path in run.glob("**/*.nc"):
        if not path.name.startswith(TEMPORARY) and not is_whole(path):
            done.append(_set_aside(path, "truncated or not NetCDF-4"))
    for index in indices_of_run(run):
        done += _mend_results(index)
    return done


def _mend_results(index: Path) -> list[str]:
    try:
        results = read_index(index)
    except ResultFileError as error:
        index.unlink()
        return [str(error)]
    done = []
    written = index.stat().st_mtime_ns
    lost = False
    for name, attributes in results.items():
        path = result_file(index, name)
        try:
            exchanged = path.stat().st_mtime_ns > written
        except FileNotFoundError:
            lost = True
            continue
        if exchanged and not _belongs(path, str(attributes.get("case_hash"))):
            done.append(_set_aside(path, "not the result of its case"))
            lost = True
    if lost:
        index.unlink()
        done.append(f"{index}: names results that are not there; they are made again")
    return done


def _belongs(path: Path, case_hash: str) -> bool:
    from equisection.results.netcdf import read_attributes  # noqa: PLC0415, costly, seldom needed

    try:
        read_attributes(path, case_hash)
    except ResultFileError:
        return False
    return True


def _set_aside(path: Path, why: str) -> str:
    aside = path.with_name(path.name + ".broken")
    path.replace(aside)
    return f"{path}: {why}; kept as {aside.name}, made again"
