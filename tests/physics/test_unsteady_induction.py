"""Induction and apparent mass of finite beams: vortex lattices, limits, published values."""

from __future__ import annotations

import numpy as np
import pytest

from equisection.aerodynamics.apparent_mass import apparent_mass
from equisection.aerodynamics.channel import lattice_kernel
from equisection.aerodynamics.indicial import theodorsen
from equisection.aerodynamics.span_strips import SpanStrips, cosine_strips
from equisection.aerodynamics.unsteady_induction import (
    BOUND_LINE,
    COLLOCATION_POINT,
    InductionStates,
    UnsteadyInduction,
    circulation_of_lift,
    induction_states,
    steady_induction,
)
from equisection.aerodynamics.vortex_rings import SpanGeometry

COUNT = 12


def half_wing(aspect_ratio: float, count: int = COUNT) -> SpanGeometry:
    return SpanGeometry.of(cosine_strips(count), 1.0, 0.5 * aspect_ratio)


def plate_in_channel() -> SpanGeometry:
    """Return the paper's plate: root on a wall of a channel 4 x 4 chords."""
    return SpanGeometry.of(cosine_strips(COUNT), 1.0, 3.7, 4.0, 4.0)


def prandtl(strips: SpanStrips, length: float, *walls: float | None) -> np.ndarray:
    """Induced incidence (rad) of c_l by trailing half-lines, with the root on a wall.

    alpha_i = (1/8 pi) int dc_l/dz' [K(z - z') - K(z + z')] dz' (Prandtl 1918; Glauert, The
    Elements of Aerofoil and Airscrew Theory, chapters X, XI and XIV for the walls), lengths in
    chords.
    """
    station, edge = length * strips.stations[:, None], length * strips.edges
    walls = walls or (None, None)
    kernel = lattice_kernel(station - edge, *walls) - lattice_kernel(station + edge, *walls)
    return (kernel.real[:, :-1] - kernel.real[:, 1:]) / (8 * np.pi)


def incidence_matrix(geometry: SpanGeometry, omega: float) -> np.ndarray:
    return UnsteadyInduction.at(COLLOCATION_POINT, geometry).matrix(omega)


def front_matrix(geometry: SpanGeometry, omega: float) -> np.ndarray:
    return UnsteadyInduction.at(BOUND_LINE, geometry).matrix(omega)


def lift_slope(geometry: SpanGeometry) -> float:
    """Lift slope (1/rad) with sections of 2 pi."""
    matrix = incidence_matrix(geometry, 0.0).real
    section = 2 * np.pi * np.ones(geometry.strips)
    return mean(geometry, np.linalg.solve(np.eye(geometry.strips) + 2 * np.pi * matrix, section))


def mean(geometry: SpanGeometry, values: np.ndarray) -> complex | float:
    return np.diff(geometry.edges) @ values / (geometry.edges[-1] - geometry.edges[0])


def segment(start: np.ndarray, end: np.ndarray, point: np.ndarray) -> np.ndarray:
    """Vertical velocity of a straight vortex of strength 1, by the law of Biot and Savart.

    Katz and Plotkin, Low-Speed Aerodynamics, 2001, section 10.4.5; everything in the plane y = 0,
    positions (x, z). Zero on the line of the vortex.
    """
    first, second = point - start, point - end
    cross = first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]
    unit = first / np.linalg.norm(first, axis=-1)[..., None] - (
        second / np.linalg.norm(second, axis=-1)[..., None]
    )
    along = ((end - start) * unit).sum(axis=-1)
    safe = np.where(np.abs(cross) < 1e-12, 1.0, cross)
    return np.where(np.abs(cross) < 1e-12, 0.0, along / (4 * np.pi * safe))


