"""Zigzag of the loads of every release that is kept, or of its first part.

python -m tests.benchmarks.zigzags [--until 10]
"""

import argparse
from pathlib import Path

from equisection.results.loads_zigzag import loads_zigzag
from equisection.results.netcdf import read_attributes, read_dataset
from equisection.verdict.zigzag import zigzag_of

KEPT = Path("results/reference")


def of_whole(path: Path) -> float:
    """Return the zigzag of a release as its solver found it, or as its samples show it."""
    return float(loads_zigzag(path, read_attributes(path)).get("loads_zigzag", float("nan")))


def of_first(path: Path, until: float) -> float:
    """Return the zigzag that the samples of the first part of a release show."""
    run = read_dataset(path).sel(time=slice(0, until))
    return float(zigzag_of(run["time"].values, run["cl"].values, run["cm"].values))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.zigzags")
    parser.add_argument("--until", type=float, metavar="C/V", help="of the sweeps alone")
    until = parser.parse_args().until
    folders = "*" if until is None else "paper-*"
    for each in sorted(KEPT.glob(f"{folders}/unsteady/*/k*.nc")):
        print(f"{of_whole(each) if until is None else of_first(each, until):.5f}", each)
