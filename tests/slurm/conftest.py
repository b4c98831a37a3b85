import os
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from equisection.config.groups.openfoam_keys import PREFIX_VARIABLE
from tests.conftest import ROOT
from tests.slurm import node as slurm
from tests.slurm.cluster_project import PLUGIN, ClusterProject
from tests.slurm.node import Node
from tests.workflow.project import Project, small

STAND_IN = f"{sys.executable} {ROOT / 'tests' / 'openfoam_stand_in.py'}"


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Every test of this folder needs SLURM."""
    here = Path(__file__).parent
    for item in items:
        if here in item.path.parents:
            item.add_marker(pytest.mark.slurm)


@pytest.fixture(scope="session")
def node(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Node]:
    """A SLURM of one node; where it cannot be, a test is skipped, but not in CI."""
    reason = slurm.missing()
    if not PLUGIN.is_dir():
        reason = "Snakemake has no executor for SLURM; `make slurm` installs it"
    if reason and os.environ.get("CI") == "true":
        pytest.fail(f"no SLURM: {reason}")
    if reason:
        pytest.skip(reason)
    started = Node(tmp_path_factory.mktemp("slurm"))
    try:
        started.start()
        yield started
    finally:
        started.stop()


@pytest.fixture
def project(node: Node, tmp_path: Path) -> ClusterProject:
    """A fresh copy of the project that runs its jobs on the node."""
    del node
    return ClusterProject.fresh(tmp_path / "project")


#: The one case of a project on the stand-in for OpenFOAM: its file and its result.
CASE, RESULT = "cases/unsteady/2d/k5.json", "unsteady/2d/k5.nc"


@pytest.fixture(scope="session")
def prepared(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """A project with a case of OpenFOAM that has not been run yet; not to be changed."""
    config = small(
        solver="openfoam",
        sweep={"k_star": [5.0], "models": ["2d"]},
        unsteady={"duration": 20.0, "time_step": 0.02},
    )
    project = Project.fresh(tmp_path_factory.mktemp("prepared") / "project", config)
    project.run(project.target(CASE))
    return project


@pytest.fixture(scope="session")
def undisturbed(prepared: Project, tmp_path_factory: pytest.TempPathFactory) -> Project:
    """The case run on this machine without a scheduler; not to be changed."""
    project = prepared.copy(tmp_path_factory.mktemp("undisturbed") / "project")
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv(PREFIX_VARIABLE, STAND_IN)
        project.run(project.target(RESULT))
    return project


@pytest.fixture
def case(
    node: Node, prepared: Project, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> ClusterProject:
    """The case on the node."""
    del node
    monkeypatch.setenv(PREFIX_VARIABLE, STAND_IN)
    return ClusterProject(prepared.copy(tmp_path / "project").folder, prepared.config)
