"""Processes that a test waits for: by what they do, and not by the clock."""

import time
from collections.abc import Callable

#: Seconds after which what is waited for will not come any more, on a machine that is busy too.
LONG = 3600.0


def wait_until(condition: Callable[[], object]) -> None:
    """Wait for a condition."""
    end = time.monotonic() + LONG
    while not condition():
        assert time.monotonic() < end, f"not within {LONG:g} s"
        time.sleep(0.05)
