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
from equisection.solvers.verdicts import TipMotion, is_decided

#: H section at 1 m/s: its verdict is in at 30 c/V with the release in front, and not without it.
KEPT = ROOT / "results" / "reference" / "openfoam-h-section" / "unsteady" / "2d" / "v1.nc"


def test_run_ends_at_the_look_that_its_result_ends_at(tmp_path: Path) -> None:
    kept = read_dataset(KEPT)
    case = UnsteadyCase.model_validate(json.loads(kept.attrs["case"]))
    case = case.model_copy(update={"duration": 100.0})
    names = ("time", "twist", "deflection", "cl", "cm", "cm")
    after = SectionHistory(*(kept[name].values[1:] for name in names))
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
    assert not watch(24.9)
    assert not watch(30.0), "this step has begun, and its loads are not written"
    assert watch(30.04)
    assert SectionRun._watch(cast(SectionRun, run), 0.0, lambda *now: None)(36.0)
    alone = TipMotion(after.time, after.twist, after.deflection)
    assert not is_decided(case, alone), "the release no longer matters: take another history"
    assert math.isclose(kept.attrs["end_time"], 30.0)
