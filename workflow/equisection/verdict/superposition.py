"""Mean of a motion that still rings: constant plus damped waves, by the matrix pencil.

The free motion of a section near its equilibrium is

    x(s) = X + sum_j a_j exp(lambda_j s),    lambda_j = sigma_j + i omega_j,

with the same few lambda_j in twist and deflection (pitch, heave and lags). The matrix pencil
(Hua & Sarkar 1990, IEEE Trans. ASSP 38, 814) finds them from samples by a singular value
decomposition and an eigenvalue problem, with no first guess; X and a_j follow from linear
least squares. Samples are averages over equal bins, which leaves X and lambda_j as they are
and keeps noise and aliases out.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.verdict.cycles import Array

_BINS_PER_PERIOD = 8
# Small enough for matrix products that linear algebra libraries do not spread over threads.
_MAXIMAL_BINS = 96
# Constant, pitch, heave, their first harmonics or lags.
_MAXIMAL_WAVES = 8
# Singular values below this fraction of the largest are taken for noise.
_RELATIVE_RANK = 3e-4
# A wave that changes by less than this over the whole record cannot be told from the constant.
_CONSTANT = 0.1


@dataclass(frozen=True)
class Superposition:
    """Constant and waves that make up a motion.

    Attributes
    ----------
    constant : ndarray, shape (channels,)
        X of each channel (unit of the channel).
    residual : ndarray, shape (channels,)
        Root mean square of the residual of the fit (unit of the channel).
    rates : ndarray of complex, shape (waves,)
        lambda_j (per c/V).
    """

    constant: Array
    residual: Array
    rates: NDArray[np.complex128]


def bin_averages(time: Array, channels: Array, width: float, count: int) -> tuple[Array, Array]:
    """Averages over ``count`` bins of ``width`` (c/V) that end with the record.

    Parameters
    ----------
    time : ndarray, shape (n,)
    channels : ndarray, shape (channels, n)

    Returns
    -------
    centre : ndarray, shape (count,)
    average : ndarray, shape (channels, count)
    """
    edges = time[-1] - width * np.arange(count, -1, -1)
    first = max(int(np.searchsorted(time, edges[0], side="right")) - 1, 0)
    s, x = time[first:], channels[:, first:]
    integral = np.zeros_like(x)
    np.cumsum(0.5 * (x[:, 1:] + x[:, :-1]) * np.diff(s), axis=1, out=integral[:, 1:])
    at = np.clip(np.searchsorted(s, edges, side="right") - 1, 0, s.size - 2)
    part = edges - s[at]
    slope = (x[:, at + 1] - x[:, at]) / (s[at + 1] - s[at])
    upto = integral[:, at] + part * (x[:, at] + 0.5 * part * slope)
    return 0.5 * (edges[1:] + edges[:-1]), np.diff(upto, axis=1) / width


def mean_of(time: Array, signal: Array, start: float, end: float) -> float:
    """Average of a history between two times (trapezoidal rule, ends interpolated)."""
    inside = slice(int(np.searchsorted(time, start)), int(np.searchsorted(time, end, "right")))
    ends = np.interp((start, end), time, signal)
    s = np.concatenate(((start,), time[inside], (end,)))
    x = np.concatenate((ends[:1], signal[inside], ends[1:]))
    return float(np.trapezoid(x, s) / (end - start))


def superposition(time: Array, channels: Array, start: float, period: float) -> Superposition:
    """Fit constant and waves to the record after ``start``.

    Parameters
    ----------
    time : ndarray, shape (n,)
        Convective time s (c/V).
    channels : ndarray, shape (channels, n)
        Histories with waves in common.
    start : float
        Begin of the fit (c/V).
    period : float
        Shortest period to be resolved (c/V).
    """
    length = float(time[-1]) - start
    count = int(np.clip(_BINS_PER_PERIOD * length / period, 12, _MAXIMAL_BINS))
    centre, sample = bin_averages(time, channels, length / count, count)
    middle = sample.mean(axis=1, keepdims=True)
    # A channel that is constant but for rounding must not be scaled up into noise.
    scale = np.maximum(sample.std(axis=1, keepdims=True), 1e-12 + 1e-9 * np.abs(middle))
    scaled = (sample - middle) / scale
    rates = _rates(scaled, length / count)
    waves = _waves(centre, rates[rates.imag >= 0.0])
    basis = np.concatenate((np.ones((count, 1)), waves.real, waves.imag), axis=1)
    basis = basis[:, np.any(basis != 0.0, axis=0)]
    coefficient, *_ = np.linalg.lstsq(basis, scaled.T, rcond=1e-9)
    left = scaled - (basis @ coefficient).T
    return Superposition(
        constant=middle[:, 0] + scale[:, 0] * coefficient[0],
        residual=scale[:, 0] * np.sqrt(np.mean(left**2, axis=1)),
        rates=rates,
    )


def _waves(time: Array, rates: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """exp(lambda_j s), shape (n, waves), each scaled to at most 1 over the record."""
    origin = np.where(rates.real < 0.0, time[0], time[-1])
    waves: NDArray[np.complex128] = np.exp(rates * (time[:, None] - origin))
    return waves


def _rates(sample: Array, step: float) -> NDArray[np.complex128]:
    """Rates lambda_j of the waves that the channels share, the constant left out."""
    count = sample.shape[1]
    pencil = count // 3
    windows = np.lib.stride_tricks.sliding_window_view(sample, pencil + 1, axis=1)
    # The correlation matrix has the Hankel matrix' right singular vectors at a third of the
    # cost; it squares the singular values, hence the square of the rank tolerance.
    hankel = windows.reshape(-1, pencil + 1)
    correlation = hankel.T @ hankel
    # Only the largest ones: the solver for all of them spreads over threads, which costs a
    # hundred times its work when the machine is busy.
    largest = [max(pencil + 1 - _MAXIMAL_WAVES, 0), pencil]
    values, vectors = scipy.linalg.eigh(correlation, subset_by_index=largest, check_finite=False)
    significant = int(np.sum(values > _RELATIVE_RANK**2 * values[-1]))
    basis = vectors[:, -max(significant, 1) :]
    shift = np.linalg.lstsq(basis[:-1], basis[1:], rcond=None)[0]
    poles = np.linalg.eigvals(shift).astype(complex)
    poles = poles[np.abs(poles) > 1e-3]
    rates = np.log(poles) / step
    length = step * count
    kept = (np.abs(rates) * length > _CONSTANT) & (rates.real * length < 5.0)
    found: NDArray[np.complex128] = rates[kept]
    return found
