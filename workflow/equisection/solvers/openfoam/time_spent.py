"""Time that the programs of a case took, by their logs, over all starts including killed ones."""

from __future__ import annotations

import re
from pathlib import Path

from equisection.results.spent import Spent

#: Where a program begins, and what it says of its time at each step.
_START = re.compile(rb"^Exec +: ", re.MULTILINE)
_RANKS = re.compile(rb"^nProcs +: (\d+)", re.MULTILINE)
_TIMES = re.compile(rb"^ExecutionTime = ([\d.e+]+) s +ClockTime = ([\d.e+]+) s", re.MULTILINE)


def spent(folder: Path) -> Spent:
    """Return the time that programs took whose logs (``log.*``) are below a folder."""
    processors = clock = 0.0
    for log in sorted(folder.rglob("log.*")):
        for start in _START.split(log.read_bytes())[1:]:
            times, ranks = _TIMES.findall(start), _RANKS.search(start)
            if times:
                processors += float(times[-1][0]) * (int(ranks[1]) if ranks else 1)
                clock += float(times[-1][1])
    return Spent(processors, clock)
