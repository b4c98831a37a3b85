"""Linear stability of a section on springs: divergence, and flutter by the k and p-k methods.

With q = (w/c, theta) the section obeys M q'' + sqrt(s) C q' + s K q = Q q, where Q are the loads of
a thin plate about the elastic axis (:mod:`equisection.aerodynamics.thin_airfoil`), M, C and K those
of :class:`equisection.beam.section.Section`, and s multiplies both stiffnesses: k* goes with s, and
s with one over the square of the speed, at which dampers weigh sqrt(s).

Divergence
    det(s K - Q(0)) = 0. Lift does not turn the section, so s k* = dc_m/dtheta (Bisplinghoff,
    Ashley & Halfman, *Aeroelasticity*, 1955, section 8-2).
k method
    Neutral oscillation at omega is (omega^2 M + Q(omega)) q = s K q with s real. s is complex at
    any other omega; Im s/Re s is the structural damping that would be needed (Theodorsen & Garrick,
    NACA Report 685, 1940; Hodges & Pierce, *Introduction to Structural Dynamics and
    Aeroelasticity*, 2nd ed., 2011, section 5.4). With dampers it is a quadratic in sqrt(s).
p-k method
    (p^2 M + p sqrt(s) C + s K - Q(Im p)) q = 0, iterated until Q is that of the frequency found
    (Hassig, Journal of Aircraft 8, 1971). Re p is the growth rate (V/c), exact where it is zero.
    Both motions are followed from an s at which the air acts as a mass alone. The steps of s do not
    depend on the s that are asked for, so that the motions are not confused.
"""

from __future__ import annotations

import cmath
import contextlib
import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.beam.section import Section
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
#: Times that the loads are looked up, at most, for the start and for each s that is asked for; a
#: plate at 1e-18 of its stiffness takes 5,000. What is beyond reach is NaN.
_MOST_LOOKS, _MOST_LOOKS_OF_ONE = 20_000, 1_000
#: Least and largest s to which the motions are followed: beyond, their squares are no numbers.
_SOFTEST, _STIFFEST = 1e-100, 1e100
#: Difference of two p, of 1 + |p|, below which they are one.
_ONE_ROOT = 1e-3
#: A step on which a motion goes further than this part of what separates both is halved.
_CLEAR_PART = 0.3
_MOST_HALVINGS = 6
#: Im p that is round-off.
_STILL = 1e-12
#: Name of the theory in messages, and the members beyond mass and springs that it has.
_THEORY = "linear theory"
_OF_THEORY = ("static_imbalance", "flexural_damping", "torsional_damping", "elastic_axis")
#: Bounds of the part of its way that an iteration goes.
_LEAST_PART, _LARGEST_PART = 0.25, 1.5


class FlutterIterationError(EquisectionError):
    """The p-k iteration found no frequency that its loads belong to."""


class _OutOfReachError(ArithmeticError):
    """The motions cannot be followed as far as an s that is asked for."""


@dataclass(frozen=True)
class FlutterEquations:
    """Equations M q'' + sqrt(s) C q' + s K q = Q q of n motions in a flow, ' = d/ds (-).

    Attributes
    ----------
    mass, damping, stiffness
        M, C, K, shape (n, n).
    influence
        Q at a frequency omega c/V, shape (n, n).
    """

    mass: Floats
    damping: Floats
    stiffness: Floats
    influence: Callable[[float], Complexes]

    @cached_property
    def is_damped(self) -> bool:
        """Presence of dampers."""
        return bool(self.damping.any())


class _Flow:
    """A section in its flow: the matrices and the loads, made once, and looked up so often."""

    def __init__(self, section: Section, most_looks: int = _MOST_LOOKS) -> None:
        self._looks_left = most_looks
        section.require_in_flow()
        section.require_defaults(_THEORY, but=_OF_THEORY)
        self.mass = section.mass_matrix
        self.inverse_mass = np.asarray(np.linalg.inv(self.mass), dtype=np.float64)
        self.damping = section.damping_matrix
        self.is_damped = bool(self.damping.any())
        self.stiffness = section.stiffness_matrix
        self.air = ThinAirfoil(section.axis_behind_mid_chord)

    def loads(self, omega: float) -> Complexes:
        """Return Q at a frequency omega c/V, shape (2, 2).

        Raises
        ------
        _OutOfReachError
            It is no number, or has been looked up too often.
        """
        self._looks_left -= 1
        found = self.air.influence(omega)
        if self._looks_left < 0 or not np.isfinite(found).all():
            raise _OutOfReachError
        return found


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


