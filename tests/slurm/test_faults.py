"""Faults under the scheduler: nothing that was computed is lost, nothing runs twice.

OpenFOAM is a stand-in here, held at one of its steps to be disturbed.
"""

import json
import os
import signal
import subprocess
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import pytest

from equisection.results.netcdf import read_dataset
from tests.processes import LONG, wait_until
from tests.slurm.cluster_project import ClusterProject
from tests.slurm.conftest import RESULT
from tests.slurm.node import AS_ROOT, Node, said
from tests.workflow.project import Project, has_nothing_to_do

Begun = Callable[..., tuple[subprocess.Popen[str], str]]
SUMMARY = "comparison/summary.csv"
#: Piece of the free section's output behind which it is held: it has written its first state, at
#: 2 c/V or behind 100 steps of four pieces, and gone on to 2.2 c/V.
PIECE = 470


def free_folder(project: Project) -> Path | None:
    """Return where the free section runs, once it does."""
    return next(iter((project.folder / "results" / ".store").glob("*/case0/free")), None)


@pytest.fixture
def held(tmp_path: Path) -> Path:
    """File that is there once the free section is held."""
    return tmp_path / "held"


@pytest.fixture
def begun(case: ClusterProject, node: Node, held: Path, monkeypatch: pytest.MonkeyPatch) -> Begun:
    """Start a run and return it with the number of its job, held a while into it."""

    def start(*arguments: str) -> tuple[subprocess.Popen[str], str]:
        monkeypatch.setenv("STAND_IN_HOLD", f"pimpleFoam:{PIECE}:{held}")
        workflow = case.start(*arguments, case.target(RESULT))
        monkeypatch.delenv("STAND_IN_HOLD")
        job = node.running()
        wait_until(held.exists)
        folder = free_folder(case)
        assert folder is not None
        assert "Time = 2.2\n" in (folder / "log.pimpleFoam").read_text()
        return workflow, job

    return start


def owners(project: Project) -> list[dict[str, Any]]:
    """Return who had the working directory, in their order."""
    files = (project.folder / "results" / ".store").glob("*/owners/*.json")
    return [json.loads(path.read_text()) for path in sorted(files, key=lambda path: int(path.stem))]


def starts(project: Project) -> list[float]:
    """Return the times (c/V) from which the solver was started."""
    folder = free_folder(project)
    assert folder is not None
    return sorted(float(path.name) for path in (folder / "postProcessing" / "loads").iterdir())


def ends_well(workflow: subprocess.Popen[str]) -> str:
    said_by_it, _ = workflow.communicate(timeout=LONG)
    assert workflow.returncode == 0, said_by_it
    return said_by_it


def assert_same_result(project: Project, undisturbed: Project) -> None:
    """The history, the verdict and the summary are those of a run that nothing has happened to."""
    one, other = (read_dataset(run.results / RESULT) for run in (project, undisturbed))
    for name in ("time", "twist", "deflection", "cl", "cm"):
        np.testing.assert_allclose(one[name], other[name], atol=1e-12)
    for name in ("regime", "end_time", "twist_amplitude_deg", "case_hash"):
        assert one.attrs[name] == other.attrs[name]
    project.run(project.target(SUMMARY))
    (row,) = pd.read_csv(project.results / SUMMARY).to_dict("records")
    assert (row["k_star"], row["regime"]) == (5.0, other.attrs["regime"])
    assert row["end_time"] == pytest.approx(other.attrs["end_time"])


def assert_one_after_the_other(first: dict[str, Any], second: dict[str, Any]) -> None:
    """The first job was over when the second began.

    Its processes get the signal together: it was killed, and its end is 0, or saw its solver die.
    """
    assert first["ended"] < second["since"] < second["ended"]


def test_case_that_is_cancelled_is_told_and_goes_on_at_the_next_start(
    begun: Begun, case: ClusterProject, undisturbed: Project
) -> None:
    workflow, job = begun("--retries=0")
    subprocess.run(["scancel", job], check=True)
    told, _ = workflow.communicate(timeout=LONG)
    assert workflow.returncode == 1
    assert f"SLURM-job '{job}' failed, SLURM status is: 'CANCELLED'" in told
    assert not (case.results / RESULT).exists()
    case.run(case.target(RESULT))
    assert_same_result(case, undisturbed)
    first, second = owners(case)
    assert first["job"] == job != second["job"]
    assert_one_after_the_other(first, second)
    assert starts(case)[1] >= 2.0


