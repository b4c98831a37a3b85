"""Common to all rules: the validated configuration, places of files, and package sources."""

import hashlib
import os
import time

import equisection
from equisection.cases import KINDS
from equisection.study import plan
from equisection.config import resolve_config
from equisection.config.groups import FLAT_PLATE
from equisection.provenance import command_line, config_hash
from equisection.run.source_digest import source_digest
from equisection.store.mend import put_aside, unsound_files
from equisection.study.axes import RIGID_PATTERN, SWEEP_PATTERN, onset_axis, varied
from equisection.study.result_files import index_of_beam, indices_of_sweep
from equisection.solvers.registry import SOLVERS, Capability

# The folder of results, as rules name it and, in a module with a prefix, as it is on the disk.
PLACE = workflow.pathvars.apply("<results>")
PLACE_ON_DISK = Path(workflow.modifier.modify_path(PLACE))

try:
    CONFIG = start.checked_config(config, PROJECT, PLACE_ON_DISK)
except ConfigError as error:
    print(error, file=sys.stderr)
    sys.exit(1)

RESOLVED = resolve_config(CONFIG)
RESULTS = f"{PLACE}/{CONFIG.run}"
LOGS = f"{RESULTS}/logs"
STORE = str(PLACE_ON_DISK / start.STORE)
# Results that are only looked up, so that a later run that computes does not find them.
KEPT_STORE = str(PLACE_ON_DISK / CONFIG.run / ".kept")
ENVIRONMENT = "../../envs/environment.yaml"
# Priority of jobs that others wait for; figures are drawn in between. The modes are the longest.
FIRST = 50
PROVIDES = SOLVERS[CONFIG.solver].provides
# Whether all cases of a batch go to one job: the solver takes many, or they are only looked up.
IN_ONE_JOB = Capability.BATCH in PROVIDES or not CONFIG.compute
# Whether cases may have no result: none is kept, or no file has it.
MAY_MISS = Capability.RECORDS in PROVIDES or not CONFIG.compute
# Models whose cases of the sweep one job writes, since a solver that takes many cases is quick, and
# those of a section that it also runs in one.
WRITTEN_TOGETHER = list(CONFIG.sweep.models) if Capability.BATCH in PROVIDES else []
SECTIONS_TOGETHER = plan.sections_together(CONFIG)
DIMENSIONS = plan.steady_dimensions(CONFIG)
SWEEP = plan.sweep_cases(CONFIG)
STEADY = plan.steady_cases(CONFIG)
MESH_CASE = plan.rigid_case(CONFIG.steady.resolution, CONFIG.flow.incidence_deg)

# Jobs inherit what tells them where the solver is on this machine.
for name, value in CONFIG.solver_section.environment().items():
    os.environ.setdefault(name, value)

if workflow.is_main_process:
    # They inherit, too, what the files that they make say of where they come from.
    start.tell_jobs(command_line(sys.argv), config_hash(RESOLVED))
    # What was cut short by a crash, altered, lost or exchanged must not pass for a finished result.
    unsound = unsound_files(PLACE_ON_DISK / CONFIG.run)
    if unsound and start.changes_files(sys.argv[1:]):
        start.say(put_aside(unsound))
    else:
        start.say(file.words(done=False) for file in unsound)
    start.say(start.notices(CONFIG, PLACE_ON_DISK))


STARTED = time.time()


onsuccess:
    from equisection.run.verify import verify_made

    start.say(verify_made(PLACE_ON_DISK / CONFIG.run, STARTED))


wildcard_constraints:
    dimension=plan.DIMENSION_PATTERN,
    model=plan.MODEL_PATTERN,
    angle=RIGID_PATTERN,
    case=SWEEP_PATTERN,
    batch=plan.BATCH_PATTERN,
    motion=plan.FORCED_PATTERN,


# What may be added to the runs of one beam (paper.smk): further names of figures, tables of values
# to draw beside their own, and further files.
FURTHER_NAMES = {}
REFERENCES = []
FURTHER_FILES = []


def given(paths):
    """Return files from outside as such: the prefix of a module is not put before them."""
    return [local(path) for path in paths]


