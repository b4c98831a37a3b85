"""Memory, time and ranks of the jobs that run a solver, from the cost model.

Like everything that the graph is built from, they come from the configuration alone.
"""

from equisection.cases import kinds
from equisection.run import jobs
from equisection.run import cost
from equisection.solvers.protocol import MPIRUN

# A solver need not tell what its jobs will ask for; they then get what starting them takes.
TELLS_WORK = bool(SOLVERS[CONFIG.solver].work)

try:
    COSTS = cost.read_cost_model(PROJECT / cost.COST_MODEL)
    for dimension in SOLVERS[CONFIG.solver].dimensions if TELLS_WORK else ():
        COSTS.of(CONFIG.solver, dimension)
except ConfigError as error:
    print(error, file=sys.stderr)
    sys.exit(1)


def dimension_of(wildcards):
    """Return the dimension of a job's cases."""
    if "dimension" in wildcards.keys():
        return wildcards.dimension
    if "model" not in wildcards.keys():
        return "2d"  # sections together
    return plan.model(wildcards.model, CONFIG.reduction).dimension


def ranks(wildcards):
    """Return the threads of a job, each a rank of MPI if there are more than one."""
    return CONFIG.solver_section.threads(dimension_of(wildcards))


def launcher(wildcards):
    """Return the command that starts the ranks on one machine; empty for a job on one rank."""
    return MPIRUN if ranks(wildcards) > 1 else ""


def work_of(wildcards):
    """Return the work of a job."""
    dimension = dimension_of(wildcards)
    if not wildcards.keys():
        return jobs.batch_work(CONFIG, kinds.FREE, *SECTIONS_TOGETHER)
    if "motion" in wildcards.keys():
        return cost.work_of(CONFIG, kinds.FORCED, dimension, CONFIG.steady.resolution)
    if "angle" in wildcards.keys():
        resolution, _ = plan.rigid_point(wildcards.angle)
        return cost.work_of(CONFIG, kinds.STEADY, dimension, resolution)
    if "case" in wildcards.keys():
        return cost.work_of(CONFIG, kinds.FREE, dimension, CONFIG.run_resolution)
    if "batch" in wildcards.keys():
        return jobs.batch_work(CONFIG, kinds.FREE, wildcards.model)
    return jobs.batch_work(CONFIG, kinds.STEADY, dimension)


def work_and_costs(wildcards):
    """Return the work of a job, and what a cell costs."""
    if not TELLS_WORK:
        return cost.NOT_TOLD
    return work_of(wildcards), COSTS.of(CONFIG.solver, dimension_of(wildcards))


def memory(wildcards, attempt):
    """Return the memory of a job (MB); one that ran out of it gets as much again."""
    return attempt * cost.megabytes(*work_and_costs(wildcards), ranks(wildcards))


def memory_of_plate_mesh(wildcards, attempt):
    """Return the memory of a job that makes the mesh of the beam (MB), on one rank."""
    work = cost.work_of(CONFIG, kinds.STEADY, "3d", CONFIG.steady.resolution)
    return attempt * cost.megabytes(work, COSTS.of(CONFIG.solver, "3d"), 1)


def runtime(wildcards):
    """Return the time of a job (minutes), which goes on in the next one if that is too little."""
    return cost.minutes(*work_and_costs(wildcards), ranks(wildcards))
