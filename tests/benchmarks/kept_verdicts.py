"""Verdicts on all kept releases, one a line: to be printed before and after a change of the rules.

python -m tests.benchmarks.kept_verdicts > before.csv
"""

import math
from collections.abc import Iterator
from pathlib import Path

from equisection.results.netcdf import read_dataset
from equisection.solvers.verdicts import decided_at, judge
from equisection.store.judged_again import tip_motion
from tests.benchmarks.early_verdict import case_of
from tests.workflow.project import ROOT

KEPT = ROOT / "results" / "reference"


def line(path: Path) -> str:
    """Return first look with a verdict, that verdict, and the one on the whole history."""
    known = read_dataset(path)
    case, motion = case_of(known), tip_motion(known)
    first = decided_at(case, motion)
    early = judge(case, motion.until(first)) if math.isfinite(first) else {"regime": ""}
    late = judge(case, motion)
    numbers = (f"{late[one]:.6g}" for one in ("growth_rate", "growth_low", "growth_high"))
    return ",".join((_name(path), f"{first:g}", early["regime"], late["regime"], *numbers))


def releases() -> Iterator[Path]:
    """Return the files of the kept releases that have a history."""
    for path in sorted(KEPT.rglob("unsteady/*/*.nc")):
        if read_dataset(path)["time"].size:
            yield path


def _name(path: Path) -> str:
    return str(path.relative_to(KEPT).with_suffix(""))


if __name__ == "__main__":
    print("run,first_verdict_at,first_verdict,last_verdict,growth_rate,growth_low,growth_high")
    for one in releases():
        print(line(one))
