"""Loads of rigid beams: Prandtl's line by Glauert's series, Weissinger's by limits and symmetry.

With the induced incidence of the quarter chord at both points of the chord the line is Prandtl's,
whose solutions are known (``prandtl``).
"""

from __future__ import annotations

import numpy as np
import pytest

from equisection.aerodynamics import lifting_line
from equisection.aerodynamics.lifting_line import LiftingLine, SpanwiseLoads
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.span_strips import cosine_strips
from equisection.aerodynamics.unsteady_induction import CURVATURE_SHARE
from equisection.aerodynamics.vortex_rings import SpanGeometry
from equisection.errors import IncidenceOutOfRangeError, SolverError

THIN_PLATE = Polar.flat_plate(0.5)
STALLING_DEG = np.array([0, 1, 2, 3, 4, 5, 6, 8, 10, 12])
STALLING = Polar(
    np.radians(STALLING_DEG),
    0.04 + 0.001 * STALLING_DEG**2,
    np.array([0, 0.17, 0.34, 0.49, 0.58, 0.64, 0.67, 0.66, 0.64, 0.62]),
    np.array([0, 0.033, 0.059, 0.066, 0.062, 0.058, 0.058, 0.057, 0.062, 0.070]),
    "stalling",
).mirrored()


def free_wing(aspect_ratio: float, count: int, polar: Polar = THIN_PLATE) -> LiftingLine:
    strips = cosine_strips(count, root_on_wall=False)
    span = SpanGeometry.of(strips, 1.0, aspect_ratio, root_on_wall=False)
    return LiftingLine.of(polar, strips, span)


def prandtl(line: LiftingLine) -> LiftingLine:
    """Return Prandtl's line of the same strips."""
    return LiftingLine(line.polar, line.strips, line.front, line.front)


def cantilever(
    count: int,
    polar: Polar = THIN_PLATE,
    length: float = 3.7,
    width: float | None = 4.0,
    height: float | None = 4.0,
) -> LiftingLine:
    strips = cosine_strips(count)
    return LiftingLine.of(polar, strips, SpanGeometry.of(strips, 1.0, length, width, height))


def glauert_series(aspect_ratio: float, terms: int = 80) -> tuple[float, float]:
    """Lift slope (1/rad) and C_Di pi AR/C_L^2 of a rectangular thin wing in free air.

    Collocation of Prandtl's equation with Gamma = 2 b V sum A_n sin n phi, odd n (Glauert, The
    Elements of Aerofoil and Airscrew Theory, chapter XI).
    """
    n = 2 * np.arange(terms) + 1
    phi = np.arange(1, terms + 1) * np.pi / (2 * terms)
    mu = 2 * np.pi / (4 * aspect_ratio)
    system = np.sin(np.outer(phi, n)) * (np.sin(phi)[:, np.newaxis] + mu * n)
    coefficients = np.linalg.solve(system, mu * np.sin(phi))
    ratios = coefficients / coefficients[0]
    return float(np.pi * aspect_ratio * coefficients[0]), float(np.sum(n * ratios**2))


def induced_factor(loads: SpanwiseLoads, aspect_ratio: float) -> float:
    return loads.induced_drag * np.pi * aspect_ratio / loads.lift**2


@pytest.mark.parametrize("aspect_ratio", [2.0, 6.0, 8.0])
def test_rectangular_wing_is_glauerts_series(aspect_ratio: float) -> None:
    slope, factor = glauert_series(aspect_ratio)
    loads = prandtl(free_wing(aspect_ratio, 40)).solve(0.1)
    assert loads.lift / 0.1 == pytest.approx(slope, rel=5e-4)
    assert induced_factor(loads, aspect_ratio) == pytest.approx(factor, rel=5e-4)


