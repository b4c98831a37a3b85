"""Progress of a run as nobody watches it, and as somebody does who ends it."""

from collections.abc import Callable


def nothing(done: float, total: float) -> None:
    """Take no notice of the progress of a run."""
    del done, total


def interrupt_after(time: float) -> Callable[[float, float], None]:
    """Return what ends a run as an interruption from the keyboard does, at ``time`` (c/V)."""

    def tell(done: float, total: float) -> None:
        del total
        if done >= time:
            raise KeyboardInterrupt

    return tell
