"""Runs of OpenFOAM's programs, one at a time: log followed, faults reported, none left behind."""

from __future__ import annotations

import contextlib
import ctypes
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import IO

from equisection.config.groups.openfoam_keys import refused_path
from equisection.errors import SolverError
from equisection.solvers.openfoam.dictionaries import STOP_FILE
from equisection.solvers.openfoam.installation import Installation

#: Seconds between two looks at a log.
INTERVAL = 0.2
#: Seconds without a new line in the log after which a program counts as hung.
SILENCE = 900.0
#: Lines of a fault that reach the user.
_LINES = 12
#: Bytes left on a disk that counts as full: less than any state that is written.
_FULL = 2**16
_TIME = re.compile(rb"^Time = ([-+0-9.eE]+)", re.MULTILINE)
#: Stands in the log behind each step that was computed.
_STEP_DONE = b"ExecutionTime = "

#: Loaded before a process is made of this one, in which nothing can be loaded safely.
_LIBC = ctypes.CDLL(None) if sys.platform == "linux" else None

#: Called with the latest time in the log; true ends the run at the end of a step.
Watch = Callable[[float], bool]
#: Called with what tells whether a program runs, and with what asks it to end.
Serve = Callable[[Callable[[], bool], Callable[[], None]], None]


class Every:
    """Tells whether an interval has passed since it last did."""

    def __init__(self, interval: float, start: float = 0.0) -> None:
        self._interval = interval
        self._last = start

    def is_due(self, now: float) -> bool:
        """Tell whether it is time."""
        if now < self._last + self._interval:
            return False
        self._last = now
        return True


class BlowUpError(SolverError):
    """The flow or the mesh broke down: a result of the case, not a fault of the machine."""


def run_program(
    installation: Installation,
    program: str,
    folder: Path,
    watch: Watch | None = None,
    *,
    silence: float = SILENCE,
    arguments: Sequence[str] = (),
    ranks: int = 1,
) -> None:
    """Run a program in a case to its end, or until ``watch`` says so.

    On more than one rank the case is one that ``decomposePar`` has divided. The program's output
    is appended to ``log.<program>`` in the case.

    Raises
    ------
    BlowUpError
        It ended with a floating-point exception, or gave up after steps that went well.
    SolverError
        It could not start, ended with any other fault, or its log has been silent for too long.
    """

    def follow(process: subprocess.Popen[bytes], log: Path, start: int) -> None:
        _follow(process, log, start, watch, silence)

    _run(installation, [*installation.command(program, ranks), *arguments], program, folder, follow)


def run_beside(
    installation: Installation, program: str, folder: Path, serve: Serve, *, ranks: int = 1
) -> None:
    """Run a program in a case together with a function that exchanges data with it.

    Parameters
    ----------
    serve
        Called with a function that tells whether the program still runs, and one that ends it at
        the end of a step; it returns when the program has ended.

    Raises
    ------
    BlowUpError
        The program ended with a floating-point exception.
    SolverError
        It could not start or ended with a fault.
    """

    def follow(process: subprocess.Popen[bytes], log: Path, start: int) -> None:
        del start
        serve(lambda: process.poll() is None, (log.parent / STOP_FILE).touch)

    _run(installation, installation.command(program, ranks), program, folder, follow)


def _run(
    installation: Installation,
    command: Sequence[str],
    program: str,
    folder: Path,
    follow: Callable[[subprocess.Popen[bytes], Path, int], None],
) -> None:
    refusal = refused_path(folder)
    if refusal:
        raise SolverError(refusal)
    log = folder / f"log.{program}"
    stop = folder / STOP_FILE
    stop.unlink(missing_ok=True)
    start = log.stat().st_size if log.exists() else 0
    with log.open("ab") as output, _started(installation, command, folder, output) as process:
        follow(process, log, start)
        status = process.wait()
    stop.unlink(missing_ok=True)
    if status != 0:
        raise _fault(program, status, log, start)


