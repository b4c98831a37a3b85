"""Processes that a test has to find, since it did not start them itself."""

import contextlib
import time
from collections.abc import Callable
from pathlib import Path

import psutil


def process_in(folder: Path, seconds: float = 30.0) -> psutil.Process:
    """Return the process that runs in a folder, for instance the solver of a case, once it does.

    Its log may be there before it is.
    """
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        for process in psutil.process_iter():
            with contextlib.suppress(psutil.Error):
                if Path(process.cwd()) == folder:
                    return process
        time.sleep(0.02)
    raise AssertionError(f"nothing runs in {folder} within {seconds:g} s")


def wait_until(condition: Callable[[], object], seconds: float) -> None:
    """Wait for a condition."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, f"not within {seconds:g} s"
        time.sleep(0.1)