def divergence_scale(section: Section, moment_slope: float | None = None) -> float:
    """Return s at static divergence; 0 where the moment does not grow with the twist.

    Parameters
    ----------
    section
        The section in its flow.
    moment_slope
        dc_m/dtheta about the elastic axis (1/rad) in the place of the thin plate's.

    Raises
    ------
    EquisectionError
        The section is in SI units, or has a quantity that the theory lacks.
    """
    section.require_in_flow()
    section.require_defaults(_THEORY, but=_OF_THEORY)
    plate = ThinAirfoil(section.axis_behind_mid_chord)
    slope = plate.moment_slope if moment_slope is None else moment_slope
    return 0.0 if slope <= 0.0 else slope / section.torsional_stiffness


def flutter(section: Section) -> Neutral | None:
    """Return the neutral oscillation of the largest s, the first met from low speed (k method).

    None if there is none at reduced frequencies k from 0.001 to 10.

    Parameters
    ----------
    section
        The section in its flow.

    Raises
    ------
    EquisectionError
        The section is in SI units.
    """
    flow = _Flow(section)
    equations = FlutterEquations(flow.mass, flow.damping, flow.stiffness, flow.air.influence)
    return neutral_oscillation(equations)


def neutral_oscillation(equations: FlutterEquations) -> Neutral | None:
    """Return the neutral oscillation of the largest s of any number of motions (k method).

    None if there is none at reduced frequencies k from 0.001 to 10.
    """
    found = neutral_oscillations(equations, 2.0 * _FREQUENCIES)
    return max(found, key=lambda each: each.scale, default=None)


def neutral_oscillations(equations: FlutterEquations, frequencies: Floats) -> list[Neutral]:
    """Return the neutral oscillations of any number of motions (k method).

    Parameters
    ----------
    equations
        The motions.
    frequencies
        Ascending omega c/V between which they are looked for.
    """
    scales = [_scales(equations, float(omega)) for omega in frequencies]
    found = []
    for place, (low, high) in enumerate(itertools.pairwise(frequencies)):
        for start in scales[place]:
            end = _nearest(scales[place + 1], start)
            if start.imag * end.imag < 0.0:
                found.append(_neutral_between(equations, start, float(low), float(high)))
    return [each for each in found if each is not None]


def _nearest(values: Complexes, wanted: complex) -> complex:
    return complex(values[np.argmin(np.abs(values - wanted))])


def _neutral_between(
    equations: FlutterEquations, start: complex, low: float, high: float
) -> Neutral | None:
    """Return the oscillation between two frequencies at which s, from a start on, is real."""

    def followed(omega: float) -> complex:
        return _nearest(_scales(equations, omega), start)

    omega = float(scipy.optimize.brentq(lambda value: followed(value).imag, low, high, xtol=1e-13))
    scale = followed(omega)
    is_root = abs(scale.imag) < 1e-6 * abs(scale) and scale.real > 0.0
    return Neutral(scale.real, omega) if is_root else None


def _scales(flow: FlutterEquations, omega: float) -> Complexes:
    """Return the s of the k method at a frequency, by ascending absolute value."""
    matrix = omega**2 * flow.mass + flow.influence(omega)
    by_place = np.asarray(np.linalg.solve(flow.stiffness, matrix), dtype=np.complex128)
    if not np.isfinite(by_place).all():  # so soft or heavy that no s is a number
        return np.full(len(by_place), complex(math.nan, math.nan))
    if flow.is_damped:
        by_rate = -1j * omega * np.linalg.inv(flow.stiffness) @ flow.damping
        values = _of_positive_real_part(_quadratic_roots(by_rate, by_place)) ** 2
    else:
        values = np.asarray(np.linalg.eigvals(by_place), dtype=np.complex128)
    return values[np.argsort(np.abs(values))]


def _quadratic_roots(by_rate: Floats | Complexes, by_place: Floats | Complexes) -> Complexes:
    """Return the 2 n values x of det(x^2 - x ``by_rate`` - ``by_place``) = 0."""
    size = len(by_place)
    above = np.concatenate([np.zeros((size, size)), np.eye(size)], axis=1)
    return np.asarray(
        np.linalg.eigvals(np.concatenate([above, np.concatenate([by_place, by_rate], axis=1)])),
        dtype=np.complex128,
    )


