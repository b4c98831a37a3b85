"""Maps of stability of a section and of a beam, without releases."""

import time
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from equisection.cases import SolverBlock
from equisection.config import load_config
from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.map_dataset import map_of_body
from equisection.solvers.embedded.adapter import Adapter
from tests.benchmarks.measure import Row, limit
from tests.sample_cases import UNSTEADY, UNSTEADY_PLATE, beam_modes

POLAR = Path(__file__).parents[2] / "config" / "polars" / "plate_2d_11136.csv"


def rows() -> Iterator[Row]:
    """Map a section at 40 incidences and 100 speeds, and a beam at 15 and 60."""
    solver = Adapter.from_config(
        load_config({"embedded": {"polars": {"coarse": str(POLAR)}, "strips": 12}}), "coarse"
    )
    block = SolverBlock(name=solver.name, version=solver.version, settings={})
    section = UNSTEADY.model_copy(update={"solver": block})
    beam = UNSTEADY_PLATE.model_copy(update={"solver": block, "beam": beam_modes(modes=4)})
    both = (
        ("section, 40 incidences by 100 speeds", section, 40, 100, 2.0),
        ("beam of 4 + 4 modes and 12 strips, 15 by 60", beam, 15, 60, 60.0),
    )
    for what, case, incidences, speeds, most in both:
        body = solver.body(case)
        angles, range_ = np.linspace(-6.0, 6.0, incidences), np.linspace(10.0, 60.0, speeds)
        clock, processor = _seconds(body, list(angles), list(range_))
        yield limit(f"map of a {what}", clock, most, "s")
        yield Row("processor time of it", f"{processor:.3g} s")


def _seconds(
    body: BodyInFlow, angles: Sequence[float], speeds: Sequence[float]
) -> tuple[float, float]:
    """Return the time by the clock and that of the processor."""
    clock, processor = time.perf_counter(), time.process_time()
    map_of_body(body, angles, speeds)
    return time.perf_counter() - clock, time.process_time() - processor
