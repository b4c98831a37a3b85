"""Frame of every script around its ``main``: a log, and errors in words for a person."""

from __future__ import annotations

import errno
import logging
import os
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path

from equisection.errors import EquisectionError
from equisection.store.made_from import write_record

#: No space left on the device, quota exceeded, file too large.
_FULL = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)


@contextmanager
def logged(log: str, inputs: Iterable[str] = (), outputs: Iterable[str] = ()) -> Iterator[None]:
    """Send the log of the block to a file; end with status 1 on an error a user can mend.

    Outputs of the block, if any, are recorded with their hashes and those of its inputs.

    An error that a user can mend, such as a full disk, is printed and logged as its message alone.
    Any other is a fault of the program and keeps its traceback, in the log and on the terminal.
    """
    path = Path(log)
    path.parent.mkdir(parents=True, exist_ok=True)
    logging.basicConfig(
        filename=path,
        filemode="w",
        level=logging.INFO,
        format="%(asctime)s %(levelname)s %(message)s",
        force=True,
    )
    logging.raiseExceptions = False  # a log without space must not hide what was to stand in it
    try:
        yield
        made = [Path(name) for name in outputs]
        if made:
            write_record(path, map(Path, inputs), made)
    except Exception as error:
        message = _message(error)
        if message:
            logging.getLogger(__name__).error("%s", message)
            print(f"error: {message}", file=sys.stderr)
            raise SystemExit(1) from None
        logging.getLogger(__name__).exception("a fault of the program")
        raise


def _message(error: Exception) -> str:
    """Return what a person is told of an error; nothing of a fault of the program."""
    if isinstance(error, EquisectionError):
        return str(error)
    # copying a folder raises an error that holds those of its files as text
    if isinstance(error, OSError) and any(os.strerror(code) in str(error) for code in _FULL):
        return (
            "the disk is full, or a limit on it reached; free some space and run again, what is "
            f"finished is kept ({str(error)[:300]})"
        )
    return ""
