"""Sections that stand for the plate: deviations, loads on its modes, curvature of its polar.

python -m tests.benchmarks.sections_for_plate        # after `make paper`
"""

from pathlib import Path

import pandas as pd
from scipy.interpolate import PchipInterpolator

from equisection.analysis.deviations import root_mean_square
from equisection.results.netcdf import read_dataset
from tests.benchmarks.needed import needed

RUNS = ("results/paper-reductions", "results/paper-reductions-modal")
AT = (0, 1, 2.5, 4, 5, 7, 10)  # deg

if __name__ == "__main__":
    with needed("make paper"):
        deviations = [pd.read_csv(f"{run}/comparison/section_and_beam.csv") for run in RUNS]
        mean, felt = (
            read_dataset(Path(run, "steady/correction.nc"))[["beam_cl", "beam_cm"]] for run in RUNS
        )
    for run, table in zip(RUNS, deviations, strict=True):
        print(run, root_mean_square(table), sep="\n")
    print("loads as the first modes feel them, over their means", (felt / mean).to_dataframe())
    polar = Path("results/reference/paper-reductions/steady/2d")
    for name in ("cl", "cm"):
        of = [float(read_dataset(polar / f"coarse_a{angle:g}.nc")[name]) for angle in AT]
        few, all_of_them = (float(PchipInterpolator(AT[:n], of[:n])(3.1)) for n in (4, len(AT)))
        print(f"{name} at 3.1 deg: {few:.4f} by four incidences, {all_of_them:.4f} by seven")
