"""Progress files and logs that the jobs of a run write."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from equisection.keys.shown import printable
from equisection.store.progress import SUFFIX, Snapshot, read_snapshot

#: Lines of a log that are shown of what failed.
LINES = 5


class JobsOfRun:
    """Progress files and logs of a run."""

    def __init__(self, run: Path) -> None:
        self._folder = run / "logs"
        self._errors: dict[Path, str] = {}
        self._asked: set[Path] = set()
        self._logs = {path.name: path.stat().st_mtime for path in self._folder.glob("*.log")}
        self._time_of = cache(lambda path: path.stat().st_mtime)
        self._of_case: dict[str, Snapshot] = {}
        for path in self._folder.glob("*" + SUFFIX):
            snapshot = read_snapshot(path)
            for case in snapshot.cases if snapshot else ():
                before = self._of_case.get(case)
                if snapshot and (before is None or before.updated < snapshot.updated):
                    self._of_case[case] = snapshot

    def of(self, hash_of_case: str) -> Snapshot | None:
        """Return the progress of the last job that ran a case."""
        return self._of_case.get(hash_of_case)

    def error(self, place: str, case: Path) -> tuple[str, Path | None]:
        """Return the error with which a case's last job ended, if it did, and the job's log.

        A log older than the case file is that of an earlier case of the same name.
        """
        job = place.replace("/", "_")
        logs = [f"{job}_{case.stem}.log", f"{job}.log"]
        kind, _, model = place.partition("/")
        if model.startswith("2d"):
            logs.append(f"{kind}_sections_{case.stem}.log")
        there = [self._folder / name for name in logs if name in self._logs]
        if not there:
            return "", None
        log = max(there, key=lambda path: self._logs[path.name])
        self._asked.update(there)
        if self._logs[log.name] < self._time_of(case):
            return "", None
        return self._error_of(log), log

    def troubles(self) -> list[str]:
        """Return the errors of the jobs that run no case, each with its log."""
        logs = sorted(set(self._folder.glob("*.log")) - self._asked)
        found = ((path, self._error_of(path)) for path in logs)
        return [f"{path}: {error}" for path, error in found if error]

    def _error_of(self, log: Path) -> str:
        if log not in self._errors:
            self._errors[log] = last_error(log)
        return self._errors[log]


def last_error(log: Path) -> str:
    """Return the message of the last error in a log; for a fault of the program its last line."""
    try:
        lines = log.read_text(encoding="utf-8", errors="replace").splitlines()
    except OSError:
        return ""
    numbers = [number for number, line in enumerate(lines) if " ERROR " in line[:40]]
    if not numbers:
        return ""
    after = [line for line in lines[numbers[-1] :] if line.strip()]
    if any(line.startswith("Traceback") for line in after):
        return f"a fault of the program: {after[-1].strip()} (see {log})"
    return after[0].split(" ERROR ", 1)[1]


def last_warning(log: Path | None) -> str:
    """Return the message of the last warning in the log of a job; empty if there is none."""
    try:
        text = log.read_text(encoding="utf-8", errors="replace") if log else ""
    except OSError:
        return ""
    found = [line for line in text.splitlines() if " WARNING " in line[:40]]
    return found[-1].split(" WARNING ", 1)[1] if found else ""


def last_lines(work: Path, log: Path | None) -> tuple[str, ...]:
    """Return the last lines of the newest log: of a program in the working directory, or the job's.

    The log of a program may be long, so only its end is read.
    """
    logs = [*work.glob("log.*"), *([log] if log else [])]
    try:
        newest = max(logs, key=lambda path: path.stat().st_mtime, default=None)
        if newest is None:
            return ()
        with newest.open("rb") as stream:
            stream.seek(max(0, newest.stat().st_size - 4096))
            text = stream.read().decode("utf-8", errors="replace")
    except OSError:
        return ()
    lines = [printable(line) for line in text.splitlines() if line.strip()]
    return (f"{newest}:", *lines[-LINES:])
