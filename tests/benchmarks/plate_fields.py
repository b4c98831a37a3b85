"""Bubble, y+ and flow near the tip of the rigid plate at 2.5 deg on its coarse mesh, which is kept.

python -m tests.benchmarks.plate_fields
"""

from pathlib import Path

import numpy as np

from equisection.results.netcdf import read_dataset
from equisection.results.plate_surface import plate_surface_from_dataset
from equisection.results.tip_flow import tip_flow_from_dataset

RESULT = Path("results/reference/paper-plate-openfoam-3d/steady/3d/coarse_a2.5.nc")
STATIONS = (0, 1, 2, 3, 3.35, 3.7)  # c from the root

if __name__ == "__main__":
    found = read_dataset(RESULT)
    surface, flow = plate_surface_from_dataset(found), tip_flow_from_dataset(found)
    assert surface is not None
    assert flow is not None
    whole = [float(found[name]) for name in ("cd", "cl", "cm")]
    print("C_D, C_L, C_M summed over the faces", surface.loads(2.5), "of the run", whole)
    for side in ("upper", "lower"):
        faces, (z, bubble) = surface.on(side), surface.reattachment(side)
        print(side, f"bubble ends at {np.interp(STATIONS, z, bubble).round(2)} at z/c {STATIONS}")
        mean = np.average(faces.y_plus, weights=faces.area)
        print(f"  y+ {faces.y_plus.min():.1f} to {faces.y_plus.max():.1f}, mean {mean:.1f}")
    planes = zip(flow.x, flow.turbulence, np.moveaxis(flow.velocity, -1, 1), strict=True)
    for x, k, (_, v, w) in planes:
        across = np.nanmax(np.hypot(v, w))
        print(f"x/c {x + 0.5:.2f}: k {np.nanmax(k):.3f} V^2, across the stream {across:.2f} V")
    print(RESULT.stat().st_size, "bytes")
