"""Loads in answer to harmonic motion, from histories by least squares.

y(s) = m + d s + sum Re(Y_i exp(i omega_i s)) + rest, with mean m and drift d. Frequencies need not
be multiples of one another, nor of what a record holds. A record of N blocks gives N answers, whose
standard deviation over the root of N says how well each is known. The rest is what the motion does
at other frequencies: harmonics of a load that is not linear in it, and the flow's own unsteadiness.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.errors import ArgumentError

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

#: Blocks of a record.
BLOCKS = 2
#: Largest condition of the least squares at which close frequencies are told apart.
_LARGEST_CONDITION = 50.0


@dataclass(frozen=True)
class LoadResponse:
    """Answer of a load to harmonic motion.

    Attributes
    ----------
    response
        Y_i over the whole record, shape (n,).
    spread
        Standard error of its real and imaginary part, shape (n,).
    mean
        m at the middle of the record.
    rest
        Root mean square of the rest over that of the load without mean and drift.
    """

    response: Complexes
    spread: Floats
    mean: float
    rest: float


def load_response(time: Floats, load: Floats, frequencies: Floats) -> LoadResponse:
    """Fit the answer of a load to harmonics.

    Parameters
    ----------
    time
        s = tV/c of the record after the motion has set in, shape (m,).
    load
        c_l or c_m, shape (m,).
    frequencies
        omega c/V, shape (n,).

    Raises
    ------
    ArgumentError
        The record is too short to tell the frequencies apart.
    """
    response, mean, rest = _fit(time, load, frequencies)
    parts = np.array_split(np.arange(time.size), BLOCKS)
    each = np.array([_fit(time[part], load[part], frequencies)[0] for part in parts])
    off = each - each.mean(axis=0)
    variance = 0.5 * np.sum(np.abs(off) ** 2, axis=0) / (BLOCKS - 1)
    return LoadResponse(response, np.sqrt(variance / BLOCKS), mean, rest)


def _fit(time: Floats, load: Floats, frequencies: Floats) -> tuple[Complexes, float, float]:
    middle = 0.5 * (time[0] + time[-1])
    half = 0.5 * (time[-1] - time[0])
    angle = np.multiply.outer(time, frequencies)
    columns = [np.ones_like(time), (time - middle) / half, *np.cos(angle).T, *np.sin(angle).T]
    matrix = np.stack(columns, axis=1)
    singular = np.linalg.svd(matrix, compute_uv=False)
    if matrix.shape[0] <= matrix.shape[1] or singular[0] > _LARGEST_CONDITION * singular[-1]:
        raise ArgumentError(
            f"{time.size} samples over {2.0 * half:.4g} c/V do not tell the frequencies "
            f"{', '.join(f'{one:.3g}' for one in frequencies)} (omega c/V) apart; record for longer"
        )
    found, *_ = np.linalg.lstsq(matrix, load, rcond=None)
    number = frequencies.size
    response = found[2 : 2 + number] - 1j * found[2 + number :]
    steady = matrix[:, :2] @ found[:2]
    moved = load - steady
    size = math.sqrt(float(np.mean(moved**2)))
    rest = math.sqrt(float(np.mean((load - matrix @ found) ** 2)))
    return response, float(found[0]), rest / size if size > 0.0 else 0.0