def _of_positive_real_part(roots: Complexes) -> Complexes:
    """Return the half of all sqrt(s) that are speeds; without dampers the others are negatives."""
    return roots[np.argsort(roots.real)[roots.size // 2 :]]


def growth_and_frequency(section: Section, scales: Floats) -> Complexes:
    """Return p of both motions at each s by the p-k method, shape (n, 2).

    Re p is the growth rate (V/c), Im p = omega c/V >= 0. The first column is the motion that is
    heave in vacuum, the second the one that is pitch. The result at one s does not depend on the
    others that are asked for. NaN at an s so far off that the motions cannot be followed to it.

    Parameters
    ----------
    section
        The section in its flow.
    scales
        s > 0, shape (n,), in any order.

    Raises
    ------
    EquisectionError
        The section is in SI units.
    FlutterIterationError
        The iteration did not converge.
    """
    flow = _Flow(section, _MOST_LOOKS + _MOST_LOOKS_OF_ONE * len(scales))
    found = np.full((len(scales), 2), complex(math.nan, math.nan))
    with contextlib.suppress(_OutOfReachError, OverflowError):
        _follow(flow, scales, found)
    return found


def _follow(flow: _Flow, scales: Floats, found: Complexes) -> None:
    """Write p of both motions at each s into an array: the stiff ones first, then ever softer."""
    start, roots_there = _start(flow)
    within = (scales > _SOFTEST) & (scales < _STIFFEST)
    descending = [int(place) for place in np.argsort(scales)[::-1] if within[place]]
    below = [place for place in descending if scales[place] <= start]
    above = [place for place in reversed(descending) if scales[place] > start]
    for places, step in ((above, _STEP), (below, 1.0 / _STEP)):
        scale, roots = start, roots_there
        for place in places:
            wanted = float(scales[place])
            while (scale * step - wanted) * (step - 1.0) < 0.0:
                roots = _followed(flow, scale, scale * step, roots)
                scale *= step
            found[place] = _both(flow, wanted, _followed(flow, scale, wanted, roots), True)


def _start(flow: _Flow) -> tuple[float, Pair]:
    """Return an s at which the air is no more than a mass on the section, and both p there."""
    mass = flow.mass + flow.air.apparent_mass
    squares = np.linalg.eigvals(np.linalg.solve(mass, flow.stiffness)).real
    apart = np.diag(flow.stiffness) / np.diag(mass)  # omega^2 of one alone
    slow, fast = np.sqrt(np.sort(squares))
    inertia = np.sqrt(np.outer(np.diag(mass), np.diag(mass)))
    scale = 1.0
    while True:
        omega = float(slow) * math.sqrt(scale)
        if not (omega > 0.0 and scale < _STIFFEST):
            raise _OutOfReachError
        loads = flow.loads(omega) / omega**2 - flow.air.apparent_mass
        if np.max(np.abs(loads) / inertia) <= _SMALL_LOADS:
            break
        scale *= 2.0
    heave, pitch = (slow, fast) if apart[0] <= apart[1] else (fast, slow)
    guesses = (1j * heave * math.sqrt(scale), 1j * pitch * math.sqrt(scale))
    return scale, _both(flow, scale, guesses)


def _followed(flow: _Flow, start: float, end: float, roots: Pair, halved: int = 0) -> Pair:
    """Return both p at an s from those at one near it."""
    if start == end:
        return roots
    stiffer = math.sqrt(end / start)
    guesses = (roots[0] * stiffer, roots[1] * stiffer)
    found = _both(flow, end, guesses)
    gone = max(abs(found[0] - guesses[0]), abs(found[1] - guesses[1]))
    if gone <= _CLEAR_PART * abs(found[0] - found[1]) or halved == _MOST_HALVINGS:
        return found
    middle = math.sqrt(start * end)
    roots = _followed(flow, start, middle, roots, halved + 1)
    return _followed(flow, middle, end, roots, halved + 1)


def _both(flow: _Flow, scale: float, guesses: Pair, is_wanted: bool = False) -> Pair:
    """Return both p, each nearest to its guess but for what the other is."""

    def nearest(p: complex) -> complex:
        return min(_roots(flow, scale, p), key=lambda root: abs(root - p))

    one = _root(scale, guesses[0], nearest, is_wanted)
    other = _root(scale, guesses[1], nearest, is_wanted)
    if abs(one - other) > _ONE_ROOT * (1.0 + abs(one)):
        return one, other
    # Both guesses lead to one motion: the other one is the other root of its own loads.

    def not_it(p: complex) -> complex:
        return max(_roots(flow, scale, p), key=lambda root: abs(root - one))

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


def _roots(flow: _Flow, scale: float, p: complex) -> Pair:
    """Return both p under the loads of the frequency of one."""
    loads = flow.loads(max(p.imag, 0.0)) - scale * flow.stiffness
    if flow.is_damped:
        by_rate = -math.sqrt(scale) * flow.inverse_mass @ flow.damping
        return _oscillating(_quadratic_roots(by_rate, flow.inverse_mass @ loads))
    ((a, b), (c, d)) = (flow.inverse_mass @ loads).tolist()
    middle, half = 0.5 * (a + d), cmath.sqrt(0.25 * (a - d) ** 2 + b * c)
    one, other = cmath.sqrt(middle - half), cmath.sqrt(middle + half)
    return (-one if one.imag < 0.0 else one), (-other if other.imag < 0.0 else other)


def _oscillating(roots: Complexes) -> Pair:
    """Return the two of four p that turn forwards; of those that do not turn, what grows."""
    order = np.lexsort((roots.real, np.where(np.abs(roots.imag) < _STILL, 0.0, roots.imag)))
    one, other = (complex(root) for root in roots[order[2:]])
    return one, other
