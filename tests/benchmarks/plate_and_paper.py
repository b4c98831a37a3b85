"""Loads of the rigid plate on its finer meshes beside the paper's finest one.

python -m tests.benchmarks.plate_and_paper
"""

from pathlib import Path

import pandas as pd

from equisection.results.netcdf import read_dataset

KEPT = Path("results/reference/paper-plate-openfoam-3d-grid")
NAMES = ["cl", "cm", "cd"]
#: C_L, C_M, C_D of the paper's Table 1, 15e6 cells, by incidence (deg).
PAPER = {
    "0": (0, 0, 0.0438),
    "2.5": (0.2613, 0.0602, 0.0541),
    "5": (0.4826, 0.0697, 0.0858),
    "10": (0.5684, 0.0659, 0.1535),
}

if __name__ == "__main__":
    for angle, there in PAPER.items():
        found = read_dataset(KEPT / f"steady/3d/medium_a{angle}.nc")
        here = [float(found[name]) for name in NAMES]
        off = (f"{100 * (c / p - 1):+.1f} %" for c, p in zip(here, there, strict=True) if p)
        seconds = f"{found.attrs['cpu_seconds']:.0f} s"
        print("medium", angle, *(f"{c:.4f}" for c in here), found.attrs["method"], seconds, *off)
    waver = pd.read_csv(KEPT / "fine_a2.5_iterations.csv", comment="#")
    late = waver[waver["iteration"] > 400][NAMES]
    print("fine 2.5, from iteration 400 on", late.agg(["mean", "min", "max"]).round(4), sep="\n")
