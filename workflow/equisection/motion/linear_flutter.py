"""Linear stability of a section on springs: divergence, and flutter by the k and p-k methods.

With q = (w/c, theta) the section obeys M q'' + s K q = Q q, where Q are the loads of a thin plate
(:mod:`equisection.aerodynamics.thin_airfoil`) and s multiplies both stiffnesses: k* goes with s,
and s with one over the square of the speed.

Divergence
    det(s K - Q(0)) = 0. Lift does not turn the section, so s k* = dc_m/dtheta (Bisplinghoff,
    Ashley & Halfman, *Aeroelasticity*, 1955, section 8-2).
k method
    Neutral oscillation at omega is (omega^2 M + Q(omega)) q = s K q with s real. s is complex at
    any other omega; Im s/Re s is the structural damping that would be needed (Theodorsen & Garrick,
    NACA Report 685, 1940; Hodges & Pierce, *Introduction to Structural Dynamics and
    Aeroelasticity*, 2nd ed., 2011, section 5.4).
p-k method
    (p^2 M + s K - Q(Im p)) q = 0, iterated until Q is that of the frequency found (Hassig, Journal
    of Aircraft 8, 1971). Re p is the growth rate (V/c), exact where it is zero. Both motions are
    followed from where the air is no more than a mass on them, in steps of s that are the same
    whatever s is asked for, so that they keep apart.
"""

from __future__ import annotations

import cmath
import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.errors import EquisectionError

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
Pair = tuple[complex, complex]

#: Reduced frequencies k between which neutral oscillations are looked for.
_FREQUENCIES = np.geomspace(1e-3, 10.0, 600)
#: Rounds at most at an s that is asked for, and at one between, where the last will do.
_MOST_ITERATIONS, _MOST_BETWEEN = 500, 50
#: Change of p in a round, of 1 + |p|, at which it is found, and is near enough to be gone on from.
_CONVERGED, _NEAR = 1e-10, 1e-4
#: Ratio of two s between which the motions are followed.
_STEP = 1.1
#: Loads but the apparent mass, over the inertia forces, at which they are followed from.
_SMALL_LOADS = 0.1
#: Difference of two p, of 1 + |p|, below which they are one.
_ONE_ROOT = 1e-3
#: A step on which a motion goes further than this part of what separates both is halved.
_CLEAR_PART = 0.3
_MOST_HALVINGS = 6
#: Bounds of the part of its way that an iteration goes.
_LEAST_PART, _LARGEST_PART = 0.25, 1.5


class FlutterIterationError(EquisectionError):
    """The p-k iteration found no frequency that its loads belong to."""


@dataclass(frozen=True)
class TypicalSection:
    """A section on two springs at its pitch axis, in the non-dimensional numbers of Eq. 18.

    Attributes
    ----------
    mass : float
        m* (-).
    inertia : float
        I* about the pitch axis (-).
    flexural_stiffness : float
        k_w* (-).
    torsional_stiffness : float
        k_theta/(q c^2) (-).
    axis : float
        Chords from mid-chord back to the pitch axis.
    centre : float
        Chords from mid-chord back to the centre of mass.
    """

    mass: float
    inertia: float
    flexural_stiffness: float
    torsional_stiffness: float
    axis: float = 0.0
    centre: float = 0.0

    @cached_property
    def air(self) -> ThinAirfoil:
        """The loads."""
        return ThinAirfoil(self.axis)

    @cached_property
    def mass_matrix(self) -> Floats:
        """M; a point x behind the axis moves by w - x theta."""
        static_moment = -self.mass * (self.centre - self.axis)
        return np.array([[self.mass, static_moment], [static_moment, self.inertia]])

    @cached_property
    def inverse_mass(self) -> Floats:
        """Inverse of M."""
        return np.asarray(np.linalg.inv(self.mass_matrix), dtype=np.float64)

    @cached_property
    def stiffness_matrix(self) -> Floats:
        """K at s = 1."""
        return np.diag([self.flexural_stiffness, self.torsional_stiffness])


