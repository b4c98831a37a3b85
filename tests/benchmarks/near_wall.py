"""What moves lift, moment and bubble of the rigid section of what a description of a run leaves
open: cells at the wall, numerical schemes, turbulence of the stream. One change at a time.

    python -m tests.benchmarks.near_wall [--run [NAME ...]]

Prints `results/reference/near-wall.csv`. With `--run` the changes named, or all that have no line
there, are run at 2.5 deg (steady, ten to ninety seconds each, `five-layers` two minutes), and their
lines are added to it. Loads that do not converge are means of the last 1500 iterations, with the
bubble of the last one; `half_range` is the largest of a load over the last 150, relative. The files
of the runs stay in `results/near-wall`.
"""

import argparse
import csv
import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from equisection.results.surface import suction_side
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.case_folder import emptied
from equisection.solvers.openfoam.dictionaries import (
    control,
    write_system,
)
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.mesh.block_mesh import SIMILAR, Spacing, _across, expansion
from equisection.solvers.openfoam.mesh.near_wall_spacing import (
    FIRST_LAYER,
    Part,
    WallCells,
    by_size,
    layers,
)
from equisection.solvers.openfoam.mesh.outline_sizes import OutlineSizes
from equisection.solvers.openfoam.mesh.poly_mesh import read_poly_mesh
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.rigid_flow import MOST, WINDOW
from equisection.solvers.openfoam.section.rigid_section import (
    SIZES,
    SectionCells,
    mesh_and_iterate,
    mesh_of,
    outline_mesh_of,
    steady_mean,
)
from equisection.solvers.openfoam.stream_turbulence import STREAM, StreamTurbulence
from tests.benchmarks.rigid import section
from tests.watching import nothing

KEPT = Path("results/reference/near-wall.csv")
INCIDENCE_DEG = 2.5


@dataclass(frozen=True)
class Change:
    """One change, and what it is changed from.

    Attributes
    ----------
    of
        Name of the mesh, or of the change, that it is compared with.
    refinement, spacing
        Mesh.
    schemes
        Entries of ``fvSchemes`` in the place of the usual ones.
    turbulence
        Turbulence of the stream.
    sizes
        Sizes of the mesh around the outline, in the place of a mesh of blocks.
    """

    of: str
    refinement: float = 1.0
    spacing: Spacing = SIMILAR
    schemes: Mapping[str, Mapping[str, str]] = field(default_factory=dict)
    turbulence: StreamTurbulence = STREAM
    sizes: OutlineSizes | None = None


def first_cell(size: float) -> Spacing:
    """Return the spacing of `coarse` with another first cell (chords) at the walls."""
    return replace(SIMILAR, across=partial(_across, at_wall=size))


def rows_off_sides(cells: int) -> Spacing:
    """Return the spacing of `coarse` with more rows off the sides and the same first cell."""
    rows = (SIMILAR.rows[0], cells, SIMILAR.rows[2], cells, SIMILAR.rows[4])

    def across(points: NDArray[np.float64], line: int, j: int) -> str:
        if j not in (1, 3) or line not in (2, 3):
            return SIMILAR.across(points, line, j)
        length = math.dist(points[line, j], points[line, j + 1])
        ratio = expansion(length, cells, FIRST_LAYER)
        return f"{1 / ratio if j == 1 else ratio:.8g}"

    return replace(SIMILAR, rows=rows, across=across)


def twice_the_columns(spacing: Spacing) -> Spacing:
    """Return a spacing with twice its columns."""
    return replace(spacing, columns=tuple(2 * one for one in spacing.columns))


def off_sides(part: Part, cells: int) -> Spacing:
    """Return the spacing of `coarse` with other cells off the sides, then even ones, in all."""
    rows = (SIMILAR.rows[0], cells, SIMILAR.rows[2], cells, SIMILAR.rows[4])
    of_finest = by_size(WallCells(off_sides=part))

    def across(points: NDArray[np.float64], line: int, j: int) -> str:
        is_beside = j in (1, 3) and line in (2, 3)
        return (of_finest if is_beside else SIMILAR).across(points, line, j)

    return replace(SIMILAR, rows=rows, across=across)


def _divergence(**fields: str) -> dict[str, dict[str, str]]:
    return {
        "divSchemes": {f"div(phi,{name})": f"bounded Gauss {of}" for name, of in fields.items()}
    }


def _stream(intensity: float = STREAM.intensity, ratio: float = STREAM.viscosity_ratio) -> Change:
    return Change("coarse", turbulence=StreamTurbulence(STREAM.model, intensity, ratio))


def _outline(**sizes: float) -> Change:
    return Change("outline", sizes=replace(SIZES, **sizes))


