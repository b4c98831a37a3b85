"""Exact modes of a uniform beam: Euler-Bernoulli bending and Saint-Venant torsion.

Bending, with beta^4 = omega^2 rho_s c h L^4/(E I) and kappa = k_b L/(E I) (Blevins, Formulas for
Natural Frequency and Mode Shape, table 8-1), the equations divided by cosh(beta):

    clamped-free       cos + sech = 0            clamped-clamped   cos - sech = 0
    pinned-pinned      sin = 0                   clamped-pinned    sin - cos tanh = 0
    spring root, free  kappa (cos + sech) - beta (sin - cos tanh) = 0

Torsion, with gamma^2 = omega^2 rho_s c^2 L^2 h/(12 J/c) / G and kappa = k_t L/(G J):

    fixed-free  gamma = (n - 1/2) pi,  f = sin(gamma s);    fixed-fixed  gamma = n pi
    spring root, free  gamma tan(gamma) = kappa,  f = cos(gamma (1 - s))
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.beam.beam import Beam

Floats = NDArray[np.float64]

# Derivatives that vanish at each kind of end; "spring" takes its slope condition apart.
_VANISHING = {"clamped": (0, 1), "pinned": (0, 2), "free": (2, 3)}
# Below this root a sprung beam moves as a rigid body to within beta^4/10 < 1e-6.
_RIGID_BELOW = 0.05


def bending_modes(beam: Beam, span: Floats, count: int) -> tuple[Floats, Floats]:
    """Bending frequencies (Hz, (n,)) and shapes g ((n, m)) at the stations z/L."""
    spring = (beam.root_bending_stiffness or 0.0) * beam.length / beam.bending_rigidity
    roots = bending_roots(beam.bending_ends, spring, count)
    shapes = [_bending_shape(beam.bending_ends, spring, root, span) for root in roots]
    rate = np.sqrt(beam.bending_rigidity / beam.mass_per_length) / beam.length**2
    return roots**2 * rate / (2.0 * np.pi), np.array(shapes)


def torsion_modes(beam: Beam, span: Floats, count: int) -> tuple[Floats, Floats]:
    """Torsion frequencies (Hz, (n,)) and shapes f ((n, m)) at the stations z/L."""
    order = np.arange(count)
    match beam.torsion_ends:
        case ("fixed", "free"):
            roots = (order + 0.5) * np.pi
            shapes = np.sin(roots[:, None] * span)
        case ("fixed", "fixed"):
            roots = (order + 1.0) * np.pi
            shapes = np.sin(roots[:, None] * span)
        case _:
            stiffness = beam.root_torsional_stiffness or 0.0
            roots = _sprung_torsion_roots(stiffness * beam.length / beam.torsional_rigidity, count)
            shapes = np.cos(roots[:, None] * (1.0 - span))
    rate = np.sqrt(beam.torsional_rigidity / beam.inertia_per_length) / beam.length
    return roots * rate / (2.0 * np.pi), shapes


def bending_roots(ends: tuple[str, str], spring: float, count: int) -> Floats:
    """First roots beta (-) of the characteristic equation; ``spring`` is kappa = k_b L/(E I)."""
    equation = _characteristic(ends, spring)
    start = 1e-4 if ends[0] == "spring" else 0.5
    fine = np.geomspace(start, 0.5, 60)[:-1] if start < 0.5 else np.empty(0)
    grid = np.concatenate([fine, np.arange(0.5, (count + 2) * np.pi, 0.05)])
    value = equation(grid)
    change = np.flatnonzero(np.sign(value[:-1]) * np.sign(value[1:]) < 0)
    roots = [scipy.optimize.brentq(equation, grid[i], grid[i + 1], xtol=1e-13) for i in change]
    rigid = (3.0 * spring) ** 0.25  # a soft spring, or a hinge: the beam swings as a rigid body
    if ends[0] == "spring" and rigid <= start:
        roots.insert(0, rigid)
    return np.array(roots[:count])


def _characteristic(ends: tuple[str, str], spring: float) -> Callable[[Floats], Floats]:
    def sech(b: Floats) -> Floats:
        return 2.0 * np.exp(-b) / (1.0 + np.exp(-2.0 * b))

    def hinged(b: Floats) -> Floats:
        return np.asarray(np.sin(b) - np.cos(b) * np.tanh(b))

    equations: dict[tuple[str, str], Callable[[Floats], Floats]] = {
        ("clamped", "free"): lambda b: np.cos(b) + sech(b),
        ("clamped", "clamped"): lambda b: np.cos(b) - sech(b),
        ("pinned", "pinned"): np.sin,
        ("clamped", "pinned"): hinged,
        ("spring", "free"): lambda b: spring * (np.cos(b) + sech(b)) - b * hinged(b),
    }
    return equations[ends]


def _basis(root: float, s: Floats, order: int) -> Floats:
    """Cosine, sine and two decaying exponentials, differentiated ``order`` times over beta, (4, m).

    Exponentials that decay from either end stay of order one where cosh would overflow.
    """
    quarter = order * np.pi / 2.0
    return np.stack(
        [
            np.cos(root * s + quarter),
            np.sin(root * s + quarter),
            (-1.0) ** order * np.exp(-root * s),
            np.exp(-root * (1.0 - s)),
        ]
    )


def _bending_shape(ends: tuple[str, str], spring: float, root: float, span: Floats) -> Floats:
    """Shape g at the stations: the combination that meets the four end conditions."""
    if root < _RIGID_BELOW:
        return span.copy()
    conditions = []
    for end, where in zip(ends, (0.0, 1.0), strict=True):
        at = np.array([where])
        if end == "spring":
            # Moment balance EI g''/L = k_b g' at the root.
            moment = root * _basis(root, at, 2) - spring * _basis(root, at, 1)
            conditions += [_basis(root, at, 0), moment / max(root, spring)]
        else:
            conditions += [_basis(root, at, order) for order in _VANISHING[end]]
    matrix = np.stack([condition[:, 0] for condition in conditions])
    coefficient = np.linalg.svd(matrix)[2][-1]
    return np.asarray(coefficient @ _basis(root, span, 0))


def _sprung_torsion_roots(spring: float, count: int) -> Floats:
    """Roots of gamma tan(gamma) = kappa, one in each [n pi, (n + 1/2) pi)."""

    def equation(gamma: float) -> float:
        return float(gamma * np.sin(gamma) - spring * np.cos(gamma))

    return np.array(
        [
            scipy.optimize.brentq(equation, n * np.pi, (n + 0.5) * np.pi, xtol=1e-13)
            for n in range(count)
        ]
    )