@dataclass(frozen=True)
class Neutral:
    """An oscillation that neither grows nor decays.

    Attributes
    ----------
    scale : float
        s, by which the stiffnesses are multiplied (-).
    omega : float
        omega c/V (-).
    """

    scale: float
    omega: float


def divergence_scale(section: TypicalSection, moment_slope: float | None = None) -> float:
    """Return s at static divergence; 0 where the moment does not grow with the twist.

    Parameters
    ----------
    section
        The section.
    moment_slope
        dc_m/dtheta about the pitch axis (1/rad) in the place of the thin plate's.
    """
    slope = section.air.moment_slope if moment_slope is None else moment_slope
    return 0.0 if slope <= 0.0 else slope / section.torsional_stiffness


def flutter(section: TypicalSection) -> Neutral | None:
    """Return the neutral oscillation of the largest s, the first met from low speed (k method).

    None if there is none at reduced frequencies k from 0.001 to 10.
    """
    found = [
        neutral
        for branch in range(2)
        for low, high in itertools.pairwise(_FREQUENCIES)
        if (neutral := _neutral_between(section, branch, 2.0 * low, 2.0 * high)) is not None
    ]
    return max(found, key=lambda neutral: neutral.scale, default=None)


def _neutral_between(
    section: TypicalSection, branch: int, low: float, high: float
) -> Neutral | None:
    """Return the oscillation between two frequencies at which s of a branch is real."""
    start = _scales(section, low)[branch]

    def followed(omega: float) -> complex:
        values = _scales(section, omega)
        return complex(values[np.argmin(np.abs(values - start))])

    if followed(low).imag * followed(high).imag >= 0.0:
        return None
    omega = float(brentq(lambda value: followed(value).imag, low, high, xtol=1e-13))
    scale = followed(omega)
    is_root = abs(scale.imag) < 1e-6 * abs(scale) and scale.real > 0.0
    return Neutral(scale.real, omega) if is_root else None


def _scales(section: TypicalSection, omega: float) -> Complexes:
    """Return both s of the k method at a frequency, by ascending absolute value."""
    matrix = omega**2 * section.mass_matrix + section.air.influence(omega)
    values = np.linalg.eigvals(np.linalg.solve(section.stiffness_matrix, matrix))
    return np.asarray(values[np.argsort(np.abs(values))], dtype=np.complex128)


def growth_and_frequency(section: TypicalSection, scales: Floats) -> Complexes:
    """Return p of both motions at each s by the p-k method, shape (n, 2).

    Re p is the growth rate (V/c), Im p = omega c/V >= 0. The first column is the motion that is
    heave in vacuum, the second the one that is pitch. What is found at one s does not depend on
    the others that are asked for.

    Parameters
    ----------
    section
        The section.
    scales
        s > 0, shape (n,), in any order.

    Raises
    ------
    FlutterIterationError
        The iteration did not converge.
    """
    found = np.empty((len(scales), 2), dtype=np.complex128)
    start, roots_there = _start(section)
    descending = [int(place) for place in np.argsort(scales)[::-1]]
    below = [place for place in descending if scales[place] <= start]
    above = [place for place in reversed(descending) if scales[place] > start]
    for places, step in ((below, 1.0 / _STEP), (above, _STEP)):
        scale, roots = start, roots_there
        for place in places:
            wanted = float(scales[place])
            while (scale * step - wanted) * (step - 1.0) < 0.0:
                roots = _followed(section, scale, scale * step, roots)
                scale *= step
            found[place] = _both(section, wanted, _followed(section, scale, wanted, roots), True)
    return found


