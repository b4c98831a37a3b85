"""Modes under loads from outside: exact motion, energy, and the order of the coupling."""

import numpy as np
import pytest
from scipy.linalg import expm

from equisection.motion.modal_response import Floats, ModalState, ModalStep, Staggered

FREQUENCY = np.array([0.4, 1.3, 9.0])


def at_rest(load: Floats) -> ModalState:
    return ModalState.at_rest(0.0, load)


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