_LIMITED = "cellLimited Gauss linear 1"
CHANGES: Mapping[str, Change] = {
    "coarse": Change("coarse"),
    "viscosity ratio 100": _stream(ratio=100.0),
    "intensity 5 %, viscosity ratio 100": _stream(0.05, 100.0),
    "k and omega by second-order upwind": Change(
        "coarse", schemes=_divergence(k="linearUpwind grad(k)", omega="linearUpwind grad(omega)")
    ),
    "gradient of the velocity limited": Change(
        "coarse", schemes={"gradSchemes": {"grad(U)": _LIMITED}}
    ),
    "first cell 1e-4 c": Change("coarse", spacing=first_cell(1e-4)),
    "first cell 1e-3 c": Change("coarse", spacing=first_cell(1e-3)),
    "twice the rows off the sides": Change("coarse", spacing=rows_off_sides(64)),
    "twice the columns": Change("coarse", spacing=twice_the_columns(SIMILAR)),
    "twice the columns, and rows off the sides": Change(
        "coarse", spacing=twice_the_columns(rows_off_sides(64))
    ),
    "five layers off the sides, then 0.02 c": Change(
        "coarse", spacing=off_sides(layers(FIRST_LAYER), 36)
    ),
    "medium": Change("medium", PRESETS["medium"].refinement),
    "medium, gradient of the velocity limited": Change(
        "medium", PRESETS["medium"].refinement, schemes={"gradSchemes": {"grad(U)": _LIMITED}}
    ),
    "five-layers": Change("medium", 1.0, PRESETS["five-layers"].spacing),
    "outline": _outline(),
    "outline, twice the layers": _outline(layers=52, growth=1.086),
    "outline, half of the size along the wall": _outline(wall=0.007, last=2.4),
    "outline, half of the size at corners": _outline(at_corner=1e-3, last=2.4),
    "outline, twice the rays at corners": _outline(fan_step_deg=9.0),
    "outline, half of the size near it": _outline(near=0.0175, wake=0.025),
    "outline, half of the size far off": _outline(far=0.0375, outward=0.08),
}


def run(name: str) -> dict[str, object]:
    """Run one change and return its line."""
    change, case = CHANGES[name], section(INCIDENCE_DEG)
    if change.sizes is None:
        mesh: SectionCells = mesh_of(case, change.refinement, change.spacing)
    else:
        mesh = outline_mesh_of(case, change.refinement, sizes=change.sizes)
    folder = emptied(Path("results") / "near-wall" / name.replace(" ", "-") / "steady")
    reynolds = flow.reynolds_number(case.geometry, case.medium)
    flow.write_flow(folder, reynolds, turbulence=change.turbulence)
    schemes = flow.schemes(steady=True)
    for part, entries in change.schemes.items():
        schemes[part] = {**schemes[part], **entries}
    write_system(folder, control("simpleFoam", MOST, 1, MOST), schemes, flow.steady_solution())
    _, loads, has_converged = mesh_and_iterate(find(), mesh, folder, nothing)
    found = steady_mean(find(), folder, loads, mesh)
    if not has_converged:
        drag, lift, moment = loads.last(10 * WINDOW).means()
        found = replace(found, drag=drag, lift=lift, moment=moment)
    sides = [found.surface.on(side) for side in ("upper", "lower")]
    y_plus = np.concatenate([side.y_plus for side in sides])
    length = np.concatenate([side.length for side in sides])
    assert case.geometry.upstream is not None
    left = change.turbulence.after(case.geometry.upstream - 0.5, 1.0 / reynolds)
    return {
        "change": name,
        "of": change.of,
        "cells": int(read_poly_mesh(folder).owner.max()) + 1,
        "cl": found.lift,
        "cm": found.moment,
        "cd": found.drag,
        "bubble": found.surface.reattachment(suction_side(INCIDENCE_DEG)),
        "y_plus_mean": float(np.average(y_plus, weights=length)),
        "y_plus_largest": float(y_plus.max()),
        "intensity_at_plate": left.intensity,
        "viscosity_ratio_at_plate": left.viscosity_ratio,
        "iterations": loads.time[-1],
        "half_range": loads.last(WINDOW).spread(),
    }


def lines() -> list[dict[str, Any]]:
    """Return the lines that are kept."""
    if not KEPT.exists():
        return []
    with KEPT.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(row for row in file if not row.startswith("#")))


def keep(line: Mapping[str, object]) -> None:
    """Add a line to those that are kept, in the order of the changes."""
    found = {each["change"]: each for each in lines()} | {str(line["change"]): dict(line)}
    with KEPT.open("w", encoding="utf-8", newline="") as file:
        file.write("# python -m tests.benchmarks.near_wall --run (OpenFOAM, section at 2.5 deg)\n")
        writer = csv.DictWriter(file, list(line), lineterminator="\n")
        writer.writeheader()
        for name in filter(found.__contains__, CHANGES):
            writer.writerow(
                {key: f"{v:.6g}" if isinstance(v, float) else v for key, v in found[name].items()}
            )


def table() -> pd.DataFrame:
    """Return the lines with their differences from what was changed (%, bubble in chords)."""
    kept = pd.read_csv(KEPT, comment="#").set_index("change", drop=False)
    base = kept.loc[kept["of"]]
    for name in ("cl", "cm", "cd"):
        kept[f"{name} %"] = 100 * (kept[name].to_numpy() / base[name].to_numpy() - 1)
    kept["bubble +"] = kept["bubble"].to_numpy() - base["bubble"].to_numpy()
    return kept


def missing() -> Iterator[str]:
    """Yield the changes that have no line yet."""
    done = {line["change"] for line in lines()}
    return (name for name in CHANGES if name not in done)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.near_wall")
    parser.add_argument("--run", nargs="*", metavar="NAME", choices=[*CHANGES])
    chosen = parser.parse_args()
    if chosen.run is not None:
        for each in chosen.run or missing():
            keep(run(each))
    shown = [
        "cells", "cl", "cm", "cd", "bubble", "cl %", "cm %", "cd %", "bubble +", "y_plus_mean",
        "y_plus_largest", "intensity_at_plate", "viscosity_ratio_at_plate", "iterations",
        "half_range",
    ]  # fmt: skip
    print(table()[shown].to_string(float_format="%.4g"))
