"""Where the loads of the rigid plate go at 2.5 deg as its mesh is refined, and how sure that is.

    python -m tests.benchmarks.plate_meshes

Reads what is kept, and extrapolates to cells of no size with an interval (`equisection.analysis.
grid_limit`):

* the plate on its three meshes, of which the finest did not converge and wavers (mean and half
  range of its last 150 iterations);
* the section on the same cells in the plane, of which the finest wavers too, and on its own three
  meshes, which are finer;
* the ratio of plate to section on equal cells, and the plate by that ratio of the section's limit.
"""

from collections.abc import Iterator
from pathlib import Path

import pandas as pd
import xarray as xr

from equisection.analysis.grid_convergence import cell_size
from equisection.analysis.grid_limit import GridLimit, grid_limit
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.rigid_flow import CONVERGED, WINDOW

KEPT = Path("results/reference")
NAMES = ("coarse", "medium", "fine")
PLATE = (
    KEPT / "paper-plate-openfoam-3d/steady/3d/coarse_a2.5.nc",
    KEPT / "paper-plate-openfoam-3d-grid/steady/3d/medium_a2.5.nc",
    KEPT / "paper-plate-openfoam-3d-grid/fine_a2.5_iterations.csv",
)
ON_CELLS_OF_PLATE = (
    KEPT / "paper-reductions/steady/2d/coarse_a2.5.nc",
    KEPT / "plate-cells/medium_a2.5_iterations.csv",
    KEPT / "plate-cells/fine_a2.5_iterations.csv",
)
ON_OWN = (
    KEPT / "paper-plate-openfoam/steady/2d/coarse_a2.5.nc",
    KEPT / "paper-plate-openfoam-grid/steady/2d/medium_a2.5.nc",
    KEPT / "paper-plate-openfoam-grid/steady/2d/fine_a2.5.nc",
)
Three = tuple[float, float, float]


def known(path: Path, name: str) -> tuple[float, float]:
    """Return a load of a result, or the mean of iterations, and the half range it is known to."""
    if path.suffix == ".nc":
        value = float(xr.load_dataset(path)[name])
        return value, CONVERGED * abs(value)
    history = pd.read_csv(path, comment="#")
    late = history[history["iteration"] > history["iteration"].max() - WINDOW][name]
    return float(late.mean()), float(late.max() - late.min()) / 2


def of(paths: tuple[Path, Path, Path], name: str) -> tuple[Three, Three]:
    """Return a load on three meshes, and the half ranges that it is known to."""
    (coarse, medium, fine) = (known(path, name) for path in paths)
    return (coarse[0], medium[0], fine[0]), (coarse[1], medium[1], fine[1])


def _ratio(whole: tuple[Three, Three], plane: tuple[Three, Three]) -> tuple[Three, Three]:
    ratios = [w / p for w, p in zip(whole[0], plane[0], strict=True)]
    errors = [
        abs(ratio) * (a / abs(w) + b / abs(p))
        for ratio, w, p, a, b in zip(ratios, whole[0], plane[0], whole[1], plane[1], strict=True)
    ]
    return (ratios[0], ratios[1], ratios[2]), (errors[0], errors[1], errors[2])


def _sizes(dimensions: int, cells: list[int]) -> Three:
    coarse, medium, fine = (cell_size(number, dimensions) for number in cells)
    return coarse, medium, fine


def _line(what: str, values: Three, found: GridLimit) -> dict[str, object]:
    return {
        "": what,
        **dict(zip(NAMES, values, strict=True)),
        "order": found.order,
        "limit": found.value,
        "from": found.low,
        "to": found.high,
    }


def rows() -> Iterator[dict[str, object]]:
    """Yield the lines of each load."""
    of_3d = _sizes(3, [PRESETS[name].plate_cells for name in NAMES])
    in_plane = _sizes(2, [PRESETS[f"plate-{name}"].cells for name in NAMES])
    of_own = _sizes(2, [PRESETS[name].cells for name in NAMES])
    for name in ("cl", "cm", "cd"):
        whole, plane = of(PLATE, name), of(ON_CELLS_OF_PLATE, name)
        own, ratio = of(ON_OWN, name), _ratio(whole, plane)
        limits = {}
        for what, (values, errors), sizes in (
            (f"plate {name.upper()}", whole, of_3d),
            (f"section {name}, plate's cells", plane, in_plane),
            (f"section {name}, own meshes", own, of_own),
            (f"{name.upper()}/{name}", ratio, of_3d),
        ):
            limits[what] = grid_limit(values, sizes, errors)
            yield _line(what, values, limits[what])
        section, of_ratio = list(limits.values())[2:]
        yield {
            "": f"plate {name.upper()} by the section",
            "limit": section.value * of_ratio.value,
            "from": section.low * of_ratio.low,
            "to": section.high * of_ratio.high,
        }


if __name__ == "__main__":
    print(pd.DataFrame(rows()).to_string(index=False, float_format="%.4f", na_rep=""))
