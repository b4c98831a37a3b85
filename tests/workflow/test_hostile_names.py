"""A path with everything that a shell would act on, through Snakemake and its jobs."""

import shutil
from pathlib import Path

from equisection.cases import read_cases
from tests.workflow.project import ROOT, Project, small

HOSTILE = "my polar; touch executed $(touch executed) `touch executed` 'q' \"d\" & x.csv"


def test_a_polar_with_a_hostile_name_is_read_and_nothing_else_happens(tmp_path: Path) -> None:
    project = Project.fresh(
        tmp_path / "project", small(embedded={"polars": {"coarse": HOSTILE}, "strips": 8})
    )
    shutil.copy(ROOT / "config/polars/plate_2d_11136.csv", project.folder / HOSTILE)
    before = {path.name for path in project.folder.iterdir()}
    project.run(project.target("cases/steady/2d/polar.json"))
    cases = read_cases(project.results / "cases/steady/2d/polar.json")
    assert len(cases) == len(project.config["steady"]["incidence_deg"])  # type: ignore[index]
    after = {path.name for path in project.folder.iterdir()}
    assert after - before == {"results", ".snakemake", "small.yaml"}
