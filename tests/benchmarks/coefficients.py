"""Loads of steady results, a line a file: c_l, c_m, c_d, how they were found, cells and cost.

python -m tests.benchmarks.coefficients result.nc ...
"""

import argparse
from pathlib import Path

import pandas as pd

from equisection.analysis.bubble import bubble_table
from equisection.results.netcdf import read_dataset
from tests.benchmarks.needed import needed


def line(path: Path) -> dict[str, object]:
    """Return the line of a result."""
    found = read_dataset(path)
    surface = {}
    if path.parent.name == "2d" and "y_plus" in found:
        sides = bubble_table({("", float(found.attrs["incidence_deg"])): found}).iloc[0]
        surface = {name: sides[name] for name in ("bubble", "y_plus_mean", "y_plus_largest")}
    return {
        "result": f"{path.parents[2].name} {path.stem}",
        **{name: float(found[name]) for name in ("cl", "cm", "cd")},
        **surface,
        "y+, edges too": float(found["y_plus"].max()) if "y_plus" in found else float("nan"),
        "seconds": f"{found.attrs['cpu_seconds']:.0f}",
        "method": found.attrs["method"],
        "solver": found.attrs["solver_description"],
    }


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.coefficients")
    parser.add_argument("results", nargs="+", type=Path, metavar="result.nc")
    paths = parser.parse_args().results
    with needed("the run that it is a result of"):
        table = pd.DataFrame([line(path) for path in paths])
    print(table.to_string(index=False, float_format="%.4f"))
