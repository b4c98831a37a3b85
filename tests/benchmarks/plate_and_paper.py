"""Loads of the rigid plate on its finer meshes beside the paper's finest one.

python -m tests.benchmarks.plate_and_paper
"""

from pathlib import Path

import pandas as pd

from equisection.paper.printed_values import COEFFICIENTS, TABLE_1
from equisection.results.netcdf import read_dataset

KEPT = Path("results/reference/paper-plate-openfoam-3d-grid")
NAMES = list(COEFFICIENTS.values())

if __name__ == "__main__":
    print("mesh, deg", *NAMES, "method, time, off the paper's")
    for angle, there in TABLE_1["15e6 cells"].items():
        found = read_dataset(KEPT / f"steady/3d/medium_a{angle:g}.nc")
        here = [float(found[name]) for name in NAMES]
        off = (f"{100 * (c / p - 1):+.1f} %" for c, p in zip(here, there, strict=True) if p)
        seconds = f"{found.attrs['cpu_seconds']:.0f} s"
        print(
            "medium",
            f"{angle:g}",
            *(f"{c:.4f}" for c in here),
            found.attrs["method"],
            seconds,
            *off,
        )
    waver = pd.read_csv(KEPT / "fine_a2.5_iterations.csv", comment="#")
    late = waver[waver["iteration"] > 400][NAMES]
    print("fine 2.5, from iteration 400 on", late.agg(["mean", "min", "max"]).round(4), sep="\n")
