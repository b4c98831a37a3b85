"""Modes of the plate at the paper's resolution: 24 x 89 elements in plan, two in thickness.

The paper has four linear elements through the thickness; two quadratic ones stand for them.
"""

import sys
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory

from tests.benchmarks.measure import Row, limit, measured

ELEMENTS = (24, 89, 2)
COMPUTE = f"""
from equisection.beam.beam import Beam
from equisection.structure.modes import compute_modes

compute_modes(Beam(), "solid", {ELEMENTS}, count=12)
"""


def rows() -> Iterator[Row]:
    """Compute the modes of the default beam."""
    with TemporaryDirectory() as folder:
        cost = measured([sys.executable, "-c", COMPUTE], Path(folder))
    mesh = " x ".join(map(str, ELEMENTS))
    yield limit(f"modes on {mesh} quadratic elements", cost.seconds, 20, "s")
    yield Row("processor time of it", f"{cost.processor_seconds:.3g} s")
    yield limit("peak memory of it", cost.peak_gigabytes, 2.5, "GB")
