"""The exchange with ``lumpedPointMovement`` over named pipes, with no waiting and no hanging.

OpenFOAM (v1912) writes the loads to one file, removes a lock, waits until a lock is there, and
reads the places of the points from another file. Stock, it looks for the lock once a second. Here

- both files are named pipes: opening one waits for the other side, which is all the synchronisation
  that is needed;
- there are two locks, ``OpenFOAM.lock`` and ``OpenFOAM.lock.gz``. OpenFOAM removes the first that
  it finds and goes on if it finds one, so it never waits. The one removed is put back while
  OpenFOAM reads the places of the points: after it has looked, and before it can look again;
- the pipe of the places is closed only when it is open anew for the next ones. OpenFOAM reads the
  lines that it wants and not to the end. If the pipe were closed behind each message, OpenFOAM
  could come for the next places before a busy machine has closed it, and would find its end.

This side opens neither pipe in a way that blocks, so it sees within a moment that the other is
gone. The other side is in a blocking call if this one goes; it ends with it (``process``).
"""

from __future__ import annotations

import errno
import os
import select
import shutil
import time
from collections.abc import Callable
from pathlib import Path

from equisection.errors import SolverError

#: Names in the case's folder.
FOLDER, LOADS, PLACES = "comms", "loads.out", "places.in"
_LOCKS = ("OpenFOAM.lock", "OpenFOAM.lock.gz")
#: Seconds between looks at whether the program still runs, and between tries to open a pipe.
_LOOK, _TRY = 0.1, 1e-4

#: Tells whether the program at the other end still runs.
Alive = Callable[[], bool]


def names() -> dict[str, str]:
    """Return folder and names of the files as ``lumpedPointMovement`` wants them."""
    return {
        "commsDir": f'"{FOLDER}"',
        "inputName": f'"{PLACES}"',
        "outputName": f'"{LOADS}"',
        "logName": '"log"',
    }


class Pipes:
    """The structure's side of the exchange of one run.

    Parameters
    ----------
    case
        Folder of the case. Files that an earlier run left of the exchange are removed.
    silence
        Seconds after which a program that neither hands over loads nor ends counts as hung.
    """

    def __init__(self, case: Path, silence: float) -> None:
        self._folder = case / FOLDER
        self.silence = silence
        shutil.rmtree(self._folder, ignore_errors=True)
        self._folder.mkdir(parents=True)
        for name in (LOADS, PLACES):
            os.mkfifo(self._folder / name)
        # OpenFOAM appends all that is exchanged to a log, which is of no use here
        (self._folder / "log").symlink_to(os.devnull)
        self._lock()
        self._loads = self._open_loads()
        self._places: int | None = None

    def _lock(self) -> None:
        for name in _LOCKS:
            (self._folder / name).touch()

    def _open_loads(self) -> int:
        return os.open(self._folder / LOADS, os.O_RDONLY | os.O_NONBLOCK)

    def close(self) -> None:
        """Close this side."""
        os.close(self._loads)
        self._keep(None)

    def receive(self, alive: Alive) -> str | None:
        """Return the next loads from OpenFOAM; None if it ended instead.

        Parameters
        ----------
        alive
            Tells whether the program still runs.

        Raises
        ------
        SolverError
            The program has been silent for too long.
        """
        poll = select.poll()
        poll.register(self._loads, select.POLLIN)
        parts: list[bytes] = []
        started = time.monotonic()
        while True:
            if not poll.poll(1e3 * _LOOK):
                if not alive():
                    return None
                self._require_sign_of_life(started)
                continue
            part = os.read(self._loads, 1 << 16)
            if part:
                parts.append(part)
            elif parts:
                break
            elif not alive():
                return None
            else:
                time.sleep(_TRY)
        # opened anew, the pipe waits for the next writer instead of telling that the last has gone
        opened = self._open_loads()
        os.close(self._loads)
        self._loads = opened
        return b"".join(parts).decode()

    def send(self, message: str, alive: Alive) -> bool:
        """Hand over the places of the points; return True if OpenFOAM took them.

        Raises
        ------
        SolverError
            The program has been silent for too long.
        """
        started = time.monotonic()
        while True:
            try:
                places = os.open(self._folder / PLACES, os.O_WRONLY | os.O_NONBLOCK)
                break
            except OSError as error:
                if error.errno != errno.ENXIO:
                    raise
            if not alive():
                return False
            self._require_sign_of_life(started)
            time.sleep(_TRY)
        self._keep(places)
        self._lock()
        os.set_blocking(places, True)
        rest = memoryview(message.encode())
        try:
            while rest:
                rest = rest[os.write(places, rest) :]
        except BrokenPipeError:
            return False
        return True

    def _keep(self, places: int | None) -> None:
        """Hold the pipe of the places open by this end, and no longer by the one before it."""
        before, self._places = self._places, places
        if before is not None:
            os.close(before)

    def _require_sign_of_life(self, since: float) -> None:
        if time.monotonic() - since > self.silence:
            raise SolverError(
                f"the solver has exchanged nothing with the structure for {self.silence:g} s and "
                f"was ended; see the logs beside {self._folder}"
            )
