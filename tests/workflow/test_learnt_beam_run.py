"""`sweep.onset: model` learns the beam from a release of its own and its loads along the span."""

import logging
from pathlib import Path

import numpy as np
import pytest

from equisection.analysis.learning import Lessons
from equisection.analysis.learnt_dataset import dataset_of, onsets_of
from equisection.analysis.learnt_lines import LearntLine
from equisection.analysis.learnt_map import map_of_learnt, stability_of_learnt
from equisection.config import load_config
from equisection.results.netcdf import write_dataset
from equisection.results.section_dataset import nominal_k_star
from equisection.study.axes import AsGiven
from tests.workflow.project import Project, small

LEARNT = {"models": ["3d"], "onset": "model", "k_star": [6.0, 10.0, 21.0]}


def test_model_and_map_of_the_beam_are_made_from_its_own_files(tmp_path: Path) -> None:
    config = small(sweep={**LEARNT, "incidence_deg": [2.5, 4.0]})
    project = Project.fresh(tmp_path / "project", config)
    said = project.run(
        "-n", project.target("rom/3d/model_a4.nc"), project.target("comparison/stability_map.nc")
    )
    of_model, of_map = (
        said.partition(f"{message}\n")[2].splitlines()[0]
        for message in (
            "3d: model learnt from its releases",
            "stability over incidence and speed, by learnt models",
        )
    )
    for made in ("steady/polar_3d.nc", "structure/modes.nc"):
        assert made in of_model
        assert made in of_map
    assert "unsteady/3d/round3.json" in of_model
    assert "rom/3d/model_a2.5.nc" in of_map
    assert "polar_2d" not in of_model + of_map


def test_finished_sweep_of_the_beam_can_be_learnt_from(
    finished_sweep: Project, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    """The model of a release says what it is, and the angles that its polar lacks are named."""
    lessons = Lessons.read(
        load_config(small(sweep=LEARNT)),
        "3d",
        {
            "releases": [str(finished_sweep.results / "unsteady" / "3d" / "sweep.json")],
            "equivalent": str(finished_sweep.results / "structure" / "equivalent.nc"),
            "modes": str(finished_sweep.results / "structure" / "modes.nc"),
            "polar_3d": str(finished_sweep.results / "steady" / "polar_3d.nc"),
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
    assert not lessons.limit_cycles().words  # too few terms for large amplitudes
    # its map has two kinds of modes, and the speed of the model
    given = AsGiven(nominal_k_star(lessons.data["equivalent"]), lessons.config.flow.speed)
    line = LearntLine(lessons, data, given, np.geomspace(20.0, 60.0, 9))
    table = stability_of_learnt([line], chord=lessons.config.beam.chord, design_speed=10.0)
    found = map_of_learnt([line], table, chord=lessons.config.beam.chord)
    write_dataset(tmp_path / "map.nc", found)
    assert sorted(found["mode"].values) == ["bending 1", "bending 2", "torsion 1", "torsion 2"]
    growth = found["growth_rate"].isel(model=0, incidence_deg=0).values
    assert (growth > 0.0).tolist() == (found["speed"].values > line.small[0]).tolist()
    (row,) = table.to_dict("records")
    onset = float(given.speed_at(data.attrs["onset_k_star"]))
    assert row["speed"] == pytest.approx(onset, nan_ok=True)
    assert row["basis"] == "model"
