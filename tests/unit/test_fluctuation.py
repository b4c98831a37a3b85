"""Fluctuation of unsteady loads: a wave's rms and frequency, and none where there is no wave."""

from __future__ import annotations

import math

import numpy as np
import pytest

from equisection.results.fluctuation import Fluctuation

TIME = np.arange(0.02, 40.0, 0.02)
FLAT = np.ones_like(TIME)


@pytest.mark.parametrize("frequency", [0.1437, 0.146, 0.52, 3.1])
def test_wave_has_its_frequency_and_its_rms(frequency: float) -> None:
    lift = 0.3 + 0.2 * np.sin(2 * np.pi * frequency * TIME)
    found = Fluctuation.of(TIME, FLAT, lift, 0.1 * lift)
    assert found.frequency == pytest.approx(frequency, abs=1e-5)
    assert found.lift == pytest.approx(0.2 / math.sqrt(2.0), rel=0.05)
    assert found.moment == pytest.approx(0.1 * found.lift)
    assert found.drag == 0.0
    assert set(found.variables()) == {"cd_rms", "cl_rms", "cm_rms", "strouhal"}


def test_slow_drift_below_a_wave_leaves_its_frequency() -> None:
    lift = 0.02 * TIME + 0.05 * np.sin(2 * np.pi * 0.2 * TIME)
    assert Fluctuation.of(TIME, FLAT, lift, lift).frequency == pytest.approx(0.2, abs=1e-5)


@pytest.mark.parametrize(
    "lift",
    [
        np.random.default_rng(1).normal(size=TIME.size),
        np.exp(-TIME / 10.0),
        1e-4 * np.sin(TIME),
        FLAT,
        np.sin(2 * np.pi * TIME / 15.0),
    ],
    ids=["noise", "transient", "too small", "steady", "fewer than four periods"],
)
def test_loads_without_a_wave_have_no_frequency(lift: np.ndarray) -> None:
    found = Fluctuation.of(TIME, FLAT, lift, lift)
    assert found.frequency is None
    assert "strouhal" not in found.variables()
