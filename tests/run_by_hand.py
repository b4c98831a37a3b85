"""A run's folder made by hand, with cases in every state."""

from __future__ import annotations

import json
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import xarray as xr

from equisection.beam.section import Section
from equisection.cases import (
    EndCriteria,
    Geometry,
    Medium,
    SolverBlock,
    UnsteadyCase,
    case_hash,
    write_cases,
)
from equisection.results.netcdf import write_dataset
from equisection.run.status import CaseStatus, run_status
from equisection.store.progress import Process, Snapshot

PARTS = {
    "resolution": "coarse",
    "incidence_deg": 2.5,
    "geometry": Geometry(
        chord=0.1,
        span=3.7,
        thickness=0.04,
        root_on_wall=True,
        channel_height=None,
        tip_gap=None,
        upstream=None,
        downstream=None,
    ),
    "medium": Medium(speed=20.0, density=1.18, dynamic_viscosity=1.86e-5),
    "solver": SolverBlock(name="embedded", version="1", settings={}),
}


def unsteady(k_star: float) -> UnsteadyCase:
    return UnsteadyCase(
        dimension="2d",
        k_star=k_star,
        section=Section(
            torsional_stiffness=k_star,
            flexural_stiffness=1.0,
            inertia=6.7,
            mass=80.0,
            twist_recovery=1.0,
            deflection_recovery=1.0,
        ),
        duration=400.0,
        time_step=0.05,
        output_interval=0.1,
        criteria=EndCriteria(
            settled_amplitude_deg=0.05, growing_amplitude_deg=6.0, steadiness=0.02, periods=5
        ),
        **PARTS,  # type: ignore[arg-type]
    )


class Run:
    """A run's folder, made by hand."""

    def __init__(self, results: Path, name: str = "beam") -> None:
        self.folder = results / name
        (self.folder / "logs").mkdir(parents=True)

    def case(self, k_star: float) -> str:
        """Write a case that waits; return its hash."""
        case = unsteady(k_star)
        name = f"k{k_star:g}"
        write_cases(self.folder / f"cases/unsteady/2d/{name}.json", {name: case})
        return case_hash(case)

    def result(self, path: Path, **attributes: str | float) -> None:
        data = xr.Dataset({"x": ("t", np.zeros(3), {"units": "1", "long_name": "nothing"})})
        write_dataset(path, data.assign_attrs(**attributes))

    def finished(
        self, k_star: float, regime: str, reason: str = "because", **attributes: float
    ) -> Path:
        path = self.folder / f"unsteady/2d/k{k_star:g}.nc"
        self.result(path, case_hash=self.case(k_star), regime=regime, reason=reason, **attributes)
        return path

    def job(self, k_star: float, process: Process) -> None:
        job = Snapshot(
            (self.case(k_star),), "a solver", "c/V", 100.0, 400.0, 1e9, 1e9 + 50, 0.0, 1e9, process
        )
        path = self.folder / f"logs/unsteady_2d_k{k_star:g}.progress.json"
        path.write_text(json.dumps(asdict(job)), encoding="utf-8")

    def log(self, name: str, text: str) -> None:
        path = self.folder / "logs" / f"{name}.log"
        path.write_text(f"2026-01-01 10:00:00,000 INFO starts\n{text}", encoding="utf-8")

    def entry(self, case: str) -> CaseStatus:
        return next(e for e in run_status(self.folder).entries if e.case == case)


#: A process that is not there.
GONE = replace(Process.this(), pid=2**22 + 1)
