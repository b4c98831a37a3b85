"""Indicial functions of the attached flow: how circulation follows the incidence.

A step of incidence builds its circulatory lift up after Wagner's function phi, which R. T. Jones
(NACA Report 681, 1940) fitted with two exponentials of the time tau = 2 s in semi-chords:

    phi(tau) = 1 - A_1 exp(-b_1 tau) - A_2 exp(-b_2 tau).

In the frequency domain the same statement is Theodorsen's function C(k) (NACA Report 496, 1935),
with k = omega c/(2 V), and for a motion exp(p s) that grows or decays it is C(p/2) with complex
arguments (Edwards, Ashley & Breakwell, AIAA Journal 17, 1979). As states, with the incidence
alpha_34 at three quarters of the chord:

    z_i' = 2 b_i (alpha_34 - z_i),
    alpha_E = (1 - A_1 - A_2) alpha_34 + A_1 z_1 + A_2 z_2,    ' = d/ds,

and the circulatory coefficients are those of steady flow at alpha_E.
"""

from __future__ import annotations

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

Floats = NDArray[np.float64]

JONES_AMPLITUDES = (0.165, 0.335)
#: Reduced frequencies between which C(k) can be computed.
_LEAST_K, _LARGEST_K = 1e-200, 1e8
"""A_1, A_2 of R. T. Jones."""

JONES_RATES_SEMICHORD = (0.0455, 0.3)
"""b_1, b_2 of R. T. Jones, per semi-chord travelled."""

LAG_RATES = (2 * JONES_RATES_SEMICHORD[0], 2 * JONES_RATES_SEMICHORD[1])
"""2 b_1, 2 b_2: the same rates per chord travelled, that is per unit of s."""

IMMEDIATE_SHARE = 1.0 - sum(JONES_AMPLITUDES)
"""phi(0) = 1/2, the part of the circulation that is there at once."""


def wagner(time: ArrayLike) -> Floats:
    """Wagner's function phi in Jones' form at convective times s = tV/c >= 0, any shape."""
    s = np.asarray(time, dtype=np.float64)
    lags = zip(JONES_AMPLITUDES, LAG_RATES, strict=True)
    return np.asarray(1.0 - sum(a * np.exp(-rate * s) for a, rate in lags), dtype=np.float64)


def theodorsen(reduced_frequency: ArrayLike) -> NDArray[np.complex128]:
    """Theodorsen's C(k), exact, at k = omega c/(2 V) > 0, any shape.

    C = H_1/(H_1 + i H_0) with Hankel functions of the second kind (NACA Report 496). Beyond the k
    at which these can be computed it is within 2e-9 of its limits, 1 and 1/2.
    """
    k = np.clip(np.asarray(reduced_frequency, dtype=np.float64), _LEAST_K, _LARGEST_K)
    first, zeroth = scipy.special.hankel2(1, k), scipy.special.hankel2(0, k)
    return np.asarray(first / (first + 1j * zeroth), dtype=np.complex128)


def theodorsen_of_jones(reduced_frequency: ArrayLike) -> NDArray[np.complex128]:
    """C(k) of Jones' form of phi, that of the states z_i, at k = omega c/(2 V), any shape."""
    ik = 1j * np.asarray(reduced_frequency, dtype=np.float64)
    lags = zip(JONES_AMPLITUDES, JONES_RATES_SEMICHORD, strict=True)
    return np.asarray(1.0 - sum(a * ik / (ik + b) for a, b in lags), dtype=np.complex128)


def theodorsen_of_growing(rate: complex) -> complex:
    """C of a motion that grows or decays, exact, at p/2 = growth + i k, per semi-chord.

    C(z) = K_1(z)/(K_0(z) + K_1(z)) with modified Bessel functions, on the imaginary axis
    Theodorsen's (Edwards, Ashley & Breakwell, AIAA Journal 17, 1979). It is cut along the negative
    real axis: the wake of what decays without turning never ends. There the value is that from
    above.
    """
    first, zeroth = scipy.special.kve(1, complex(rate)), scipy.special.kve(0, complex(rate))
    return complex(first / (zeroth + first))


def theodorsen_slope(rate: complex) -> complex:
    """dC/dz of :func:`theodorsen_of_growing`: 2 C - 1 - C (1 - C)/z.

    From K_0' = -K_1 and K_1' = -K_0 - K_1/z (Abramowitz & Stegun, 9.6.26 and 9.6.27).
    """
    value = theodorsen_of_growing(rate)
    return 2.0 * value - 1.0 - value * (1.0 - value) / rate
