"""Findings on the paper's claims on structure, mesh and rigid loads."""

from __future__ import annotations

import math
from collections.abc import Iterable

import numpy as np
import pandas as pd
import xarray as xr

from equisection.analysis.grid_convergence import cell_size
from equisection.analysis.grid_limit import grid_limit
from equisection.paper.claims_page.evidence import Evidence
from equisection.paper.claims_page.findings import (
    ClaimVerdict,
    Finding,
    Known,
    open_finding,
    percent,
    together,
)
from equisection.paper.mesh_convergence.kept_releases import cells_of
from equisection.paper.mesh_convergence.loads_by_mesh import RIGID, printed_limit
from equisection.paper.printed_values import (
    ABOUT,
    BUBBLE_2D,
    BUBBLE_AT_ROOT,
    COEFFICIENTS,
    TABLE_1,
    TABLE_2,
)
from equisection.paper.tables import limits_of_table_2
from equisection.results.correction_dataset import factor_at
from equisection.results.section_mesh import share_below

#: Part of the chord by which a length of the paper's bubble may be off.
_OF_CHORD = 0.05


def natural_frequencies(evidence: Evidence) -> Finding:
    """Judge Table 2: each of its meshes, by the limits of the mesh study here."""
    limits = limits_of_table_2(evidence.table_2)
    rows = zip(limits, evidence.table_2.to_dict("records"), strict=True)
    known = [(limit, row) for limit, row in rows if math.isfinite(limit.half_width)]
    if not known:
        return open_finding("the modes of Table 2")
    verdicts, parts = [], []
    for mesh in TABLE_2:
        differences, of_mesh = [], []
        for limit, row in known:
            printed = float(row[f"paper {mesh}"])
            here = Known(limit.value, limit.low, limit.high)
            differences.append(limit.value / printed - 1.0)
            of_mesh.append(here.meets(_printed(printed)))
        verdicts.append(together(of_mesh))
        agree = sum(one is ClaimVerdict.AGREES for one in of_mesh)
        parts.append(
            f"{mesh}: {agree} of {len(of_mesh)} meet the limit here, "
            f"{percent(min(differences))} to {percent(max(differences))} from them"
        )
    return Finding(
        together(verdicts),
        "; ".join(parts),
        f"solid elements, limits over {known[0][0].meshes} meshes (`tables/table2.csv`)",
        "The paper's finer mesh has up to 2.6 % lower frequencies; refinement here does not move "
        "them that way ([errata](errata.md)).",
    )


def _printed(value: float) -> Known:
    """Return a printed value of three digits with half a unit of its last one."""
    half = 0.5 * 10.0 ** (math.floor(math.log10(abs(value))) - 2)
    return Known(value, value - half, value + half)


def property_ratios(evidence: Evidence) -> Finding:
    """Judge the ratios after Eq. 18."""
    rows = evidence.paper[evidence.paper["quantity"].str.startswith("c^2 ")]
    rows = rows.dropna(subset=["here"])
    if rows.empty:
        return open_finding("the equivalent section")
    here = ", ".join(
        f"{row.quantity} = {row.here:.4g} ({percent(row.relative_difference)})"
        for row in rows.itertuples()
    )
    return Finding(
        ClaimVerdict.AGREES
        if rows["relative_difference"].abs().max() <= ABOUT
        else ClaimVerdict.DIFFERS,
        here,
        "modes of the solid plate, reduction `paper`",
        "With A_theta,w under both bending terms, not the A_theta that Eq. 17 prints under m_2D "
        "([errata](errata.md)).",
    )


def rigid_plate(evidence: Evidence) -> Finding:
    """Judge Table 1, coefficient by coefficient: limits of the meshes here and of the paper's."""
    parts: dict[ClaimVerdict, dict[str, list[str]]] = {}
    for angle in next(iter(TABLE_1.values())):
        for name in COEFFICIENTS:
            here = evidence.limit(name, RIGID["3d"], f"{angle:g} deg")
            if math.isnan(here.value):
                continue
            printed = printed_limit(name, angle)
            stated = Known(printed.value, printed.low, printed.high)
            angles = parts.setdefault(here.meets(stated), {}).setdefault(name, [])
            angles.append(f"{angle:g}")
    if not parts:
        return open_finding("steady runs of the plate (`config/openfoam3d.yaml`)")
    return Finding(
        together(parts),
        "; ".join(
            f"{verdict}: " + ", ".join(f"{name} at {'/'.join(at)} deg" for name, at in of.items())
            for verdict, of in parts.items()
        ),
        _described(
            part.rpartition(": ")[2]
            for row in sorted(set(evidence.table_1["made_by"].dropna()))
            for part in row.split("; ")
        ),
        "[Values and intervals](mesh-convergence.md#loads-of-the-rigid-plate-table-1), the paper's "
        "too; three meshes at 2.5 deg alone, else two ([plate-polar.md](plate-polar.md)).",
    )


