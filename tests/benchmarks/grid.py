"""Grid study of the rigid section at 2.5 deg on its three meshes, of the run ``grid``.

python -m tests.benchmarks.grid
"""

from pathlib import Path

import xarray as xr

from equisection.analysis.grid_study import grid_study
from equisection.results.netcdf import read_dataset
from equisection.solvers.openfoam.mesh.presets import PRESETS

NAMES = ("coarse", "medium", "fine")

if __name__ == "__main__":
    runs = [read_dataset(Path(f"results/grid/steady/2d/{name}_a2.5.nc")) for name in NAMES]
    polar = xr.concat(runs, "resolution", combine_attrs="drop").assign_coords(
        resolution=list(NAMES)
    )
    cells = {name: PRESETS[name].cells for name in NAMES}
    table = grid_study(polar.expand_dims(incidence_deg=[2.5]), cells)
    print(table.drop(columns=["incidence_deg", "resolutions", "cells"]).to_string(index=False))
