"""Findings on the paper's claims on structure, mesh and rigid loads."""

from __future__ import annotations

import math

import numpy as np

from equisection.paper.claims_page.evidence import Evidence
from equisection.paper.claims_page.findings import (
    ClaimVerdict,
    Finding,
    graded,
    open_finding,
    percent,
)
from equisection.paper.printed_values import BUBBLE_2D, BUBBLE_AT_ROOT, COEFFICIENTS, TABLE_1
from equisection.results.correction_dataset import factor_at
from equisection.results.section_mesh import share_below

#: The finest mesh of Table 1, which is the one to judge by.
_FINEST = "15e6 cells"


def natural_frequencies(evidence: Evidence) -> Finding:
    """Judge Table 2."""
    rows = evidence.paper[evidence.paper["source"] == "Table 2"].dropna(subset=["here"])
    if rows.empty:
        return open_finding("the modes of Table 2")
    differences = {}
    for mesh in ("8.5e3", "5.0e4"):
        of_mesh = rows[rows["quantity"].str.contains(mesh, regex=False)]
        differences[mesh] = of_mesh["relative_difference"]
    return Finding(
        ClaimVerdict.PARTLY if differences["5.0e4"].abs().max() > 0.01 else ClaimVerdict.AGREES,
        f"within {100 * differences['8.5e3'].abs().max():.2g} % of the 8.5e3 elements; "
        f"{percent(differences['5.0e4'].min())} to {percent(differences['5.0e4'].max())} from the "
        "5.0e4 elements",
        str(rows["note"].iloc[0]),
        "The paper's finer mesh has lower frequencies than its coarser one by up to 2.6 %; "
        "refinement here does not move them that way ([errata](errata.md)).",
    )


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
        graded(rows["relative_difference"], 0.01, 0.05),
        here,
        "modes of the solid plate, reduction `paper`",
        "They come out with A_theta,w under both bending terms, not with the A_theta that Eq. 17 "
        "prints under m_2D. The consistent reduction has other ratios, and the natural frequencies "
        "of the plate ([errata](errata.md)).",
    )


def rigid_plate(evidence: Evidence) -> Finding:
    """Judge Table 1, against its finest mesh."""
    table = evidence.table_1.set_index("incidence_deg")
    made = [name.removeprefix("C_L ") for name in table.columns if name.startswith("C_L ")]
    resolutions = [name for name in made if not name.startswith("paper")]
    parts, all_differences = [], []
    for resolution in resolutions:
        for angle, published in TABLE_1[_FINEST].items():
            here = [table[f"{name} {resolution}"].get(angle, np.nan) for name in COEFFICIENTS]
            if angle == 0.0 or not np.isfinite(here).all():
                continue
            differences = np.divide(here, published) - 1.0
            all_differences += list(differences)
            words = ", ".join(
                f"{name} {percent(value)}"
                for name, value in zip(COEFFICIENTS, differences, strict=True)
            )
            parts.append(f"{resolution}, {angle:g} deg: {words}")
    if not parts:
        return open_finding("steady runs of the plate (`config/openfoam3d.yaml`)")
    return Finding(
        graded(all_differences, 0.05, 0.15),
        "; ".join(parts) + f" (from the paper's {_FINEST})",
        "; ".join(sorted(set(evidence.table_1["made_by"].dropna()))),
        "What of it is the mesh stands in [plate-polar.md](plate-polar.md).",
    )


def independence_of_the_mesh(evidence: Evidence) -> Finding:
    """Judge the agreement of meshes on Fig. 6."""
    study = evidence.grid_study
    study = study[(study["incidence_deg"] > 0) & study["coefficient"].isin(["cl", "cm"])]
    study = study.dropna(subset=["coarse", "fine"])
    if study.empty:
        return open_finding("the section's polar on three meshes")
    changes = study["coarse"] / study["fine"] - 1.0
    coarser = [name for name in ("coarse", "medium") if name in study]
    words = "; ".join(
        f"{row['coefficient']} at {row['incidence_deg']:g} deg: "
        + ", ".join(f"{name} {percent(row[name] / row['fine'] - 1)}" for name in coarser)
        + " from fine"
        for _, row in study.iterrows()
    )
    near_stall = study["incidence_deg"].max() >= 5.0
    verdict = graded(changes, 0.05, 0.1)
    return Finding(
        verdict if near_stall else ClaimVerdict.PARTLY,
        words + ("" if near_stall else "; three meshes were not run at angles near to stall"),
        f"cells {study['cells'].iloc[0]}",
        "From 5 deg on, the steady solver finds no steady flow on the finer meshes "
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
            f"{resolution}: below 1 on {100 * shares[-1]:.1f} % of both sides at "
            f"{row['incidence_deg']:g} deg, largest {row['y_plus_largest']:.2g}"
        )
    worst = rows.loc[rows["y_plus_below_1"].idxmin()]
    parts.append(
        f"least at {worst['incidence_deg']:g} deg on {worst['resolution']}, "
        f"{100 * worst['y_plus_below_1']:.0f} %"
    )
    everywhere = rows["y_plus_largest"].max() < 1.0
    return Finding(
        ClaimVerdict.AGREES if everywhere else ClaimVerdict.PARTLY,
        "; ".join(parts),
        "; ".join(dict.fromkeys(rows["solver"])),
        ""
        if everywhere
        else "It is above 1 at the sharp edges, and on the pressure side at "
        "larger incidence; inside the viscous sublayer (below 5) it is everywhere.",
    )


