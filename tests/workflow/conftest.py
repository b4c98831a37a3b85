from pathlib import Path

import pytest

from tests.workflow.project import Project, small


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """Every test of this folder that starts Snakemake is marked."""
    here = Path(__file__).parent
    for item in items:
        if here in item.path.parents and item.path.name != "test_config_errors.py":
            item.add_marker(pytest.mark.workflow)


@pytest.fixture(scope="session")
def finished(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """A small run of every model with all its files; not to be changed."""
    config = small(figure_formats=["png", "svg", "pdf"])
    project = Project.fresh(tmp_path_factory.mktemp("finished") / "project", config)
    project.run()
    return project


@pytest.fixture(scope="session")
def finished_sweep(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """A small sweep of every model up to its summary, without figures; not to be changed."""
    project = Project.fresh(tmp_path_factory.mktemp("finished-sweep") / "project", small())
    project.run(project.target("comparison/summary.csv"))
    return project


@pytest.fixture(scope="session")
def finished_section(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """A small sweep of model 2d up to its summary; not to be changed."""
    project = Project.fresh(
        tmp_path_factory.mktemp("finished-section") / "project", small(sweep={"models": ["2d"]})
    )
    project.run(project.target("comparison/summary.csv"))
    return project


@pytest.fixture
def section(finished_section: Project, tmp_path: Path) -> Project:
    """A copy of the finished sweep of model 2d."""
    return finished_section.copy(tmp_path / "project")


@pytest.fixture
def project(tmp_path: Path) -> Project:
    """A fresh copy of the project with the small configuration."""
    return Project.fresh(tmp_path / "project", small())
