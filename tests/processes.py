"""Processes that a test waits for: by what they do, and not by the clock."""

import fcntl
import os
import sys
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


def narrow_pipe() -> tuple[int, int]:
    """Return the ends of a pipe in which one piece of text has room until it is read (Linux)."""
    if sys.platform != "linux":
        return os.pipe()
    read, write = os.pipe2(os.O_DIRECT | os.O_CLOEXEC)  # each piece is a packet of its own
    fcntl.fcntl(write, fcntl.F_SETPIPE_SZ, os.sysconf("SC_PAGE_SIZE"))
    return read, write
