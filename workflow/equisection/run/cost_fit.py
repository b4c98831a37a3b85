"""Fit of the cost model to results, each of which has its time and, by its case, its work."""

from __future__ import annotations

import json
from collections import defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from typing import Any

import yaml

from equisection.cases.kinds import kind_named
from equisection.errors import ResultFileError
from equisection.files import write_text
from equisection.results.failures import failure_of
from equisection.results.netcdf import read_attributes
from equisection.run.cost import CostModel
from equisection.solvers.openfoam.work_done import work_done

_HEADER = """\
# What one cell costs a solver, by dimension: s of processor per iteration of the steady flow, s of
# processor per iteration of a time step, and memory in kB. For the embedded solver a cell is a
# section of a case. docs/cluster.md says what memory and time each job asks for by these, and how
# they were measured; `make cost-model` fits the times of OpenFOAM to the results that are there.
"""


@dataclass(frozen=True)
class Fit:
    """A coefficient and the results behind it.

    Attributes
    ----------
    solver, dimension, term
        Entry of the cost model.
    values
        s per cell and iteration, or step, of each result, ascending.
    """

    solver: str
    dimension: str
    term: str
    values: tuple[float, ...]

    @property
    def value(self) -> float:
        """Median, so that a run on a busy machine does not count more than others."""
        return float(f"{median(self.values):.3g}")

    def words(self) -> str:
        """Return the fit as a line for a person."""
        low, high = (value / self.value for value in (self.values[0], self.values[-1]))
        return (
            f"{self.solver} {self.dimension} {self.term}: {self.value:.3g} s per cell, from "
            f"{len(self.values)} results at {low:.2f} to {high:.2f} times that"
        )


def fits(folders: Iterable[Path]) -> list[Fit]:
    """Return the fits to results below some folders; a result that is there twice counts once."""
    found: dict[tuple[str, str, str], dict[str, float]] = defaultdict(dict)
    for folder in folders:
        for path in sorted(folder.rglob("*.nc")):
            attributes = _attributes(path)
            measured = _measured(attributes)
            if measured:
                key, value = measured
                found[key][str(attributes["case_hash"])] = value
    return [Fit(*key, tuple(sorted(values.values()))) for key, values in sorted(found.items())]


def fitted(model: CostModel, found: Iterable[Fit]) -> CostModel:
    """Return the model with the coefficients that were fitted; the others stay."""
    values = model.model_dump()
    for fit in found:
        values[fit.solver][fit.dimension][fit.term] = fit.value
    return CostModel.model_validate(values)


def write_cost_model(path: Path, model: CostModel) -> None:
    """Write the coefficients, whole or not at all."""
    write_text(path, _HEADER + yaml.safe_dump(model.model_dump(), sort_keys=False))


def _measured(attributes: dict[str, Any]) -> tuple[tuple[str, str, str], float] | None:
    """Return which coefficient a result is of, and its value.

    None for what fits no coefficient: a beam's release from static equilibrium has moved its mesh
    there, too, which is no step.
    """
    case = json.loads(attributes.get("case", "{}"))
    if not case or failure_of(attributes) or case["solver"]["name"] != "openfoam":
        return None
    if case["dimension"] == "3d" and case.get("start", {}).get("state") == "equilibrium":
        return None
    work, spent = work_done(case, attributes), float(attributes["cpu_seconds"])
    if work is None or spent <= 0:
        return None
    term = kind_named(case["kind"]).cost_term
    amount = work.cells * (work.iterations + work.steps)
    return ("openfoam", case["dimension"], term), spent / amount


def _attributes(path: Path) -> dict[str, Any]:
    """Return a file's attributes; none of what is broken."""
    try:
        return read_attributes(path)
    except ResultFileError:
        return {}
