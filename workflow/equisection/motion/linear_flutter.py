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
    of Aircraft 8, 1971). Re p is the growth rate (V/c), exact where it is zero.
"""

from __future__ import annotations

import itertools
import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.errors import EquisectionError

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

#: Reduced frequencies k between which neutral oscillations are looked for.
_FREQUENCIES = np.geomspace(1e-3, 10.0, 600)
_MOST_ITERATIONS = 500
_CONVERGED = 1e-10
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
    heave in vacuum, the second the one that is pitch, followed from the largest s down.

    Parameters
    ----------
    section
        The section.
    scales
        s, shape (n,), in any order.

    Raises
    ------
    FlutterIterationError
        The iteration did not converge.
    """
    order = np.argsort(scales)[::-1]
    found = np.empty((len(scales), 2), dtype=np.complex128)
    stiffness, mass = section.stiffness_matrix, section.mass_matrix
    vacuum = np.sqrt(np.diag(stiffness) / np.diag(mass))
    last = 1j * vacuum * math.sqrt(float(scales[order[0]]))
    for place in order:
        last = np.array([_root(section, float(scales[place]), guess) for guess in last])
        found[place] = last
    return found


def _root(section: TypicalSection, scale: float, guess: complex) -> complex:
    """Return the p nearest to a guess whose loads are those of its own frequency.

    Each round goes a part of the way to the p that its loads give: half of it at first, then what
    meets the frequency if the rounds before go on in a straight line (a secant).
    """
    p, part, before = guess, 0.5, math.nan
    for _ in range(_MOST_ITERATIONS):
        nearest = _nearest_root(section, scale, p)
        if abs(nearest - p) < _CONVERGED * (1.0 + abs(p)):
            return nearest
        missed = nearest.imag - p.imag
        if abs(missed - before) > 0.0:  # not in the first round
            part = min(max(part * before / (before - missed), _LEAST_PART), _LARGEST_PART)
        p, before = p + part * (nearest - p), missed
    raise FlutterIterationError(
        f"the p-k iteration at {scale:.4g} times the stiffness did not settle within "
        f"{_MOST_ITERATIONS} rounds (last p = {p:.4g}); ask for fewer k* below divergence"
    )


def _nearest_root(section: TypicalSection, scale: float, p: complex) -> complex:
    """Return the root nearest to p under the loads of its frequency."""
    loads = section.air.influence(max(p.imag, 0.0)) - scale * section.stiffness_matrix
    squares = np.linalg.eigvals(np.linalg.solve(section.mass_matrix, loads))
    roots = np.sqrt(squares.astype(np.complex128))
    roots = np.where(roots.imag < 0.0, -roots, roots)
    return complex(roots[np.argmin(np.abs(roots - p))])