def _start(section: TypicalSection) -> tuple[float, Pair]:
    """Return an s at which the air is no more than a mass on the section, and both p there."""
    mass = section.mass_matrix + section.air.apparent_mass
    squares = np.linalg.eigvals(np.linalg.solve(mass, section.stiffness_matrix)).real
    apart = np.diag(section.stiffness_matrix) / np.diag(mass)  # omega^2 of one alone
    slow, fast = np.sqrt(np.sort(squares))
    inertia = np.sqrt(np.outer(np.diag(mass), np.diag(mass)))
    scale = 1.0
    while True:
        omega = slow * math.sqrt(scale)
        loads = section.air.influence(omega) / omega**2 - section.air.apparent_mass
        if np.max(np.abs(loads) / inertia) <= _SMALL_LOADS:
            break
        scale *= 2.0
    heave, pitch = (slow, fast) if apart[0] <= apart[1] else (fast, slow)
    guesses = (1j * heave * math.sqrt(scale), 1j * pitch * math.sqrt(scale))
    return scale, _both(section, scale, guesses)


def _followed(
    section: TypicalSection, start: float, end: float, roots: Pair, halved: int = 0
) -> Pair:
    """Return both p at an s from those at one near it."""
    if start == end:
        return roots
    stiffer = math.sqrt(end / start)
    guesses = (roots[0] * stiffer, roots[1] * stiffer)
    found = _both(section, end, guesses)
    gone = max(abs(found[0] - guesses[0]), abs(found[1] - guesses[1]))
    if gone <= _CLEAR_PART * abs(found[0] - found[1]) or halved == _MOST_HALVINGS:
        return found
    middle = math.sqrt(start * end)
    roots = _followed(section, start, middle, roots, halved + 1)
    return _followed(section, middle, end, roots, halved + 1)


def _both(section: TypicalSection, scale: float, guesses: Pair, is_wanted: bool = False) -> Pair:
    """Return both p, each nearest to its guess but for what the other is."""

    def nearest(p: complex) -> complex:
        return min(_roots(section, scale, p), key=lambda root: abs(root - p))

    one = _root(scale, guesses[0], nearest, is_wanted)
    other = _root(scale, guesses[1], nearest, is_wanted)
    if abs(one - other) > _ONE_ROOT * (1.0 + abs(one)):
        return one, other
    # Both guesses lead to one motion: the other one is the other root of its own loads.

    def not_it(p: complex) -> complex:
        return max(_roots(section, scale, p), key=lambda root: abs(root - one))

    if abs(one - guesses[0]) <= abs(one - guesses[1]):
        return one, _root(scale, guesses[1], not_it, is_wanted)
    return _root(scale, guesses[0], not_it, is_wanted), one


def _root(
    scale: float, guess: complex, chosen: Callable[[complex], complex], is_wanted: bool
) -> complex:
    """Return the p from a guess on that is chosen of those with the loads of its own frequency.

    Each round goes a part of the way to the p that its loads give: half of it at first, then what
    meets the frequency if the rounds before go on in a straight line (a secant).
    """
    p, part, before = guess, 0.5, math.nan
    within = _CONVERGED if is_wanted else _NEAR
    for _ in range(_MOST_ITERATIONS if is_wanted else _MOST_BETWEEN):
        found = chosen(p)
        if abs(found - p) < within * (1.0 + abs(p)):
            return found
        missed = found.imag - p.imag
        if abs(missed - before) > 0.0:  # not in the first round
            part = min(max(part * before / (before - missed), _LEAST_PART), _LARGEST_PART)
        p, before = p + part * (found - p), missed
    if not is_wanted:
        return p
    raise FlutterIterationError(
        f"the p-k iteration at {scale:.4g} times the stiffness did not settle within "
        f"{_MOST_ITERATIONS} rounds (last p = {p:.4g}); ask for no k* below divergence"
    )


def _roots(section: TypicalSection, scale: float, p: complex) -> Pair:
    """Return both p under the loads of the frequency of one."""
    loads = section.air.influence(max(p.imag, 0.0)) - scale * section.stiffness_matrix
    ((a, b), (c, d)) = (section.inverse_mass @ loads).tolist()
    middle, half = 0.5 * (a + d), cmath.sqrt(0.25 * (a - d) ** 2 + b * c)
    one, other = cmath.sqrt(middle - half), cmath.sqrt(middle + half)
    return (-one if one.imag < 0.0 else one), (-other if other.imag < 0.0 else other)
