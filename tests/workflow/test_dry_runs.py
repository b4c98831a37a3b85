import re
import shutil
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
import yaml
from snakemake.utils import update_config

from equisection.config import load_config
from equisection.paper.paper_case import is_paper_case
from equisection.run.cost import COST_MODEL, read_cost_model
from equisection.run.jobs import solver_jobs
from equisection.solvers.registry import SOLVERS, Capability
from equisection.study import plan
from tests.workflow.project import ROOT, Project, jobs_planned, one_case_at_a_time, small

EXAMPLES = sorted((ROOT / "config" / "examples").glob("*.yaml"))
SHIPPED = sorted((ROOT / "config").glob("*.yaml")) + EXAMPLES
#: Configurations of the paper's meshes that need no other one below them.
OF_THE_PAPER = [ROOT / "config" / "paper" / f"{name}.yaml" for name in ("resolution", "near_wall")]

#: Rules that run once in every run.
ONCE = (
    "config_resolved",
    "modes",
    "equivalent_section",
    "summary",
    "onset",
    "run",
)

#: Rules that run once where the sweep is at one incidence, and where it is over several.
ONCE_AT_ONE_INCIDENCE = ("response", "growth_rate")
ONCE_OVER_INCIDENCES = ("stability_map", "figures_of_map")

#: Rules of figures that run once where the solver takes many cases in one job.
ONCE_WITH_BATCHES = ("figures_of_modes", "figures_of_loads")

#: Rules that run once where the solver has a mesh of the section.
ONCE_WITH_MESH = ("section_mesh", "mesh_of_section", "courant_number")

#: Rules that run once where the solver has surface data.
ONCE_WITH_SURFACE = ("bubble", "surface_loads")

#: Rules that run once where the solver has mesh, surface data and flow of the beam.
ONCE_WITH_BEAM_AND = {
    Capability.MESH: ("plate_mesh", "mesh_of_beam"),
    Capability.SURFACE: ("surface_of_beam",),
    Capability.FIELDS: ("flow_at_tip",),
}

#: Rules that run once with the paper's beam and flow.
ONCE_WITH_THE_PAPERS_CASE = ("workflow_drawing", "paper_comparison")

#: Examples that are the paper's plate.
OF_THE_PLATE = ("own_polar", "openfoam_equilibrium", "plate_forced")

#: Examples of other beams, one of each kind of run: embedded, over incidences, CFD of an outline.
OF_EACH_KIND = ("photovoltaic_panel", "tracker_over_tilt", "openfoam_deck")

RUN_A_SOLVER = (
    "steady_batch",
    "steady_case",
    "sections_batch",
    "unsteady_batch",
    "unsteady_case",
    "forced_case",
)


