"""Means, frequency and rigid loads of the paper's plate and its section over the cell size."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np
import pandas as pd

from equisection.analysis.grid_convergence import cell_size
from equisection.analysis.grid_limit import GridLimit, grid_limit
from equisection.config.groups.openfoam_keys import ON_CELLS_OF_PLATE
from equisection.paper.mesh_convergence.kept_releases import (
    MeshLoads,
    MeshRelease,
    alike_sections,
    is_on_cells_of_plate,
)
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, MeshValue
from equisection.paper.mesh_convergence.onset_by_mesh import EARLY, LEARNT_AT, PLATE_ITERATIONS
from equisection.paper.printed_values import COEFFICIENTS, TABLE_1
from equisection.results.netcdf import read_dataset
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.verdicts import judge
from equisection.verdict.growth import AFTER_RELEASE

#: Means of a release that are compared, by their names in a verdict.
MEANS = {
    "mean_twist_deg": "mean twist, deg",
    "mean_deflection_chords": "mean deflection, chords",
    "frequency_strouhal": "frequency, f c/V",
}
#: Bodies at rest, by dimension.
RIGID = {"2d": "rigid section", "3d": "rigid plate"}
#: Section and plate on equal cells, and the quantity of :func:`modal_series`.
EQUAL_CELLS, FIRST_MODE = "section over plate", "first {} mode over the next"
#: Two iterations of a time step of the plate over four, and the means that are compared so.
TWO_OVER_FOUR, MEANS_OF_TIP = "two iterations over four", ("mean twist", "mean deflection")
#: Loads of iterations that did not end, the mesh and the incidence (deg) that they are of, and the
#: iteration from which on they go to and fro.
_UNFINISHED = Path("paper-plate-openfoam-3d-grid", "fine_a2.5_iterations.csv")
_UNFINISHED_MESH, _UNFINISHED_DEG, _TO_AND_FRO_FROM = "fine", 2.5, 400


def mean_series(releases: Sequence[MeshRelease]) -> Iterator[MeshSeries]:
    """Yield the means and the frequency of the section at each k* that two meshes have."""
    for k_star, alike, end in alike_sections(releases):
        verdicts = [judge(one.case, one.tip.until(end)) for one in alike]
        for name, quantity in MEANS.items():
            values = tuple(
                MeshValue(one.mesh, one.cells, float(verdict[name]))
                for one, verdict in zip(alike, verdicts, strict=True)
            )
            basis = f"releases, up to {end:.0f} c/V"
            yield MeshSeries(quantity, "2d", f"k* = {k_star:g}", basis, 2, values)


def load_series(
    loads: Sequence[MeshLoads], dimension: str, reference: Path
) -> Iterator[MeshSeries]:
    """Yield the loads of the rigid section or plate at the incidences of Table 1."""
    similar = [one for one in loads if not is_on_cells_of_plate(one)]
    for angle in next(iter(TABLE_1.values())):
        for name, short in COEFFICIENTS.items():
            if angle == 0.0 and name != "C_D":
                continue  # nil by symmetry on any mesh
            values = [
                MeshValue(one.mesh, one.cells, one.loads[short])
                for one in similar
                if one.incidence_deg == angle
            ]
            if dimension == "3d" and angle == _UNFINISHED_DEG:
                values += _unfinished(reference / _UNFINISHED, short)
            if values:
                symbol = name if dimension == "3d" else name.lower()
                at = f"{angle:g} deg"
                size = int(dimension[0])
                yield MeshSeries(symbol, RIGID[dimension], at, "steady runs", size, tuple(values))


def ratio_series(
    section_loads: Sequence[MeshLoads], plate_loads: Sequence[MeshLoads]
) -> Iterator[MeshSeries]:
    """Yield the quotients of section and plate on equal cells in the plane."""
    for angle in next(iter(TABLE_1.values())):
        for name, short in COEFFICIENTS.items():
            values = [
                MeshValue(plate.mesh, plate.cells, section.loads[short] / plate.loads[short])
                for plate in plate_loads
                for section in section_loads
                if section.mesh == ON_CELLS_OF_PLATE + plate.mesh
                and section.incidence_deg == plate.incidence_deg == angle > 0.0
            ]
            if values:
                at = f"{angle:g} deg"
                quotient = f"{name.lower()}/{name}"
                yield MeshSeries(quotient, EQUAL_CELLS, at, "steady runs", 3, tuple(values))


def modal_series(releases: Sequence[MeshRelease]) -> Iterator[MeshSeries]:
    """Yield the mean of the plate's first mode of each kind over that of the next, by the mesh.

    The releases are those with four iterations at k* = 6.44; the mean is from 10 to 30 c/V.
    """
    own = [one for one in _of_plate(releases) if one.iterations == PLATE_ITERATIONS]
    for kind in ("torsion", "bending"):
        values = []
        for one in own:
            part = read_dataset(one.path).sel(time=slice(AFTER_RELEASE, EARLY))
            means = np.abs(part[f"{kind}_amplitude"].mean("time").values)
            values.append(MeshValue(one.mesh, one.cells, float(means[0] / means[1:].max())))
        if values:
            at = f"k* = {LEARNT_AT:g}"
            quantity = FIRST_MODE.format(kind)
            yield MeshSeries(quantity, "3d", at, "releases, 10 to 30 c/V", 3, tuple(values))


def iteration_series(releases: Sequence[MeshRelease]) -> Iterator[MeshSeries]:
    """Yield the plate's means with two iterations of a time step over those with four, by mesh.

    They are means over the first 30 c/V, from 10 c/V on, at k* = 6.44, of meshes that have both.
    """
    own = {(one.mesh, one.iterations): one for one in _of_plate(releases)}
    for name in MEANS_OF_TIP:
        values = []
        for (mesh, iterations), four in own.items():
            two = own.get((mesh, PLATE_ITERATIONS // 2))
            if two is not None and iterations == PLATE_ITERATIONS:
                end = min(EARLY, two.end, four.end)
                quotient = _mean_of_tip(two, name, end) / _mean_of_tip(four, name, end)
                values.append(MeshValue(mesh, four.cells, quotient))
        if values:
            at = f"k* = {LEARNT_AT:g}"
            yield MeshSeries(name, TWO_OVER_FOUR, at, "releases, 10 to 30 c/V", 3, tuple(values))


def _of_plate(releases: Sequence[MeshRelease]) -> list[MeshRelease]:
    """Return the releases of the plate at the k* at which its meshes are compared."""
    return [one for one in releases if one.model == "3d" and one.case.k_star == LEARNT_AT]


def _mean_of_tip(release: MeshRelease, name: str, end: float) -> float:
    time = release.tip.time
    record = release.tip.twist if name == MEANS_OF_TIP[0] else release.tip.deflection
    return float(record[(time >= AFTER_RELEASE) & (time <= end)].mean())


def _unfinished(path: Path, short: str) -> list[MeshValue]:
    """Return the loads of iterations that go to and fro, with their range."""
    if not path.is_file():
        return []
    table = pd.read_csv(path, comment="#")
    late = table.loc[table["iteration"] > _TO_AND_FRO_FROM, short]
    cells = PRESETS[_UNFINISHED_MESH].plate_cells
    note = "mean of iterations that go to and fro"
    return [MeshValue(_UNFINISHED_MESH, cells, late.mean(), late.min(), late.max(), note)]


def printed_limit(name: str, angle: float) -> GridLimit:
    """Return a coefficient of Table 1 with the interval that its three meshes give it."""
    place = list(COEFFICIENTS).index(name)
    values = [rows[angle][place] for rows in TABLE_1.values()]
    sizes = [cell_size(int(float(mesh.split()[0])), 3) for mesh in TABLE_1]
    return grid_limit(values, sizes)
