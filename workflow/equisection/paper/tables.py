"""The paper's tables, its values next to those of a run.

The C_i of Eq. 23 all refer to one k* and one I*. This run's are those of the finest mesh, whose
torsion shape gives k* by Eq. 17; a coarser mesh of the study has the same constant times the
ratio of the frequencies. The analytic beam has a k* of its own, with which sqrt(k*/I*) is
omega_theta1 c/V exactly, so that its C_i = (h/L) f_i/(2 pi f_theta1).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pandas as pd
import xarray as xr

from equisection.analysis.grid_convergence import cell_size, grid_convergence
from equisection.analysis.grid_limit import GridLimit, grid_limit
from equisection.paper.printed_values import COEFFICIENTS, TABLE_1, TABLE_2, TABLE_2_KINDS


def table_1(polar_3d: xr.Dataset) -> pd.DataFrame:
    """Return ``tables/table1.csv``: coefficients of the rigid plate over incidence.

    The paper's meshes come first, then each resolution of this run, then its origin.
    """
    angles = list(next(iter(TABLE_1.values())))
    resolutions = [str(name) for name in polar_3d["resolution"].values]
    columns = ["incidence_deg"]
    columns += [f"{name} paper {mesh}" for mesh in TABLE_1 for name in COEFFICIENTS]
    columns += [f"{name} {resolution}" for resolution in resolutions for name in COEFFICIENTS]
    rows = []
    for angle in angles:
        row: dict[str, object] = {"incidence_deg": angle}
        for mesh, values in TABLE_1.items():
            for name, value in zip(COEFFICIENTS, values[angle], strict=True):
                row[f"{name} paper {mesh}"] = value
        for resolution in resolutions:
            here = at_incidence(polar_3d, resolution, angle)
            for name, short in COEFFICIENTS.items():
                row[f"{name} {resolution}"] = math.nan if here is None else float(here[short])
        row["made_by"] = "; ".join(
            f"{resolution}: {polar_3d.attrs[f'solver_{resolution}']}" for resolution in resolutions
        )
        row["failures"] = polar_3d.attrs.get("failures", "")
        rows.append(row)
    return pd.DataFrame(rows, columns=[*columns, "made_by", "failures"])


def at_incidence(polar: xr.Dataset, resolution: str, angle: float) -> xr.Dataset | None:
    """Return a polar at one incidence (deg); None if the run does not have it."""
    index = np.flatnonzero(np.isclose(polar["incidence_deg"].values, angle, rtol=0, atol=1e-6))
    return (
        polar.sel(resolution=resolution).isel(incidence_deg=int(index[0])) if index.size else None
    )


def table_2(modes: xr.Dataset, mesh_study: xr.Dataset, thickness_over_span: float) -> pd.DataFrame:
    """Return ``tables/table2.csv``: C_1 to C_5 by mesh.

    The paper's meshes come first, then those of the mesh study, the limit of the three finest of
    these, the mesh of this run, and the analytic beam. Modes are paired by kind, since in-plane
    modes come between them.

    Parameters
    ----------
    modes, mesh_study
        Data sets of ``structure/modes.nc`` and ``structure/mesh_study.nc``.
    thickness_over_span
        h/L.
    """
    of_modes = modes_of_table_2([str(kind) for kind in modes["kind"].values])
    of_study = modes_of_table_2([str(kind) for kind in mesh_study["kind"].values])
    finest = f"{modes.attrs['method']} {modes.attrs['elements']}"
    first_torsion = _at(mesh_study["analytic_frequency"], of_study[TABLE_2_KINDS.index("torsion")])
    meshes = [str(mesh) for mesh in mesh_study["mesh"].values]
    sizes = _element_sizes(meshes)
    rows = []
    for number, kind in enumerate(TABLE_2_KINDS):
        row: dict[str, object] = {"constant": f"C_{number + 1}", "kind": kind}
        for mesh, published in TABLE_2.items():
            row[f"paper {mesh}"] = published[number]
        constant = _at(modes["frequency_constant"], of_modes[number])
        frequency = _at(modes["frequency"], of_modes[number])
        study = {
            f"mesh {mesh}": constant
            * _at(mesh_study["frequency"].isel(elements=level), of_study[number])
            / frequency
            for level, mesh in enumerate(meshes)
        }
        row |= study | _convergence(list(study.values()), sizes)
        row[finest] = constant
        analytic = _at(mesh_study["analytic_frequency"], of_study[number])
        row["analytic beam"] = thickness_over_span * analytic / (2.0 * math.pi * first_torsion)
        row["frequency_hz"] = frequency
        rows.append(row)
    return pd.DataFrame(rows)


def _element_sizes(meshes: Sequence[str]) -> list[float]:
    """Return h of meshes as ``12 x 44 x 1``, by the directions in which they differ."""
    counts = np.array([[int(number) for number in mesh.split(" x ")] for mesh in meshes])
    refined = max(1, int((counts != counts[-1]).any(axis=0).sum()))
    return [cell_size(int(number), refined) for number in counts.prod(axis=1)]


def limits_of_table_2(table: pd.DataFrame) -> list[GridLimit]:
    """Return the limit of each constant of :func:`table_2` over the meshes of its study.

    Of meshes of one size the last counts.
    """
    meshes = [column.removeprefix("mesh ") for column in table if column.startswith("mesh ")]
    sizes = dict(zip(meshes, _element_sizes(meshes), strict=True)) if meshes else {}
    finer = {size: f"mesh {mesh}" for mesh, size in sizes.items()}
    return [grid_limit(row, list(finer)) for row in table[list(finer.values())].values.tolist()]


def _convergence(values: Sequence[float], sizes: Sequence[float]) -> dict[str, object]:
    """Return the convergence of a value as columns; none without three finer and finer meshes."""
    if len(values) < 3 or not sizes[-3] > sizes[-2] > sizes[-1]:
        return {}
    coarse, medium, fine = values[-3:]
    found = grid_convergence((coarse, medium, fine), (sizes[-3], sizes[-2], sizes[-1]))
    return {
        "convergence": str(found.convergence),
        "observed_order": found.order,
        "extrapolated": found.extrapolated,
        "gci": found.index,
    }


def modes_of_table_2(kinds: Sequence[str]) -> list[int | None]:
    """Return the places of Table 2's modes among modes of some kinds; None for a missing one."""
    left = {kind: [i for i, this in enumerate(kinds) if this == kind] for kind in set(kinds)}
    return [left[kind].pop(0) if left.get(kind) else None for kind in TABLE_2_KINDS]


def _at(values: xr.DataArray, index: int | None) -> float:
    return math.nan if index is None else float(values.values[index])