def jobs_wanted(raw: dict[str, Any], batches: bool = True, with_paper: bool = True) -> Counter[str]:
    """Return the jobs of a run on a fresh clone, counted from its configuration alone.

    ``batches`` is whether the solver takes many cases in one job, ``with_paper`` whether the clone
    has what the paper adds.
    """
    config = load_config(raw)
    models, k_star = len(config.sweep.models), len(config.sweep.values())
    steady = config.steady
    of_study = len(steady.study_incidence_deg) or len(steady.incidence_deg)
    angles = len(steady.incidence_deg) + of_study * len(steady.study)
    rounds = plan.refinement_rounds(config)
    dimensions = len(plan.steady_dimensions(config))
    jobs = Counter(ONCE)
    jobs.update(ONCE_OVER_INCIDENCES if config.sweep.incidence_deg else ONCE_AT_ONE_INCIDENCE)
    if plan.has_mesh(config):
        jobs.update(ONCE_WITH_MESH)
    if plan.has_surface(config):
        jobs.update(ONCE_WITH_SURFACE)
    if dimensions == 2:
        for capability in SOLVERS[config.solver].provides & ONCE_WITH_BEAM_AND.keys():
            jobs.update(ONCE_WITH_BEAM_AND[capability])
    jobs.update(
        polar=1 if batches else dimensions,
        correction_factors=plan.has_beam_polar(config),
        given_beam_polar=bool(config.steady.beam_polar),
        grid_study=plan.has_grid_study(config),
        refine_onset=models * rounds,
    )
    if config.forced.run and not batches:
        of_beam = config.forced.beam_modes
        harmonics = len(config.forced.reduced_velocity)
        moved = 2 * (1 + of_beam) * (1 if config.forced.motion == "multi-sine" else harmonics)
        jobs.update(forced_case_file=moved, forced_case=moved)
        jobs.update(("forced_results", "forced_derivatives", "flutter_derivatives"))
        if of_beam:
            jobs.update(("forced_results", "forced_modes", "forces_on_modes"))
    if is_paper_case(config) and with_paper:
        jobs.update((*ONCE_WITH_THE_PAPERS_CASE, *(["rigid_beam_table"] * (dimensions == 2))))
    if batches:
        together = len(plan.sections_together(config))
        jobs.update(steady_cases=1, steady_batch=dimensions)
        jobs.update(sweep_cases=models > 1, unsteady_cases=models * rounds + (models == 1))
        jobs.update(sections_batch=together > 0)
        jobs.update(unsteady_batch=models * (1 + rounds) - together)
        jobs.update(ONCE_WITH_BATCHES)
    else:
        jobs.update(mode_shapes=1, section_polar=1, spanwise_loads=dimensions == 2)
        jobs.update(load_corrections=plan.has_beam_polar(config))
        jobs.update(modal_contributions="3d" in config.sweep.models)
        jobs.update(steady_case_file=dimensions * angles, steady_case=dimensions * angles)
        jobs.update(steady_results=dimensions)
        jobs.update(unsteady_case_file=models * k_star, unsteady_case=models * k_star)
        jobs.update(unsteady_results=models * (1 + rounds))
    return +jobs


def without_anything_but_python(project: Project) -> dict[str, str]:
    """Return an environment with no program to find: no solver, no dot, no shell."""
    return {
        "PATH": "",
        "HOME": str(project.folder),
        "PYTHONPATH": project.environment()["PYTHONPATH"],
        "PYTHONDONTWRITEBYTECODE": "1",
    }


@pytest.fixture(scope="module")
def clone(tmp_path_factory: pytest.TempPathFactory) -> Project:
    return Project.fresh(tmp_path_factory.mktemp("clone") / "project")


@pytest.mark.parametrize("path", [*SHIPPED, *OF_THE_PAPER], ids=lambda path: path.stem)
def test_dry_run_of_a_shipped_config_plans_the_jobs_that_it_asks_for(
    path: Path, clone: Project
) -> None:
    """Without any program, and of another beam than the paper's without a file of the paper."""
    raw = yaml.safe_load((ROOT / "config" / "config.yaml").read_text())
    update_config(raw, yaml.safe_load(path.read_text()))
    command = ("--dry-run", "--configfile", str(path.relative_to(ROOT)))
    before = set(clone.folder.rglob("*"))

    ended = clone.attempt(*command, environment=without_anything_but_python(clone))

    assert ended.returncode == 0, ended.stdout
    batches = Capability.BATCH in SOLVERS[raw["solver"]].provides
    planned = jobs_planned(ended.stdout)
    assert planned == jobs_wanted(raw, batches)
    asked = solver_jobs(load_config(raw), read_cost_model(ROOT / COST_MODEL))
    assert sum(jobs.number for jobs in asked) == sum(planned[rule] for rule in RUN_A_SOLVER)
    created = {
        path.relative_to(clone.folder).parts[0] for path in set(clone.folder.rglob("*")) - before
    }
    assert created <= {".snakemake", ".cache"}
    if path in EXAMPLES and path.stem not in OF_THE_PLATE:
        over_incidence = path.stem.endswith(("_over_incidence", "_over_tilt"))
        shown = "critical-speed" if over_incidence else "response"
        assert f"/figures/{shown}.png" in ended.stdout
        assert not re.search(r"/fig[0-9]|/paper\.csv|/table[0-9]", ended.stdout)


