"""Poles of a damped structure from its motion under loads that are recorded."""

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]


def exact_poles(mass: Floats, damping: Floats, stiffness: Floats) -> Complexes:
    """Return the poles of M q'' + C q' + K q = 0 above the real axis, by frequency, shape (n,)."""
    count = len(mass)
    inverse = np.linalg.inv(mass)
    rates = np.block(
        [[np.zeros((count, count)), np.eye(count)], [-inverse @ stiffness, -inverse @ damping]]
    )
    poles = np.linalg.eigvals(rates)
    above = poles[poles.imag > 0.0]
    return np.asarray(above[np.argsort(above.imag)])


def fitted_poles(time: Floats, motion: Floats, loads: Floats, near: Complexes) -> Complexes:
    """Return the poles with which a structure at rest best answers loads with a motion.

    Each pole p answers a load with the convolution of the load and exp(p s). The motion is any sum
    of these, real and imaginary, and the poles are those that leave the least of it. So neither
    the matrices nor the size of the loads are assumed.

    Parameters
    ----------
    time
        Even steps, shape (n,).
    motion, loads
        Shape (n, coordinates) and (n, loads).
    near
        Poles to start from, each 3 % off.
    """
    step, size = time[1] - time[0], np.abs(motion).max(axis=0)
    since, count = time - time[0], near.size

    def answers(poles: Complexes) -> Floats:
        columns = []
        for pole in poles:
            decay = np.exp(pole * since)
            rows = loads / decay[:, None]
            areas = 0.5 * step * np.cumsum(rows[1:] + rows[:-1], axis=0)
            both = decay[:, None] * np.concatenate([np.zeros_like(rows[:1]), areas])
            columns += [both.real, both.imag]
        found = np.concatenate(columns, axis=1)
        return np.asarray(found / np.abs(found).max(axis=0))

    def misfit(parts: Floats) -> Floats:
        columns = answers(parts[:count] + 1j * parts[count:])
        sums = np.linalg.lstsq(columns, motion / size, rcond=1e-9)[0]
        return np.asarray((motion / size - columns @ sums).ravel())

    start = 1.03 * np.concatenate([near.real, near.imag])
    parts = least_squares(misfit, start, x_scale=np.abs(start), xtol=1e-12, ftol=1e-12).x
    return np.asarray(parts[:count] + 1j * parts[count:])
