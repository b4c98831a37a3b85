"""What all rules share: the validated configuration, where files go, and package sources."""

import os
import sys
from pathlib import Path

import equisection
from equisection import plan
from equisection.config import check_files, load_config, resolve_config
from equisection.errors import ConfigError
from equisection.results.whole import set_aside_broken
from equisection.solvers.registry import SOLVERS, Capability

try:
    CONFIG = load_config(config)
    check_files(CONFIG)
except ConfigError as error:
    print(error, file=sys.stderr)
    sys.exit(1)

RESOLVED = resolve_config(CONFIG)
RESULTS = f"results/{CONFIG.run}"
LOGS = f"{RESULTS}/logs"
STORE = "results/.store"
ENVIRONMENT = "../../envs/environment.yaml"
PROVIDES = SOLVERS[CONFIG.solver].provides
SWEEP = plan.sweep_cases(CONFIG)
STEADY = plan.steady_cases(CONFIG)

# A result that was cut short by a crash of the machine must not pass for a finished one.
if workflow.is_main_process:
    set_aside_broken(Path(RESULTS))


wildcard_constraints:
    dimension=plan.DIMENSION_PATTERN,
    model=plan.MODEL_PATTERN,
    case=plan.CASE_PATTERN,


def sources(*parts):
    """Return the package's source files of some parts, so that editing one redraws or
    recomputes what is cheap. Rules that run a solver take none: their case file decides.
    The paths are relative, so that a project that was moved has nothing to do.
    """
    package = Path(equisection.__file__).parent
    found = []
    for part in parts:
        place = package / part
        found += sorted(place.glob("*.py")) if place.is_dir() else [place]
    return [os.path.relpath(path) for path in found]


def solver_input_files():
    """Return the files that the configured solver reads, for instance section polars."""
    return [path for path in CONFIG.embedded.polars.values() if path != "flat-plate"]


def structure_of_model(wildcards):
    """Return what a model's cases are made from."""
    model = plan.model(wildcards.model, CONFIG.reduction)
    files = {"equivalent": f"{RESULTS}/structure/equivalent.nc"}
    if model.dimension == "3d":
        files["modes"] = f"{RESULTS}/structure/modes.nc"
    if model.corrected:
        files["correction"] = f"{RESULTS}/steady/correction.nc"
    return files


def cases_of_model(model, rounds):
    """Return the names of a model's cases: the sweep's, then those of rounds of refinement."""
    names = list(SWEEP)
    for number in range(1, rounds + 1):
        chosen = checkpoints.refine_onset.get(model=model, round=number).output[0]
        names += plan.read_refinement(Path(chosen))
    return names


def case_and_result_files(model, rounds):
    """Return case files and result files of a model, in the same order."""
    names = cases_of_model(model, rounds)
    return {
        "cases": [f"{RESULTS}/cases/unsteady/{model}/{name}.json" for name in names],
        "results": [f"{RESULTS}/unsteady/{model}/{name}.nc" for name in names],
    }


def results_before_round(wildcards):
    """Return what a round of refinement decides on: all runs of the rounds before."""
    return case_and_result_files(wildcards.model, int(wildcards.round) - 1)


def last_rounds_of_refinement():
    """Return the last round of each model, so that all models are refined side by side; the
    search for the results alone stops at the first model that is not refined yet.
    """
    rounds = plan.refinement_rounds(CONFIG)
    models = CONFIG.sweep.models if rounds else ()
    return [f"{RESULTS}/comparison/refine/{model}_{rounds}.json" for model in models]


def results_of_sweep(wildcards):
    """Return all runs of all models, with those of the refinement of the onset."""
    files = {"cases": [], "results": []}
    for model in CONFIG.sweep.models:
        found = case_and_result_files(model, plan.refinement_rounds(CONFIG))
        files["cases"] += found["cases"]
        files["results"] += found["results"]
    return files


def runs_of_sweep(wildcards):
    """Return the results of all runs of all models."""
    return results_of_sweep(wildcards)["results"]


def structure_files():
    """Return what is known of the beam without a flow."""
    return [
        f"{RESULTS}/structure/{name}.nc" for name in ("modes", "mesh_study", "equivalent")
    ]


def steady_files():
    """Return the results of the rigid section and beam, one by one and gathered."""
    single = [
        f"{RESULTS}/steady/{dimension}/{case}.nc"
        for dimension in ("2d", "3d")
        for case in STEADY
    ]
    gathered = ("polar_2d", "polar_3d", "correction")
    return single + [f"{RESULTS}/steady/{name}.nc" for name in gathered]


def figure_files():
    """Return the figures of the run, each in three formats."""
    return [
        f"{RESULTS}/figures/{name}.{suffix}"
        for name in plan.figures(CONFIG)
        for suffix in ("png", "svg", "pdf")
    ]


def comparison_files():
    """Return the tables that compare the models with each other and with the paper."""
    return [
        f"{RESULTS}/comparison/{name}.csv" for name in ("summary", "onset", "paper")
    ]


def table_files():
    """Return the paper's tables."""
    return [f"{RESULTS}/tables/{name}.csv" for name in ("table1", "table2")]
