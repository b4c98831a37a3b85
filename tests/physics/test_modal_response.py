"""Modes under loads from outside: exact motion, energy, and the order of the coupling."""

import numpy as np
import pytest
from scipy.linalg import expm

from equisection.motion.modal_response import Floats, ModalState, ModalStep, Staggered

FREQUENCY = np.array([0.4, 1.3, 9.0])


def at_rest(load: Floats) -> ModalState:
    nothing = np.zeros_like(load)
    return ModalState(0.0, nothing, nothing, load, load)


def test_free_modes_ring_at_their_frequencies_for_ever() -> None:
    step = ModalStep(FREQUENCY, 0.3)
    state = ModalState(0.0, np.ones(3), np.zeros(3), np.zeros(3), np.zeros(3))
    for _ in range(1000):
        state = step.advanced(state, np.zeros(3))
    np.testing.assert_allclose(state.position, np.cos(FREQUENCY * 300.0), atol=1e-9)


def test_load_that_is_put_on_slowly_gives_the_static_deflection() -> None:
    step, load = ModalStep(FREQUENCY, 0.05), np.array([0.2, -1.0, 3.0])
    state = at_rest(np.zeros(3))
    steps = 40_000
    for number in range(1, steps + 1):
        state = step.advanced(state, load * number / steps)
    np.testing.assert_allclose(state.position, load / FREQUENCY**2, rtol=5e-3)


def test_sudden_load_swings_to_twice_the_static_deflection() -> None:
    half_period = np.pi / FREQUENCY[1]
    step = ModalStep(FREQUENCY[1:2], half_period / 7)
    state = at_rest(np.array([0.5]))
    for _ in range(7):
        state = step.advanced(state, np.array([0.5]))
    np.testing.assert_allclose(state.position, 2 * 0.5 / FREQUENCY[1] ** 2)
    np.testing.assert_allclose(state.velocity, 0.0, atol=1e-12)


def test_linear_load_is_followed_exactly_at_any_step() -> None:
    """Against the matrix exponential of the motion together with its load."""
    omega, slope, step = 1.3, 0.7, 2.1
    rates = np.array([[0, 1, 0, 0], [-(omega**2), 0, 1, 0], [0, 0, 0, 1], [0, 0, 0, 0]])
    expected = expm(rates * step) @ [0.2, -0.1, 0.5, slope]
    start = ModalState(
        0.0, np.array([0.2]), np.array([-0.1]), np.array([0.5]), np.array([0.5 - slope * step])
    )
    assert start.expected_load() == pytest.approx(expected[2])
    state = ModalStep(np.array([omega]), step).advanced(start, start.expected_load())
    assert [*state.position, *state.velocity] == pytest.approx(list(expected[:2]))


DAMPED = np.array([0.01, 0.05, 0.15])


def test_damped_mode_decays_as_its_ratio_says() -> None:
    """exp(-zeta omega s), at a step that is no small part of the period."""
    step = ModalStep(FREQUENCY, 0.3, DAMPED)
    state = ModalState(0.0, np.ones(3), np.zeros(3), np.zeros(3), np.zeros(3))
    for _ in range(40):
        state = step.advanced(state, np.zeros(3))
    pole = FREQUENCY * (-DAMPED + 1j * np.sqrt(1 - DAMPED**2))
    expected = ((pole.conj() * np.exp(pole * 12.0)).imag) / pole.conj().imag
    np.testing.assert_allclose(state.position, expected, rtol=1e-9)


def test_one_mode_by_matrix_exponential_is_duhamels_integral() -> None:
    """The closed form in the module's own words."""
    omega, h, q, v, p, rise = 1.3, 0.7, 0.2, -0.1, 0.5, 0.3
    c, s = np.cos(omega * h), np.sin(omega * h)
    start = ModalState(0.0, *(np.array([value]) for value in (q, v, p, p)))
    state = ModalStep(np.array([omega]), h).advanced(start, np.array([p + rise]))
    one, both = (1 - c) / omega**2, 1 / omega**2 - s / (omega**3 * h)
    assert state.position[0] == pytest.approx(c * q + s / omega * v + one * p + both * rise)
    rate = -omega * s * q + c * v + s / omega * p + one / h * rise
    assert state.velocity[0] == pytest.approx(rate)


COUPLED = ModalStep(
    np.array([1.3, 0.9]), 0.05, np.array([0.03, 0.01]), np.array([[1.0, -2.0], [-0.08, 1.0]])
)
#: Generalised inertia of its modes, whose rows are over it: M = diag(1, 25) mu is symmetric.
INERTIA = np.array([1.0, 25.0])


def test_imbalance_shifts_both_frequencies_to_those_of_the_coupled_modes() -> None:
    """(1 - eps) x^2 - (w1^2 + w2^2) x + w1^2 w2^2 = 0 of x = omega^2, eps = mu_12 mu_21."""
    undamped = ModalStep(COUPLED.frequency, COUPLED.step, None, COUPLED.mass)
    ones, twos = COUPLED.frequency**2
    exact = np.sqrt(np.sort(np.roots([1 - 0.16, -(ones + twos), ones * twos])))
    at_rest = ModalState(0.0, np.array([1.0, 0.3]), *np.zeros((3, 2)))
    moved = np.array([state.position for state in march(undamped, at_rest, 4000)])
    time = 0.05 * np.arange(1, 4001)
    waves = [wave(omega * time) for omega in exact for wave in (np.cos, np.sin)]
    _, left, _, _ = np.linalg.lstsq(np.stack(waves, axis=1), moved, rcond=None)
    assert left.max() < 1e-12


