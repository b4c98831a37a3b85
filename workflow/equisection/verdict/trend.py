"""Growth rate of an envelope, with its uncertainty.

The least-squares line through ln A(s): its slope sigma = d ln A/ds (per c/V) is the growth
rate, exact for A = A_0 exp(sigma s). The standard error is that of the slope,
sqrt(sum r_i^2 / ((n - 2) sum (s_i - mean s)^2)) with the residuals r_i.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from equisection.verdict.cycles import Array

# Amplitudes of neighbouring half cycles share four of five extrema, so their errors come in
# runs: n of them hold about n/4 independent ones, and the standard error doubles.
_SHARED_EXTREMA = 2.0


@dataclass(frozen=True)
class Trend:
    """Exponential trend of an amplitude, with its standard error.

    Attributes
    ----------
    growth_rate : float
        sigma = d ln A/ds (per c/V).
    standard_error : float
        Standard error of the growth rate (per c/V).
    span : float
        Length of the record that it is drawn from (c/V).
    """

    growth_rate: float
    standard_error: float
    span: float

    def clear(self, threshold: float, errors: float = 3.0) -> bool:
        """Tell whether the trend is beyond doubt.

        Parameters
        ----------
        threshold : float
            Relative change over the span that it has to exceed.
        errors : float
            Standard errors that it has to exceed.
        """
        return (
            abs(self.growth_rate) > errors * self.standard_error
            and abs(self.growth_rate) * self.span > threshold
        )


def exponential_trend(time: Array, amplitude: Array, noise: float = 0.0) -> Trend:
    """Fit A = A_0 exp(sigma s).

    Parameters
    ----------
    time : ndarray, shape (n,)
        Convective time s (c/V).
    amplitude : ndarray, shape (n,)
        Amplitudes A > 0.
    noise : float
        Standard deviation of each amplitude (its unit), beneath which the standard error does
        not fall however well the points happen to lie on a line.
    """
    if time.size < 2:
        return Trend(math.nan, math.nan, 0.0)
    s = time - time.mean()
    log_amplitude = np.log(np.maximum(amplitude, np.finfo(float).tiny))
    spread = float(s @ s)
    rate = float(s @ log_amplitude) / spread
    span = float(time[-1] - time[0])
    if time.size == 2:
        floor = noise / float(np.mean(amplitude))
        return Trend(rate, max(floor * math.sqrt(2.0) / span, abs(rate)), span)
    residual = log_amplitude - log_amplitude.mean() - rate * s
    variance = float(residual @ residual) / (time.size - 2)
    variance = max(variance, (noise / float(np.mean(amplitude))) ** 2)
    return Trend(rate, _SHARED_EXTREMA * math.sqrt(variance / spread), span)