@pytest.mark.parametrize(
    ("aspect_over_slope", "tau", "delta"),
    [(0.75, 0.14, 0.034), (1.0, 0.17, 0.049), (1.25, 0.20, 0.063), (1.5, 0.22, 0.076)],
)
def test_glauerts_printed_table(aspect_over_slope: float, tau: float, delta: float) -> None:
    """Table of chapter XI, from four coefficients of the series, hence the tolerance."""
    aspect_ratio = 2 * np.pi * aspect_over_slope
    loads = prandtl(free_wing(aspect_ratio, 40)).solve(0.1)
    computed_tau = (2 * np.pi * 0.1 / loads.lift - 1) * aspect_ratio / 2 - 1
    assert computed_tau == pytest.approx(tau, abs=0.01)
    assert induced_factor(loads, aspect_ratio) - 1 == pytest.approx(delta, abs=0.006)


def test_error_falls_with_the_square_of_the_strips() -> None:
    slope, _ = glauert_series(7.4)
    errors = [
        abs(prandtl(free_wing(7.4, count)).solve(0.1).lift / 0.1 - slope) for count in (16, 32, 64)
    ]
    assert np.log2(np.array(errors[:-1]) / np.array(errors[1:])) == pytest.approx(2, abs=0.2)


def test_elliptic_load_has_constant_induced_incidence() -> None:
    """alpha_i = C_L/(pi AR) with the least induced drag (Prandtl 1918)."""
    aspect_ratio = 7.0
    wing = free_wing(aspect_ratio, 60)
    elliptic = np.sqrt(1 - (2 * wing.strips.stations - 1) ** 2)
    lift = wing.strips.weights @ elliptic
    assert wing.front @ elliptic == pytest.approx(lift / (np.pi * aspect_ratio), rel=1e-3)


def test_induced_drag_is_the_energy_left_in_the_wake() -> None:
    """C_Di = pi AR sum n A_n^2 of the Trefftz plane, A_n from the computed load alone."""
    aspect_ratio = 6.0
    wing = free_wing(aspect_ratio, 80, STALLING)
    loads = wing.solve(np.radians(5), np.radians(2) * wing.strips.stations)
    phi = np.arccos(1 - 2 * wing.strips.stations)
    n = np.arange(1, 40)
    circulation = loads.cl_section / (4 * aspect_ratio)  # Gamma/(2 b V), equal steps of phi
    coefficients = 2 / phi.size * np.sin(np.outer(n, phi)) @ circulation
    wake = np.pi * aspect_ratio * np.sum(n * coefficients**2)
    assert loads.induced_drag == pytest.approx(wake, rel=3e-3)


def test_drag_is_profile_plus_induced_drag() -> None:
    line = cantilever(20, STALLING)
    loads = line.solve(np.radians(4))
    profile = line.strips.weights @ line.polar.drag_coefficient(loads.effective_incidence)
    assert loads.drag == pytest.approx(profile + loads.induced_drag)
    assert loads.induced_drag > 0


def test_long_beam_is_its_section() -> None:
    loads = free_wing(1e4, 20).solve(0.05)
    assert loads.lift == pytest.approx(2 * np.pi * 0.05, rel=1e-3)
    assert loads.moment == pytest.approx(0.5 * np.pi * 0.05, rel=1e-3)


def test_beam_from_wall_to_wall_is_its_section_exactly() -> None:
    """Up to the images of the walls, whose sums end somewhere."""
    line = cantilever(20, STALLING, length=4.0)
    loads = line.solve(np.radians(3))
    assert loads.lift == pytest.approx(float(STALLING.lift_coefficient(np.radians(3))), rel=1e-8)
    assert loads.induced_incidence == pytest.approx(0, abs=1e-8)
    assert loads.induced_drag == pytest.approx(0, abs=1e-8)


def test_closing_the_gap_raises_the_lift_towards_the_section() -> None:
    lengths = np.array([3.0, 3.5, 3.9, 3.99, 3.9999])
    lifts = [cantilever(40, length=length).solve(0.05).lift for length in lengths]
    assert np.all(np.diff(lifts) > 0)
    assert lifts[-1] == pytest.approx(2 * np.pi * 0.05, rel=0.1)
    assert lifts[-1] < 2 * np.pi * 0.05


