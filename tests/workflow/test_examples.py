"""Every example on the embedded solver, over a shortened sweep, has its figures and its report.

``python -m tests.benchmarks examples`` takes all of them; other runs take :data:`USUAL`.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
import yaml

from equisection.run.answer import answer_of
from tests.chromium import Chromium, program
from tests.workflow.project import ROOT, Project

CONFIGS = {
    path.stem: yaml.safe_load(path.read_text(encoding="utf-8"))
    for path in sorted((ROOT / "config" / "examples").glob("*.yaml"))
}
#: Environment variable by which all are taken, and those that are without it.
ALL, USUAL = "EQUISECTION_TEST_EXAMPLES", ("free_air_wing",)
EMBEDDED = [
    name
    for name, config in CONFIGS.items()
    if ("solver" not in config if os.environ.get(ALL) == "all" else name in USUAL)
]
MOST_BYTES = 10e6


def ends_and_middle(values: Any) -> Any:
    """Return a sweep of three values: the first, the one in the middle and the last."""
    if isinstance(values, dict):
        return {**values, "number": 3}
    return [values[0], values[len(values) // 2], values[-1]] if len(values) > 3 else values


def shortened(config: dict[str, Any]) -> dict[str, Any]:
    """Return an example with fewer points, strips and periods, and no search for the onset."""
    sweep = {
        name: ends_and_middle(value) if name in ("k_star", "speed", "incidence_deg") else value
        for name, value in config["sweep"].items()
    }
    sweep |= {"onset": "sweep"}
    return {
        **config,
        "sweep": sweep,
        "unsteady": {**config.get("unsteady", {}), "duration": 60},
        "embedded": {**config.get("embedded", {}), "strips": 6},
    }


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
    name: str, tmp_path: Path, browser: Chromium | None
) -> None:
    project = Project.fresh(tmp_path / "project", shortened(CONFIGS[name]))
    style = project.folder / "envs" / "equisection.mplstyle"
    style.write_text(style.read_text().replace("savefig.dpi: 200", "savefig.dpi: 50"))
    project.run(project.target("report.html"))
    folder = project.results
    page = folder / "report.html"
    assert page.stat().st_size < MOST_BYTES
    answer = list(answer_of(folder).lines())
    assert 4 <= len(answer) <= 5
    assert "e+" not in "".join(answer)
    text = page.read_text(encoding="utf-8")
    for picture in (folder / "figures").glob("*.png"):
        assert f'id="figure-{picture.stem}"' in text
    speeds = pd.read_csv(folder / "comparison" / "critical_speed.csv")
    known = speeds[["speed", "speed_low", "speed_high"]].notna().any(axis=1)
    assert known.groupby(speeds["model"]).any().all()  # no model of it has failed runs alone
    if browser is None:
        return
    browser.open(page, 1000, 800, prefers_color_scheme="light")
    assert browser.value("document.title") == f"equisection: {folder.name}"
    assert browser.complaints() == []
    assert browser.value("[...document.images].every(one => one.naturalWidth > 0)")
    has_map = browser.value("document.querySelectorAll('#map .main-svg').length > 0")
    assert has_map == ("incidence_deg" in CONFIGS[name]["sweep"])
