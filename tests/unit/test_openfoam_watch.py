"""A section is followed by the same history that it is judged by in the end."""

from __future__ import annotations

import json
import math
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
from tests.conftest import ROOT

from equisection.cases import UnsteadyCase
from equisection.results.netcdf import read_dataset
from equisection.solvers.openfoam.section.free_section import SectionRun
from equisection.solvers.openfoam.section.section_history import SectionHistory
from equisection.solvers.verdicts import TipMotion, decided_at, is_decided
from equisection.store.judged_again import tip_motion

#: Section at k* 8.5: its verdict by four periods is in with the release in front, not without it.
KEPT = ROOT / "results" / "reference" / "paper-plate-openfoam" / "unsteady" / "2d" / "k8.5.nc"
END = 80.0  # c/V


def test_run_ends_at_the_look_that_its_result_ends_at(tmp_path: Path) -> None:
    kept = read_dataset(KEPT).sel(time=slice(None, END + 0.01))
    case = UnsteadyCase.model_validate(json.loads(kept.attrs["case"]))
    criteria = case.criteria.model_copy(update={"periods": 4})
    changes = {"duration": 100.0, "criteria": criteria, "time_step": case.output_interval}
    case = case.model_copy(update=changes)
    values = {name: kept[name].values[1:] for name in ("time", "twist", "deflection", "cl", "cm")}
    values["deflection"] = values["deflection"] / kept.attrs["chord"]
    after = SectionHistory(*values.values(), values["cm"])
    (tmp_path / "release.json").write_text(json.dumps({"lift": 0.0, "moment": 0.0}))
    loads = np.full((after.time.size, 3), 0.1)
    (tmp_path / "postProcessing" / "loads" / "0").mkdir(parents=True)
    rows = np.column_stack([after.time, loads])
    np.savetxt(
        tmp_path / "postProcessing" / "loads" / "0" / "coefficient.dat",
        rows,
        header="Time Cd Cl CmPitch",
    )
    run: Any = SimpleNamespace(
        case=case,
        folder=tmp_path,
        history=lambda loads=None: after,
        require_room=lambda so_far: None,
    )
    watch = SectionRun._watch(cast(SectionRun, run), 0.0, lambda *now: None)
    assert not watch(END - 5.1)
    assert not watch(END), "this step has begun, and its loads are not written"
    assert watch(END + 0.1)
    assert SectionRun._watch(cast(SectionRun, run), 0.0, lambda *now: None)(END + 6.0)
    tip = tip_motion(kept)
    alone = TipMotion(tip.time[1:], tip.twist[1:], tip.deflection[1:])
    assert not is_decided(case, alone), "the release no longer matters: take another history"
    assert math.isclose(decided_at(case, tip_motion(kept)), END)