def independence_of_the_mesh(evidence: Evidence) -> Finding:
    """Judge the agreement of meshes on Fig. 6: a fair one is taken to be 10 %."""
    study = evidence.grid_study
    study = study[(study["incidence_deg"] > 0) & study["coefficient"].isin(["cl", "cm"])]
    study = study.dropna(subset=["coarse", "fine"])
    if study.empty:
        return open_finding("the section's polar on three meshes")
    coarser = [name for name in ("coarse", "medium") if name in study]
    words = f"{' and '.join(coarser)} from fine: " + "; ".join(
        f"{coefficient} at {'/'.join(f'{angle:g}' for angle in rows['incidence_deg'])} deg "
        + ", ".join(
            " and ".join(percent(row[name] / row["fine"] - 1) for name in coarser)
            for _, row in rows.iterrows()
        )
        for coefficient, rows in study.groupby("coefficient", sort=False)
    )
    near_stall = study["incidence_deg"].max() >= 5.0
    fair = [
        ClaimVerdict.AGREES
        if (study[name] / study["fine"] - 1.0).abs().max() <= ABOUT
        else ClaimVerdict.DIFFERS
        for name in coarser
    ]
    return Finding(
        together(fair) if near_stall else ClaimVerdict.PARTLY,
        words + ("" if near_stall else "; three meshes were not run at angles near to stall"),
        f"cells {study['cells'].iloc[0]}",
        "The paper's 3.5e4 and 5.1e4 cells are between medium and fine. From 5 deg on, the "
        "steady solver finds no steady flow on the finer meshes "
        "([openfoam-polar.md](openfoam-polar.md)).",
    )


def wall_distance(evidence: Evidence) -> Finding:
    """Judge y+ below 1."""
    rows = evidence.bubble.dropna(subset=["y_plus_below_1"])
    if rows.empty:
        return open_finding("surface data of the section")
    parts, shares = [], []
    for resolution, of_mesh in rows.groupby("resolution", sort=False):
        row = of_mesh.iloc[int(np.argmin(np.abs(of_mesh["incidence_deg"] - 2.5)))]
        shares.append(float(row["y_plus_below_1"]))
        parts.append(
            f"{100 * shares[-1]:.1f} % at {row['incidence_deg']:g} deg on {resolution}, "
            f"largest {row['y_plus_largest']:.2g}"
        )
    worst = rows.loc[rows["y_plus_below_1"].idxmin()]
    parts.append(
        f"least {100 * worst['y_plus_below_1']:.0f} % at {worst['incidence_deg']:g} deg on "
        f"{worst['resolution']}"
    )
    everywhere = rows["y_plus_largest"].max() < 1.0
    return Finding(
        ClaimVerdict.AGREES if everywhere else ClaimVerdict.PARTLY,
        f"part of both sides below 1: {'; '.join(parts)}",
        _described(rows["solver"]),
        ""
        if everywhere
        else "It is above 1 at the sharp edges, and on the pressure side at larger incidence; "
        "below 5 (viscous sublayer) everywhere.",
    )


def _described(solvers: Iterable[str]) -> str:
    """Return descriptions of solvers, with what they have in common once."""
    first, *others = dict.fromkeys(solvers)
    begin = first.rpartition(", ")[0]
    further = (other.removeprefix(f"{begin}, ").replace(" cells ", " ") for other in others)
    return ", ".join([first, *further])


def bubble_of_the_section(evidence: Evidence) -> Finding:
    """Judge the bubble at 1 and 5 deg, by its limit over the meshes."""
    rows = evidence.bubble.dropna(subset=["bubble"])
    parts, verdicts, used = [], [], []
    for angle, stated in BUBBLE_2D.items():
        at = rows[np.isclose(rows["incidence_deg"], angle)]
        if at.empty:
            continue
        used += list(at["solver"])
        here = _over_cells(at["bubble"], at["solver"], 2)
        verdict = here.meets(Known(stated, stated - _OF_CHORD, stated + _OF_CHORD))
        by_mesh = ", ".join(f"{row.bubble:.2g} c ({row.resolution})" for row in at.itertuples())
        verdicts.append(verdict)
        parts.append(f"{angle:g} deg: {by_mesh}, paper {stated:g} c: {verdict}")
    if not parts:
        return open_finding("surface data of the section at 1 and 5 deg")
    return Finding(
        together(verdicts),
        "; ".join(parts),
        _described(used),
        f"The paper's lengths are taken to be good to {_OF_CHORD:g} c. It [contradicts "
        "itself](errata.md#2-what-is-misprinted).",
    )