class Lattice:
    """Vortex lattice of a rectangular wing in harmonic motion, by straight vortices of its own.

    Both halves of the wing are modelled. Rings of the wake are as long as a panel near the wing.
    """

    def __init__(
        self, aspect_ratio: float, panels: int, strips: int, wake: float, longest: float = 0.4
    ) -> None:
        self.panels, self.strips = panels, 2 * strips
        self.step = 1.0 / panels
        angle = np.pi * np.arange(self.strips + 1) / self.strips
        self.edges = -0.5 * aspect_ratio * np.cos(angle)
        stations = -0.5 * aspect_ratio * np.cos(angle[:-1] + 0.5 * np.pi / self.strips)
        bound = -0.5 + self.step * (np.arange(panels) + 0.25)
        self.collocation = -0.5 + self.step * (np.arange(panels) + 0.75)
        self.bound = bound
        lines, length = [0.5 + 0.25 * self.step], self.step
        while lines[-1] < 0.5 + wake:
            lines.append(lines[-1] + length)
            length = length if lines[-1] < 3.0 else min(1.06 * length, longest)
        self.lines = np.array(lines)
        x, z = np.meshgrid(self.collocation, stations, indexing="ij")
        self.points = np.stack([x.ravel(), z.ravel()], axis=-1)
        self.places = np.append(bound, self.lines)
        self.rings = np.array(
            [self._ring(a, b) for a, b in zip(self.places[:-1], self.places[1:], strict=True)]
        )

    def _ring(self, start: float, end: float) -> np.ndarray:
        """Downwash at all points of the rings between two lines, shape (points, strips)."""
        total = 0.0
        left, right = self.edges[:-1], self.edges[1:]
        x = np.ones(self.strips)
        corners = [(start * x, left), (start * x, right), (end * x, right), (end * x, left)]
        for first, second in zip(corners, corners[1:] + corners[:1], strict=True):
            total = total + segment(
                np.stack(first, axis=-1), np.stack(second, axis=-1), self.points[:, None, :]
            )
        return -np.asarray(total)

    def loads(self, omega: float, incidence: np.ndarray) -> tuple[complex, complex]:
        """C_L and C_M about mid-chord at incidences of the collocation points, (panels, strips)."""
        system = np.concatenate(list(self.rings[: self.panels]), axis=1).astype(complex)
        middles = 0.5 * (self.lines[:-1] + self.lines[1:]) - self.lines[0]
        lengths = np.diff(self.lines)
        phase = np.exp(-1j * omega * (middles + 0.5 * self.step))
        phase = phase * np.sinc(omega * lengths / (2 * np.pi))
        own = np.abs(lengths - self.step) < 1e-9
        phase[own] = np.exp(-1j * omega * (middles[own] + 0.5 * self.step))
        system[:, -self.strips :] += np.tensordot(phase, self.rings[self.panels :], axes=1)
        strength = np.linalg.solve(system, incidence.ravel()).reshape(self.panels, self.strips)
        jump = np.diff(strength, axis=0, prepend=0.0)
        length = np.full(self.panels, self.step)
        length[-1] *= 0.75
        middle = self.bound + 0.5 * length
        pressure = 2.0 * jump + 2j * omega * strength * length[:, None]
        moment = 2.0 * self.bound[:, None] * jump
        moment = moment + 2j * omega * strength * (middle * length)[:, None]
        share = np.diff(self.edges) / (self.edges[-1] - self.edges[0])
        return complex(pressure.sum(axis=0) @ share), complex(-moment.sum(axis=0) @ share)

    def motion(self, omega: float, twist: float, heave: float) -> np.ndarray:
        by_chord = twist * (1 + 1j * omega * self.collocation) - 1j * omega * heave
        return np.repeat(by_chord[:, None], self.strips, axis=1)


@pytest.mark.parametrize("aspect_ratio", [2.0, 4.0, 7.4, 20.0])
def test_lift_slope_is_that_of_a_vortex_lattice(aspect_ratio: float) -> None:
    lattice = Lattice(aspect_ratio, panels=6, strips=20, wake=1e4, longest=1e4)
    lift, _ = lattice.loads(0.0, np.ones((6, 40)))
    assert lift_slope(half_wing(aspect_ratio)) == pytest.approx(lift.real, rel=0.02)


def test_lift_of_a_slender_wing_is_that_of_r_t_jones() -> None:
    """C_L = (pi/2) AR alpha for AR -> 0 (R. T. Jones, NACA Report 835, 1946)."""
    errors = [1 - lift_slope(half_wing(ratio)) / (0.5 * np.pi * ratio) for ratio in (0.1, 0.05)]
    assert errors[1] < 1e-3
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.02)


@pytest.mark.parametrize("walls", [(None, None), (None, 3.0), (4.0, None), (4.0, 3.0)])
def test_at_the_bound_line_it_is_the_lifting_line(walls: tuple[float | None, float | None]) -> None:
    """The legs are half-lines there, as in Prandtl's theory."""
    strips = cosine_strips(COUNT)
    line = prandtl(strips, 3.7, *walls)
    found = front_matrix(SpanGeometry.of(strips, 1.0, 3.7, *walls), 0.0).real
    assert found == pytest.approx(line, abs=1e-6 * np.abs(line).max())


def test_long_beams_tend_to_the_lifting_line() -> None:
    strips = cosine_strips(COUNT)
    errors = []
    for length in (1e4, 1e5):
        line = prandtl(strips, length)
        found = incidence_matrix(SpanGeometry.of(strips, 1.0, length), 0.0).real
        errors.append(np.abs(found - line).max() / np.abs(line).max())
    assert errors[1] < 2e-3
    assert errors[0] / errors[1] == pytest.approx(10.0, rel=0.05)


