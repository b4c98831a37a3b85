"""The coupled plate's run where a program beside it fails: the result stays."""

import math
from pathlib import Path
from typing import NoReturn, cast

import pytest
from tests.sample_cases import UNSTEADY_PLATE

from equisection.errors import SolverError
from equisection.solvers.openfoam import flow, plate_free, tip_flow
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh import Channel, Mesh
from equisection.solvers.openfoam.plate_free import PlateRun
from equisection.solvers.openfoam.plate_mesh import PlateMesh

MESH = PlateMesh(Mesh(Channel(0.04, 4.0, 5.0, 15.0), math.radians(2.5), 0.55), 3.7, 0.3)


def fails(*arguments: object, **keywords: object) -> NoReturn:
    raise SolverError("no such program")


def test_check_of_the_last_mesh_is_no_condition_of_a_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(plate_free, "run_program", fails)
    nowhere = cast(Installation, None)
    run = PlateRun(nowhere, UNSTEADY_PLATE, MESH, flow.Coupling(2), tmp_path, ranks=1)
    (run.folder / "2").mkdir(parents=True)
    assert run._mesh_before() == ""


def test_picture_of_the_tip_is_no_condition_of_a_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tip_flow, "run_program", fails)
    assert tip_flow.sample_tip_flow(cast(Installation, None), tmp_path, MESH, state="") is None
