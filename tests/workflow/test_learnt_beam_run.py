"""`sweep.onset: model` learns the beam from a release of its own and its loads along the span."""

import logging
from pathlib import Path

import numpy as np
import pytest

from equisection.analysis.learning import Lessons, dataset_of, onsets_of
from equisection.config import load_config
from tests.workflow.project import Project, small

LEARNT = {"models": ["3d"], "onset": "model", "k_star": [6.0, 10.0, 21.0]}


def test_model_of_the_beam_is_made_from_its_own_files(tmp_path: Path) -> None:
    project = Project.fresh(tmp_path / "project", small(sweep=LEARNT))
    said = project.run("-n", project.target("rom/3d/model.nc"))
    reason = said.partition("3d: model learnt from its releases\n")[2].splitlines()[0]
    for made in ("steady/polar_3d.nc", "structure/modes.nc", "unsteady/3d/round3.json"):
        assert made in reason
    assert "polar_2d" not in reason


def test_finished_sweep_of_the_beam_can_be_learnt_from(
    finished: Project, caplog: pytest.LogCaptureFixture
) -> None:
    """The model of a release says what it is, and the angles that its polar lacks are named."""
    lessons = Lessons.read(
        load_config(small(sweep=LEARNT)),
        "3d",
        {
            "releases": [str(finished.results / "unsteady" / "3d" / "sweep.json")],
            "equivalent": str(finished.results / "structure" / "equivalent.nc"),
            "modes": str(finished.results / "structure" / "modes.nc"),
            "polar_3d": str(finished.results / "steady" / "polar_3d.nc"),
        },
    )
    with caplog.at_level(logging.WARNING):
        course = lessons.course()
    assert "add them to steady.incidence_deg" in caplog.text
    data = dataset_of(course, "3d", lessons.axis)
    assert data.attrs["words"].startswith("model learnt from embedded solver")
    assert "on strips, incidence" in data.attrs["words"]
    assert data["moment_terms"].shape == (4, 5)
    np.testing.assert_array_equal(data["moment_terms"][:3, 4], 0.0)
    assert set(lessons.config.sweep.values()) <= set(data["k_star"].values)
    assert data.attrs["learnt_from"] == f"3d/{lessons.last_release.point.name}"
    assert list(onsets_of([data])["model"]) == ["3d"]
    assert lessons.limit_cycles().table["limit_cycle_deg"].size == data.sizes["k_star"]