@pytest.mark.parametrize("geometry", [half_wing(4.0), plate_in_channel()])
def test_steady_induction_is_that_of_the_unsteady_one_at_rest(geometry: SpanGeometry) -> None:
    rear, front = steady_induction(geometry)
    assert rear == pytest.approx(incidence_matrix(geometry, 0.0).real, abs=1e-12)
    assert front == pytest.approx(front_matrix(geometry, 0.0).real, abs=1e-12)


@pytest.mark.parametrize("omega", [0.0, 0.02, 0.5, 3.0])
@pytest.mark.parametrize("height", [None, 4.0, 1.0])
def test_between_walls_nothing_is_induced(omega: float, height: float | None) -> None:
    closed = SpanGeometry.of(cosine_strips(COUNT), 1.0, 4.0, 4.0, height)
    size = np.abs(incidence_matrix(closed, 0.0)).max()
    for matrix in (incidence_matrix(closed, omega), front_matrix(closed, omega)):
        assert np.abs(matrix.sum(axis=1)).max() < 1e-6 * size


@pytest.mark.parametrize("point", [COLLOCATION_POINT, BOUND_LINE])
def test_root_on_a_wall_is_half_of_a_symmetric_beam(point: float) -> None:
    half = UnsteadyInduction.at(point, half_wing(6.0)).matrix(0.7)
    whole_strips = cosine_strips(2 * COUNT, root_on_wall=False)
    whole_beam = SpanGeometry.of(whole_strips, 1.0, 6.0, root_on_wall=False)
    whole = UnsteadyInduction.at(point, whole_beam).matrix(0.7)
    right, left = whole[COUNT:, COUNT:], whole[COUNT:, COUNT - 1 :: -1]
    assert half == pytest.approx(right + left, abs=1e-10 * np.abs(half).max())


def test_wide_and_high_channels_are_free_air() -> None:
    free = incidence_matrix(half_wing(6.0), 0.5)
    errors = []
    for size in (20.0, 40.0):
        channel = SpanGeometry.of(cosine_strips(COUNT), 1.0, 3.0, size, size)
        errors.append(np.abs((incidence_matrix(channel, 0.5) - free).sum(axis=1)).max())
    assert errors[1] < 1e-3
    assert errors[0] > 2.0 * errors[1]


def test_nothing_is_induced_at_once() -> None:
    """The circulation of a step of lift grows with the root of time: T falls with omega^-1/2."""
    sizes = [np.linalg.norm(incidence_matrix(half_wing(6.0), w)) for w in (1e3, 1e4, 1e5)]
    assert np.log10(np.array(sizes[:-1]) / np.array(sizes[1:])) == pytest.approx(0.5, abs=0.03)


def test_circulation_of_lift_is_continuous_at_rest() -> None:
    distances = [abs(circulation_of_lift(k) - circulation_of_lift(0.0)) for k in (1e-3, 1e-5, 1e-7)]
    assert distances[0] > distances[1] > distances[2]
    assert distances[2] < 1e-5


def test_slow_motion_is_steady_flow() -> None:
    """T is continuous at rest, and real there."""
    matrix = incidence_matrix(half_wing(6.0), 1e-4)
    assert np.abs(matrix.imag).max() < 1e-2 * np.abs(matrix.real).max()
    assert matrix.real == pytest.approx(incidence_matrix(half_wing(6.0), 0.0).real, rel=1e-2)


def test_error_falls_at_least_with_the_square_of_the_strips() -> None:
    slopes = np.array([lift_slope(half_wing(7.4, count)) for count in (3, 6, 12, 24)])
    steps = np.abs(np.diff(slopes))
    assert np.all(steps[:-1] > 4.0 * steps[1:])


@pytest.mark.parametrize("geometry", [half_wing(4.0), half_wing(20.0), plate_in_channel()])
def test_states_have_the_induction(geometry: SpanGeometry) -> None:
    states = induction_states(geometry)
    exact = incidence_matrix(geometry, 0.0).real
    assert states.matrix(0.0).real == pytest.approx(exact, abs=1e-12 * np.abs(exact).max())
    exact = front_matrix(geometry, 0.0).real
    assert states.front_matrix(0.0).real == pytest.approx(exact, abs=1e-12 * np.abs(exact).max())
    for omega in (0.1, 0.5, 1.0, 2.0):
        wanted, found = (
            circulatory_lift(geometry, omega, matrix)
            for matrix in (incidence_matrix(geometry, omega), states.matrix(omega))
        )
        assert np.abs(found - wanted).max() < 0.02 * np.abs(wanted).max()


