"""The flow near the tip on the way to file and back, with steady and with unsteady results."""

import math
from pathlib import Path

import numpy as np
import pytest

from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.steady_result import SteadyResult
from equisection.results.tip_flow import TipFlow, tip_flow_from_dataset
from equisection.results.unsteady_result import UnsteadyResult

NOTHING = np.empty(0)


def vortex() -> TipFlow:
    """Return the flow of a line vortex along the stream at the tip, with a plate at mid-chord."""
    x, y, z = np.array([0.0, 1.0]), np.linspace(-0.5, 0.5, 11), np.linspace(3.2, 4.0, 9)
    up, out = np.meshgrid(y, z - 3.6, indexing="ij")
    across = np.stack([np.ones_like(up), out, -up], axis=-1) / (0.1 + up**2 + out**2)[..., None]
    velocity = np.stack([across, across])
    velocity[0, 5, :5] = math.nan  # the plate
    turbulence = 0.01 * np.linalg.norm(velocity, axis=-1)
    chord_line = np.full((2, 9), math.nan)
    chord_line[0, :5] = 0.0
    return TipFlow(x, y, z, velocity, turbulence, chord_line, 3.6, 0.04, "made up")


def steady(flow: TipFlow | None) -> SteadyResult:
    return SteadyResult(0.1, 0.2, 0.3, *[NOTHING] * 3, "steady", tip_flow=flow)


def unsteady(flow: TipFlow | None) -> UnsteadyResult:
    time = np.linspace(0.0, 1.0, 5)
    return UnsteadyResult(*[time] * 8, {"regime": "settled"}, tip_flow=flow)


@pytest.mark.parametrize("kind", ["steady", "unsteady"])
def test_flow_is_read_back_with_its_gaps(tmp_path: Path, kind: str) -> None:
    flow = vortex()
    result = steady(flow).to_dataset() if kind == "steady" else unsteady(flow).to_dataset(0.1)
    write_dataset(tmp_path / "a.nc", result)
    again = tip_flow_from_dataset(read_dataset(tmp_path / "a.nc"))
    assert again is not None
    for name in ("x", "y", "z", "velocity", "turbulence", "chord_line"):
        np.testing.assert_allclose(getattr(again, name), getattr(flow, name), rtol=1e-6, atol=1e-9)
    assert (again.span, again.thickness, again.state) == (3.6, 0.04, "made up")
    assert np.isnan(again.turbulence).sum() == 5


def test_result_of_before_there_was_such_a_flow_has_none() -> None:
    assert tip_flow_from_dataset(steady(None).to_dataset()) is None
    assert tip_flow_from_dataset(unsteady(None).to_dataset(0.1)) is None
