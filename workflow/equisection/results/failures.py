"""Failed cases: the reason in the attributes of a result, and the warning of a job."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from equisection.results.unsteady_result import Regime


def failure_of(attributes: Mapping[str, Any]) -> str:
    """Return the reason why a case failed, from its result's attributes; empty if it did not."""
    if attributes.get("regime") == Regime.FAILED:
        return str(attributes.get("reason", "")) or "no reason is given"
    return str(attributes.get("failure", ""))


def warning_of(results: Mapping[str, Mapping[str, Any]], output: Path) -> str:
    """Return the warning of the failed cases of a job, in one line for the terminal.

    Parameters
    ----------
    results
        Attributes of each result by the name of its case.
    output
        The job's output, which holds the results.
    """
    failures = {name: failure_of(attributes) for name, attributes in results.items()}
    failed = [f"{name}: {failure}" for name, failure in failures.items() if failure]
    if not failed:
        return ""
    return (
        f"{len(failed)} of {len(results)} in {output} failed, the other cases go on; to try again, "
        f"delete that file and run again. {failed[0]}"
    )
