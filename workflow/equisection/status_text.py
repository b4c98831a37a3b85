"""The status of runs as a table for a person, or as lines for a pipe."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from datetime import datetime

from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table

from equisection.progress import clock
from equisection.status import Entry, RunStatus, State

#: Columns of the plain form.
PLAIN_COLUMNS = (
    "run",
    "model",
    "case",
    "state",
    "regime",
    "percent",
    "since",
    "estimated_end",
    "text",
)
_STYLES = {
    State.DONE: "green",
    State.FAILED: "red",
    State.RUNNING: "cyan",
    State.STOPPED: "yellow",
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
                " ".join(entry.text.split()),
            )
            lines.append("\t".join(fields))
    return lines


def print_status(console: Console, run: RunStatus) -> None:
    """Print the table of a run, what went wrong beside it, and its summary."""
    shown = [entry for entry in run.entries if not entry.steady or entry.state != State.DONE]
    if shown:
        console.print(_table(run.name, shown))
    for trouble in run.troubles:
        console.print(f"[red]{escape(trouble)}[/red]", soft_wrap=True)
    console.print(summary(run), highlight=False, soft_wrap=True)


def summary(run: RunStatus) -> str:
    """Return how far a run is in one line."""
    if not run.entries:
        return f"{run.name}: no case has been written yet"
    parts = []
    steady, sweep = run.count(steady=True), run.count(steady=False)
    if steady:
        parts.append(f"steady {_counts(steady)}")
    if sweep:
        regimes = Counter(e.regime for e in run.entries if e.state == State.DONE and e.regime)
        details = ", ".join(f"{number} {regime}" for regime, number in regimes.items())
        parts.append(f"sweep {_counts(sweep)}" + (f" ({details})" if details else ""))
    jobs = [entry.job for entry in run.entries if entry.state == State.RUNNING and entry.job]
    ends = [end for job in jobs if (end := job.estimated_end) is not None]
    if ends:
        parts.append(f"what runs now ends about {clock(max(ends))}")
    return f"{run.name}: " + "; ".join(parts)


def _table(title: str, entries: list[Entry]) -> Table:
    table = Table(title=title, title_justify="left", title_style="bold", box=box.SIMPLE_HEAD)
    for name, justify in (("model", "left"), ("k*", "right"), ("state", "left")):
        table.add_column(name, justify=justify, no_wrap=True)  # type: ignore[arg-type]
    table.add_column("remarks", overflow="fold")
    before = ""
    for entry in entries:
        if before and entry.model != before:
            table.add_section()
        style = "magenta" if entry.regime == "growing" else _STYLES[entry.state]
        table.add_row(
            entry.model if entry.model != before else "",
            entry.case.removeprefix("k"),
            f"[{style}]{_state(entry)}[/{style}]",
            escape(_what(entry)),
        )
        before = entry.model
    return table


def _state(entry: Entry) -> str:
    if entry.state == State.RUNNING and entry.job:
        return f"running {100 * entry.job.fraction:.0f} %"
    return entry.regime if entry.state == State.DONE and entry.regime else str(entry.state)


def _what(entry: Entry) -> str:
    if entry.state == State.RUNNING and entry.job:
        job, end = entry.job, entry.job.estimated_end
        together = f" ({len(job.cases)} cases)" if len(job.cases) > 1 else ""
        return (
            f"since {clock(job.started)}" + (f", ends about {clock(end)}" if end else "") + together
        )
    return "" if entry.state == State.DONE else entry.text


def _counts(counts: Counter[State]) -> str:
    total = sum(counts.values())
    if counts[State.DONE] == total:
        return f"all {total} done"
    others = (
        f"{counts[state]} {state}" for state in State if state != State.DONE and counts[state]
    )
    return f"{counts[State.DONE]} of {total} done, " + ", ".join(others)


def _iso(seconds: float | None) -> str:
    if seconds is None:
        return ""
    return datetime.fromtimestamp(seconds).astimezone().isoformat(timespec="seconds")
