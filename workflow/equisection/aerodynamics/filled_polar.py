"""Polars of few points: filled in the shape of a denser one, and the angles that they lack."""

from __future__ import annotations

import itertools

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.polar import Polar
from equisection.errors import ArgumentError

Floats = NDArray[np.float64]

#: Widest interval of a polar (deg) inside which a bend of a thin plate's loads is not lost.
WIDEST_INTERVAL_DEG = 1.5


def filled(polar: Polar, denser: Polar) -> Polar:
    """Polar at the angles of a denser one, with its shape and the values of the first.

    The ratio of both, lift and moment each, is linear between the angles that the first has; the
    denser polar, for instance that of a coarser mesh, only gives the shape in between.

    Raises
    ------
    ArgumentError
        The polar has an angle beyond the denser one, or one at which that has no load.
    """
    given = polar.incidence > 0.0
    angles = polar.incidence[given]
    if not denser.covers(angles):
        raise ArgumentError(
            f"polar {denser.label!r} covers {np.degrees(denser.incidence_range)} deg; wanted is "
            f"one that covers all angles of {polar.label!r}"
        )

    def shaped(values: Floats, shape: Floats, at: Floats) -> Floats:
        if np.any(at == 0.0):
            raise ArgumentError(
                f"polar {denser.label!r} has no load at an angle of {polar.label!r}, so that it "
                "gives no shape"
            )
        return shape * np.interp(denser.incidence, angles, values[given] / at)

    return Polar(
        denser.incidence,
        denser.drag,
        shaped(polar.lift, denser.lift, denser.lift_coefficient(angles)),
        shaped(polar.moment, denser.moment, denser.moment_coefficient(angles)),
        f"{polar.label} in the shape of {denser.label}",
    )


def missing_angles(polar: Polar, seen: tuple[float, float]) -> list[float]:
    """Return the angles (deg) that a polar lacks where a motion takes it.

    They are the whole degrees inside each interval between its points that is wider than
    :data:`WIDEST_INTERVAL_DEG`, in the range of incidence of a motion.

    Parameters
    ----------
    polar
        The polar.
    seen
        Least and greatest incidence (rad) of the motion.
    """
    return missing_between(polar.incidence, seen)


def missing_between(incidence: Floats, seen: tuple[float, float]) -> list[float]:
    """Angles (deg) that lack where a motion goes (:func:`missing_angles`) between given ones (rad).

    ``incidence`` ascends, shape (n,).
    """
    points = np.degrees(incidence)
    low, high = np.degrees(seen)
    found: list[float] = []
    for start, stop in itertools.pairwise(points):
        if stop - start <= WIDEST_INTERVAL_DEG or stop < low or start > high:
            continue
        whole = np.arange(np.floor(start) + 1.0, np.ceil(stop))
        found += [float(angle) for angle in whole if start + 1e-6 < angle < stop - 1e-6]
    return found
