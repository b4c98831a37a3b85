"""Evidence for and against the paper's claims: tables of ``make paper``, and kept runs."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from equisection.analysis.bubble import plate_bubble_table
from equisection.analysis.missing import missing_table
from equisection.errors import ResultFileError
from equisection.paper.claims_page.findings import Known
from equisection.paper.claims_page.kept_runs import kept_runs
from equisection.paper.mesh_convergence.mesh_series import LIMIT
from equisection.results.netcdf import read_dataset
from equisection.store.index import indices_of_run


@dataclass(frozen=True)
class Evidence:
    """Evidence by which claims are judged.

    Attributes
    ----------
    paper, summary, onset, linear
        ``comparison/*.csv`` of the run that the paper's figures are drawn from.
    missing
        The cases of the three runs of ``make paper`` that have no result.
    bubble, grid_study
        ``tables/*.csv`` of it.
    correction, section_mesh
        ``steady/*.nc`` of it.
    table_1
        ``tables/table1.csv`` of the run of the rigid plate.
    plate_bubble
        Ends of the bubble in the steady results of that run.
    reductions
        ``comparison/summary.csv`` of plate and sections of both reductions on the plate's cells.
    table_2
        ``tables/table2.csv`` of the run that the paper's figures are drawn from.
    convergence
        ``mesh_convergence.csv``: values over the cell size, with limits.
    kept
        Every unsteady run that is kept.
    embedded
        ``comparison/summary.csv`` of the embedded solver, for its cost.
    """

    paper: pd.DataFrame
    summary: pd.DataFrame
    onset: pd.DataFrame
    linear: pd.DataFrame
    missing: pd.DataFrame
    bubble: pd.DataFrame
    grid_study: pd.DataFrame
    correction: xr.Dataset
    section_mesh: xr.Dataset
    table_1: pd.DataFrame
    plate_bubble: pd.DataFrame
    reductions: pd.DataFrame
    table_2: pd.DataFrame
    convergence: pd.DataFrame
    kept: pd.DataFrame
    embedded: pd.DataFrame

    def number(self, quantity: str) -> float:
        """Return this project's value of a quantity of ``paper.csv``; NaN if it has none."""
        rows = self.paper.loc[self.paper["quantity"] == quantity, "here"]
        return float(rows.iloc[0]) if len(rows) else math.nan

    def over_meshes(self, quantity: str, model: str, at: str = "", basis: str = "") -> pd.DataFrame:
        """Return the lines of a value over the cell size, that of its limit last."""
        table = self.convergence
        chosen = (
            (table["quantity"] == quantity)
            & (table["model"] == model)
            & (table["at"].fillna("") == at)
        )
        if basis:
            chosen &= table["basis"] == basis
        return table[chosen]

    def limit(self, quantity: str, model: str, at: str = "", basis: str = "") -> Known:
        """Return the limit of a value at vanishing cell size; NaN where there is none."""
        rows = self.over_meshes(quantity, model, at, basis)
        rows = rows[rows["mesh"] == LIMIT]
        if rows.empty:
            return Known(math.nan)
        row = rows.iloc[0]
        return Known(float(row["value"]), float(row["low"]), float(row["high"]))

    def runs(self, model: str) -> pd.DataFrame:
        """Return the runs of a model that did not fail, by ascending k*."""
        chosen = (self.summary["model"] == model) & (self.summary["regime"] != "failed")
        return self.summary[chosen].sort_values("k_star")

    def at(self, model: str, k_star: float) -> pd.Series | None:
        """Return the run of a model at a k*, if there is one."""
        runs = self.runs(model)
        found = runs[np.isclose(runs["k_star"], k_star)]
        return None if found.empty else found.iloc[0]

    def bracket(self, model: str) -> tuple[float, float]:
        """Return the highest unstable and the lowest stable k* of a model; NaN where unknown."""
        row = self.onset[self.onset["model"] == model]
        if row.empty:
            return math.nan, math.nan
        return float(row["k_star_unstable"].iloc[0]), float(row["k_star_stable"].iloc[0])


def read_evidence(
    figures: Path, plate: Path, reductions: Path, reference: Path, convergence: Path
) -> Evidence:
    """Read the evidence from what ``make paper`` makes, and the folder of kept results.

    Raises
    ------
    ResultFileError
        A file is missing.
    """
    comparison = figures / "comparison"
    return Evidence(
        paper=_table(comparison / "paper.csv"),
        summary=_table(comparison / "summary.csv"),
        onset=_table(comparison / "onset.csv"),
        linear=_table(comparison / "linear_theory.csv"),
        missing=missing_table(
            index for run in (figures, plate, reductions) for index in indices_of_run(run)
        ),
        bubble=_table(figures / "tables" / "bubble.csv"),
        grid_study=_table(figures / "tables" / "grid_study.csv"),
        correction=read_dataset(figures / "steady" / "correction.nc"),
        section_mesh=read_dataset(figures / "steady" / "section_mesh.nc"),
        table_1=_table(plate / "tables" / "table1.csv"),
        plate_bubble=plate_bubble_table(
            read_dataset(path) for path in sorted((plate / "steady" / "3d").glob("*.nc"))
        ),
        reductions=_table(reductions / "comparison" / "summary.csv"),
        table_2=_table(figures / "tables" / "table2.csv"),
        convergence=_table(convergence),
        kept=kept_runs(reference),
        embedded=_table(reference / "embedded-cost.csv"),
    )


def _table(path: Path) -> pd.DataFrame:
    try:
        return pd.read_csv(path)
    except OSError:
        raise ResultFileError(f"{path}: missing; `make paper` makes it") from None
