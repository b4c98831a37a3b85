"""The coupled plate's run where a program beside it fails: the result stays."""

import math
from pathlib import Path
from typing import NoReturn, cast

import numpy as np
import pytest
from tests.sample_cases import UNSTEADY_PLATE
from tests.watching import nothing

from equisection.errors import SolverError
from equisection.motion.modal_response import ModalState, ModalStep, Staggered
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.beam import free_beam as plate_free
from equisection.solvers.openfoam.beam.beam_history import add_row
from equisection.solvers.openfoam.beam.free_beam import PlateRun
from equisection.solvers.openfoam.beam.pipes import Pipes
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.mesh.beam_mesh import PlateMesh
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox, Mesh
from equisection.solvers.openfoam.process import BlowUpError
from equisection.solvers.openfoam.reading import sampled_tip_flow as tip_flow

MESH = PlateMesh(Mesh(ChannelBox(0.04, 4.0, 5.0, 15.0), math.radians(2.5), 0.55), 3.7, 0.3)


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


@pytest.mark.parametrize("side", [-1.0, 1.0])
@pytest.mark.parametrize(
    ("twist_deg", "room_taken"),
    [(0.0, 0.5 * math.sin(math.radians(2.5))), (27.5, 0.25), (-32.5, 0.25)],
)
def test_plate_is_to_stay_a_tenth_of_a_chord_from_floor_and_ceiling(
    tmp_path: Path, side: float, twist_deg: float, room_taken: float
) -> None:
    """Half of 4 c, less the deflection and half of sin(theta_0 + theta), theta_0 = 2.5 deg."""
    run = PlateRun(
        cast(Installation, None), UNSTEADY_PLATE, MESH, flow.Coupling(2), tmp_path, ranks=1
    )
    structure = Staggered(ModalStep(run.points.frequency, 0.04), None)
    exchange = plate_free._Exchange(run, structure, cast(Pipes, None), 0.0, nothing)
    most = side * (2.0 - room_taken - 0.1)
    twist = math.radians(twist_deg)
    exchange._require_room(np.array([twist, 0.0, 0.99 * most, 0.0]), 7.0)
    with pytest.raises(BlowUpError, match=r"come to within 0\.\d+ c of floor or ceiling at 7 c/V"):
        exchange._require_room(np.array([twist, 0.0, 1.01 * most, 0.0]), 7.0)


def test_picture_of_the_tip_is_no_condition_of_a_result(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(tip_flow, "run_program", fails)
    assert tip_flow.sample_tip_flow(cast(Installation, None), tmp_path, MESH, state="") is None


def test_zigzag_of_the_loads_is_seen_in_every_step_whatever_is_recorded(tmp_path: Path) -> None:
    """A lift that zigzags by 10 % of its variation, of which each second step is recorded."""
    case = UNSTEADY_PLATE.model_copy(update={"output_interval": 0.08, "time_step": 0.04})
    run = PlateRun(cast(Installation, None), case, MESH, flow.Coupling(2), tmp_path, ranks=1)
    run.folder.mkdir()
    modes = run.points.frequency.size
    with run.history_file.open("w", encoding="ascii") as stream:
        for number in range(1000):
            time, nothing = number * 0.04, np.zeros(modes)
            swing = math.sin(time)
            place = 0.01 * swing * np.eye(modes)[0]
            state = ModalState(time, place, nothing, nothing, nothing)
            add_row(stream, state, 0.3 + 0.1 * swing + 0.01 * (-1) ** number / 2**0.5, 0.05 * swing)
    result = run._result("")
    assert result.loads_zigzag == pytest.approx(0.1, rel=0.02)
    assert np.abs(np.diff(result.lift, 4)).max() < 0.001
