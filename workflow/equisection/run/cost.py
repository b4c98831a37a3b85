"""The cost model: memory and time of a job, from its work and what a cell costs.

    seconds of the processors = cells (iterations c_i + steps c_s)
    time asked for            = START_UP + SAFETY * seconds/ranks
    memory asked for          = PYTHON + RANK * ranks + MARGIN * cells * m

with c_i in s per cell and iteration, c_s in s per cell and step of one outer corrector, m in kB per
cell. Linear in the cells, since that is what the iterations of a multigrid solver are; and
in 1/ranks, so a job on more ranks than its mesh is worth needs ``--set-resources``. The
coefficients are those of a machine: ``workflow/profiles/cost.yaml`` holds them, ``make cost-model``
fits c_i and c_s to the results that are there.
"""

from __future__ import annotations

import math
from importlib import import_module
from pathlib import Path
from typing import Annotated

import yaml
from pydantic import Field, RootModel, ValidationError

from equisection.cases import Kind
from equisection.config import Config
from equisection.config.groups import KeyGroup
from equisection.errors import ConfigError
from equisection.keys.shown import shown
from equisection.keys.values import NotNegative
from equisection.solvers.registry import SOLVERS
from equisection.solvers.work import Work

#: The cost model of a clone, as seen from where the workflow is started.
COST_MODEL = Path("workflow") / "profiles" / "cost.yaml"
#: What a job is given beyond what it is expected to take: other processors, company on the memory
#: bus, a flow that needs more iterations of the pressure.
SAFETY = 3.0
#: Starting up, reading, meshing and writing (minutes).
START_UP = 10.0
#: Python with what a job imports, and a program without a mesh on one rank (MB).
PYTHON, RANK = 400.0, 100.0
#: Room for memory that was not measured, such as that of the cells between ranks.
MARGIN = 1.5


class CellCost(KeyGroup):
    """Cost of one cell for a solver in one dimension."""

    iteration: NotNegative = Field(description="s of processor per iteration of the steady flow.")
    step: NotNegative = Field(description="s of processor per iteration of a time step.")
    memory_kb: NotNegative = Field(description="Memory (kB).")


#: Work and cost of a job whose solver does not tell them: it asks for what starting it takes.
NOT_TOLD = (Work(cells=0.0), CellCost(iteration=0.0, step=0.0, memory_kb=0.0))


class CostModel(
    RootModel[dict[str, Annotated[dict[str, CellCost], Field(min_length=1)]]], frozen=True
):
    """Cost of a cell, by solver and dimension."""

    def of(self, solver: str, dimension: str) -> CellCost:
        """Return the cost of a cell of a solver.

        Raises
        ------
        ConfigError
            The model does not have it.
        """
        try:
            return self.root[solver][dimension]
        except KeyError:
            raise ConfigError(
                f"cost model: no entry {solver}.{dimension}; add iteration, step and memory_kb "
                "of one cell to workflow/profiles/cost.yaml"
            ) from None


def read_cost_model(path: Path) -> CostModel:
    """Read the coefficients.

    Raises
    ------
    ConfigError
        The file is missing or not a cost model; the message names file and key.
    """
    try:
        return CostModel.model_validate(yaml.safe_load(path.read_text(encoding="utf-8")))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        why = " ".join(str(error).split())
        raise ConfigError(f"{path}: cannot be read as a cost model ({why})") from None
    except ValidationError as error:
        first = error.errors()[0]
        where = ".".join(map(str, first["loc"]))
        raise ConfigError(
            f"{path}: {where}: {shown(first['input'])}: allowed are numbers from 0 on "
            "under solver, dimension, and iteration, step, memory_kb"
        ) from None


def seconds(work: Work, cost: CellCost) -> float:
    """Return the time of the processors (s) that a job takes."""
    return work.cells * (work.iterations * cost.iteration + work.steps * cost.step)


def minutes(work: Work, cost: CellCost, ranks: int) -> int:
    """Return the time by the clock (minutes) that a job asks for."""
    return math.ceil(START_UP + SAFETY * seconds(work, cost) / ranks / 60)


def megabytes(work: Work, cost: CellCost, ranks: int) -> int:
    """Return the memory (MB) that a job asks for, all ranks together."""
    return math.ceil(PYTHON + RANK * ranks + MARGIN * work.cells * cost.memory_kb / 1024)


def work_of(config: Config, kind: Kind, dimension: str, resolution: str, cases: int = 1) -> Work:
    """Return the work of a job of the configured solver.

    Parameters
    ----------
    config
        The configuration.
    kind, dimension, resolution, cases
        Kind, dimension, resolution and number of the cases of the job.

    Raises
    ------
    ConfigError
        The solver gives no work of such cases.
    """
    module = SOLVERS[config.solver].work
    estimate = getattr(import_module(module), kind.work_function, None) if module else None
    if estimate is None:
        raise ConfigError(
            f"solver: '{config.solver}' does not tell the work of {kind.name} cases; "
            f"{kind.work_function} is to be in {module or 'a module that the registry names'}"
        )
    work: Work = estimate(config, dimension, resolution, cases)
    return work
