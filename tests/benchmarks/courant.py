"""Courant numbers on the mesh of a rigid section, at its own time step and at others.

python -m tests.benchmarks.courant results/grid/steady/section_mesh.nc [--steps 0.02 0.05]
"""

import argparse
from pathlib import Path

import numpy as np

from equisection.results.netcdf import read_dataset
from equisection.results.section_mesh import share_below
from tests.benchmarks.needed import needed

if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.courant")
    parser.add_argument("mesh", type=Path, metavar="section_mesh.nc")
    parser.add_argument("--steps", nargs="*", type=float, metavar="C/V")
    chosen = parser.parse_args()
    with needed("the run of the mesh, which docs/openfoam-polar.md has"):
        mesh = read_dataset(chosen.mesh)
    area, unit = mesh["area"].values, mesh["courant"].values / mesh.attrs["time_step"]
    ones = np.ones_like(area)
    corner = mesh["corners"].values[unit.argmax()]
    place = (mesh[axis].values[corner].mean() for axis in ("x", "y"))
    print("largest at x/c, y/c", *(f"{one:.4f}" for one in place))
    print("aspect ratio, skewness", mesh.attrs["max_aspect_ratio"], mesh.attrs["max_skewness"])
    for step in chosen.steps or [mesh.attrs["time_step"]]:
        courant = step * unit
        of_cells = (f"{share_below(limit, courant, ones):.1%}" for limit in (1, 1.5, 2))
        of_area = (f"{share_below(limit, courant, area):.1%}" for limit in (1, 1.5, 2))
        mean = f"{courant.mean():.3g} over cells, {np.average(courant, weights=area):.3g} over area"
        print(f"step {step:g}: largest {courant.max():.3g}, mean {mean}")
        print("  below 1, 1.5, 2: cells", *of_cells, "area", *of_area)
    order = np.argsort(unit)
    below = area[order].cumsum() / area.sum()
    most = 1.5 / unit[order][below.searchsorted(0.9)]
    print(f"90 % of the area below 1.5 with {most:.3f}, half of the cells below 2 with", end=" ")
    print(f"{2 / np.median(unit):.3f} c/V")