def march(step: ModalStep, state: ModalState, count: int) -> list[ModalState]:
    """Return the states of modes without loads after each of some steps."""
    found = []
    for _ in range(count):
        state = step.advanced(state, np.zeros(step.frequency.size))
        found.append(state)
    return found


def test_dampers_take_what_the_coupled_modes_lose() -> None:
    """1/2 q' M q' + 1/2 q K q falls by the integral of q' C q', and by nothing without dampers."""
    assert COUPLED.mass is not None
    mass = INERTIA[:, None] * COUPLED.mass
    np.testing.assert_allclose(mass, mass.T)
    start = ModalState(0.0, np.array([1.0, -0.3]), *np.zeros((3, 2)))
    for ratio in (np.zeros(2), COUPLED.damping_ratio):
        assert ratio is not None
        states = march(ModalStep(COUPLED.frequency, 0.01, ratio, COUPLED.mass), start, 2000)
        rates = np.array([state.velocity for state in states])
        places = np.array([state.position for state in states])
        energy = 0.5 * np.einsum("ti,ij,tj->t", rates, mass, rates)
        energy += 0.5 * (INERTIA * COUPLED.frequency**2 * places**2).sum(axis=1)
        power = (2 * ratio * COUPLED.frequency * INERTIA * rates**2).sum(axis=1)
        lost = 0.005 * (power[1:] + power[:-1]).sum()
        assert energy[0] - energy[-1] == pytest.approx(lost, rel=1e-4, abs=1e-10)


def flow_of(time: float, position: Floats, rate: Floats) -> Floats:
    """Return the loads of a flow with added mass left out: stiffness, damping, and a gust."""
    return -0.1 * position - 0.05 * rate + np.sin(0.7 * time)


def coupled(step: float, turns: int, end: float = 6.0) -> float:
    """Return where a mode in such a flow is in the end, whose rate it takes from two places."""
    structure = Staggered(ModalStep(FREQUENCY[:1], step))
    place = earlier = np.zeros(1)
    load = flow_of(0.0, place, place)
    for number in range(1, round(end / step) + 2):
        before, earlier = earlier, place
        for _ in range(turns):
            place = structure.turn(number * step, load)
            rate = (3 * place - 4 * earlier + before) / (2 * step)
            load = flow_of(number * step, place, rate)
    assert structure.state is not None
    assert structure.state.time == pytest.approx(end)
    return float(structure.state.position[0])


@pytest.mark.parametrize("turns", [1, 3])
def test_coupling_is_of_second_order(turns: int) -> None:
    coarse, middle, fine = (coupled(step, turns) for step in (0.1, 0.05, 0.025))
    assert np.log2((coarse - middle) / (middle - fine)) > 1.8


def test_one_turn_a_step_comes_to_what_many_come_to() -> None:
    assert coupled(0.05, 1) == pytest.approx(coupled(0.05, 4), rel=1e-4)


def test_energy_of_the_structure_is_the_work_of_its_loads() -> None:
    """Exact but for the trapezoidal rule, with which the work is summed here."""
    structure, step = Staggered(ModalStep(FREQUENCY, 0.01)), 0.01
    work = np.zeros(3)
    for number in range(1, 2000):
        before = structure.state
        structure.turn(number * step, np.sin(number * step * np.array([0.3, 1.0, 5.0])))
        if before is not None and structure.state is not None:
            mean = 0.5 * (before.load + structure.state.load)
            work += mean * (structure.state.position - before.position)
    state = structure.state
    assert state is not None
    energy = 0.5 * state.velocity**2 + 0.5 * (FREQUENCY * state.position) ** 2
    np.testing.assert_allclose(work, energy, rtol=1e-3)


def test_structure_that_is_taken_up_again_goes_on_as_before() -> None:
    whole = Staggered(ModalStep(FREQUENCY, 0.02))
    for number in range(1, 20):
        whole.turn(number * 0.02, np.full(3, 0.1 * number))
    again = Staggered(ModalStep(FREQUENCY, 0.02), whole.state)
    np.testing.assert_array_equal(again.proposed_position, whole.proposed_position)
    for number in range(20, 25):
        load = np.full(3, 0.1 * number)
        np.testing.assert_array_equal(
            again.turn(number * 0.02, load), whole.turn(number * 0.02, load)
        )


def test_release_from_a_position_with_a_velocity_is_the_free_vibration_from_there() -> None:
    """Under a load that is balanced by the springs at a place, about that place."""
    place, start = np.array([0.2, -0.1, 0.01]), np.array([0.5, 0.3, -0.2])
    velocity = np.array([-0.4, 0.1, 0.6])
    load, step = place * FREQUENCY**2, 0.05
    structure = Staggered(ModalStep(FREQUENCY, step), position=start, velocity=velocity)
    np.testing.assert_array_equal(structure.proposed_position, start)
    for number in range(1, 102):
        structure.turn(number * step, load)
    assert structure.state is not None
    phase = FREQUENCY * structure.state.time
    assert structure.state.time == pytest.approx(5.0)
    expected = place + (start - place) * np.cos(phase) + velocity / FREQUENCY * np.sin(phase)
    np.testing.assert_allclose(structure.state.position, expected, atol=1e-12)
