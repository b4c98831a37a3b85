"""Where the loads of the rigid plate go at 2.5 deg as its mesh is refined, and how sure that is.

    python -m tests.benchmarks.plate_meshes

Reads what is kept, and extrapolates to cells of no size with a range (`equisection.analysis.
limit_range`):

* the plate on its three meshes, of which the finest did not converge and wavers (mean and half
  range of its last iterations);
* the section on the same cells in the plane, and on its own three meshes, which are finer;
* the ratio of plate to section on equal cells, and the plate by that ratio of the section's limit.
"""

from collections.abc import Iterator
from pathlib import Path

import pandas as pd
import xarray as xr

from equisection.analysis.grid_convergence import cell_size
from equisection.analysis.limit_range import LimitRange, limit_range
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.rigid_flow import CONVERGED

KEPT = Path("results/reference")
NAMES = ("coarse", "medium", "fine")
PLATE = {
    "coarse": KEPT / "paper-plate-openfoam-3d/steady/3d/coarse_a2.5.nc",
    "medium": KEPT / "paper-plate-openfoam-3d-grid/steady/3d/medium_a2.5.nc",
}
ITERATIONS = KEPT / "paper-plate-openfoam-3d-grid/fine_a2.5_iterations.csv"
#: Iterations of the finest mesh that are left out.
BEFORE = 400
ON_CELLS_OF_PLATE = [KEPT / f"plate-cells/steady/2d/{name}_a2.5.nc" for name in NAMES]
ON_OWN = [
    KEPT / f"paper-plate-openfoam{run}/steady/2d/{name}_a2.5.nc"
    for run, name in zip(("", "-grid", "-grid"), NAMES, strict=True)
]

Three = tuple[float, float, float]


def of_plate(name: str) -> tuple[Three, Three]:
    """Return a load of the plate on its meshes, and the half range within which it is known."""
    coarse, medium = (float(xr.load_dataset(path)[name]) for path in PLATE.values())
    late = pd.read_csv(ITERATIONS, comment="#").query(f"iteration > {BEFORE}")[name]
    half = float(late.max() - late.min()) / 2
    known = (CONVERGED * abs(coarse), CONVERGED * abs(medium), half)
    return (coarse, medium, float(late.mean())), known


def of_section(paths: list[Path], name: str) -> tuple[Three, Three]:
    """Return the same of the section."""
    coarse, medium, fine = (float(xr.load_dataset(path)[name]) for path in paths)
    known = (CONVERGED * abs(coarse), CONVERGED * abs(medium), CONVERGED * abs(fine))
    return (coarse, medium, fine), known


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


def _line(what: str, values: Three, found: LimitRange) -> dict[str, object]:
    return {
        "": what,
        **dict(zip(NAMES, values, strict=True)),
        "order from": found.order_low,
        "to": found.order_high,
        "limit": found.value,
        "least": found.low,
        "greatest": found.high,
    }


def rows() -> Iterator[dict[str, object]]:
    """Yield the lines of each load."""
    of_3d = _sizes(3, [PRESETS[name].plate_cells for name in NAMES])
    in_plane = _sizes(2, [PRESETS[f"plate-{name}"].cells for name in NAMES])
    of_own = _sizes(2, [PRESETS[name].cells for name in NAMES])
    for name in ("cl", "cm", "cd"):
        whole, plane = of_plate(name), of_section(ON_CELLS_OF_PLATE, name)
        own, ratio = of_section(ON_OWN, name), _ratio(whole, plane)
        limits = {}
        for what, (values, errors), sizes in (
            (f"plate {name.upper()}", whole, of_3d),
            (f"section {name}, plate's cells", plane, in_plane),
            (f"section {name}, own meshes", own, of_own),
            (f"{name.upper()}/{name}", ratio, of_3d),
        ):
            limits[what] = limit_range(values, sizes, errors)
            yield _line(what, values, limits[what])
        section, of_ratio = list(limits.values())[2:]
        yield {
            "": f"plate {name.upper()} by the section",
            "limit": section.value * of_ratio.value,
            "least": section.low * of_ratio.low,
            "greatest": section.high * of_ratio.high,
        }


if __name__ == "__main__":
    print(pd.DataFrame(rows()).to_string(index=False, float_format="%.4f", na_rep=""))
