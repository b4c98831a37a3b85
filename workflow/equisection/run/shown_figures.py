"""Figures of a run: what there is, and a viewer for it."""

from __future__ import annotations

import os
import shutil
import sys
import webbrowser
from collections.abc import Sequence
from pathlib import Path

from equisection.errors import EquisectionError

#: Folder of the figures in that of a run, and the format that is shown.
FIGURES, SHOWN = "figures", ".png"


class NoFigureError(EquisectionError):
    """A run has no figure of that name."""


def figures_of(run: Path, names: Sequence[str] = ()) -> list[Path]:
    """Return the pictures of a run, all of them or those of some names.

    Raises
    ------
    NoFigureError
        There is no such folder, no figure yet, or none of a name.
    """
    if not run.is_dir():
        raise NoFigureError(f"{run}: no such folder; 'equisection status' lists the runs")
    there = {
        path.stem: path for path in sorted((run / FIGURES).glob(f"*{SHOWN}")) if path.is_file()
    }
    if not there:
        raise NoFigureError(
            f"{run / FIGURES}: no figure yet; 'equisection status {run}' says how far the run is"
        )
    unknown = [name for name in names if name not in there]
    if unknown:
        raise NoFigureError(f"{run}: no figure {unknown[0]!r}; there are {', '.join(there)}")
    return [there[name] for name in names or there]


def copied(pictures: Sequence[Path], folder: Path) -> list[Path]:
    """Copy pictures, in every format that there is, to a folder; return the copies.

    Raises
    ------
    NoFigureError
        The folder cannot be written to.
    """
    copies = []
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for picture in pictures:
            for one in sorted(picture.parent.glob(f"{picture.stem}.*")):
                copies.append(Path(shutil.copy2(one, folder / one.name)))
    except OSError as error:
        raise NoFigureError(f"{folder}: cannot be written to ({error})") from None
    return copies


def has_display() -> bool:
    """Tell whether this session can open a window."""
    if sys.platform in ("darwin", "win32"):
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def opened(pictures: Sequence[Path]) -> bool:
    """Open pictures in the viewer of this session; return False where there is none."""
    if not has_display():
        return False
    return all(webbrowser.open(picture.resolve().as_uri()) for picture in pictures)