def circulatory_lift(geometry: SpanGeometry, omega: float, matrix: np.ndarray) -> np.ndarray:
    """Circulatory c_l of strips of a thin plate at unit incidence of their rear points."""
    section = 2 * np.pi * (complex(theodorsen(0.5 * omega)) if omega else 1.0)
    return np.linalg.solve(
        np.eye(geometry.strips) + section * matrix, section * np.ones(geometry.strips)
    )


def test_states_are_found_once_and_cannot_be_spoilt() -> None:
    states = induction_states(plate_in_channel())
    assert induction_states(plate_in_channel()) is states
    with pytest.raises(ValueError, match="read-only"):
        states.incidence[0, 0, 0] = 1.0


def test_a_beam_longer_than_its_channel_is_refused() -> None:
    with pytest.raises(ValueError, match="does not fit into a channel of width 4"):
        SpanGeometry.of(cosine_strips(3), 1.0, 4.1, 4.0)


@pytest.mark.parametrize(
    ("aspect_ratio", "published"),
    [(1.0, 0.579), (2.0, 0.757), (4.0, 0.872), (8.0, 0.934), (10.0, 0.947)],
)
def test_apparent_mass_of_rectangular_plates(aspect_ratio: float, published: float) -> None:
    """Table of DNV-RP-C205, appendix D, over that of an endless plate.

    The lattice converges with 1/M, so it is extrapolated from 8 and 16 panels.
    """
    wing = half_wing(aspect_ratio)
    coarse, fine = (
        mean(wing, apparent_mass(wing, panels).mass.sum(axis=1)) / (np.pi / 2) for panels in (8, 16)
    )
    assert 2 * fine - coarse == pytest.approx(published, abs=0.001)
    assert coarse == pytest.approx(published, rel=0.04)


def test_apparent_mass_between_walls_is_that_of_the_section() -> None:
    closed = SpanGeometry.of(cosine_strips(COUNT), 1.0, 4.0, 4.0, 4.0)
    found = apparent_mass(closed)
    assert found.mass.sum(axis=1) == pytest.approx(np.pi / 2, rel=1e-7)
    assert found.inertia.sum(axis=1) == pytest.approx(np.pi / 64, rel=1e-7)


def test_apparent_mass_is_nearly_reciprocal_and_positive() -> None:
    """Kinetic energy of the air: weighted with the strips, the matrices are nearly symmetric."""
    found = apparent_mass(half_wing(6.0))
    weights = np.diff(half_wing(6.0).edges)[:, None]
    for matrix in (weights * found.mass, weights * found.inertia):
        assert np.abs(matrix - matrix.T).max() < 0.05 * np.abs(matrix).max()
        assert np.linalg.eigvalsh(matrix + matrix.T).min() > 0.0


def strip_loads(
    geometry: SpanGeometry, states: InductionStates, omega: float, twist: float, heave: float
) -> tuple[complex, complex]:
    """C_L and C_M of thin plates (Theodorsen) on strips with induction and apparent mass."""
    count = geometry.strips
    air = apparent_mass(geometry)
    at_rear = twist * (1 + 0.25j * omega) - 1j * omega * heave
    lift = at_rear * circulatory_lift(geometry, omega, states.matrix(omega))
    rate, ones = 1j * omega * twist, np.ones(count)
    curvature = 2.0 * (states.matrix(omega) - states.front_matrix(omega)) @ lift
    leading = lift / (2 * np.pi) - 0.25 * rate + 0.25 * 0.65 * curvature
    total = lift + air.mass @ ones * (rate + omega**2 * heave)
    moment = 0.5 * np.pi * leading + air.inertia @ ones * omega**2 * twist
    return complex(mean(geometry, total)), complex(mean(geometry, moment))


@pytest.mark.parametrize(("twist", "heave"), [(1.0, 0.0), (0.0, 1.0)])
def test_loads_in_harmonic_motion_are_those_of_a_vortex_lattice(twist: float, heave: float) -> None:
    """Lattice extrapolated from 6 and 12 panels; within 4 % and 2 deg at k = 0.05 to 1."""
    wing = half_wing(7.4)
    states = induction_states(wing)
    lattices = [Lattice(7.4, panels, strips=8, wake=60.0) for panels in (6, 12)]
    for k in (0.05, 0.2, 0.5, 1.0):
        coarse, fine = (
            np.array(each.loads(2 * k, each.motion(2 * k, twist, heave))) for each in lattices
        )
        ratio = np.array(strip_loads(wing, states, 2 * k, twist, heave)) / (2 * fine - coarse)
        assert np.abs(ratio) == pytest.approx(1.0, abs=0.04), k
        assert np.degrees(np.angle(ratio)) == pytest.approx(0.0, abs=2.0), k
