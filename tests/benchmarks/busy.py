"""Tests of kills, locks and processes, again and again beside processes that take the machine.

What such a test waits for may come late there. It has to pass all the same, every time.
"""

import contextlib
import os
import subprocess
import sys
from collections.abc import Iterator

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


def rows() -> Iterator[Row]:
    """Run the tests so often; a row for each round, and one for all."""
    passed = 0
    with busy(PROCESSES):
        for number in range(1, ROUNDS + 1):
            ended = one_round()
            passed += ended.returncode == 0
            last = ended.stdout.rstrip().rpartition("\n")[2].strip("= ")
            yield Row(f"round {number} of tests that kill and wait", last)
    what = f"rounds beside {PROCESSES} busy processes that pass"
    yield Row(what, f"{passed} of {ROUNDS}", f"{ROUNDS}", passed == ROUNDS)


@contextlib.contextmanager
def busy(number: int) -> Iterator[None]:
    """Keep so many processes busy."""
    spinning = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(number)]
    try:
        yield
    finally:
        for process in spinning:
            process.kill()
            process.wait()


def one_round() -> subprocess.CompletedProcess[str]:
    """Run the tests once; say what failed."""
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-q", *TESTS]
    ended = subprocess.run(
        command,
        cwd=ROOT,
        env={**os.environ, "CI": "true"},  # none is skipped
        capture_output=True,
        text=True,
        check=False,
    )
    if ended.returncode:
        print(ended.stdout[-5000:], file=sys.stderr, flush=True)
    return ended
