"""Verdicts on releases, a line a file, as if they had ended at a time.

python -m tests.benchmarks.judged [--until 60] result.nc ...
"""

import argparse
import math
from pathlib import Path

import pandas as pd

from equisection.results.netcdf import read_dataset
from equisection.solvers.verdicts import judge
from equisection.store.judged_again import tip_motion
from tests.benchmarks.early_verdict import case_of
from tests.benchmarks.needed import needed

NUMBERS = (
    "growth_rate",
    "growth_low",
    "growth_high",
    "frequency_strouhal",
    "mean_twist_deg",
    "mean_deflection_chords",
    "twist_amplitude_deg",
)


def line(path: Path, until: float) -> dict[str, object]:
    """Return the verdict on the first part of a release."""
    known = read_dataset(path)
    motion = tip_motion(known, until)
    verdict = judge(case_of(known), motion)
    return {
        "run": path.parents[2].name,
        "case": f"{path.parent.name} {path.stem}",
        "regime": verdict["regime"],
        **{name: verdict[name] for name in NUMBERS},
        "end": f"{motion.time[-1]:.0f}",
        "seconds": f"{known.attrs['cpu_seconds']:.0f}",
    }


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.judged")
    parser.add_argument("--until", type=float, default=math.inf, metavar="C/V")
    parser.add_argument("results", nargs="+", type=Path, metavar="result.nc")
    chosen = parser.parse_args()
    with needed("the run that it is a result of"):
        table = pd.DataFrame([line(path, chosen.until) for path in chosen.results])
    print(table.to_string(index=False, float_format="%.4f"))
