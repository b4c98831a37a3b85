"""Grid study of the section's polar: every coefficient at every incidence on three meshes.

Lift and moment at 0 deg are left out. Plate, channel and meshes are symmetric about the chord line
there, so both are nil by symmetry on any mesh. A solver's values of them are residues of its
iterations, and an index, which is a part of the value, would be one residue over another.
"""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd
import xarray as xr

from equisection.analysis.grid_convergence import cell_size, grid_convergence

COLUMNS = (
    "incidence_deg", "coefficient", "resolutions", "cells", "coarse", "medium", "fine",
    "convergence", "observed_order", "extrapolated", "gci", "gci_second_order",
)  # fmt: skip


#: Coefficients, and those of them that are nil at 0 deg.
_COEFFICIENTS, _ODD = ("cl", "cm", "cd"), ("cl", "cm")


def grid_study(polar: xr.Dataset, cells: Mapping[str, int | None]) -> pd.DataFrame:
    """Return ``tables/grid_study.csv``: a line for each incidence and coefficient not nil there.

    Parameters
    ----------
    polar
        ``steady/polar_2d.nc``.
    cells
        Number of cells at each resolution; None for a mesh that is not similar to the others. Such
        a mesh is left out, and so is one that the polar does not have. The three finest of the rest
        are compared. With fewer there are no lines, and none for an incidence that one of the three
        was not run at.
    """
    known = set(polar["resolution"].values)
    similar = {
        name: number for name, number in cells.items() if number is not None and name in known
    }
    names = sorted(similar, key=lambda name: similar[name])[-3:]
    if len({similar[name] for name in names}) < 3:
        return pd.DataFrame(columns=COLUMNS)
    coarse, medium, fine = (cell_size(similar[name], 2) for name in names)
    rows = []
    all_run = polar["is_run"].sel(resolution=names).all("resolution")
    for angle in polar["incidence_deg"].values[all_run.values]:
        for coefficient in _COEFFICIENTS:
            if angle == 0.0 and coefficient in _ODD:
                continue
            at = polar[coefficient].sel(incidence_deg=angle)
            values = tuple(float(at.sel(resolution=name)) for name in names)
            found = grid_convergence((values[0], values[1], values[2]), (coarse, medium, fine))
            rows.append(
                (
                    float(angle),
                    coefficient,
                    "/".join(names),
                    "/".join(str(similar[name]) for name in names),
                    *values,
                    str(found.convergence),
                    found.order,
                    found.extrapolated,
                    found.index,
                    found.index_second_order,
                )
            )
    return pd.DataFrame(rows, columns=COLUMNS)