def _over_cells(values: pd.Series, solvers: pd.Series, dimensions: int) -> Known:
    """Return the limit of values by the cells that their solvers' descriptions name."""
    table = pd.DataFrame({"value": values, "cells": [cells_of(str(one)) for one in solvers]})
    table = table.dropna().drop_duplicates("cells").sort_values("cells")
    sizes = [cell_size(int(cells), dimensions) for cells in table["cells"]]
    found = grid_limit(table["value"].tolist(), sizes)
    return Known(found.value, found.low, found.high)


def bubble_of_the_plate(evidence: Evidence) -> Finding:
    """Judge the bubble at the root at 2 and 4 deg, and compare it with that of the section."""
    rows, section = evidence.plate_bubble, evidence.bubble.dropna(subset=["bubble"])
    of_section = ", ".join(
        f"{row.bubble:.2g} c at {row.incidence_deg:g} deg ({row.resolution})"
        for row in section[section["incidence_deg"].isin(BUBBLE_AT_ROOT)].itertuples()
    )
    note = f"Section: {of_section}."
    parts, verdicts, used = [], [], []
    for angle, stated in BUBBLE_AT_ROOT.items():
        at = rows[rows["incidence_deg"] == angle]
        if at.empty:
            continue
        here = _over_cells(at["root"], at["solver"], 3)
        verdicts.append(here.meets(Known(stated, stated - _OF_CHORD, stated + _OF_CHORD)))
        by_mesh = ", ".join(
            f"{row.root:.2g} c at the root, {row.tip:.2g} c at the tip ({row.resolution})"
            for row in at.itertuples()
        )
        parts.append(f"{angle:g} deg: {by_mesh}, paper {stated:g} c: {verdicts[-1]}")
        used += list(at["solver"])
    if not parts:
        return open_finding("surface data of the plate at 2 and 4 deg", note)
    return Finding(
        together(verdicts),
        "; ".join(parts),
        _described(used),
        f"{note} One mesh has no interval.",
    )


def courant_number(evidence: Evidence) -> Finding:
    """Judge the shares of Fig. 8 at the time step used here."""
    mesh = evidence.section_mesh
    if not mesh.sizes["cell"]:
        return open_finding("the section's mesh, kept")
    courant, area = mesh["courant"].values, mesh["area"].values
    cells_below_2 = share_below(2.0, courant, np.ones_like(area))
    area_below = share_below(1.5, courant, area)
    holds = cells_below_2 > 0.5 and area_below >= 0.9
    return Finding(
        ClaimVerdict.AGREES if holds else ClaimVerdict.DIFFERS,
        f"below 2 in {100 * cells_below_2:.0f} % of the cells, below 1.5 in "
        f"{100 * area_below:.1f} % of the area; largest {courant.max():.2g}",
        f"{mesh.attrs['solver_description']}, {float(mesh.attrs['time_step']):g} c/V a step",
        "The paper's step [is not clear](errata.md#2-what-is-misprinted).",
    )


def section_against_plate(evidence: Evidence) -> Finding:
    """Judge the quotients of section and plate at low and at high incidence, of their limits."""
    parts, verdicts = [], []
    for angle, judged, words in (
        (2.5, Known.is_above, "above"),
        (10.0, Known.is_below, "below"),
    ):
        for name in ("C_L", "C_M"):
            at = f"{angle:g} deg"
            section = evidence.limit(name.lower(), RIGID["2d"], at)
            plate = evidence.limit(name, RIGID["3d"], at)
            if math.isnan(section.value) or math.isnan(plate.value):
                continue
            quotient = section.over(plate)
            verdicts.append(judged(quotient, 1.0))
            parts.append(
                f"{name.lower()}/{name} at {at} {quotient.words()}, paper {words} 1: {verdicts[-1]}"
            )
    if not parts:
        return open_finding("polars of section and plate")
    return Finding(
        together(verdicts),
        "; ".join(parts),
        "limits of section and plate over their meshes",
        f"With the paper's plate: {_by_table_1(evidence.correction)}.",
    )


def _by_table_1(correction: xr.Dataset) -> str:
    """Return the quotients of the sweep's correction in words, whose plate is Table 1."""
    parts = []
    for name, factor in (("c_l/C_L", "lift_factor"), ("c_m/C_M", "moment_factor")):
        shown = ", ".join(
            f"{value:.2f} at {angle:g} deg"
            for angle in (2.5, 5.0, 10.0)
            if math.isfinite(value := factor_at(correction, factor, angle))
        )
        parts.append(f"{name} {shown}")
    return "; ".join(parts)