@contextmanager
def _started(
    installation: Installation, command: Sequence[str], folder: Path, output: IO[bytes]
) -> Iterator[subprocess.Popen[bytes]]:
    """Start a program, and leave none of it behind whatever ends the block."""
    try:
        process = subprocess.Popen(
            command,
            cwd=folder,
            env=installation.variables(),
            stdin=subprocess.DEVNULL,
            stdout=output,
            stderr=subprocess.STDOUT,
            start_new_session=True,
            # the job's other thread only touches a file, and holds nothing that is needed here
            preexec_fn=_die_with_parent,  # noqa: PLW1509
        )
    except OSError as error:
        raise SolverError(f"{' '.join(command)} does not start: {error}") from None
    try:
        yield process
    finally:
        if process.poll() is None:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            process.wait()


def _die_with_parent() -> None:
    """Ask the system (Linux) to end this process with the one that started it."""
    if _LIBC is not None:
        _LIBC.prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG


def _follow(
    process: subprocess.Popen[bytes],
    log: Path,
    start: int,
    watch: Watch | None,
    silence: float,
) -> None:
    """Read the log as it grows until the program ends; hand each new time to ``watch``."""
    heard = time.monotonic()
    tail = b""
    with log.open("rb") as lines:
        lines.seek(start)
        while process.poll() is None:
            with contextlib.suppress(subprocess.TimeoutExpired):
                process.wait(INTERVAL)
            new = lines.read()
            if not new:
                if _is_full(log.parent):
                    raise SolverError(f"{_disk_is_full(log.parent)}; see {log}")
                if time.monotonic() - heard > silence:
                    raise SolverError(
                        f"{log.name.removeprefix('log.')} has said nothing for {silence:g} s and "
                        f"was ended; see {log}"
                    )
                continue
            heard = time.monotonic()
            tail += new
            times = _TIME.findall(tail)
            tail = tail[-200:]
            if times and watch is not None and watch(float(times[-1])):
                (log.parent / STOP_FILE).touch()
                watch = None


def _is_full(folder: Path) -> bool:
    return shutil.disk_usage(folder).free < _FULL


def _disk_is_full(folder: Path) -> str:
    return (
        f"the disk of {folder} is full; free some space and run again, the case goes on from its "
        "last whole state"
    )


def _fault(program: str, status: int, log: Path, start: int) -> SolverError:
    """Return what went wrong, in the words of the log.

    A program that gives up with a ``FOAM FATAL ERROR`` in a step, after steps that went well in
    this start or an earlier one, was set up rightly: the case went where it cannot be computed.
    Before the first step, or in reading and writing files (``FOAM FATAL IO ERROR``), it is a fault
    of the set-up or the machine.
    """
    whole = log.read_bytes()
    said = whole[start:].decode(errors="replace")
    fatal = said.rfind("FOAM FATAL")
    words = f"status {status}" if status >= 0 else f"signal {-status}"
    words = f"ended with {words}: {' / '.join(said.strip().splitlines()[-3:])[: _LINES * 50]}"
    if fatal >= 0:
        words = " / ".join(line.strip() for line in said[fatal:].splitlines() if line.strip())
        words = words[: _LINES * 50]
    if _is_full(log.parent):
        return SolverError(f"{_disk_is_full(log.parent)} ({program}: {words}); see {log}")
    if fatal >= 0:
        in_a_step = _STEP_DONE in whole and _TIME.search(whole, start) is not None
        gave_up = said.startswith("FOAM FATAL ERROR", fatal) and in_a_step
        return (BlowUpError if gave_up else SolverError)(f"{program}: {words}; see {log}")
    if "sigFpe" in said or status in (-signal.SIGFPE, 128 + signal.SIGFPE):
        return BlowUpError(f"{program}: floating-point exception; see {log}")
    return SolverError(f"{program} {words}; see {log}")