def of_project(pattern):
    """Return files of the project by relative paths, so that a project that was moved has nothing
    to do; they are found from another working directory too.
    """
    return given(os.path.relpath(path) for path in sorted(PROJECT.glob(pattern)))


def code(script, *further):
    """Return a function that gives the digest of the modules of a script, for `params`: editing one
    makes the outputs of cheap rules anew. `further` are modules that are loaded by name. Rules that
    run a solver have no digest: their case file decides.
    """
    path = PROJECT / "scripts" / f"{script}.py"

    def digest(wildcards):
        return source_digest(path, further)

    return digest


def solver_input_files():
    """Return the files that the configured solver reads, for instance section polars, and the
    beam's outline.
    """
    return given(CONFIG.solver_section.input_files() + CONFIG.beam.input_files)


def table_of_derivatives():
    """Return the table of flutter derivatives, if the run makes one or the configuration names one."""
    if CONFIG.forced.run:
        return derivative_files()[:1]
    return given([CONFIG.derivatives.table] if CONFIG.derivatives.table else [])


def modes_of_table():
    """Return the modes of the beam, if the table of derivatives gives its onset too."""
    wanted = table_of_derivatives() and "3d" in CONFIG.sweep.models
    return [f"{RESULTS}/structure/modes.nc"] if wanted else []


def case_files_of_forced(dimension):
    """Return the case files of the forced motions of a dimension."""
    names = ["forced"] if IN_ONE_JOB else plan.forced_names(CONFIG, dimension)
    return [f"{RESULTS}/cases/forced/{dimension}/{name}.json" for name in names]


def motions(wildcards):
    """Return the forced cases of a dimension."""
    return list(plan.forced_names(CONFIG, wildcards.dimension))


def case_files_of_motions(wildcards):
    """Return the case files of the forced motions that a rule is about."""
    return case_files_of_forced(wildcards.dimension)


def results_of_motions(wildcards):
    """Return the results of the forced motions that a rule is about."""
    place = f"{RESULTS}/forced/{wildcards.dimension}"
    return [f"{place}/{name}.nc" for name in motions(wildcards)]


def modes_of_motions(wildcards):
    """Return the modes of the beam, if the forced motions are in them."""
    return [f"{RESULTS}/structure/modes.nc"] if wildcards.dimension == "3d" else []


def derivative_files():
    """Return the derivatives from forced motion, and the forces on modes, of what is moved."""
    return [
        f"{RESULTS}/derivatives/{dimension}{part}.csv"
        for dimension in plan.forced_dimensions(CONFIG)
        for part in ("", "-fit")
    ]


def forces_on_modes():
    """Return the forces on the modes of the beam, if its onset is found by them."""
    moved = "3d" in plan.forced_dimensions(CONFIG) and "3d" in CONFIG.sweep.models
    return [f"{RESULTS}/derivatives/3d.csv"] if moved else []


def kept_files():
    """Return the kept results that are taken where none is computed, so that new ones are seen."""
    found = Path(CONFIG.reuse).rglob("*.nc") if not CONFIG.compute else []
    return given(sorted(map(str, found)))


def section_polar():
    """Return the file of the section polar of the run's resolution, if it is one."""
    path = CONFIG.embedded.polars.get(CONFIG.steady.resolution, FLAT_PLATE)
    return given([] if path == FLAT_PLATE else [path])


def of_dimensions(pattern):
    """Return the files of the steady cases of all dimensions where one job writes them, or else the
    pattern of those of one.
    """
    return expand(pattern, dimension=DIMENSIONS) if WRITTEN_TOGETHER else pattern


def log_of_dimensions(name):
    """Return the log of such a job."""
    return (
        f"{LOGS}/{name}.log" if WRITTEN_TOGETHER else f"{LOGS}/{name}_{{dimension}}.log"
    )


def structure_of_model(wildcards):
    """Return the files that a model's cases are made from."""
    return structure_of(wildcards.model)


def structure_of(name):
    """Return the files that the cases of the model of a name are made from."""
    model = plan.model(name, CONFIG.reduction)
    files = {"equivalent": f"{RESULTS}/structure/equivalent.nc"}
    if model.dimension == "3d":
        files["modes"] = f"{RESULTS}/structure/modes.nc"
    if model.corrected:
        files["correction"] = f"{RESULTS}/steady/correction.nc"
    if plan.starts_by_polar(CONFIG):
        files |= polar_of_dimension(model.dimension)
    return files


