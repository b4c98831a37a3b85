"""Where the loads of the rigid plate go at 2.5 deg as its mesh is refined, and how sure that is.

    python -m tests.benchmarks.plate_meshes

Reads what is kept: the plate on its three meshes, of which the finest did not converge and wavers
(mean and half range of its last iterations), and the section on the same cells in the plane. Limits
are by the observed order, with the range that orders 1 and 2 and the wavering give
(`equisection.analysis.limit_range`).
"""

from collections.abc import Iterator
from pathlib import Path

import pandas as pd
import xarray as xr

from equisection.analysis.grid_convergence import cell_size
from equisection.analysis.limit_range import limit_range
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.rigid_flow import CONVERGED

KEPT = Path("results/reference")
PLATE = {
    "coarse": KEPT / "paper-plate-openfoam-3d/steady/3d/coarse_a2.5.nc",
    "medium": KEPT / "paper-plate-openfoam-3d-grid/steady/3d/medium_a2.5.nc",
}
ITERATIONS = KEPT / "paper-plate-openfoam-3d-grid/fine_a2.5_iterations.csv"
SECTION = KEPT / "plate-cells/steady/2d"
#: Iterations of the finest mesh that are left out.
BEFORE = 400
NAMES = ("coarse", "medium", "fine")


def of_plate(name: str) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return a load of the plate on its meshes, and the half range within which it is known."""
    values = [float(xr.load_dataset(path)[name]) for path in PLATE.values()]
    late = pd.read_csv(ITERATIONS, comment="#").query(f"iteration > {BEFORE}")[name]
    errors = [CONVERGED * abs(value) for value in values]
    half = float(late.max() - late.min()) / 2
    return (*values, float(late.mean())), (*errors, half)


def of_section(name: str) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Return the same of the section on the plate's cells."""
    values = [float(xr.load_dataset(SECTION / f"{mesh}_a2.5.nc")[name]) for mesh in NAMES]
    return tuple(values), tuple(CONVERGED * abs(value) for value in values)


def rows() -> Iterator[dict[str, object]]:
    """Yield a line for each load of plate and section, and for their ratio."""
    plate = tuple(cell_size(PRESETS[mesh].plate_cells, 3) for mesh in NAMES)
    section = tuple(cell_size(PRESETS[f"plate-{mesh}"].cells, 2) for mesh in NAMES)
    for name in ("cl", "cm", "cd"):
        (whole, of_whole), (plane, of_plane) = of_plate(name), of_section(name)
        ratio = tuple(w / p for w, p in zip(whole, plane, strict=True))
        of_ratio = tuple(
            r * (a / abs(w) + b / abs(p))
            for r, w, a, p, b in zip(ratio, whole, of_whole, plane, of_plane, strict=True)
        )
        for what, values, errors, sizes in (
            (f"plate {name.upper()}", whole, of_whole, plate),
            (f"section {name}", plane, of_plane, section),
            (f"{name.upper()}/{name}", ratio, of_ratio, plate),
        ):
            found = limit_range(values, sizes, errors)  # type: ignore[arg-type]
            yield {
                "": what,
                **dict(zip(NAMES, values, strict=True)),
                "wavers by": errors[-1],
                "order from": found.order_low,
                "to": found.order_high,
                "limit": found.value,
                "least": found.low,
                "greatest": found.high,
            }


if __name__ == "__main__":
    print(pd.DataFrame(rows()).to_string(index=False, float_format="%.4f"))
