"""Lags of the wake that are Theodorsen's within 0.01 %, for motions that are prescribed.

The free motions carry R. T. Jones' two lags (:mod:`equisection.aerodynamics.indicial`), whose C(k)
is up to 2.3 % off. A prescribed motion costs next to nothing a lag, so that it has more:

    C(k) = 1 - sum a_j ik/(ik + b_j),    a_j >= 0,    sum a_j = 1/2,

with rates b_j that are fixed and amplitudes by non-negative least squares on the exact C(k).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.indicial import (
    JONES_AMPLITUDES,
    LAG_RATES,
    theodorsen,
)

#: Rates b_j per semi-chord, and reduced frequencies k that C(k) is met at.
_RATES = np.geomspace(2e-3, 3.0, 13)
_FREQUENCIES = np.geomspace(5e-3, 5.0, 120)
#: Weight of the condition on the sum.
_STRONG = 1e3


@dataclass(frozen=True)
class WakeLags:
    """Lags by which the circulation follows the incidence.

    Attributes
    ----------
    amplitudes
        a_j (-).
    rates
        2 b_j (V/c).
    """

    amplitudes: tuple[float, ...] = JONES_AMPLITUDES
    rates: tuple[float, ...] = LAG_RATES

    @property
    def immediate(self) -> float:
        """Part of the circulation that is there at once (-)."""
        return 1.0 - sum(self.amplitudes)

    def lag(self, reduced_frequency: ArrayLike) -> NDArray[np.complex128]:
        """Return C at reduced frequencies k = omega c/(2 V)."""
        p = 2j * np.asarray(reduced_frequency, dtype=np.float64)
        lags = zip(self.amplitudes, self.rates, strict=True)
        return np.asarray(1.0 - sum(a * p / (p + rate) for a, rate in lags), dtype=np.complex128)


#: The two lags of R. T. Jones, those of the free motions.
JONES = WakeLags()


@cache
def accurate_lags() -> WakeLags:
    """Return the lags that are Theodorsen's C(k) within 0.01 % at k from 0.005 to 5."""
    k = _FREQUENCIES
    terms = 1j * k[:, None] / (1j * k[:, None] + _RATES)
    missing = 1.0 - theodorsen(k)
    size = np.abs(theodorsen(k))
    rows = np.concatenate(
        [(terms.real.T / size).T, (terms.imag.T / size).T, _STRONG * np.ones((1, _RATES.size))]
    )
    wanted = np.concatenate([missing.real / size, missing.imag / size, [0.5 * _STRONG]])
    amplitudes, _ = scipy.optimize.nnls(rows, wanted)
    used = amplitudes > 0.0
    return WakeLags(tuple(amplitudes[used].tolist()), tuple((2.0 * _RATES[used]).tolist()))
