"""Runs that are alive in a working directory, so that no other takes their lock away.

Snakemake's lock names no process, and ``snakemake --unlock`` removes it whoever has it. So each run
writes its process to a small file beside the locks, and removes it at its end. A run that was
killed leaves it behind, and is seen to be gone.
"""

from __future__ import annotations

import atexit
import contextlib
import json
import time
from collections.abc import Iterator, Sequence
from dataclasses import asdict
from pathlib import Path

from equisection.files import write_text
from equisection.store.progress import Process, clock, require_times

#: Folder of the files, in the working directory.
FOLDER = Path(".snakemake") / "equisection"
_UNLOCK = "--unlock"
#: Options with which ``snakemake`` only looks, as they are written in most cases.
_LOOKS = frozenset({"-n", "-np", "--dry-run", "--dryrun", "--lint", "--list", "--summary", "--dag"})


def unlocks(arguments: Sequence[str]) -> bool:
    """Tell whether a ``snakemake`` command removes locks; it takes abbreviations of its options."""
    return any(len(one) > len("--un") and _UNLOCK.startswith(one) for one in arguments)


def announce(arguments: Sequence[str]) -> None:
    """Say that this process runs the workflow here, until it ends.

    Nothing is written by a command that only looks, nor where nothing can be written.
    """
    if unlocks(arguments) or _LOOKS & set(arguments):
        return
    this = Process.this()
    path = FOLDER / f"{this.host}-{this.pid}.json"
    with contextlib.suppress(OSError):
        for gone in [place for place, process, _ in _runs() if process.lives() is False]:
            gone.unlink(missing_ok=True)
        write_text(path.absolute(), json.dumps({**asdict(this), "since": time.time()}))
        atexit.register(path.absolute().unlink, missing_ok=True)


def refusal_to_unlock(arguments: Sequence[str]) -> str:
    """Return why the locks must stay; empty if they need not, or nothing unlocks.

    Of a run on another machine nothing is known; it is not asked for.
    """
    if not unlocks(arguments):
        return ""
    for _, process, since in _runs():
        if process.lives():
            return (
                f"error: process {process.pid} runs the workflow here since {clock(since)}: "
                "without its lock a second run could write the same files; wait for its end, or "
                f"end it ('kill {process.pid}'), and unlock then"
            )
    return ""


def elsewhere(arguments: Sequence[str]) -> Iterator[str]:
    """Yield a line for each run on another machine whose lock is removed, and forget it."""
    for path, process, since in _runs() if unlocks(arguments) else ():
        if process.lives() is None:
            yield (
                f"warning: process {process.pid} on {process.host} has run the workflow here since "
                f"{clock(since)}, and cannot be asked from here: make sure that it has ended"
            )
            with contextlib.suppress(OSError):
                path.unlink()


def _runs() -> Iterator[tuple[Path, Process, float]]:
    """Give file, process and start (seconds since the epoch) of each run that is noted here."""
    for path in sorted(FOLDER.glob("*.json")):
        with contextlib.suppress(OSError, ValueError, KeyError, TypeError, RecursionError):
            raw = json.loads(path.read_text(encoding="utf-8"))
            since = float(raw.pop("since"))
            require_times(since)
            yield path, Process(**raw), since
