"""Digests for results that have none, as they are from before digests or of another program."""

from __future__ import annotations

import multiprocessing
import shutil
from collections.abc import Iterator, Sequence
from multiprocessing.pool import Pool
from pathlib import Path

from equisection.errors import ResultFileError
from equisection.files import TEMPORARY, written_whole
from equisection.results.netcdf import read_without_digest
from equisection.results.whole import WITHOUT_DIGEST, append_digest, fault_of
from equisection.store.kept import holds_its_case

#: How long a damaged file may keep the HDF5 library busy (s).
PATIENCE = 300.0


def seal(places: Sequence[Path]) -> Iterator[tuple[Path, str]]:
    """Write digests to the NetCDF files that have none, after all else about them was checked.

    The values themselves nobody can check: whoever calls this vouches for them.

    Parameters
    ----------
    places
        Files, and folders of which every NetCDF file is meant.

    Yields
    ------
    Path
        A file that had no digest, or that is broken.
    str
        What is wrong with it; empty if it has its digest now.

    Raises
    ------
    ResultFileError
        A place is not there.
    """
    with _ReaderApart() as reader:
        for path in _files(places):
            fault = fault_of(path)
            if fault == WITHOUT_DIGEST:
                fault = reader.fault(path)
                if not fault:
                    with written_whole(path) as aside:
                        shutil.copyfile(path, aside)
                        append_digest(aside)
                yield path, fault
            elif fault:
                yield path, fault


def _files(places: Sequence[Path]) -> Iterator[Path]:
    for place in places:
        if not place.exists():
            raise ResultFileError(f"{place}: not there; give a file or a folder of results")
        found = sorted(place.rglob("*.nc")) if place.is_dir() else [place]
        yield from (path for path in found if not path.name.startswith(TEMPORARY))


class _ReaderApart:
    """Reads files in a process of its own, which a damaged file may take down."""

    def __enter__(self) -> _ReaderApart:
        self._pool: Pool | None = None
        return self

    def __exit__(self, *exception: object) -> None:
        self._stop()

    def fault(self, path: Path) -> str:
        """Return what is wrong with the content of a file; empty if nothing is."""
        if self._pool is None:
            self._pool = multiprocessing.get_context("spawn").Pool(1)
        try:
            return self._pool.apply_async(_fault_of_content, (path,)).get(PATIENCE)
        except multiprocessing.TimeoutError:
            self._stop()
            return f"cannot be read within {PATIENCE:.0f} s"

    def _stop(self) -> None:
        if self._pool is not None:
            self._pool.terminate()
            self._pool.join()
        self._pool = None


def _fault_of_content(path: Path) -> str:
    try:
        attributes = read_without_digest(path).attrs
    except Exception as error:  # the library raises anything on a damaged file
        return str(error).removeprefix(f"{path}: ")
    return "" if holds_its_case(attributes) else "the case that it holds is not that of its hash"
