"""One line in the place of a traceback, where what a command reads is not there."""

from collections.abc import Iterator
from contextlib import contextmanager

from equisection.errors import EquisectionError


@contextmanager
def needed(first: str) -> Iterator[None]:
    """End with what is not there, and what makes it.

    Parameters
    ----------
    first
        What is to be run first.
    """
    try:
        yield
    except (EquisectionError, OSError) as error:
        raise SystemExit(f"error: {error}; first: {first}") from None
