"""What runs again after a change, and what does not."""

from pathlib import Path

import pandas as pd
import xarray as xr

from tests.workflow.project import Project, has_nothing_to_do, jobs_run, small

SUMMARY = "comparison/summary.csv"
SOLVER_RULES = {
    "steady_batch",
    "steady_case",
    "sections_batch",
    "unsteady_batch",
    "unsteady_case",
}


def results_of_solver(project: Project) -> dict[str, bytes]:
    return {
        name: content
        for name, content in project.files().items()
        if name.startswith(("steady/2d/", "steady/3d/", "unsteady/")) and name.endswith(".nc")
    }


def test_editing_the_package_without_changing_a_case_runs_no_solver(
    finished_sweep: Project, tmp_path: Path
) -> None:
    project = finished_sweep.copy(tmp_path / "project")
    before = results_of_solver(project)
    for module in ("solvers/embedded/adapter.py", "structure/modes.py", "aerodynamics/polar.py"):
        with (project.folder / "workflow" / "equisection" / module).open("a") as source:
            source.write("# Nothing that decides a result.\n")

    done = jobs_run(project.run(project.target(SUMMARY)))

    assert {"modes", "steady_cases", "sweep_cases"} <= set(done)
    assert not SOLVER_RULES & set(done)
    assert results_of_solver(project) == before
    assert has_nothing_to_do(project.run(project.target(SUMMARY)))


def test_touching_a_polar_file_runs_no_solver(section: Project) -> None:
    before = results_of_solver(section)
    (section.folder / "config" / "polars" / "plate_2d_11136.csv").touch()
    assert not SOLVER_RULES & set(jobs_run(section.run(section.target(SUMMARY))))
    assert results_of_solver(section) == before


def test_one_more_k_star_computes_that_one_alone(section: Project) -> None:
    before = results_of_solver(section)
    stored = {path.name for path in (section.folder / "results" / ".store").iterdir()}
    section.config = small(sweep={"models": ["2d"], "k_star": [6.0, 8.0, 10.0, 21.0]})

    done = jobs_run(section.run(section.target(SUMMARY)))

    after = results_of_solver(section)
    assert done["unsteady_batch"] == 1
    assert set(after) - set(before) == {"unsteady/2d/k8.nc"}
    # the results hold what they cost, so that a second computation would show
    assert {name: after[name] for name in before} == before
    assert len(list((section.folder / "results" / ".store").iterdir())) == len(stored) + 1
    with xr.open_dataset(section.results / "unsteady" / "2d" / "k8.nc") as run:
        assert run.attrs["batch_cases"] == 1


def test_another_run_with_the_same_cases_shares_their_results(section: Project) -> None:
    before = results_of_solver(section)
    assert section.config is not None
    section.config["run"] = "other-name_2.b"
    section.run(section.target(SUMMARY))
    assert results_of_solver(section) == before


def test_another_time_step_computes_the_sweep_again(section: Project) -> None:
    before = results_of_solver(section)
    section.config = small(sweep={"models": ["2d"]}, unsteady={"time_step": 0.1})
    done = jobs_run(section.run(section.target(SUMMARY)))
    assert done["unsteady_batch"] == 1
    after = results_of_solver(section)
    assert set(after) == set(before)
    assert all(after[name] != before[name] for name in before)


def test_another_value_in_the_polar_computes_the_sweep_again(section: Project) -> None:
    polar = section.folder / "config" / "polars" / "plate_2d_11136.csv"
    text = polar.read_text()
    assert "\n3,0.45675," in text
    polar.write_text(text.replace("\n3,0.45675,", "\n3,0.41675,"))

    done = jobs_run(section.run(section.target(SUMMARY)))

    assert done["unsteady_batch"] == 1
    with xr.open_dataset(section.results / "unsteady" / "2d" / "k21.nc") as run:
        assert run.attrs["batch_cases"] == 3
    assert has_nothing_to_do(section.run(section.target(SUMMARY)))


def test_correction_by_what_the_modes_feel_computes_the_corrected_section_alone(
    finished_sweep: Project, tmp_path: Path
) -> None:
    """They feel less than the mean of a load that is lost at the tip: less twist and deflection."""
    project = finished_sweep.copy(tmp_path / "project")
    project.config = small(correction="modal")
    before = pd.read_csv(project.results / SUMMARY).set_index(["model", "k_star"])

    done = jobs_run(project.run(project.target(SUMMARY)))

    assert done["correction_factors"] == done["sections_batch"] == 1
    assert not {"modes", "steady_batch", "unsteady_batch"} & set(done)
    for name, content in results_of_solver(finished_sweep).items():  # what they cost is in them too
        same = (project.results / name).read_bytes() == content
        assert same == ("2d-corrected" not in name)
    after = pd.read_csv(project.results / SUMMARY).set_index(["model", "k_star"])
    loads = ["mean_twist_deg", "mean_deflection_chords"]
    for model in ("2d", "3d"):
        assert after.loc[model].equals(before.loc[model])
    changed = after.loc["2d-corrected", loads] / before.loc["2d-corrected", loads]
    assert ((changed > 0.7) & (changed < 0.99)).all(axis=None)
    assert has_nothing_to_do(project.run(project.target(SUMMARY)))
