"""One-dimensional finite elements: Euler-Bernoulli bending and Saint-Venant torsion.

With s = z/L, find g, f and omega such that for every admissible v

    EI/L^3 [ int g'' v'' ds + (k_b L/EI) g'(0) v'(0) ] = omega^2 rho_s c h L int g v ds,
    GJ/L   [ int f' v' ds + (k_t L/GJ) f(0) v(0) ]     = omega^2 rho_s c^3 h L/12 int f v ds,

on cubic Hermite and quadratic Lagrange elements, with root springs k_b and k_t (N m/rad).
"""

from __future__ import annotations

from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray
from skfem import Basis, BilinearForm, ElementLineHermite, ElementLineP2, MeshLine
from skfem.helpers import dd, ddot, dot, grad

from equisection.beam.beam import Beam

Floats = NDArray[np.float64]

#: s of the shifted eigenvalue problem, of the size of the lowest lambda (-).
_SHIFT = 1.0


def _curvature(u: Any, v: Any, _: Any) -> Any:
    return ddot(dd(u), dd(v))


def _twist_rate(u: Any, v: Any, _: Any) -> Any:
    return dot(grad(u), grad(v))


def _product(u: Any, v: Any, _: Any) -> Any:
    return u * v


def bending_modes(beam: Beam, elements: int, count: int) -> tuple[Floats, Floats]:
    """Bending frequencies (Hz, (n,)) and shapes g ((n, 2 elements + 1), at ends and middles)."""
    mesh = MeshLine(np.linspace(0.0, 1.0, elements + 1))
    basis = Basis(mesh, ElementLineHermite(), intorder=6)
    deflection, slope = basis.dofs.nodal_dofs
    stiffness = BilinearForm(_curvature).assemble(basis).toarray()
    mass = BilinearForm(_product).assemble(basis).toarray()
    if beam.root_bending_stiffness is not None:
        root = slope[0]
        spring = beam.root_bending_stiffness * beam.length / beam.bending_rigidity
        stiffness[root, root] += spring
    held: list[int] = []
    for node, end in zip((0, -1), beam.bending_ends, strict=True):
        if end != "free":
            held.append(int(deflection[node]))
        if end == "clamped":
            held.append(int(slope[node]))
    eigenvalue, vector = _lowest(stiffness, mass, held, count)
    scale = beam.bending_rigidity / (beam.mass_per_length * beam.length**4)
    values, slopes = vector[deflection], vector[slope]
    middle = (values[:-1] + values[1:]) / 2.0 + (slopes[:-1] - slopes[1:]) / (8.0 * elements)
    return _hertz(eigenvalue * scale), _interleave(values, middle)


def torsion_modes(beam: Beam, elements: int, count: int) -> tuple[Floats, Floats]:
    """Torsion frequencies (Hz, (n,)) and shapes f ((n, 2 elements + 1), at ends and middles)."""
    mesh = MeshLine(np.linspace(0.0, 1.0, elements + 1))
    basis = Basis(mesh, ElementLineP2(), intorder=4)
    nodes, middles = basis.dofs.nodal_dofs[0], basis.dofs.interior_dofs[0]
    stiffness = BilinearForm(_twist_rate).assemble(basis).toarray()
    mass = BilinearForm(_product).assemble(basis).toarray()
    if beam.root_torsional_stiffness is not None:
        root = nodes[0]
        spring = beam.root_torsional_stiffness * beam.length / beam.torsional_rigidity
        stiffness[root, root] += spring
    held = [
        int(nodes[node])
        for node, end in zip((0, -1), beam.torsion_ends, strict=True)
        if end == "fixed"
    ]
    eigenvalue, vector = _lowest(stiffness, mass, held, count)
    scale = beam.torsional_rigidity / (beam.inertia_per_length * beam.length**2)
    return _hertz(eigenvalue * scale), _interleave(vector[nodes], vector[middles])


def _lowest(stiffness: Floats, mass: Floats, held: list[int], count: int) -> tuple[Floats, Floats]:
    """Lowest eigenpairs with some unknowns held at zero; vectors (unknown, mode).

    Of M x = mu (K + s M) x the largest, mu = 1/(lambda + s): their rounding is a part of
    themselves, while that of the lowest lambda of K x = lambda M x is a part of the highest.
    """
    free = np.setdiff1d(np.arange(len(stiffness)), held)
    count = min(count, len(free))
    block = np.ix_(free, free)
    largest = [len(free) - count, len(free) - 1]
    shifted = stiffness[block] + _SHIFT * mass[block]
    inverse, reduced = scipy.linalg.eigh(mass[block], shifted, subset_by_index=largest)
    eigenvalue = 1.0 / inverse[::-1] - _SHIFT
    vector = np.zeros((len(stiffness), count))
    vector[free] = reduced[:, ::-1]
    # A rigid motion comes out as rounding of either sign about zero.
    return np.where(eigenvalue > 1e-8, eigenvalue, 0.0), vector


def _hertz(omega_squared: Floats) -> Floats:
    return np.asarray(np.sqrt(omega_squared) / (2.0 * np.pi))


def _interleave(nodes: Floats, middles: Floats) -> Floats:
    """Rows of modes from columns of nodal and mid-element values, in order along the span."""
    shape = np.empty((nodes.shape[1], len(nodes) + len(middles)))
    shape[:, 0::2] = nodes.T
    shape[:, 1::2] = middles.T
    return shape
