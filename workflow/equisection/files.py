"""Files that appear whole or not at all: written aside, then renamed."""

from __future__ import annotations

import os
import re
import shutil
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

#: How the names of files begin that are not whole yet.
TEMPORARY = ".tmp-"


@contextmanager
def written_whole(path: Path) -> Iterator[Path]:
    """Yield a path in the folder of ``path`` to write to; rename it to ``path`` at the end.

    The temporary file has the same suffix, since some writers choose a format by it. It is
    removed if the block raises, and left behind only by a kill.
    """
    path.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=TEMPORARY, suffix=path.suffix, dir=path.parent)
    os.close(handle)
    aside = Path(name)
    try:
        yield aside
        aside.chmod(0o666 & ~_umask())
        aside.replace(path)
    finally:
        aside.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Write a text file, whole or not at all."""
    with written_whole(path) as aside:
        aside.write_text(text, encoding="utf-8")


def second_name(path: Path, further: Path) -> None:
    """Give a file a second name; where the file system has none, copy the file."""
    with written_whole(further) as aside:
        aside.unlink()
        try:
            os.link(path, aside)
        except OSError:
            shutil.copyfile(path, aside)


def holds_more_than(folder: Path, most: int) -> bool:
    """Tell whether a folder holds more files and folders than so many, at any depth.

    Links are not followed, and what may not be read counts as empty. The search ends with one more
    than ``most``, however large the folder is.
    """
    found, waiting = 0, [str(folder)]
    while waiting:
        try:
            with os.scandir(waiting.pop()) as entries:
                for entry in entries:
                    found += 1
                    if found > most:
                        return True
                    if entry.is_dir(follow_symlinks=False):
                        waiting.append(entry.path)
        except OSError:
            continue
    return False


#: Names of files that stay in their folder, whatever reads them.
_PLAIN_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_.+-]*")


def require_plain_names(names: Iterable[str]) -> None:
    """Refuse names read from a file that would lead out of their folder.

    Raises
    ------
    ValueError
        A name does, or would be more than a name to a shell.
    """
    for name in names:
        if not _PLAIN_NAME.fullmatch(name) or len(name) > 200:
            raise ValueError(
                f"{name[:60]!r}: no name of a case; allowed are letters, digits and '_.+-'"
            )


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