def test_case_over_its_time_limit_goes_on_in_a_new_job(
    begun: Begun, node: Node, case: ClusterProject, undisturbed: Project
) -> None:
    workflow, job = begun()
    subprocess.run(["scontrol", "update", f"JobId={job}", "EndTime=now"], check=True)
    wait_until(lambda: node.jobs()[job] == "TIMEOUT")
    ends_well(workflow)
    assert_same_result(case, undisturbed)
    assert_one_after_the_other(*owners(case))
    assert starts(case)[1] >= 2.0


def test_case_whose_node_is_lost_goes_on_when_it_returns(
    begun: Begun, node: Node, case: ClusterProject, undisturbed: Project
) -> None:
    """SLURM puts the same job into the queue again (`slurm-requeue`)."""
    workflow, job = begun()
    node.lose_node()
    wait_until(lambda: job not in node.jobs("running"))
    node.start_node()
    ends_well(workflow)
    assert_same_result(case, undisturbed)
    assert [owner["job"] for owner in owners(case)] == [job, job]
    assert starts(case)[1] >= 2.0


def test_case_that_is_preempted_goes_on_in_the_same_job(
    begun: Begun, node: Node, case: ClusterProject, undisturbed: Project
) -> None:
    """A job of a partition of higher priority wants the whole node; the case is requeued."""
    workflow, job = begun()
    wanted = ("--partition=urgent", "--exclusive", "--output=/dev/null", "--wrap=true")
    urgent = said("sbatch", "--parsable", *wanted).strip()
    wait_until(lambda: node.jobs().get(urgent) == "COMPLETED")
    ends_well(workflow)
    assert_same_result(case, undisturbed)
    assert [owner["job"] for owner in owners(case)] == [job, job]
    assert starts(case)[1] >= 2.0


def test_job_that_a_killed_workflow_left_is_waited_for(
    begun: Begun, node: Node, case: ClusterProject, undisturbed: Project, held: Path
) -> None:
    """The second workflow cannot know of the job, but its own finds the directory owned."""
    workflow, job = begun()
    os.killpg(workflow.pid, signal.SIGKILL)
    workflow.communicate()
    case.run("--unlock")
    workflow = case.start(case.target(RESULT))
    log = case.results / "logs" / "unsteady_2d_k5.log"
    words = f"SLURM job {job}, process "
    wait_until(lambda: log.is_file() and words in log.read_text())
    assert job in node.jobs("running")
    held.with_name("held.go").touch()
    ends_well(workflow)
    assert_same_result(case, undisturbed)
    first, second = owners(case)
    assert first["job"] == job != second["job"]
    assert 0 < first["ended"] <= second["ended"]
    assert starts(case) == [0.0]
    assert has_nothing_to_do(case.run(case.target(RESULT)))


@pytest.fixture
def small_disk(case: ClusterProject) -> Iterator[Path]:
    """A disk of the case's store that has room for the steady flow alone."""
    store = case.folder / "results" / ".store"
    mount = [*AS_ROOT, "mount", "-t", "tmpfs", "-o", "size=160k,mode=777", "tmpfs", store]
    store.mkdir(exist_ok=True)
    if subprocess.run(mount, capture_output=True, check=False).returncode:
        pytest.skip("needs to be allowed to mount a disk")
    yield store
    subprocess.run([*AS_ROOT, "umount", store], check=True)


def test_full_disk_is_told_and_the_case_goes_on_when_there_is_space(
    case: ClusterProject, small_disk: Path, undisturbed: Project
) -> None:
    stopped = case.attempt("--retries=0", case.target(RESULT))
    assert stopped.returncode == 1
    log = (case.results / "logs" / "unsteady_2d_k5.log").read_text()
    assert "the disk" in log
    assert "free some space and run again" in log
    assert not list(small_disk.rglob("[!.]*.nc"))
    assert not (case.results / RESULT).exists()
    subprocess.run([*AS_ROOT, "mount", "-o", "remount,size=20m", small_disk], check=True)
    case.run(case.target(RESULT))
    assert_same_result(case, undisturbed)
