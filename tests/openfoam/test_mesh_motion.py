"""Meshes that follow the free section: how far the one that morphs does, and overset beyond it.

What is compared with numbers was measured with OpenFOAM v1912.
"""

import math
import shutil
from pathlib import Path

import numpy as np
import pytest
from tests.benchmarks.morphing import mesh_at_rest
from tests.sample_cases import STEADY, UNSTEADY
from tests.watching import interrupt_after, nothing

from equisection.cases import UnsteadyCase
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.section.free_section import SectionRun
from equisection.solvers.openfoam.section.overset_section import OversetRun
from equisection.solvers.openfoam.section.rigid_section import WINDOW, mesh_of

#: Coarser than any preset, about 4,000 cells: for what does not depend on the mesh.
VERY_COARSE = 0.5
STEP = 0.04


def soft(duration: float) -> UnsteadyCase:
    """Return a section that its springs do not hold: it turns and rises ever faster."""
    assert UNSTEADY.section is not None
    section = UNSTEADY.section.model_copy(
        update={
            "torsional_stiffness": 0.3,
            "flexural_stiffness": 0.1,
            "inertia": 2.0,
            "mass": 8.0,
        }
    )
    criteria = UNSTEADY.criteria.model_copy(update={"growing_amplitude_deg": 80.0})
    return UNSTEADY.model_copy(
        update={
            "section": section,
            "criteria": criteria,
            "duration": duration,
            "time_step": STEP,
            "output_interval": STEP,
        }
    )


@pytest.mark.parametrize("twist_deg", [-9.0, 9.0])
def test_morphing_mesh_is_sound_as_far_as_the_sweep_goes(
    installation: Installation, tmp_path: Path, twist_deg: float
) -> None:
    """The kept sweep has at most 8.7 deg and 0.63 chords, when it ends at the bound of growth."""
    mesh = mesh_at_rest(installation, tmp_path / "rest")
    found = mesh.along(math.radians(twist_deg), 0.8, 8, tmp_path / "moved")
    assert [at.deflection for at in found] == pytest.approx(np.arange(1, 9) / 10)
    assert not any(at.faults for at in found[:6])
    # beyond, cells turn over above and below the section, between what moves and what stands
    assert "negative cell volume" in found[-1].faults


def test_mesh_that_tangles_is_the_reason_of_the_failure(
    installation: Installation, tmp_path: Path
) -> None:
    case = soft(8.0)
    result = SectionRun(installation, case, mesh_of(case, VERY_COARSE), Coupling(), tmp_path).run(
        nothing
    )
    assert result.verdict["regime"] == "failed"
    reason = result.verdict["reason"]
    assert f"after {result.time[-1]:g} c/V, at a twist of " in reason
    assert "where the mesh has tangled (" in reason
    assert 5.0 < result.time[-1] < 8.0


def test_rigid_loads_agree_with_those_of_the_one_mesh(
    installation: Installation, tmp_path: Path
) -> None:
    """On 11,136 cells without overlap c_l 0.380, c_m 0.0756, c_d 0.0575; here 12,808."""
    run = OversetRun(installation, UNSTEADY, mesh_of(STEADY, 1.0), Coupling(), tmp_path)
    _, loads, converged = run.steady(nothing)
    drag, lift, moment = loads.last(WINDOW // 3).means()
    assert converged
    assert lift == pytest.approx(0.380, rel=0.02)
    assert moment == pytest.approx(0.0756, rel=0.02)
    assert drag == pytest.approx(0.0575, rel=0.02)


@pytest.fixture(scope="module")
def whole(
    installation: Installation, tmp_path_factory: pytest.TempPathFactory
) -> tuple[OversetRun, UnsteadyResult]:
    """The soft section on overset meshes, to where the other mesh has long tangled."""
    case, work = soft(8.4), tmp_path_factory.mktemp("whole")
    run = OversetRun(installation, case, mesh_of(case, VERY_COARSE), Coupling(), work)
    return run, run.run(nothing)


def test_overset_goes_on_where_the_other_mesh_tangles(
    whole: tuple[OversetRun, UnsteadyResult],
) -> None:
    run, result = whole
    assert result.time[-1] == pytest.approx(run.case.duration)
    assert np.degrees(result.twist[-1]) > 20.0
    assert result.deflection[-1] > 0.8


def test_section_on_overset_obeys_its_equation_of_motion(
    whole: tuple[OversetRun, UnsteadyResult],
) -> None:
    """I* theta'' + k* theta = c_m and m* w'' + k_w* w = c_l, integrated twice from rest."""
    run, _ = whole
    section, history = run.case.section, run.history()
    assert section is not None
    for motion, inertia, stiffness, load in (
        (history.twist, section.inertia, section.torsional_stiffness, history.moment),
        (history.deflection, section.mass, section.flexural_stiffness, history.lift),
    ):
        acceleration = (load - stiffness * motion) / inertia
        expected = np.cumsum(np.cumsum(acceleration)) * STEP**2
        assert expected == pytest.approx(motion, abs=0.02 * np.abs(motion).max())


def test_overset_run_that_was_killed_goes_on_without_a_jump(
    installation: Installation, whole: tuple[OversetRun, UnsteadyResult], tmp_path: Path
) -> None:
    """From the same steady flow; a kill after 3 c/V goes back to the state at 2 c/V."""
    run, _ = whole
    case = run.case.model_copy(update={"duration": 4.0})
    again = OversetRun(installation, case, run.mesh, run.coupling, tmp_path)
    shutil.copytree(run.work, tmp_path, dirs_exist_ok=True)
    for path in [*again.folder.glob("[1-9]*"), again.folder / "postProcessing"]:
        shutil.rmtree(path)
    (again.folder / "log.pimpleFoam").unlink()
    control = again.folder / "system" / "controlDict"
    control.write_text(control.read_text().replace("endTime 8.4", "endTime 4"))

    with pytest.raises(KeyboardInterrupt):
        again.run(interrupt_after(3.0))
    again.run(nothing)

    one, other = run.history(), again.history()
    early = slice(other.time.size)
    assert len(list((again.folder / "postProcessing" / "loads").iterdir())) == 2
    np.testing.assert_allclose(one.time[early], other.time, atol=1e-9)
    assert other.twist == pytest.approx(one.twist[early], abs=2e-3 * other.twist.max())
    assert other.deflection == pytest.approx(
        one.deflection[early], abs=2e-3 * other.deflection.max()
    )
