"""Tests of kills, locks and processes, again and again beside processes that take the machine.

What such a test waits for may come late there. It has to pass all the same, every time.
"""

import contextlib
import os
import signal
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.benchmarks.measure import Row
from tests.conftest import ROOT

#: Times that the tests run, and busy processes beside them.
ROUNDS, PROCESSES = 5, 4
#: Tests that kill what they start, wait for it, or look for it.
TESTS = (
    "tests/slurm",
    "tests/workflow/test_kills.py",
    "tests/workflow/test_openfoam_faults.py",
    "tests/workflow/test_two_workflows.py",
    "tests/unit/test_alive.py",
    "tests/unit/test_openfoam_faults.py",
    "tests/unit/test_openfoam_pipes.py",
    "tests/unit/test_openfoam_process.py",
    "tests/unit/test_ownership.py",
    "tests/unit/test_progress.py",
)


#: Doubles itself twice, so that it is as many busy processes, and ends with the one that it names.
SPIN = "import os, sys\nfor _ in range(2): os.fork()\nwhile True: os.kill(int(sys.argv[1]), 0)"


def rows() -> Iterator[Row]:
    """Run the tests so often; a row for each round, and one for all."""
    passed = 0
    with busy(), TemporaryDirectory() as folder:
        for number in range(1, ROUNDS + 1):
            good, last = one_round(Path(folder) / f"round{number}.log")
            passed += good
            yield Row(f"round {number} of the tests that kill and wait", last)
    what = f"rounds beside {PROCESSES} busy processes that pass"
    yield Row(what, f"{passed} of {ROUNDS}", f"{ROUNDS}", passed == ROUNDS)


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


def one_round(log: Path) -> tuple[bool, str]:
    """Run the tests once; return whether all pass, and pytest's last line. Say what failed."""
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-v", *TESTS]
    print(f"busy: tests are told as they end in {log}", file=sys.stderr, flush=True)
    with log.open("w", encoding="utf-8") as said:
        environment = {**os.environ, "CI": "true"}  # none is skipped
        ended = subprocess.run(
            command, cwd=ROOT, env=environment, stdout=said, stderr=subprocess.STDOUT, check=False
        )
    text = log.read_text(encoding="utf-8")
    if ended.returncode:
        print(text[-8000:], file=sys.stderr, flush=True)
    return ended.returncode == 0, text.rstrip().rpartition("\n")[2].strip("= ")
