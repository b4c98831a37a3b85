"""Images of the channel: walls are impermeable, the two ways of summing agree, known limits."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import brentq
from scipy.special import ellipj, ellipk

from equisection.aerodynamics.channel import lattice_kernel
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.unsteady_induction import steady_induction
from equisection.aerodynamics.vortex_rings import SpanGeometry

WIDTHS_AND_HEIGHTS = [(4.0, 4.0), (4.0, 1.0), (1.0, 4.0), (10.0, 0.5)]


def velocity(z: np.ndarray, y: np.ndarray, width: float, height: float) -> np.ndarray:
    """u_y + i u_z of a vortex of strength 2 pi at z = 0.3 width, y = 0, with its wall image."""
    here, image = 0.3 * width, -0.3 * width
    position = z + 1j * y
    return lattice_kernel(position - here, width, height) - lattice_kernel(
        position - image, width, height
    )


@pytest.mark.parametrize(("width", "height"), WIDTHS_AND_HEIGHTS)
def test_no_flow_through_any_wall(width: float, height: float) -> None:
    across = np.linspace(0.05, 0.95, 19)
    scale = 1 / min(width, height)
    for y in (-0.5 * height, 0.5 * height):
        normal = velocity(width * across, np.full(19, y), width, height).real
        assert np.max(np.abs(normal)) < 1e-13 * scale
    for z in (0.0, width):
        normal = velocity(np.full(19, z), height * (across - 0.5), width, height).imag
        assert np.max(np.abs(normal)) < 1e-13 * scale


@pytest.mark.parametrize(("width", "height"), WIDTHS_AND_HEIGHTS[:3])
def test_kernel_is_the_jacobi_function_cs(width: float, height: float) -> None:
    """(k/W) cs(k x/W) has the same poles, residues and periods, hence is the same function."""

    def excess(m: float) -> float:
        return float(ellipk(1 - m) / ellipk(m) - height / (2 * width))

    m = brentq(excess, 1e-12, 1 - 1e-12, xtol=1e-16, rtol=1e-14)
    x = width * np.array([-1.7, -0.6, 0.01, 0.4, 0.9, 1.5])
    sn, cn, _, _ = ellipj(ellipk(m) * x / width, m)
    expected = ellipk(m) / width * cn / sn
    assert lattice_kernel(x, width, height).real == pytest.approx(expected, rel=1e-6)


def test_kernel_is_the_sum_over_the_images() -> None:
    x, width, height = 0.7, 4.0, 3.0
    rows = np.arange(-2000, 2001)
    signs = np.where(rows % 2 == 0, 1.0, -1.0)
    total = sum(
        np.sum(signs * np.real(1 / (x - 2 * m * width - 1j * rows * height)))
        for m in range(-20, 21)
    )
    assert float(lattice_kernel(x, width, height).real) == pytest.approx(total, abs=1e-5)


def test_far_walls_leave_free_air() -> None:
    x = np.array([-2.0, 0.3, 1.5])
    for width, height in [(1e4, None), (None, 1e4), (1e4, 1e4), (1e4, 3e3)]:
        assert lattice_kernel(x, width, height).real == pytest.approx(1 / x, rel=1e-5)


@pytest.mark.parametrize("breadth_to_height", [1.0, 2.0])
def test_small_wing_in_a_closed_tunnel(breadth_to_height: float) -> None:
    """Upwash delta S C_L/C of a closed wind tunnel of section C: delta = 0.137 (square, duplex).

    Glauert, The Elements of Aerofoil and Airscrew Theory (1926), chapter XIV, for a wing whose
    span is small against the tunnel.
    """
    height, span, chord = 1.0, 0.02, 0.002
    width = breadth_to_height * height
    strips = cosine_strips(20, root_on_wall=False)
    free, tunnel = (
        steady_induction(SpanGeometry.of(strips, chord, span, *walls, root_on_wall=False))[1]
        for walls in ((), (width, height))
    )
    load = np.ones(20)
    upwash = (free - tunnel) @ load
    delta = upwash * width * height / (span * chord * (strips.weights @ load))
    assert delta == pytest.approx(0.137, abs=1e-3)