def bubble_of_the_section(evidence: Evidence) -> Finding:
    """Judge the bubble at 1 and 5 deg, on the finest mesh that has it."""
    rows = evidence.bubble.dropna(subset=["bubble"])
    parts, differences, used = [], [], []
    for angle, stated in BUBBLE_2D.items():
        at = rows[np.isclose(rows["incidence_deg"], angle)]
        used += list(at["solver"])
        for row in at.itertuples():
            differences.append(row.bubble - stated)
            parts.append(f"{row.resolution}, {angle:g} deg: reattachment at {row.bubble:.2g} c")
    if not parts:
        return open_finding("surface data of the section at 1 and 5 deg")
    return Finding(
        graded(differences, 0.05, 0.2),
        "; ".join(parts),
        "; ".join(dict.fromkeys(used)),
        "The length at 2.5 deg falls with refinement here (coarse to fine by a tenth), away from "
        "the paper's. Other turbulence in the stream, or another way to read the end of the bubble "
        "off the pressure, may explain it; the paper gives neither.",
    )


def bubble_of_the_plate(evidence: Evidence) -> Finding:
    """Judge the bubble at the root at 2 and 4 deg, and compare it with that of the section."""
    rows, section = evidence.plate_bubble, evidence.bubble.dropna(subset=["bubble"])
    of_section = ", ".join(
        f"{row.bubble:.2g} c at {row.incidence_deg:g} deg ({row.resolution})"
        for row in section[section["incidence_deg"].isin(BUBBLE_AT_ROOT)].itertuples()
    )
    note = f"Section: {of_section}."
    parts, differences, used = [], [], []
    for row in rows[rows["incidence_deg"].isin(BUBBLE_AT_ROOT)].itertuples():
        differences.append(row.root - BUBBLE_AT_ROOT[row.incidence_deg])
        parts.append(
            f"{row.resolution}, {row.incidence_deg:g} deg: {row.root:.2g} c at the root, "
            f"{row.tip:.2g} c at the tip"
        )
        used.append(row.solver)
    if not parts:
        return open_finding("surface data of the plate at 2 and 4 deg", note)
    return Finding(
        graded(differences, 0.05, 0.2), "; ".join(parts), "; ".join(dict.fromkeys(used)), note
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
        "The paper's step is 2.5e-4 c/V if its 1.25e-6 are seconds, and 0.05 c/V if they are "
        "dt c/V in SI units, as printed "
        "([openfoam-polar.md](openfoam-polar.md#the-papers-cell-sizes)).",
    )


def section_against_plate(evidence: Evidence) -> Finding:
    """Judge the signs of the correction at low and at high incidence."""
    correction = evidence.correction.sel(incidence_deg=slice(0.1, None))
    incidence = correction["incidence_deg"].values
    if not incidence.size or incidence[-1] < 2.5:
        return open_finding("polars of section and plate")
    parts, holds = [], []
    for name, factor in (("c_l/C_L", "lift_factor"), ("c_m/C_M", "moment_factor")):
        values = correction[factor].values
        low = factor_at(correction, factor, 2.5)
        if not math.isfinite(low):
            return open_finding(f"a factor {name} at 2.5 deg")
        below = incidence[(values < 1.0) & (incidence > 2.5)]
        holds += [low > 1.0, below.size > 0]
        shown = ", ".join(
            f"{value:.2f} at {angle:g} deg"
            for angle in (2.5, 5.0, 7.5, 9.0, 10.0)
            if math.isfinite(value := factor_at(correction, factor, angle))
        )
        parts.append(f"{name}: {shown}")
    verdict = ClaimVerdict.PARTLY
    if all(holds):
        verdict = ClaimVerdict.AGREES
    elif not any(holds):
        verdict = ClaimVerdict.DIFFERS
    return Finding(
        verdict,
        "; ".join(parts),
        f"section: {correction.attrs['section_label']}; plate: {correction.attrs['beam_label']}",
        "Up to 5 deg the section has more of both, as the paper says. The plate's values are "
        "interpolated between 5 and 10 deg where they come from Table 1.",
    )
