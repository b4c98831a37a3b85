"""Every example on the embedded solver, over a shortened sweep, has its figures and its report."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
import yaml

from equisection.run.answer import answer_of
from tests.chromium import Chromium, program
from tests.workflow.project import ROOT, Project

RUNNER = Path(__file__).with_name("forked_jobs.py")
CONFIGS = {
    path.stem: yaml.safe_load(path.read_text(encoding="utf-8"))
    for path in sorted((ROOT / "config" / "examples").glob("*.yaml"))
}
EMBEDDED = [name for name, config in CONFIGS.items() if "solver" not in config]
MOST_BYTES = 10e6


def ends_and_middle(values: Any) -> Any:
    """Return a sweep of three values: the first, the one in the middle and the last."""
    if isinstance(values, dict):
        return {**values, "number": 3}
    return [values[0], values[len(values) // 2], values[-1]] if len(values) > 3 else values


def shortened(config: dict[str, Any]) -> dict[str, Any]:
    """Return an example with fewer points, strips and periods, and a bracket searched for once."""
    sweep = {
        name: ends_and_middle(value) if name in ("k_star", "speed", "incidence_deg") else value
        for name, value in config["sweep"].items()
    }
    if sweep.get("onset") == "refine":
        sweep |= {"onset_tolerance": 0.5, "onset_points": 1}
    return {
        **config,
        "sweep": sweep,
        "unsteady": {**config.get("unsteady", {}), "duration": 60},
        "embedded": {**config.get("embedded", {}), "strips": 6},
    }


@pytest.fixture(scope="module")
def project(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """A copy of the project, for the runs of all examples."""
    project = Project.fresh(tmp_path_factory.mktemp("examples") / "project")
    project.program, project.where = (str(RUNNER),), ("--cores", "1")
    return project


@pytest.fixture(scope="module")
def browser(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Chromium | None]:
    """A browser; None where none is installed."""
    path = program()
    if path is None:
        yield None
        return
    with Chromium(path, tmp_path_factory.mktemp("chromium")) as one:
        yield one


@pytest.mark.parametrize("name", EMBEDDED)
def test_example_has_its_figures_its_report_and_an_answer(
    name: str, project: Project, browser: Chromium | None
) -> None:
    project.config = shortened(CONFIGS[name])
    project.run(project.target("report.html"))
    page = project.results / "report.html"
    assert page.stat().st_size < MOST_BYTES
    answer = list(answer_of(project.results).lines())
    assert 4 <= len(answer) <= 5
    assert " e+" not in "".join(answer)
    for picture in (project.results / "figures").glob("*.png"):
        assert f"figure-{picture.stem}" in page.read_text(encoding="utf-8")
    if browser is None:
        return
    browser.open(page, 1000, 800, prefers_color_scheme="light")
    assert browser.value("document.title") == f"equisection: {project.config['run']}"
    assert browser.complaints() == []
    assert browser.value("[...document.images].every(one => one.naturalWidth > 0)")
    has_map = browser.value("document.querySelectorAll('#map .main-svg').length > 0")
    assert has_map == ("incidence_deg" in project.config["sweep"])
