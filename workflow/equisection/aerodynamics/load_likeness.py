"""Likeness of the loads in a prescribed motion to those that a polar has in unsteady flow.

Loads that are recorded while a section is moved follow from no equation of a body, by which they
could be weighed (:mod:`.load_balance`). But in slow motion they are those of the polar, and in
faster motion they are of the size that thin-airfoil theory gives to its slopes
(:mod:`.unsteady_loads`). Bluff sections differ from that by a factor; a load of the other sign, in
another unit or about another axis differs by more, and a single change makes it alike.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.aerodynamics.unsteady_loads import ForcedMotion, UnsteadyLoads, forced_loads
from equisection.aerodynamics.wake_lags import accurate_lags

Floats = NDArray[np.float64]

#: Difference above which loads are unlike each other (-): that of a factor of 2.6.
LARGEST_DIFFERENCE = 1.0
#: Part of the difference that a change may leave, to be what is wrong (-).
_LEFT = 0.1
#: Changes that leave up to so many times as much as the best one are named with it (-).
_AS_GOOD = 1.5
#: Factor from which a load is of another size than its section could have (-).
_FACTOR = 5.0


@dataclass(frozen=True)
class MovedLoads:
    """Loads over time, each of shape (n,): c_l, and c_m about the moving mid-chord."""

    lift: Floats
    moment: Floats

    @property
    def varying(self) -> MovedLoads:
        """The loads less their means."""
        return MovedLoads(self.lift - self.lift.mean(), self.moment - self.moment.mean())

    def difference(self, other: MovedLoads) -> float:
        """Return the difference of loads without means from others (-).

        The larger of those of lift and moment: the mean square of the difference over the product
        of their root mean squares. It is 0 of loads that agree, 4 of those of the other sign.
        """
        return max(_difference(self.lift, other.lift), _difference(self.moment, other.moment))


def expected_loads(motion: ForcedMotion, polar: Polar) -> MovedLoads | None:
    """Return the loads of a polar in a motion, with Theodorsen's lags and without separation's.

    None where the motion leaves the polar.

    Parameters
    ----------
    motion
        The motion, of mid-chord.
    polar
        Steady loads of the section.
    """
    loads = UnsteadyLoads.from_polar(polar, SeparationLags.none())
    found = forced_loads(motion, loads, accurate_lags())
    if not polar.covers(found.effective_incidence):
        return None
    return MovedLoads(found.lift_coefficient, found.moment_coefficient)


def mistakes(
    recorded: MovedLoads, expected: MovedLoads, component: str, moment_axis: float
) -> tuple[float, str]:
    """Return the difference of recorded loads from expected ones, and what would explain it.

    Parameters
    ----------
    recorded, expected
        Loads at the same times after the motion has set in.
    component
        Motion, ``pitch`` or ``heave``.
    moment_axis
        Point that the recorded moments are said to be about (x/c from the leading edge).

    Returns
    -------
    tuple
        The difference (:meth:`MovedLoads.difference`), and the single changes that remove it, in
        words; empty where the loads are alike, or no single change makes them so.
    """
    loads, wanted = recorded.varying, expected.varying
    before = loads.difference(wanted)
    if before <= LARGEST_DIFFERENCE:
        return before, ""
    moved = "twist" if component == "pitch" else "deflection"
    tried = [
        (changed.difference(wanted), words)
        for changed, words in _changes(loads, wanted, moved, moment_axis)
    ]
    best = min((left for left, _ in tried), default=math.inf)
    if best > _LEFT * before:
        return before, ""
    return before, ", or ".join(words for left, words in tried if left <= _AS_GOOD * best)


def _difference(one: Floats, other: Floats) -> float:
    sizes = math.sqrt(float(np.mean(one**2)) * float(np.mean(other**2)))
    return float(np.mean((one - other) ** 2)) / max(sizes, float(np.finfo(float).tiny))


def _changes(
    loads: MovedLoads, wanted: MovedLoads, moved: str, moment_axis: float
) -> Iterator[tuple[MovedLoads, str]]:
    """Yield loads with one thing changed, and what to write for it."""
    lift, moment = loads.lift, loads.moment
    yield MovedLoads(-lift, -moment), f"signs.{moved}: -1 explains it"
    yield replace(loads, lift=-lift), "signs.lift: -1 explains it"
    yield replace(loads, moment=-moment), "signs.moment: -1 explains it"
    arm = _factor(lift, wanted.moment - moment)
    if 0.0 <= moment_axis - arm <= 1.0:
        yield (
            replace(loads, moment=moment + arm * lift),
            f"moments about x/c = {moment_axis - arm:.2f}, and not about the axis that was said, "
            f"explain it: moment_axis: {moment_axis - arm:.2f}",
        )
    of_lift, of_moment = _factor(lift, wanted.lift), _factor(moment, wanted.moment)
    both = math.sqrt(max(of_lift, 0.0) * max(of_moment, 0.0))
    cause = "units, span, speed, density or chord"
    for factor, changed, what in (
        (both, MovedLoads(both * lift, both * moment), "lift and moment"),
        (of_lift, replace(loads, lift=of_lift * lift), "a lift"),
        (of_moment, replace(loads, moment=of_moment * moment), "a moment"),
    ):
        if factor > 0.0 and not 1.0 / _FACTOR < factor < _FACTOR:
            yield changed, f"{what} some {factor:.2g} times as large: {cause}"


def _factor(values: Floats, wanted: Floats) -> float:
    """Return the factor of values that is nearest to what is wanted, by least squares."""
    return float(values @ wanted) / max(float(values @ values), float(np.finfo(float).tiny))
