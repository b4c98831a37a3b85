"""The folder of one OpenFOAM run: made whole once, cleaned of half-written states, resumed."""

from __future__ import annotations

import shutil
from pathlib import Path

from equisection.files import write_text

#: Stands in a folder whose set-up is whole; without it the folder is made anew.
_READY = "set-up-is-whole"
#: Every file of OpenFOAM's ends with a line of these.
_END = b"// *****"
#: Fields that an unsteady run starts from, and those that a laminar one does not have.
_FIELDS, OF_TURBULENCE = ("U", "p", "k", "omega", "nut", "phi"), ("k", "omega", "nut")


def is_ready(folder: Path) -> bool:
    """Tell whether a folder's set-up is whole."""
    return (folder / _READY).is_file()


def emptied(folder: Path) -> Path:
    """Remove all that a folder holds, and return the folder."""
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def mark_ready(folder: Path) -> None:
    """Mark the set-up of a folder as whole."""
    write_text(folder / _READY, "")


def states(folder: Path) -> list[Path]:
    """Return the folders of the times written, in their order."""
    found = []
    for path in folder.iterdir():
        try:
            found.append((float(path.name), path))
        except ValueError:
            continue
    return [path for _, path in sorted(found)]


def drop_broken_states(folder: Path) -> float:
    """Remove states that a kill left half-written; return the time of the last whole one."""
    for state in reversed(states(folder)):
        if float(state.name) == 0.0 or _is_whole(state):
            return float(state.name)
        shutil.rmtree(state)
    return 0.0


def drop_states_after(folder: Path, time: float) -> None:
    """Remove states later than a time."""
    for state in states(folder):
        if float(state.name) > time:
            shutil.rmtree(state)


def drop_histories_after(folder: Path, time: float) -> None:
    """Remove histories of starts later than the one that comes, which go by their order."""
    for path in folder.glob("postProcessing/*/*"):
        try:
            later = float(path.name) > time
        except ValueError:
            continue
        if later:
            shutil.rmtree(path)


def _is_whole(state: Path) -> bool:
    files = [path for path in state.rglob("*") if path.is_file()]
    wanted = {*_fields(state.parent), "time"}
    return wanted <= {path.name for path in files} and all(map(_has_end, files))


def _fields(folder: Path) -> list[str]:
    """Return the fields of a run, by those that it set out with."""
    return [
        name for name in _FIELDS if name not in OF_TURBULENCE or (folder / "0" / name).is_file()
    ]


def _has_end(path: Path) -> bool:
    with path.open("rb") as opened:
        opened.seek(max(0, path.stat().st_size - 200))
        return _END in opened.read()


def copy_flow(source: Path, target: Path) -> None:
    """Copy the mesh and the last state of a run to time 0 of another."""
    shutil.copytree(source / "constant", target / "constant", dirs_exist_ok=True)
    shutil.copytree(source / "0", target / "0", dirs_exist_ok=True)
    last = states(source)[-1]
    for name in _fields(source):
        shutil.copyfile(last / name, target / "0" / name)
