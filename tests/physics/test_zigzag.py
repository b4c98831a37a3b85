"""Zigzag of loads from step to step: seen where it is, and nowhere else."""

import math

import numpy as np
import pytest

from equisection.verdict.zigzag import LARGEST_ZIGZAG, zigzag_of

TIME = np.arange(0.0, 60.0, 0.2)
SIGNS = (-1.0) ** np.arange(TIME.size)


def motion(period: float = 7.0, decay: float = 0.0) -> np.ndarray:
    """Return a load of amplitude 0.06 about 0.28, which decays by a rate (V/c)."""
    return 0.28 + 0.06 * np.exp(-decay * TIME) * np.sin(2 * math.pi * TIME / period)


@pytest.mark.parametrize("part", [0.005, 0.02, 0.1])
def test_the_zigzag_of_a_load_is_found_by_its_size(part):
    load = motion()
    spread = load[TIME > 5].std()
    found = zigzag_of(TIME, load + part * spread * SIGNS)
    assert found == pytest.approx(part, rel=0.02)  # the spread grows by it too: 0.5 % at 0.1


def test_of_two_loads_the_worse_counts():
    steady, rough = motion(), motion() + 0.003 * SIGNS
    assert zigzag_of(TIME, steady, rough) == zigzag_of(TIME, rough, steady)
    assert zigzag_of(TIME, steady, rough) > LARGEST_ZIGZAG > 10 * zigzag_of(TIME, steady)


@pytest.mark.parametrize("samples", [17, 35])
def test_a_resolved_oscillation_has_none(samples):
    # sin(pi/n)^4 over its root mean square: 0.0011 and 0.00006
    found = zigzag_of(TIME, motion(period=0.2 * samples, decay=0.01))
    assert found == pytest.approx(math.sin(math.pi / samples) ** 4, rel=0.05)
    assert found < LARGEST_ZIGZAG / 10


def test_size_and_mean_of_a_load_do_not_matter():
    load = motion() + 0.002 * SIGNS
    assert zigzag_of(TIME, 50.0 * load + 3.0) == pytest.approx(zigzag_of(TIME, load), rel=1e-9)


def test_the_jump_at_the_release_does_not_count():
    jump = motion()
    jump[:3] += (1.0, -1.0, 0.5)
    assert zigzag_of(TIME, jump) == pytest.approx(zigzag_of(TIME, motion()), rel=1e-9)


@pytest.mark.parametrize(
    ("time", "load", "steps"),
    [
        (TIME, motion() + 0.01 * SIGNS, 10),  # each second step is passed over
        (TIME[:30], motion()[:30], 1),
        (TIME, np.full(TIME.size, 0.3), 1),
        (TIME[:0], TIME[:0], 1),
    ],
    ids=["even number of steps", "short", "constant", "empty"],
)
def test_what_cannot_be_seen_is_not_called_converged(time, load, steps):
    assert math.isnan(zigzag_of(time, load, steps_per_sample=steps))
