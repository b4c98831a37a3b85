r"""Exact growth and frequency of a section or beam in attached flow: p-plane, no p-k.

A motion q exp(p s) that grows or decays obeys

    (p^2 M + p sqrt(s) C + s K - Q(p)) q = 0

with Theodorsen's loads for arbitrary motion, C(p/2) in the place of C(k) (Edwards, Ashley &
Breakwell, *Unsteady aerodynamic modeling for arbitrary motions*, AIAA Journal 17, 1979). p-k takes
the loads of the frequency alone (:mod:`equisection.motion.linear_flutter`), and so is exact at
flutter alone. Each root is found by Newton's method on p and q together and followed over the
stiffness from an s at which the air is a mass and no more.

C(p/2) is cut along the negative real axis. A motion that decays until it no longer turns ends
there: beyond, the decay is no exponential, and the root is NaN. So it is for one that grows until
it no longer turns. Growth without turning is a positive real root (:func:`divergence_rate`), the
first of which comes out of the cut at p = 0 at static divergence.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.beam.section import Section
from equisection.motion.linear_flutter import divergence_scale

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
_Loads = Callable[[complex], Complexes]

_LOST = complex(math.nan, math.nan)
_MOST_STEPS = 30
#: Change of p, of 1 + |p|, at which Newton's method has arrived.
_ARRIVED = 1e-13
#: Ratio of two s between which the roots are followed, and halvings of a step (of log s) at most.
_RATIO, _MOST_HALVINGS = 1.2, 14
#: A step that changes a root by more than this part of its distance to the other is halved.
_CLEAR_PART = 0.2
#: Lowest frequency (V/c) of a section so stiff that the air is a mass and little more.
_STIFF = 50.0
#: Least and largest s that the roots are followed to: beyond, their squares are no numbers.
_SOFTEST, _STIFFEST = 1e-100, 1e100
#: p (V/c) between which diverging roots are looked for, fast ones first.
_DIVERGING = np.geomspace(1e3, 1e-9, 1200)


@dataclass(frozen=True)
class GrowingMotion:
    """Equations of n motions that grow or decay: matrices and loads.

    Attributes
    ----------
    mass, damping, stiffness
        M, C, K, shape (n, n), in units of rho/2, V and c.
    influence, influence_slope
        Q and dQ/dp at a p (V/c), shape (n, n).
    """

    mass: Floats
    damping: Floats
    stiffness: Floats
    influence: _Loads
    influence_slope: _Loads

    @classmethod
    def of_section(cls, section: Section) -> GrowingMotion:
        """Equations of a section in a flow.

        Raises
        ------
        EquisectionError
            The section is in SI units.
        """
        section.require_in_flow()
        air = ThinAirfoil(section.axis_behind_mid_chord)
        return cls(
            section.mass_matrix,
            section.damping_matrix,
            section.stiffness_matrix,
            air.influence_of_growing,
            air.influence_slope,
        )

    def matrix(self, p: complex, scale: float) -> Complexes:
        """Return p^2 M + p sqrt(s) C + s K - Q(p), shape (n, n)."""
        static = scale * self.stiffness - self.influence(p)
        return np.asarray(p * p * self.mass + p * math.sqrt(scale) * self.damping + static)

    def slope(self, p: complex, scale: float) -> Complexes:
        """Return the derivative of :meth:`matrix` by p, shape (n, n)."""
        by_rate = math.sqrt(scale) * self.damping - self.influence_slope(p)
        return np.asarray(2.0 * p * self.mass + by_rate)

    def root(self, scale: float, guess: complex) -> complex:
        """Return the root p near a guess by Newton's method; NaN where it ends elsewhere.

        The root turns: Im p > 0.

        Parameters
        ----------
        scale
            s, by which the stiffnesses are multiplied (-).
        guess
            p near which the root is looked for (V/c).
        """
        size = len(self.mass)
        p = complex(guess)
        there = self.matrix(p, scale)
        if not np.isfinite(there).all():
            return _LOST
        motion = np.conj(np.linalg.svd(there)[2][-1])
        kept = motion.conj()
        for _ in range(_MOST_STEPS):
            left, slope = self.matrix(p, scale), self.slope(p, scale)
            system = np.zeros((size + 1, size + 1), dtype=np.complex128)
            system[:size, :size], system[:size, size] = left, slope @ motion
            system[size, :size] = kept
            missed = np.append(left @ motion, kept @ motion - 1.0)
            try:
                step = np.linalg.solve(system, -missed)
            except np.linalg.LinAlgError:
                return _LOST
            motion, p = motion + step[:size], p + complex(step[size])
            if not (math.isfinite(p.real) and p.imag > 0.0):
                return _LOST
            if abs(step[size]) < _ARRIVED * (1.0 + abs(p)):
                return p
        return _LOST

    def followed(self, start: float, roots: Sequence[complex], scales: Floats) -> Complexes:
        """Return the roots at each s, followed from those at a start, shape (n, m).

        Parameters
        ----------
        start
            s at which the roots are known (-).
        roots
            The m roots p there (V/c).
        scales
            s > 0, shape (n,), in any order; NaN comes back where it is beyond 1e-100 or 1e100.
        """
        found = np.full((len(scales), len(roots)), _LOST)
        within = (scales > _SOFTEST) & (scales < _STIFFEST)
        descending = [int(place) for place in np.argsort(scales)[::-1] if within[place]]
        below = [place for place in descending if scales[place] <= start]
        above = [place for place in reversed(descending) if scales[place] > start]
        for places in (below, above):
            here, at = start, np.array(roots, dtype=np.complex128)
            for place in places:
                wanted = float(scales[place])
                count = max(1, math.ceil(abs(math.log(wanted / here)) / math.log(_RATIO)))
                for scale in np.geomspace(here, wanted, count + 1)[1:]:
                    at = self._stepped(here, float(scale), at)
                    here = float(scale)
                found[place] = at
        return found

    def _stepped(self, start: float, end: float, roots: Complexes, halved: int = 0) -> Complexes:
        """Return the roots at an s from those at one near it; NaN for one that is lost."""
        if start == end:
            return roots
        guesses = roots * math.sqrt(end / start)
        found = np.array(
            [_LOST if np.isnan(guess) else self.root(end, complex(guess)) for guess in guesses]
        )
        gone = np.abs(found - guesses)
        between = np.abs(guesses[:, None] - guesses)
        np.fill_diagonal(between, np.abs(guesses))  # and as far as no motion at all
        apart = np.nanmin(np.where(np.isnan(between), np.inf, between), axis=1)
        is_clear = (gone <= _CLEAR_PART * apart) | np.isnan(roots)
        if is_clear.all():
            return found
        if halved == _MOST_HALVINGS:
            return np.where(is_clear, found, _LOST)
        middle = math.sqrt(start * end)
        there = self._stepped(start, middle, roots, halved + 1)
        return self._stepped(middle, end, there, halved + 1)


def exact_growth_and_frequency(section: Section, scales: Floats) -> Complexes:
    """Return p of both motions at each s, exact, shape (n, 2).

    Re p is the growth rate (V/c), Im p = omega c/V > 0; the first column is the motion that is
    heave in vacuum, the second the one that is pitch, as of
    :func:`equisection.motion.linear_flutter.growth_and_frequency`. NaN where a motion has ceased
    to turn.

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
    """
    section.require_in_flow()
    mass = section.mass_matrix + ThinAirfoil(section.axis_behind_mid_chord).apparent_mass
    squares = np.linalg.eigvals(np.linalg.solve(mass, section.stiffness_matrix)).real
    slow, fast = np.sqrt(np.sort(squares))
    heave, pitch = np.diag(section.stiffness_matrix) / np.diag(mass)
    still = np.array([slow, fast] if heave <= pitch else [fast, slow])
    return growth_and_frequency_of(GrowingMotion.of_section(section), still, scales)


def growth_and_frequency_of(
    equations: GrowingMotion, in_still_air: Floats, scales: Floats
) -> Complexes:
    """Return p of motions at each s, exact, shape (n, m), in the order of those in still air.

    Parameters
    ----------
    equations
        The motions.
    in_still_air
        Their frequencies (V/c) with the air's apparent mass, at s = 1, shape (m,).
    scales
        s > 0, shape (n,), in any order.
    """
    slowest = np.min(in_still_air)
    if not _SOFTEST < slowest < math.sqrt(_STIFFEST):
        return np.full((len(scales), len(in_still_air)), _LOST)
    start = float((_STIFF / slowest) ** 2)
    roots = [equations.root(start, 1j * omega * math.sqrt(start)) for omega in in_still_air]
    return equations.followed(start, roots, np.asarray(scales, dtype=np.float64))


def divergence_rate(section: Section, scale: float) -> float:
    """Return the growth rate (V/c) of static divergence; 0 at or above the s of divergence.

    The largest positive real root p of det(p^2 M + p sqrt(s) C + s K - Q(p)).

    Parameters
    ----------
    section
        The section in its flow.
    scale
        s, by which the stiffnesses are multiplied (-).

    Raises
    ------
    EquisectionError
        The section is in SI units.
    """
    if scale >= divergence_scale(section):
        return 0.0
    equations = GrowingMotion.of_section(section)

    def determinant(p: float) -> float:
        return float(np.linalg.det(equations.matrix(complex(p), scale)).real)

    values = [determinant(p) for p in _DIVERGING]
    (places,) = np.nonzero(np.diff(np.sign(values)))
    if not places.size:
        return 0.0  # slower than any that is looked for
    fast, slow = _DIVERGING[places[0]], _DIVERGING[places[0] + 1]
    return float(scipy.optimize.brentq(determinant, slow, fast, xtol=1e-15))
