"""Modes of the plate at the resolution of the paper's finest mesh."""

import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.benchmarks.measure import Row, limit, measured

COMPUTE = """
from equisection.config import load_config
from equisection.structure.modes import compute_modes
from equisection.structure.plate import Plate

config = load_config({})
elements = config.structure.elements
compute_modes(
    Plate(**config.beam.model_dump()),
    config.structure.method,
    (elements.chord, elements.span, elements.thickness),
    count=12,
)
print(elements.chord, "x", elements.span, "x", elements.thickness)
"""


def rows() -> Iterator[Row]:
    """Compute the modes of the default configuration, whose mesh is the paper's."""
    with TemporaryDirectory() as folder:
        cost = measured([sys.executable, "-c", COMPUTE], Path(folder))
    yield limit(f"modes on {cost.output.strip()} quadratic elements", cost.seconds, 20, "s")
    yield Row("processor time of it", f"{cost.processor_seconds:.3g} s")
    yield limit("peak memory of it", cost.peak_gigabytes, 2.5, "GB")
