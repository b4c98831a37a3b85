"""Many k* of the section in one job, with the writing of their results."""

import time
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from equisection.cases import Case, SolverBlock, UnsteadyCase
from equisection.config import load_config
from equisection.solvers.registry import solver_from_config
from equisection.store.job import run_cases
from tests.benchmarks.measure import Row, limit
from tests.sample_cases import UNSTEADY
from tests.workflow.project import ROOT

NUMBERS = (10, 100, 1000)


def rows() -> Iterator[Row]:
    """Run 10, 100 and 1,000 k* as the default configuration would, each in one job."""
    cost, processor = {}, {}
    for number in NUMBERS:
        cost[number], processor[number] = _seconds(number)
    each = {number: 1e3 * cost[number] / number for number in NUMBERS}
    yield limit("1,000 k* of the section in one job", cost[1000], 20, "s")
    yield Row("processor time of it", f"{processor[1000]:.3g} s")
    yield Row(
        "time per k* with 10, 100, 1,000 of them",
        ", ".join(f"{each[number]:.3g}" for number in NUMBERS) + " ms",
        "falls",
        each[10] > each[100] > each[1000],
    )


def _seconds(number: int) -> tuple[float, float]:
    """Return the time by the clock and that of the processor."""
    with TemporaryDirectory() as folder:
        place = Path(folder)
        start, processor = time.perf_counter(), time.process_time()
        cases: dict[str, Case] = {f"k{case.k_star:.6g}": case for case in cases_of_section(number)}
        run_cases(cases, place / "out", place / "store", place / "progress.json")
        return time.perf_counter() - start, time.process_time() - processor


def cases_of_section(number: int) -> list[UnsteadyCase]:
    """Return free sections at as many k* on the default polar."""
    polar = str(ROOT / "config" / "polars" / "plate_2d_11136.csv")
    config = load_config({"embedded": {"polars": {"coarse": polar}}})
    solver = solver_from_config(config, "coarse")
    block = SolverBlock(name=solver.name, version=solver.version, settings=solver.settings("2d"))
    assert UNSTEADY.section is not None
    cases = []
    for k_star in np.linspace(4.0, 21.0, number):
        section = UNSTEADY.section.model_copy(update={"torsional_stiffness": float(k_star)})
        cases.append(
            UNSTEADY.model_copy(
                update={"k_star": float(k_star), "section": section, "solver": block}
            )
        )
    return cases