def structure_of_models():
    """Return the files that the cases of all models are made from."""
    return {
        name: path
        for model in WRITTEN_TOGETHER
        for name, path in structure_of(model).items()
    }


def sweeps_of(models, place):
    """Return the files of the sweeps of some models, cases or indices of results."""
    return [
        f"{RESULTS}/{place}unsteady/{model}/{plan.SWEEP_BATCH}.json" for model in models
    ]


def inputs_of_batch(wildcards):
    """Return the files that a batch of a model's cases is made from, with the k* of a round."""
    files = structure_of_model(wildcards)
    if wildcards.batch != plan.SWEEP_BATCH:
        files["chosen"] = (
            f"{RESULTS}/comparison/refine/{wildcards.model}_{wildcards.batch}.json"
        )
    return files


def cases_of_sweep(wildcards):
    """Return the cases of the sweep of a model."""
    return plan.sweep_cases(CONFIG, wildcards.model) if plan.learns(CONFIG) else SWEEP


def cases_of_sweeps():
    """Return the cases of the sweep of all models, by the model where they differ."""
    if not plan.learns(CONFIG):
        return SWEEP
    return {model: plan.sweep_cases(CONFIG, model) for model in CONFIG.sweep.models}


def learnt_from(model, batches):
    """Return the files that a model of the loads is learnt from, and its sections are made from."""
    learner = plan.learner(CONFIG, model)
    return {
        "releases": [
            f"{RESULTS}/unsteady/{learner}/{batch}.json" for batch in batches[:2]
        ],
        "confirming": [
            f"{RESULTS}/unsteady/{model}/{batch}.json" for batch in batches[2:]
        ],
        **polar_of_learnt(model),
        **structure_of(model),
    }


def polar_of_learnt(name):
    """Return the polar that a learnt model has as its steady part, by its name."""
    return polar_of_dimension(plan.model(name, CONFIG.reduction).dimension)


def polar_of_dimension(dimension):
    """Return the steady polar of the section or the beam, by its name."""
    polar = f"polar_{dimension}"
    return {polar: f"{RESULTS}/steady/{polar}.nc"}


def polars_of_learnt():
    """Return the polars that the learnt models of the run have as their steady parts."""
    return {
        name: path
        for model in CONFIG.sweep.models
        for name, path in polar_of_learnt(model).items()
    }


def learnt_before_round(wildcards):
    """Return the files that a round of learning decides on."""
    return learnt_from(wildcards.model, plan.batches_before(wildcards.batch))


def learnt_in_all(wildcards):
    """Return the files that the model is learnt from in the end."""
    return learnt_from(wildcards.model, plan.batches(CONFIG))


def learnt_models():
    """Return the models that were learnt, if any."""
    if not plan.learns(CONFIG):
        return []
    return [
        f"{RESULTS}/rom/{model}/{name}.nc"
        for model in CONFIG.sweep.models
        for name in plan.learnt_names(CONFIG)
    ]


def placed(paths):
    """Return files of results, of which those that are taken from elsewhere get no prefix."""
    taken = set(CONFIG.sweep.taken.values())
    return [local(path) if path in taken else path for path in paths]


def indices_before_round(wildcards):
    """Return the results that a round of refinement decides on: those of the batches before."""
    return [
        f"{RESULTS}/unsteady/{wildcards.model}/{batch}.json"
        for batch in plan.batches_before(wildcards.batch)
    ]


def cases_of_batch(wildcards):
    """Return case file and result file of each case of a batch that runs them one by one."""
    names = cases_of_sweep(wildcards)
    if wildcards.batch != plan.SWEEP_BATCH:
        chosen = checkpoints.refine_onset.get(**wildcards).output[0]
        names = plan.read_refinement(Path(chosen))
    place = f"unsteady/{wildcards.model}"
    return {
        "cases": [f"{RESULTS}/cases/{place}/{name}.json" for name in names],
        "results": [f"{RESULTS}/{place}/{name}.nc" for name in names],
    }


def this_case(wildcards):
    """Return the one case that a rule is about."""
    return [wildcards.case]


