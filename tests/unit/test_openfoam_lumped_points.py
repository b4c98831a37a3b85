"""The plate's lumped points: what is handed over either way, and its signs."""

from pathlib import Path

import numpy as np
import pytest
from tests.sample_cases import beam_modes

from equisection.cases import BeamModes
from equisection.errors import EquisectionError, SolverError
from equisection.solvers.openfoam.beam.lumped_points import Handed, LumpedPoints

EDGES = np.linspace(0.0, 3.7, 75)
POINTS = LumpedPoints.of(beam_modes(), EDGES)


def handed(lift: np.ndarray, moment: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Return forces and moments of c_l and c_m over the span, nothing on either end."""
    size = 0.5 * np.concatenate([[0.0], np.diff(EDGES), [0.0]])
    forces, moments = np.zeros((2, size.size, 3))
    forces[:, 1] = size * lift
    moments[:, 2] = -size * moment
    return forces, moments


def test_coefficients_are_those_of_uniform_loads() -> None:
    lift, moment = POINTS.coefficients(*handed(np.array(0.3), np.array(0.06)))
    assert (lift, moment) == (pytest.approx(0.3), pytest.approx(0.06))


def test_generalised_inertia_is_that_of_the_uniform_beam() -> None:
    modes = beam_modes()
    # int f^2 = 1/2 of the torsion modes, int g^2 = 1/4 of the bending modes of a cantilever
    expected = np.repeat([0.5 * modes.inertia / 2, 0.5 * modes.mass / 4], 2) * 3.7
    np.testing.assert_allclose(POINTS.inertia, expected, rtol=1e-4)


def test_static_twist_and_deflection_are_those_of_the_beam() -> None:
    """A uniform load on the cantilever: m L^2/(2 G J) and q L^4/(8 E I), from 12 modes."""
    modes = beam_modes(modes=12)
    points = LumpedPoints.of(modes, EDGES)
    position = points.modal_loads(*handed(np.array(0.3), np.array(0.06))) / points.frequency**2
    twist, deflection = points.tip(position)
    # GJ/(q c^4), EI/(q c^4) of the paper's plate at 20 m/s
    dynamic_pressure, chord, thickness = 0.5 * 1.18 * 20.0**2, 0.1, 0.004
    bending = 3.3e9 * chord * thickness**3 / 12 / (dynamic_pressure * chord**4)
    torsion = 3.3e9 / (2 * 1.35) * chord * thickness**3 / 3 / (dynamic_pressure * chord**4)
    assert twist == pytest.approx(0.06 * 3.7**2 / (2 * torsion), rel=5e-3)
    assert deflection == pytest.approx(0.3 * 3.7**4 / (8 * bending), rel=2e-3)


def test_nose_up_moment_twists_nose_up_and_is_a_rotation_about_minus_z() -> None:
    position = POINTS.modal_loads(*handed(np.array(0.0), np.array(0.06)))
    rows = POINTS.message(position).splitlines()
    assert rows[0] == str(EDGES.size + 1)
    tip = np.array(rows[-1].split(), dtype=float)
    twist, deflection = POINTS.tip(position)
    assert twist > 0
    np.testing.assert_allclose(tip, [0, 0, 3.7, -twist, 0, 0], atol=1e-3 * twist)
    assert deflection == 0.0


@pytest.mark.parametrize("count", [24, 75])
def test_tip_that_is_held_stays_where_it_is(count: int) -> None:
    """Between two pins the shapes are sines; every layer follows them, the last one too."""
    stations = np.linspace(0.0, 1.0, 201)
    sines = np.sin(np.outer([1, 2], np.pi * stations)).tolist()
    held = beam_modes().model_copy(
        update={"span": stations.tolist(), "torsion_shape": sines, "bending_shape": sines}
    )
    edges = np.linspace(0.0, 3.7, count)
    points = LumpedPoints.of(held, edges)
    for shapes in (points.torsion, points.bending):
        exact = np.sin(np.outer([1, 2], np.pi * points.locations / 3.7))
        np.testing.assert_allclose(shapes, exact, atol=1e-6)
    assert np.abs(points.torsion_at_loads[:, -1]).max() < 1e-6
    # what is told of the tip is told of mid-span, where the first mode is 1 and the second 0
    assert points.tip(np.array([0.3, 5.0, 0.2, 7.0])) == pytest.approx((0.3, 0.2))


def test_root_stays_where_it_is() -> None:
    root = POINTS.message(np.ones(4)).splitlines()[1]
    np.testing.assert_allclose([float(word) for word in root.split()], 0.0, atol=1e-12)


MESSAGE = """########
# Time index=12 value=0.24
# size=2
# columns (points) (forces) (moments)
########
0 0 0 0.1 0.2 0.3 0.01 0.02 0.03
0 0 3.7 1e-05 -2 0 0 0 -0.5
"""
FOLDER = Path("free")


def test_plain_form_of_lumped_point_movement_is_read() -> None:
    loads = Handed.read(MESSAGE, FOLDER)
    assert loads.time == 0.24
    np.testing.assert_array_equal(loads.forces, [[0.1, 0.2, 0.3], [1e-5, -2, 0]])
    np.testing.assert_array_equal(loads.moments[:, 2], [0.03, -0.5])


def test_other_forms_are_told_apart() -> None:
    for message in ("", MESSAGE.replace("0.03", "x"), MESSAGE.replace(" 0 0 -0.5", "")):
        with pytest.raises(SolverError, match=r"free: .* not in its plain form"):
            Handed.read(message, FOLDER)


def test_drag_above_the_place_of_reference_turns_the_nose_up() -> None:
    """About a point that is higher by w the same drag turns less nose up, by w F_x."""
    loads = Handed.read(MESSAGE, FOLDER).about((np.zeros(2), np.array([0.5, 0.0])))
    np.testing.assert_allclose(loads.moments[:, 2], [0.03 + 0.05, -0.5])


def test_lift_ahead_of_the_place_of_reference_turns_the_nose_up() -> None:
    """About a point that is further back by x the same lift turns more nose up, by x F_y."""
    loads = Handed.read(MESSAGE, FOLDER).about((np.array([0.5, 0.0]), np.zeros(2)))
    np.testing.assert_allclose(loads.moments[:, 2], [0.03 - 0.5 * 0.2, -0.5])


def test_mesh_that_asks_twice_is_told_apart_from_another_iteration() -> None:
    """The second time the moments are about the points' new places; the forces are the same."""
    first = Handed.read(MESSAGE, FOLDER)
    again = first.about((np.zeros(2), np.array([0.1, 0.2])))
    assert again.is_again(first)
    assert not first.is_again(None)
    assert not Handed(first.time + 0.02, first.forces, first.moments).is_again(first)
    assert not Handed(first.time, 1.01 * first.forces, first.moments).is_again(first)


def test_last_layer_moves_without_a_slope() -> None:
    """What the mesh's points at its edges follow, linearly between the lumped points."""
    at_edges = np.interp(EDGES, POINTS.locations, POINTS.bending[0])
    assert at_edges[-1] == at_edges[-2]
    assert at_edges[-2] > at_edges[-3]
    exact = at_edges[-2] + np.diff(EDGES)[-1] * 1.3765 / 3.7
    assert exact == pytest.approx(1.0, rel=1e-3)


def test_loads_do_their_work_on_the_surface_as_it_moves() -> None:
    """Uniform loads on a surface that is linear between the edges of the layers."""
    work = POINTS.modal_loads(*handed(np.array(1.0), np.array(1.0))) * POINTS.inertia
    shapes = np.concatenate([POINTS.torsion, POINTS.bending])
    at_edges = np.array([np.interp(EDGES, POINTS.locations, shape) for shape in shapes])
    assert work == pytest.approx(0.5 * np.trapezoid(at_edges, EDGES, axis=1))


INCIDENCE, AXIS = np.radians(5.0), -0.2
OFFSET = LumpedPoints.of(
    beam_modes().model_copy(update={"imbalance": 3.0, "elastic_axis": 0.5 + AXIS}), EDGES, INCIDENCE
)
PLACE = np.array([0.1, -0.04, 0.3, 0.02])


def test_points_of_a_beam_with_its_axis_off_mid_chord_turn_about_the_axis() -> None:
    """Each is as far from the axis as at rest, and is turned by the twist."""
    rows = np.array([row.split() for row in OFFSET.message(PLACE).splitlines()[1:]], dtype=float)
    axis = AXIS * np.array([np.cos(INCIDENCE), -np.sin(INCIDENCE)])
    arm = rows[:, :2] - axis
    arm[:, 1] -= OFFSET.deflection(PLACE)
    np.testing.assert_allclose(np.hypot(*arm.T), abs(AXIS))
    turned = np.arctan2(*arm.T[::-1]) - np.arctan2(*-axis[::-1])
    np.testing.assert_allclose(turned, rows[:, 3], atol=1e-9)
    np.testing.assert_allclose(rows[:, 3], -OFFSET.twist(PLACE), atol=1e-9)


def test_loads_of_an_offset_beam_do_the_work_of_its_points() -> None:
    """Virtual work of forces and moments on the points, by differences of where they go."""
    generator = np.random.default_rng(3)
    forces, moments = generator.normal(size=(2, EDGES.size + 1, 3))
    forces[[0, -1]] = moments[[0, -1]] = 0.0
    loads = OFFSET.modal_loads(forces, OFFSET.about_axis(forces, moments, PLACE)) * OFFSET.inertia
    for mode, load in enumerate(loads):
        small = 1e-5 * np.eye(4)[mode]
        (x_less, y_less), (x_more, y_more) = (
            OFFSET.axes.mid_chord_places(*motion_at_loads(OFFSET, PLACE + sign * small, PLACE))
            for sign in (-1, 1)
        )
        shifts = np.stack([x_more - x_less, y_more - y_less], axis=1) / 2e-5
        twist = OFFSET.torsion_at_loads[mode] if mode < 2 else np.zeros(EDGES.size + 1)
        work = (forces[:, :2] * shifts).sum() - moments[:, 2] @ twist
        assert load == pytest.approx(work, rel=1e-6)


def motion_at_loads(
    points: LumpedPoints, position: np.ndarray, about: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Return twist and deflection near a position, as the shapes at the loads say."""
    change = position - about
    return (
        points.twist(about) + change[:2] @ points.torsion_at_loads,
        points.deflection(about) + change[2:] @ points.bending_at_loads,
    )


def test_moment_about_mid_chord_is_that_about_an_axis_there() -> None:
    forces, moments = handed(np.array(0.3), np.array(0.06))
    np.testing.assert_array_equal(POINTS.about_axis(forces, moments, PLACE), moments)
    about = OFFSET.about_axis(forces, moments, np.zeros(4))
    _, moment = OFFSET.coefficients(forces, about)
    assert moment == pytest.approx(0.06 + AXIS * 0.3 * np.cos(INCIDENCE))


def test_mass_of_the_modes_is_that_of_a_beam_with_imbalance() -> None:
    """M of the uniform beam: I int f f, m int g g, -S int f g, by sums over many stations."""
    modes = beam_modes()
    span = np.array(modes.span)
    shapes = np.array([*modes.torsion_shape, *modes.bending_shape])
    per_length = np.full((4, 4), -3.0)
    per_length[:2, :2], per_length[2:, 2:] = modes.inertia, modes.mass
    products = shapes[:, None] * shapes[None, :]
    exact = 0.5 * 3.7 * per_length * np.trapezoid(products, span, axis=-1)
    own = OFFSET.inertia[:, None] * OFFSET.mass
    np.testing.assert_allclose(own, exact, rtol=2e-3, atol=2e-3 * np.abs(np.diag(exact)).min())
    np.testing.assert_allclose(own, own.T, rtol=1e-12)
    assert np.linalg.eigvalsh(own).min() > 0.0
    np.testing.assert_array_equal(POINTS.mass, np.eye(4))


def test_release_has_the_tip_where_it_is_to_be() -> None:
    """In the first mode of each kind alone, each of which is largest at the free tip."""
    position, velocity = POINTS.release(0.05, -0.01)
    assert [*POINTS.tip(position), *POINTS.tip(velocity)] == pytest.approx([0.05, 0.0, 0.0, -0.01])
    np.testing.assert_array_equal([position[1], *position[2:]], 0.0)
    np.testing.assert_array_equal([*velocity[:2], velocity[3]], 0.0)


def test_coupled_beam_refuses_a_field_that_it_does_not_have() -> None:
    """A beam of a later kind is refused by name until its physics is here."""

    class LaterModes(BeamModes):
        left_out = frozenset({*BeamModes.left_out, "chordwise"})
        chordwise: float = 0.0

    plain = LaterModes(**dict(beam_modes()))
    assert LumpedPoints.of(plain, EDGES).span == 3.7
    later = LaterModes(**dict(beam_modes()), chordwise=0.3)
    with pytest.raises(EquisectionError, match=r"takes no beam with chordwise 0\.3 \(allowed is 0"):
        LumpedPoints.of(later, EDGES)
