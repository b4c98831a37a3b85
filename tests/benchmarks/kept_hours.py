"""Processor time that the kept results took, by run and kind of case.

python -m tests.benchmarks.kept_hours
"""

from collections import defaultdict
from pathlib import Path

from equisection.store.kept import kept_results

if __name__ == "__main__":
    hours: dict[tuple[str, str], float] = defaultdict(float)
    for kept in kept_results(Path("results/reference")):
        run = kept.path.parents[2].name
        hours[run, kept.case["kind"]] += kept.attributes["cpu_seconds"] / 3600
    for (run, kind), value in sorted(hours.items()):
        print(f"{run:30} {kind:9} {value:.2f} h of one core")