def test_root_on_wall_is_half_of_the_wing_of_twice_the_length() -> None:
    half = cantilever(20, STALLING, width=None, height=None).solve(np.radians(4))
    whole = free_wing(7.4, 40, STALLING).solve(np.radians(4))
    assert whole.lift == pytest.approx(half.lift, rel=1e-12)
    assert whole.moment == pytest.approx(half.moment, rel=1e-12)
    assert whole.cl_section[20:] == pytest.approx(half.cl_section, rel=1e-12)
    assert whole.cl_section[:20] == pytest.approx(half.cl_section[::-1], rel=1e-12)


def test_far_walls_leave_free_air() -> None:
    near = cantilever(20, width=None, height=None).matrix
    far = cantilever(20, width=2e3, height=2e3).matrix
    assert far == pytest.approx(near, abs=1e-5)


def test_beam_in_the_middle_of_a_channel_is_symmetric_and_gains_lift() -> None:
    strips = cosine_strips(21, root_on_wall=False)
    span = SpanGeometry.of(strips, 1.0, 3.0, 4.0, 4.0, root_on_wall=False)
    loads = LiftingLine.of(THIN_PLATE, strips, span).solve(0.05)
    assert loads.cl_section == pytest.approx(loads.cl_section[::-1], rel=1e-9)
    assert loads.lift > free_wing(3.0, 21).solve(0.05).lift


def test_negative_incidence_mirrors_the_loads() -> None:
    line = cantilever(20, STALLING)
    up, down = line.solve(np.radians(6)), line.solve(np.radians(-6))
    assert down.lift == pytest.approx(-up.lift, rel=1e-9)
    assert down.moment == pytest.approx(-up.moment, rel=1e-9)
    assert down.drag == pytest.approx(up.drag, rel=1e-9)
    assert line.solve(0.0).lift == 0.0


def test_twist_is_incidence() -> None:
    line = cantilever(16, STALLING)
    uniform = line.solve(np.radians(1), np.full(16, np.radians(2)))
    assert uniform.lift == pytest.approx(line.solve(np.radians(3)).lift, rel=1e-9)


def test_equation_holds_beyond_the_lift_peak() -> None:
    line = cantilever(16, STALLING)
    for degrees in np.arange(0.5, 12.1, 0.5):
        loads = line.solve(np.radians(degrees))
        advance = 0.5 * CURVATURE_SHARE * (line.rear - line.front) @ loads.cl_section
        rear = loads.effective_incidence - advance
        assert rear + line.rear @ loads.cl_section == pytest.approx(np.radians(degrees), abs=1e-9)
        polar = line.polar.lift_coefficient(loads.effective_incidence)
        slope = line.polar.lift_slope()
        assert loads.cl_section == pytest.approx(polar - slope * advance, abs=1e-9)


def test_incidence_outside_the_polar_is_named() -> None:
    with pytest.raises(IncidenceOutOfRangeError, match=r"polar 'stalling'.*-12 to 12 deg"):
        cantilever(20, STALLING).solve(np.radians(20))


def test_saw_tooth_of_stalled_strips_is_an_error_and_not_a_number() -> None:
    """Prandtl's strips narrower than |dc_l/dalpha| c/4 have no smooth load beyond the peak."""
    with pytest.raises(SolverError, match=r"'stalling' alternates .* at 11 deg"):
        prandtl(cantilever(40, STALLING)).solve(np.radians(11))


def test_beyond_the_peak_narrow_strips_have_a_smooth_load() -> None:
    """At three quarters of the chord a wave along the span has no downwash without bound."""
    coarse, fine = (cantilever(count, STALLING).solve(np.radians(11)) for count in (20, 80))
    assert coarse.lift == pytest.approx(fine.lift, rel=1e-4)


def test_no_convergence_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(lifting_line, "_NEWTON_STEPS", 1)
    monkeypatch.setattr(lifting_line, "_CHORD_STEPS", 1)
    with pytest.raises(SolverError, match=r"'stalling' does not converge at 5 deg with 20 strips"):
        cantilever(20, STALLING).solve(np.radians(5))


def test_beam_longer_than_the_channel_is_refused() -> None:
    with pytest.raises(ValueError, match="does not fit"):
        SpanGeometry.of(cosine_strips(5), 1.0, 4.1, 4.0, 4.0)
