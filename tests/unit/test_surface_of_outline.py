"""Surface data along the contour of an outline: the loads that they add up to."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
import pytest
import xarray as xr
from numpy.typing import NDArray

from equisection.results.surface import SectionSurface, surface_from_dataset

Floats = NDArray[np.float64]


def round_section(pressure: Callable[[Floats, Floats], Floats]) -> SectionSurface:
    """Return a circle of 0.4 c about mid-chord, its faces from nose to tail on either side."""
    angle = np.linspace(np.pi, 0.0, 201)
    first = 0.2 * np.stack([np.cos(angle), np.sin(angle)], axis=-1)
    first, last = (
        np.concatenate([first[:-1], first[:-1] * (1, -1)]),
        np.concatenate([first[1:], first[1:] * (1, -1)]),
    )
    middle, edge = (first + last) / 2, last - first
    length = np.hypot(*edge.T)
    side = np.repeat(["upper", "lower"], 200)
    sense = np.where(side == "upper", 1.0, -1.0)
    return SectionSurface(
        x=middle[:, 0] + 0.5,
        y=middle[:, 1],
        length=length,
        side=side,
        pressure=pressure(*middle.T),
        friction=np.zeros(400),
        y_plus=np.ones(400),
        normal_x=-sense * edge[:, 1] / length,
        normal_y=sense * edge[:, 0] / length,
    )


def test_outline_in_a_pressure_gradient_floats() -> None:
    """Gauss: the force of a pressure that grows along x or y is minus the area inside."""
    area = 0.5 * 400 * 0.2**2 * np.sin(2 * np.pi / 400)
    along = round_section(lambda x, y: x).loads(0.0)
    across = round_section(lambda x, y: y).loads(0.0)
    assert along == pytest.approx((-area, 0.0, 0.0), abs=1e-12)
    assert across == pytest.approx((0.0, -area, 0.0), abs=1e-12)
    assert round_section(lambda x, y: 1.0 + 0.0 * x).loads(3.0) == pytest.approx(
        (0, 0, 0), abs=1e-12
    )


def test_friction_of_an_outline_is_along_its_sides() -> None:
    """Friction towards the tail on both sides drags by the height that faces the stream."""
    surface = replace(round_section(lambda x, y: 0.0 * x), friction=np.ones(400))
    normal, tangent = surface.normals_and_tangents()
    assert (normal * tangent).sum(axis=1) == pytest.approx(0.0, abs=1e-12)
    assert (tangent[:, 0] >= -1e-12).all()
    drag, lift, moment = surface.loads(0.0)
    assert drag == pytest.approx(2 * 0.4)
    assert (lift, moment) == pytest.approx((0.0, 0.0), abs=1e-12)


def test_surface_of_an_outline_is_read_as_it_was_written() -> None:
    surface = round_section(lambda x, y: x * y)
    found = surface_from_dataset(xr.Dataset(surface.variables()))
    assert found is not None
    assert found.loads(2.0) == surface.loads(2.0)
    assert found.on("lower").normal_y.size == 200
