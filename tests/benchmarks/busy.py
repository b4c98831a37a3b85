"""Tests of kills, locks and processes, again and again beside processes that take the machine.

What such a test waits for may come late there. It has to pass all the same, every time.
"""

import contextlib
import os
import signal
import subprocess
import sys
import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.benchmarks.measure import Row
from tests.conftest import ROOT

#: Times that the tests run, and busy processes beside them.
ROUNDS, PROCESSES = 5, 4
#: Tests that kill what they start, wait for it, or look for it; parts run side by side, as those of
#: `make test` do, which makes the machine busier still.
PARTS = {
    "on a cluster": ("tests/slurm",),
    "of runs": ("tests/workflow/test_kills.py", "tests/workflow/test_two_workflows.py"),
    "of programs and processes": (
        "tests/workflow/test_openfoam_faults.py",
        "tests/unit/test_alive.py",
        "tests/unit/test_openfoam_faults.py",
        "tests/unit/test_openfoam_pipes.py",
        "tests/unit/test_openfoam_process.py",
        "tests/unit/test_ownership.py",
        "tests/unit/test_progress.py",
    ),
}
#: Doubles itself twice, so that it is as many busy processes, and ends with the one that it names.
SPIN = "import os, sys\nfor _ in range(2): os.fork()\nwhile True: os.kill(int(sys.argv[1]), 0)"


def rows() -> Iterator[Row]:
    """Run the tests so often; a row for each round of a part, and one for each part."""
    # a shell's background has no interruption, and tests of it would have none
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    with busy(), TemporaryDirectory() as folder, contextlib.ExitStack() as ends:
        running = {name: _Rounds(name, Path(folder)) for name in PARTS}
        for part in running.values():
            ends.callback(part.end)
        while running:
            time.sleep(1.0)
            for name, part in list(running.items()):
                said = part.ended()
                if said:
                    yield Row(f"tests {name}, round {part.done}", said)
                if part.done == ROUNDS:
                    del running[name]
                    what = f"rounds of tests {name}, beside {PROCESSES} busy processes, that pass"
                    yield Row(what, f"{part.passed} of {ROUNDS}", f"{ROUNDS}", part.all_passed)


@contextlib.contextmanager
def busy() -> Iterator[None]:
    """Keep processes busy, in a session of their own as those of another user are."""
    command = [sys.executable, "-c", SPIN, str(os.getpid())]
    spinning = subprocess.Popen(command, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        yield
    finally:
        os.killpg(spinning.pid, signal.SIGKILL)
        spinning.wait()


class _Rounds:
    """Rounds of one part, one after the other."""

    def __init__(self, name: str, folder: Path) -> None:
        self.done = self.passed = 0
        self._tests = PARTS[name]
        self._log = folder / f"{name.replace(' ', '-')}.log"
        print(f"busy: tests {name} are told as they end in {self._log}", file=sys.stderr)
        self._process = self._begun()

    @property
    def all_passed(self) -> bool:
        return self.passed == ROUNDS

    def ended(self) -> str:
        """Return pytest's last line if a round has ended, and begin the next; say what failed."""
        if self._process.poll() is None:
            return ""
        text = self._log.read_text(encoding="utf-8")
        self.done += 1
        if self._process.returncode == 0:
            self.passed += 1
        else:
            print(text[-8000:], file=sys.stderr, flush=True)
        if self.done < ROUNDS:
            self._process = self._begun()
        return text.rstrip().rpartition("\n")[2].strip("= ")

    def end(self) -> None:
        """Interrupt a round, so that it ends what it has started."""
        if self._process.poll() is None:
            os.killpg(self._process.pid, signal.SIGINT)
            self._process.wait()

    def _begun(self) -> subprocess.Popen[bytes]:
        command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-v", *self._tests]
        with self._log.open("wb") as said:
            return subprocess.Popen(
                command,
                cwd=ROOT,
                env={**os.environ, "CI": "true"},  # none is skipped
                stdout=said,
                stderr=subprocess.STDOUT,
                start_new_session=True,
            )
