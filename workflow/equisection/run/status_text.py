"""The status of runs as a table for a person, or as lines for a pipe."""

from __future__ import annotations

from collections.abc import Iterable
from datetime import datetime

from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from equisection.run.status import CaseStatus, RunStatus, State
from equisection.run.status_words import remarks_of, simulated_of, state_of, summary, where_of
from equisection.study.axes import Point

#: Columns of the plain form.
PLAIN_COLUMNS = (
    *("run", "model", "case", "state", "regime", "percent", "since", "estimated_end"),
    *("simulated", "duration", "core_seconds_used", "core_seconds_to_come", "where", "text"),
)
#: Cases up to which a table lists all; of more, those that are neither done nor waiting.
LONGEST_TABLE = 200
#: Failed and stopped cases of which the last lines of a log are printed.
MOST_LOGS = 5
_STYLES = {
    State.DONE: "green",
    State.FAILED: "red",
    State.RUNNING: "cyan",
    State.STOPPED: "yellow",
    State.STALE: "yellow",
    State.BROKEN: "red",
    State.WAITING: "dim",
}


def plain_lines(runs: Iterable[RunStatus]) -> list[str]:
    """Return one line for each case, tab separated, after one with the names of the columns."""
    lines = ["\t".join(PLAIN_COLUMNS)]
    for run in runs:
        for entry in run.entries:
            job = entry.job if entry.state == State.RUNNING else None
            fields = (
                run.name,
                entry.model,
                entry.case,
                str(entry.state),
                entry.regime,
                f"{100 * job.fraction:.1f}" if job else "",
                _iso(job.started if job else None),
                _iso(job.estimated_end if job else None),
                _digits(entry.simulated),
                _digits(entry.duration),
                _digits(entry.core_seconds_used),
                _digits(entry.core_seconds_to_come),
                where_of(entry),
                " ".join(entry.text.split()),
            )
            lines.append("\t".join(fields))
    return lines


def print_status(console: Console, run: RunStatus) -> None:
    """Print the table of a run, the errors outside of its cases, and its summary."""
    shown = [e for e in run.entries if e.kind.has_history or e.state != State.DONE]
    if len(shown) > LONGEST_TABLE:
        of_no_note = (State.DONE, State.WAITING)
        listed = [entry for entry in shown if entry.state not in of_no_note]
        left_out = f"{len(shown) - len(listed)} cases that are done or waiting are not listed"
        shown = listed
    else:
        left_out = ""
    if shown:
        console.print(_table(run.name, shown))
    _print_logs(console, shown)
    for trouble in run.troubles:
        console.print(f"[red]{escape(trouble)}[/red]", soft_wrap=True)
    if left_out:
        console.print(f"{left_out}; 'equisection status --plain' lists all", soft_wrap=True)
    console.print(summary(run), highlight=False, soft_wrap=True)


def _print_logs(console: Console, entries: list[CaseStatus]) -> None:
    """Print the last lines of the logs of what failed or stopped."""
    with_log = [entry for entry in entries if entry.last_lines]
    for entry in with_log[:MOST_LOGS]:
        console.print(f"[bold]{escape(f'{entry.model} {entry.case}')}[/bold]")
        for line in entry.last_lines:
            console.print(f"  {escape(line)}", soft_wrap=True)
    if len(with_log) > MOST_LOGS:
        console.print(f"and the logs of {len(with_log) - MOST_LOGS} more")


def _table(title: str, entries: list[CaseStatus]) -> Table:
    table = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)
    table.add_column("model", no_wrap=True)
    table.add_column(_heading(entries), justify="right", no_wrap=True)
    table.add_column("state", no_wrap=True)
    table.add_column("c/V", justify="right", no_wrap=True)
    table.add_column("remarks", overflow="fold")
    before = ""
    for entry in entries:
        if before and entry.model != before:
            table.add_section()
        style = "magenta" if entry.regime == "growing" else _STYLES[entry.state]
        table.add_row(
            entry.model if entry.model != before else "",
            _place(entry),
            f"[{style}]{state_of(entry)}[/{style}]",
            simulated_of(entry),
            escape(remarks_of(entry)),
        )
        before = entry.model
    return table


def _heading(entries: Iterable[CaseStatus]) -> str:
    """Return the axes along which the cases of the sweep are, the heading of their column."""
    axes = [axis for entry in entries if (point := _point(entry)) for axis in point.axes]
    return ", ".join(axis.heading for axis in dict.fromkeys(axes)) or "case"


def _place(entry: CaseStatus) -> str:
    """Return where a case of the sweep is along these axes, or the name of another case."""
    point = _point(entry)
    return ", ".join(f"{value:g}" for _, value in point.values) if point else entry.case


def _point(entry: CaseStatus) -> Point | None:
    """Return the point of a case of the sweep; none of a name that is none of it."""
    try:
        return Point.named(entry.case) if entry.kind.of_sweep else None
    except ValueError:
        return None


def _iso(seconds: float | None) -> str:
    return (
        ""
        if seconds is None
        else datetime.fromtimestamp(seconds).astimezone().isoformat("T", "seconds")
    )


def _digits(value: float | None) -> str:
    return "" if value is None else f"{value:.6g}"