@pytest.mark.parametrize("further", [{}, {"incidence_deg": [2.5, 5.0]}], ids=["one", "two"])
def test_dry_run_of_one_release_plans_a_model_in_the_place_of_the_sweep(
    further: dict[str, Any], clone: Project
) -> None:
    """Kept results alone, without a solver: no job of a single case, and a map over incidences."""
    (clone.folder / "results" / "reference").mkdir(parents=True, exist_ok=True)
    files = ("config/openfoam.yaml", "config/paper/one_release.yaml")
    changes = [f"sweep={{{key}: {value}}}" for key, value in further.items()]
    command = ("--dry-run", "--configfile", *files, *(["--config", *changes] if changes else []))
    ended = clone.attempt(*command, environment=without_anything_but_python(clone))
    assert ended.returncode == 0, ended.stdout
    planned = jobs_planned(ended.stdout)
    assert planned["learnt_model"] == 2
    assert planned["refine_onset"] == 2 * 3
    assert planned["unsteady_case"] == 0
    assert planned["stability_map"] == planned["figures_of_map"] == bool(further)
    assert planned["growth_rate"] == (not further)


@pytest.fixture(scope="module")
def without_the_paper(tmp_path_factory: pytest.TempPathFactory) -> Project:
    """A clone from which everything that knows the paper is gone."""
    project = Project.fresh(tmp_path_factory.mktemp("without") / "project")
    (project.folder / "workflow" / "rules" / "paper.smk").unlink()
    shutil.rmtree(project.folder / "workflow" / "equisection" / "paper")
    shutil.rmtree(project.folder / "config" / "paper")
    return project


@pytest.mark.parametrize(
    "path",
    [
        path
        for path in (ROOT / "config" / "config.yaml", *EXAMPLES)
        if path.stem in ("config", *OF_THE_PLATE, *OF_EACH_KIND)
    ],
    ids=lambda path: path.stem,
)
def test_beams_run_without_the_paper(path: Path, without_the_paper: Project) -> None:
    raw = yaml.safe_load((ROOT / "config" / "config.yaml").read_text())
    update_config(raw, yaml.safe_load(path.read_text()))
    said = without_the_paper.run("--dry-run", "--configfile", str(path.relative_to(ROOT)))
    batches = Capability.BATCH in SOLVERS[raw["solver"]].provides
    assert jobs_planned(said) == jobs_wanted(raw, batches, with_paper=False)


@pytest.mark.parametrize(
    "sweep",
    [
        {"models": ["3d"]},
        {"models": ["2d"], "k_star": [7.0]},
        {"models": ["2d-corrected-paper", "2d-consistent"]},
        {"models": ["2d", "3d"], "onset": "refine"},
    ],
    ids=["3d alone", "one k*", "named reductions", "refined onset"],
)
def test_dry_run_plans_what_the_sweep_asks_for(sweep: dict[str, Any], project: Project) -> None:
    project.config = small(sweep=sweep)
    assert jobs_planned(project.run("--dry-run")) == jobs_wanted(small(sweep=sweep))


def test_overrides_on_the_command_line_reach_the_plan(project: Project) -> None:
    project.config = None
    planned = project.run(
        "--dry-run", "--config", "run=plate_2.b-1", "sweep={k_star: [7.0], models: [2d]}"
    )
    assert jobs_planned(planned)["unsteady_batch"] == 1
    assert "results/plate_2.b-1/unsteady/2d/sweep.json" in planned
    assert "results/paper-plate/" not in planned


def test_solver_that_takes_one_case_at_a_time_has_a_job_for_each(project: Project) -> None:
    one_case_at_a_time(project)
    sweep = {"models": ["2d", "3d"], "k_star": [6.0, 10.0, 21.0]}
    project.config = small(sweep=sweep)
    assert jobs_planned(project.run("--dry-run")) == jobs_wanted(small(sweep=sweep), batches=False)


def test_lint_finds_nothing(project: Project) -> None:
    project.config = None
    assert "Congratulations" in project.run("--lint")
