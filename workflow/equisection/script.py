"""What every script needs around its ``main``: a log, and errors that speak to a person."""

from __future__ import annotations

import logging
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from equisection.errors import EquisectionError


@contextmanager
def logged(log: str) -> Iterator[None]:
    """Send the log of the block to a file; end with status 1 on an error a user can mend.

    Such an error is printed and logged as its message alone. Anything else is a fault of the
    program and keeps its traceback, in the log and on the terminal.
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
    try:
        yield
    except EquisectionError as error:
        logging.getLogger(__name__).error("%s", error)
        print(f"error: {error}", file=sys.stderr)
        raise SystemExit(1) from None
    except Exception:
        logging.getLogger(__name__).exception("a fault of the program")
        raise
