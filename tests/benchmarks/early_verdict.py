"""What the early verdict saves of a sweep's simulated time, and whether the rest would differ.

The kept histories of `config/openfoam.yaml` are judged by that configuration's criteria as a run
would be, look by look, and then as a whole.
"""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import xarray as xr
import yaml

from equisection.cases import EndCriteria, UnsteadyCase
from equisection.config import load_config
from equisection.results.netcdf import read_dataset
from equisection.solvers.verdicts import judge
from equisection.store.judged_again import judged_again, tip_motion
from tests.benchmarks.measure import Row
from tests.workflow.project import ROOT

KEPT = ROOT / "results" / "reference" / "paper-plate-openfoam" / "unsteady"


def rows() -> Iterator[Row]:
    """Judge each kept history again."""
    raw = yaml.safe_load((ROOT / "config" / "openfoam.yaml").read_text(encoding="utf-8"))
    unsteady = load_config(raw).unsteady
    wanted: dict[str, Any] = {
        "criteria": EndCriteria(**unsteady.verdict.model_dump()),
        "duration": unsteady.duration,
    }
    ends, others = [], []
    paths = sorted(KEPT.rglob("*.nc"))
    for path in paths:
        known = read_dataset(path)
        case = case_of(known).model_copy(update=wanted)
        early = judged_again(case, known)
        ends.append(case.duration if early is None else float(early.attrs["end_time"]))
        late = judge(case, tip_motion(known))["regime"]
        if early is not None and early.attrs["regime"] != late:
            others.append(f"{_name(path)} {early.attrs['regime']} then {late}")
    saved = 100 * (1 - sum(ends) / (len(paths) * unsteady.duration))
    yield Row(
        f"simulated time that {len(paths)} cases of up to {unsteady.duration:g} c/V save",
        f"{saved:.3g} %",
        ">= 30 %",
        saved >= 30,
    )
    yield Row(
        "cases that the whole of the known history judges otherwise",
        "; ".join(others) or "none",
        "none",
        not others,
    )


def case_of(known: xr.Dataset) -> UnsteadyCase:
    """Return the case that a result is of."""
    return UnsteadyCase.model_validate_json(known.attrs["case"])


def _name(path: Path) -> str:
    return f"{path.parent.name} {path.stem}"