def this_motion(wildcards):
    """Return the one forced case that a rule is about."""
    return [wildcards.motion]


def this_angle(wildcards):
    """Return the one steady case that a rule is about."""
    return [wildcards.angle]


def structure_files():
    """Return the results on the beam without a flow."""
    return [
        f"{RESULTS}/structure/{name}.nc"
        for name in ("modes", "mesh_study", "equivalent")
    ]


def steady_files():
    """Return the results of the rigid section and beam, indexed and gathered."""
    return [
        *(f"{RESULTS}/steady/{dimension}/polar.json" for dimension in DIMENSIONS),
        *(f"{RESULTS}/steady/polar_{dimension}.nc" for dimension in DIMENSIONS),
        *correction_of_beam(),
    ]


def polar_of_beam():
    """Return the polar of the rigid beam, if the solver runs it."""
    return [f"{RESULTS}/steady/polar_3d.nc"] if "3d" in DIMENSIONS else []


def correction_of_beam():
    """Return the correction for the finite beam, if there is a polar of the rigid one."""
    return [f"{RESULTS}/steady/correction.nc"] if plan.has_beam_polar(CONFIG) else []


def figure_files():
    """Return the figures of the run, under all of their names."""
    return [
        f"{RESULTS}/figures/{name}.{suffix}"
        for entry in catalogue.figures(CONFIG)
        for name in filter(None, names_of([entry]).popitem())
        for suffix in CONFIG.figure_formats
    ]


def grid_study_of_section():
    """Return the grid study of the section, if it is run on three meshes."""
    return [f"{RESULTS}/tables/grid_study.csv"] if plan.has_grid_study(CONFIG) else []


def bubble_of_section():
    """Return the table of the section's bubble, if the solver has surface data."""
    return [f"{RESULTS}/tables/bubble.csv"] if plan.has_surface(CONFIG) else []


def sections_against_beam():
    """Return the table of the sections against the beam, if models of both are run."""
    if not plan.has_both(CONFIG):
        return []
    return [f"{RESULTS}/comparison/section_and_beam.csv"]


def stability_table_of_map():
    """Return the table of the map of stability by eigenvalues, if the run has one."""
    if not plan.has_stability_map(CONFIG) or plan.has_learnt_map(CONFIG):
        return []
    return [f"{RESULTS}/comparison/stability.csv"]


def in_use_of_map():
    """Return the tables of the models at the design speed, if the run has one."""
    if not stability_table_of_map() or CONFIG.flow.design_speed is None:
        return {}
    return {
        name: f"{RESULTS}/comparison/{name}.csv" for name in ("in_use", "reactions")
    }


def structure_of_map():
    """Return the files that the models of the map of stability are made from."""
    return {
        name: path
        for model in CONFIG.sweep.models
        for name, path in structure_of(model).items()
    }


def map_files():
    """Return the map of stability with its tables, if the run has one."""
    if not plan.has_stability_map(CONFIG):
        return []
    if plan.has_learnt_map(CONFIG):
        return [
            f"{RESULTS}/comparison/stability_map.nc",
            f"{RESULTS}/comparison/stability.csv",
        ]
    return [
        f"{RESULTS}/comparison/stability_map.nc",
        *stability_table_of_map(),
        f"{RESULTS}/comparison/sensitivities.csv",
        *in_use_of_map().values(),
    ]


def comparison_files():
    """Return the tables that compare the models with each other."""
    tables = ("summary", "onset", "critical_speed", "linear_theory")
    missing = ("missing",) if MAY_MISS else ()
    return [
        *map_files(),
        *(f"{RESULTS}/comparison/{name}.csv" for name in (*tables, *missing)),
        *sections_against_beam(),
    ]


def table_files():
    """Return the tables of the steady cases."""
    return [*grid_study_of_section(), *bubble_of_section()]


def files_of_run():
    """Return every figure, table and comparison of the run, and every result behind them."""
    return [
        f"{RESULTS}/config.resolved.yaml",
        *structure_files(),
        *steady_files(),
        *indices_of_sweep(CONFIG, RESULTS),
        *learnt_models(),
        *comparison_files(),
        *derivative_files(),
        *figure_files(),
        *table_files(),
        *FURTHER_FILES,
    ]
