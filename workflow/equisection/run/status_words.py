"""Words for the status of a case or a run, on a terminal and on a page alike."""

from __future__ import annotations

import time
from collections import Counter

from equisection.cases.kinds import TIME
from equisection.run.status import CaseStatus, RunStatus, State
from equisection.store.progress import clock


def state_of(entry: CaseStatus) -> str:
    """Return the state of a case in a word or two, for one that is done its regime."""
    if entry.state == State.RUNNING and entry.job:
        return f"running {100 * entry.job.fraction:.0f} %"
    return entry.regime if entry.state == State.DONE and entry.regime else str(entry.state)


def simulated_of(entry: CaseStatus) -> str:
    """Return the simulated and the longest time of a case (c/V)."""
    if entry.duration is None or entry.simulated is None:
        return ""
    return f"{entry.simulated:.4g} of {entry.duration:.4g}"


def where_of(entry: CaseStatus) -> str:
    """Return job, process and machine of a case that runs; empty for another."""
    if entry.state != State.RUNNING:
        return ""
    process = entry.owner.process if entry.owner else entry.job.process if entry.job else None
    job = f"SLURM job {entry.owner.job}, " if entry.owner and entry.owner.job else ""
    return f"{job}process {process.pid} on {process.host}" if process else ""


def remarks_of(entry: CaseStatus) -> str:
    """Return start and estimated end of a case that runs; the remark on any other."""
    if entry.state == State.RUNNING and entry.job:
        job, end = entry.job, entry.job.estimated_end
        together = f" ({len(job.cases)} cases)" if len(job.cases) > 1 else ""
        until = f", ends about {clock(end)}" if end else ""
        return f"since {clock(job.started)}{until}{together}; {where_of(entry)}"
    if entry.state == State.RUNNING:
        return f"{entry.text}: {where_of(entry)}"
    return "" if entry.state == State.DONE else entry.text


def core_time(seconds: float | None) -> str:
    """Return a time of processors as a person says it: seconds, core minutes, core hours."""
    if seconds is None:
        return "unknown"
    if seconds < 120:
        return f"{seconds:.3g} core seconds"
    if seconds < 7200:
        return f"{seconds / 60:.3g} core minutes"
    return f"{seconds / 3600:.3g} core hours"


def costs_of(run: RunStatus) -> str:
    """Return the processor time that a run has used, and that to come."""
    to_come = run.core_seconds_to_come()
    if to_come == 0.0:
        return f"{core_time(run.core_seconds_used())} used"
    expected = "unknown" if to_come is None else f"{core_time(to_come)} at most"
    return f"{core_time(run.core_seconds_used())} used, to come: {expected}"


def summary(run: RunStatus) -> str:
    """Return the status of a run in one line."""
    if not run.entries:
        return f"{run.name}: no case has been written yet"
    parts = []
    for kind in dict.fromkeys(entry.kind for entry in run.entries):
        of_kind = [entry for entry in run.entries if entry.kind == kind]
        regimes = Counter(e.regime for e in of_kind if e.state == State.DONE and e.regime)
        details = ", ".join(f"{number} {regime}" for regime, number in regimes.items())
        counts = _counts(run.count(kind))
        parts.append(f"{kind.title} {counts}" + (f" ({details})" if details else ""))
    parts.append(costs_of(run))
    end = end_of_what_runs(run)
    if end is not None:
        parts.append(f"what runs now ends about {clock(end)}")
    end = estimated_end(run)
    if end is not None:
        parts.append(f"all of it about {clock(end)}, if as many go on at a time")
    return f"{run.name}: " + "; ".join(parts)


def end_of_what_runs(run: RunStatus) -> float | None:
    """Return the end of the last running job (seconds since the epoch), if it is known."""
    jobs = [entry.job for entry in run.entries if entry.state == State.RUNNING and entry.job]
    return max((end for job in jobs if (end := job.estimated_end) is not None), default=None)


def estimated_end(run: RunStatus) -> float | None:
    """Return the end of the run if the rest goes on at the present rate (seconds since the epoch).

    None where nothing waits, nothing runs, or no rate is known. The cases of one job share its
    rate, and a case ends earlier when its verdict is in.
    """
    waiting = [e for e in run.entries if e.state in (State.WAITING, State.STOPPED)]
    jobs = {
        entry.job.process: entry.job
        for entry in run.entries
        if entry.state == State.RUNNING and entry.job and entry.kind.has_history
    }
    rates = [
        (job.done - job.first_done) / (job.updated - job.first_time)
        for job in jobs.values()
        if job.unit == TIME and job.done > job.first_done and job.updated > job.first_time
    ]
    if not waiting or not rates:
        return None
    left = sum((entry.duration or 0.0) - (entry.simulated or 0.0) for entry in waiting)
    left += sum(job.total - job.done for job in jobs.values())
    return time.time() + left / sum(rates)


def _counts(counts: Counter[State]) -> str:
    total = sum(counts.values())
    if counts[State.DONE] == total:
        return f"all {total} done"
    others = (
        f"{counts[state]} {state}" for state in State if state != State.DONE and counts[state]
    )
    return f"{counts[State.DONE]} of {total} done, " + ", ".join(others)
