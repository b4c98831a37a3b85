"""Oscillators with exact limit cycles: Van der Pol and Stuart-Landau."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from equisection.verdict import assess

S = np.arange(0.0, 300.0, 0.1)
REST = np.zeros_like(S)
OMEGA = 2.0 * np.pi / 6.0


# Amplitude and period from Andersen & Geer (1982), SIAM J. Appl. Math. 42, 678: 2.0001 at
# mu = 0.1; for large mu from tables of the relaxation oscillation.
@pytest.mark.parametrize(
    ("mu", "amplitude", "period"),
    [(0.1, 2.0001, 6.2871), (0.5, 2.0025, 6.3807), (1.0, 2.0086, 6.6633), (3.0, 2.0233, 8.8591)],
)
def test_van_der_pol(mu, amplitude, period):
    solution = solve_ivp(
        lambda _, y: [y[1], mu * (1.0 - y[0] ** 2) * y[1] - y[0]],
        (0.0, 200.0),
        [0.1, 0.0],
        t_eval=S[S <= 200.0],
        rtol=1e-9,
        atol=1e-11,
    )
    twist = np.radians(solution.y[0])
    verdict = assess(solution.t, twist, np.zeros_like(twist))
    assert verdict.regime == "limit-cycle"
    assert np.degrees(verdict.twist_amplitude) == pytest.approx(amplitude, rel=2e-3)
    assert verdict.frequency == pytest.approx(1.0 / period, rel=1e-3)
    assert np.degrees(verdict.mean_twist) == pytest.approx(0.0, abs=0.01)


def stuart_landau(start, rate, saturated):
    """A of dA/ds = rate A (1 - A^2/saturated^2), exact (deg)."""
    return saturated / np.sqrt(1.0 + ((saturated / start) ** 2 - 1.0) * np.exp(-2.0 * rate * S))


@pytest.mark.parametrize("start", [0.1, 0.5, 1.9, 3.0, 10.0])
@pytest.mark.parametrize("rate", [0.02, 0.05])
def test_supercritical_saturates(start, rate):
    twist = np.radians(stuart_landau(start, rate, 2.0) * np.sin(OMEGA * S))
    for end in np.arange(20.0, 301.0, 20.0):
        upto = end >= S
        verdict = assess(S[upto], twist[upto], REST[upto])
        assert verdict.regime in ("undecided", "limit-cycle"), verdict.reason
        if verdict.decided:
            assert np.degrees(verdict.twist_amplitude) == pytest.approx(2.0, rel=0.03)
    assert verdict.regime == "limit-cycle"
    assert np.degrees(verdict.twist_amplitude) == pytest.approx(2.0, rel=0.005)


@pytest.mark.parametrize("power", [1.0, 2.0, 3.0])
@pytest.mark.parametrize("rate", [0.004, 0.01, 0.03])
@pytest.mark.parametrize("start", [1.3, 2.0, 4.0])
def test_falling_to_a_limit_cycle_is_not_settling(power, rate, start):
    """dA/ds = rate A (1 - (A/A_0)^n) with A_0 = 1 deg, exact, looked at every 5 c/V."""
    amplitude = (1.0 + (start**-power - 1.0) * np.exp(-power * rate * S)) ** (-1.0 / power)
    twist = np.radians(amplitude * np.sin(OMEGA * S))
    for end in np.arange(20.0, 301.0, 5.0):
        upto = end >= S
        assert assess(S[upto], twist[upto], REST[upto]).regime not in {"settled", "decaying"}


def test_saturation_beyond_the_bound_is_growth():
    twist = np.radians(stuart_landau(0.1, 0.05, 8.0) * np.sin(OMEGA * S))
    assert assess(S, twist, REST).regime == "growing"


def test_steady_from_the_start_beyond_the_bound_is_a_limit_cycle():
    assert assess(S, np.radians(8.0 * np.sin(OMEGA * S)), REST).regime == "limit-cycle"


@pytest.mark.parametrize(("start", "regime"), [(0.9, "settled"), (1.1, "growing")])
def test_subcritical_decides_at_its_unstable_cycle(start, regime):
    # dA/ds = -r A (1 - A^2): rest below A = 1 deg, growth above it.
    rate, threshold = 0.02, 1.0
    growth = 1.0 + ((threshold / start) ** 2 - 1.0) * np.exp(2.0 * rate * S)
    before_escape = growth > 0.01
    amplitude = threshold / np.sqrt(growth[before_escape])
    s = S[before_escape]
    twist = np.radians(amplitude * np.sin(OMEGA * s))
    verdict = assess(s, twist, np.zeros_like(s), final=True)
    assert verdict.regime == regime
