"""Two workflows in one store, which want the same case."""

import sys
from pathlib import Path

import pytest

from equisection.config.groups.openfoam_keys import PREFIX_VARIABLE
from equisection.results.netcdf import read_dataset
from tests.conftest import ROOT
from tests.processes import LONG, wait_until
from tests.workflow.project import Project, small

RESULT = "unsteady/2d/k5.nc"


def test_second_waits_for_the_first_and_takes_its_result(
    project: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(PREFIX_VARIABLE, f"{sys.executable} {ROOT / 'tests/openfoam_stand_in.py'}")
    config = small(
        solver="openfoam",
        sweep={"k_star": [5.0], "models": ["2d"]},
        unsteady={"duration": 20.0, "time_step": 0.02},
    )
    first, second = (Project(project.folder, {**config, "run": run}) for run in ("one", "other"))
    for run in (first, second):
        run.run(run.target("cases/unsteady/2d/k5.json"))

    held, store = tmp_path / "held", project.folder / "results" / ".store"
    monkeypatch.setenv("STAND_IN_HOLD", f"pimpleFoam:400:{held}")
    ahead = first.start(first.target(RESULT))
    wait_until(held.exists)
    (folder,) = store.glob("*/case0/free")
    behind = second.start(second.target(RESULT))
    log = second.results / "logs" / "unsteady_2d_k5.log"
    wait_until(lambda: log.is_file() and "runs this case; waiting" in log.read_text())
    unlocking = second.attempt("--unlock")
    assert unlocking.returncode == 1
    pids = {run.pid for run in (ahead, behind)}
    assert any(
        f"error: process {pid} runs the workflow here since" in unlocking.stdout for pid in pids
    )
    tmp_path.joinpath("held.go").touch()
    for workflow in (ahead, behind):
        said, _ = workflow.communicate(timeout=LONG)
        assert workflow.returncode == 0, said
    assert "runs this case; waiting for its result" in said
    assert "Unlock" in second.run("--unlock")

    starts = {path.name for path in (folder / "postProcessing" / "loads").iterdir()}
    assert starts == {"0"}
    one, other = (read_dataset(run.results / RESULT) for run in (first, second))
    assert one.identical(other)
