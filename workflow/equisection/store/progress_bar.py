"""The bar of a job on a terminal.

Jobs that run side by side share one terminal and know nothing of each other's cursor: moving
bars overwrite one another and leave scraps behind. So a job that is alone has a moving bar.
Any other writes a line now and then, which stays whole. A job that ends within seconds shows
nothing, so that it does not disturb the workflow's messages about starting jobs.
"""

from __future__ import annotations

import sys
import time

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TextColumn

_TENTHS = 10
#: Seconds before the first sign of a job, and between two lines.
PATIENCE, LINE_INTERVAL = 4.0, 10.0
#: Seconds after which a job that takes long for its next tenth has a line all the same.
LINE_INTERVAL_OF_SLOW_RUN = 600.0


class Bar:
    """The bar of one job."""

    def __init__(self, console: Console, label: str) -> None:
        self._console = console
        self._label = label
        self._moving: Progress | None = None
        self._task = TaskID(0)
        self._started = time.monotonic()
        self._tenth, self._line_time = 0, self._started

    def show(self, fraction: float, words: str, *, alone: bool) -> None:
        """Show a state: ``fraction`` from 0 to 1, and the same in words."""
        if time.monotonic() - self._started < PATIENCE:
            return
        if alone:
            self._move(fraction, words)
        else:
            self.close()
            self._line(fraction, words)

    def close(self) -> None:
        """Take the moving bar away."""
        if self._moving is not None:
            self._moving.stop()
            self._moving = None

    def _move(self, fraction: float, words: str) -> None:
        if self._moving is None:
            self._moving = Progress(
                TextColumn("{task.description}", markup=False),
                BarColumn(bar_width=18),
                TextColumn("{task.fields[words]}", markup=False),
                console=self._console,
                transient=True,
                redirect_stdout=False,
                redirect_stderr=False,
            )
            self._task = self._moving.add_task(self._label, total=1.0, words="")
            self._moving.start()
        self._moving.update(self._task, completed=fraction, words=words)

    def _line(self, fraction: float, words: str) -> None:
        tenth, now = int(fraction * _TENTHS), time.monotonic()
        wanted = LINE_INTERVAL if tenth > self._tenth else LINE_INTERVAL_OF_SLOW_RUN
        if now - self._line_time < wanted:
            return
        self._tenth, self._line_time = tenth, now
        filled = "#" * tenth + "-" * (_TENTHS - tenth)
        # One write with its line break, so that no other job writes in between.
        self._console.file.write(f"{self._label}  [{filled}]  {words}\n")
        self._console.file.flush()


def bar_of_terminal(label: str) -> Bar | None:
    """Return a bar if there is a terminal to show it on."""
    if sys.__stderr__ is None:
        return None
    console = Console(file=sys.__stderr__)
    return Bar(console, label) if console.is_terminal and not console.is_dumb_terminal else None
