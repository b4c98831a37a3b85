"""One-dimensional finite elements: Euler-Bernoulli bending and Saint-Venant torsion.

With s = z/L, find g, f and omega such that for every admissible v

    EI/L^3 [ int g'' v'' ds + (k_b L/EI) g'(0) v'(0) ] = omega^2 rho_s c h L int g v ds,
    GJ/L   [ int f' v' ds + (k_t L/GJ) f(0) v(0) ]     = omega^2 rho_s c^3 h L/12 int f v ds,

on cubic Hermite and quadratic Lagrange elements, with root springs k_b and k_t (N m/rad). A support
at s_p adds k_p g(s_p) v(s_p) to the left, a lumped mass M_p g(s_p) v(s_p) to the integral of the
mass, and each of them has a node. Deflection and twist are each alone: a lumped mass is in g with
its mass and in f with its inertia about the elastic axis, its imbalance is in neither.

Where the twist is held inside the span alone, either part turns on its own, and equal parts have
modes of one frequency, of which an eigensolver gives any mixture. They are told apart by their
moments over the span (:func:`_split`): of equal halves first both turn alike, then oppositely.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy
from numpy.typing import NDArray
from skfem import Basis, BilinearForm, ElementLineHermite, ElementLineP2, MeshLine
from skfem.helpers import dd, ddot, dot, grad

from equisection.beam.beam import Beam
from equisection.beam.supports import Fitting

Floats = NDArray[np.float64]
Integers = NDArray[np.int64]

#: Relative distance of eigenvalues that are one.
_DEGENERATE = 1e-6
#: Share of an element within which its node moves to a support.
_NEAR = 0.25
#: s of the shifted eigenvalue problem, of the size of the lowest lambda (-).
_SHIFT = 1.0


def _curvature(u: Any, v: Any, _: Any) -> Any:
    return ddot(dd(u), dd(v))


def _twist_rate(u: Any, v: Any, _: Any) -> Any:
    return dot(grad(u), grad(v))


def _product(u: Any, v: Any, _: Any) -> Any:
    return u * v


def nodes_along_span(beam: Beam, elements: int) -> Floats:
    """z/L of the nodes, equally spaced but for one at each support and lumped mass."""
    even = np.linspace(0.0, 1.0, elements + 1)
    fittings: tuple[Fitting, ...] = (*beam.supports, *beam.lumps)
    places = np.unique([fitting.at for fitting in fittings])
    if places.size == 0:
        return even
    distance = np.abs(even[:, None] - places).min(axis=1)
    kept = distance > _NEAR / elements
    kept[[0, -1]] = True
    nodes = np.union1d(even[kept], places)
    return np.asarray(nodes[np.diff(nodes, prepend=-1.0) > 1e-12], dtype=np.float64)


def stations(beam: Beam, elements: int) -> Floats:
    """z/L of the shapes: nodes and middles of the elements."""
    nodes = nodes_along_span(beam, elements)
    both = np.empty(2 * nodes.size - 1)
    both[::2], both[1::2] = nodes, (nodes[:-1] + nodes[1:]) / 2.0
    return both


@dataclass(frozen=True)
class BeamSystem:
    """Matrices of the deflection or the twist of a beam on elements, dimensionless as above.

    Attributes
    ----------
    basis
        Functions of the elements.
    nodes
        z/L of the nodes, shape (n + 1,).
    values, others
        Numbers of the unknowns that are values at the nodes, and of the others: slopes dg/ds at the
        nodes, or twists in the middles of the elements.
    of_beam
        Stiffness of the beam alone, without springs.
    stiffness, mass
        Stiffness with springs, and mass with lumped ones.
    held
        Numbers of the unknowns that are zero.
    """

    basis: Basis
    nodes: Floats
    values: Integers
    others: Integers
    of_beam: Floats
    stiffness: Floats
    mass: Floats
    held: list[int]


def bending_system(beam: Beam, nodes: Floats) -> BeamSystem:
    """Matrices of the deflection on elements with some nodes, at each support and lump one."""
    basis = Basis(MeshLine(nodes), ElementLineHermite(), intorder=6)
    deflection, slope = basis.dofs.nodal_dofs
    of_beam = BilinearForm(_curvature).assemble(basis).toarray()
    stiffness = of_beam.copy()
    mass = BilinearForm(_product).assemble(basis).toarray()
    if beam.root_bending_stiffness is not None:
        root = slope[0]
        spring = beam.root_bending_stiffness * beam.length / beam.bending_rigidity
        stiffness[root, root] += spring
    held: list[int] = []
    for support in beam.supports:
        at = deflection[node_at(nodes, support.at)]
        stiffness[at, at] += support.deflection_stiffness * beam.length**3 / beam.bending_rigidity
        if support.deflection == "fixed":
            held.append(int(at))
    for lump in beam.lumps:
        at = deflection[node_at(nodes, lump.at)]
        mass[at, at] += lump.mass / (beam.mass_per_length * beam.length)
    for node, end in zip((0, -1), beam.bending_ends, strict=True):
        if end != "free":
            held.append(int(deflection[node]))
        if end == "clamped":
            held.append(int(slope[node]))
    return BeamSystem(basis, nodes, deflection, slope, of_beam, stiffness, mass, held)


def torsion_system(beam: Beam, nodes: Floats) -> BeamSystem:
    """Matrices of the twist on elements with some nodes, at each support and lump one."""
    basis = Basis(MeshLine(nodes), ElementLineP2(), intorder=4)
    values, middles = basis.dofs.nodal_dofs[0], basis.dofs.interior_dofs[0]
    of_beam = BilinearForm(_twist_rate).assemble(basis).toarray()
    stiffness = of_beam.copy()
    mass = BilinearForm(_product).assemble(basis).toarray()
    if beam.root_torsional_stiffness is not None:
        root = values[0]
        spring = beam.root_torsional_stiffness * beam.length / beam.torsional_rigidity
        stiffness[root, root] += spring
    held = [
        int(values[node])
        for node, end in zip((0, -1), beam.torsion_ends, strict=True)
        if end == "fixed"
    ]
    for support in beam.supports:
        at = values[node_at(nodes, support.at)]
        stiffness[at, at] += support.twist_stiffness * beam.length / beam.torsional_rigidity
        if support.twist == "fixed":
            held.append(int(at))
    for lump in beam.lumps:
        at = values[node_at(nodes, lump.at)]
        mass[at, at] += lump.inertia_about_axis / (beam.inertia_per_length * beam.length)
    return BeamSystem(basis, nodes, values, middles, of_beam, stiffness, mass, held)


def bending_modes(beam: Beam, elements: int, count: int) -> tuple[Floats, Floats]:
    """Bending frequencies (Hz, (n,)) and shapes g ((n, m), at the m :func:`stations`)."""
    system = bending_system(beam, nodes_along_span(beam, elements))
    eigenvalue, vector = _lowest(system.stiffness, system.mass, system.held, count)
    scale = beam.bending_rigidity / (beam.mass_per_length * beam.length**4)
    values, slopes = vector[system.values], vector[system.others]
    size = np.diff(system.nodes)[:, None]
    middle = (values[:-1] + values[1:]) / 2.0 + size * (slopes[:-1] - slopes[1:]) / 8.0
    return _hertz(eigenvalue * scale), _interleave(values, middle)


def torsion_modes(beam: Beam, elements: int, count: int) -> tuple[Floats, Floats]:
    """Torsion frequencies (Hz, (n,)) and shapes f ((n, m), at the m :func:`stations`)."""
    system = torsion_system(beam, nodes_along_span(beam, elements))
    # Two more than wanted, so that the last of them does not lack its twin.
    wanted = count + 2 if beam.supports else count
    eigenvalue, vector = _lowest(system.stiffness, system.mass, system.held, wanted)
    if beam.supports:
        powers = (system.basis.doflocs[0][:, None] ** np.arange(len(eigenvalue))).T
        moments = powers @ BilinearForm(_product).assemble(system.basis) @ vector
        eigenvalue, vector = _split(eigenvalue, vector, moments)
        eigenvalue, vector = eigenvalue[:count], vector[:, :count]
    scale = beam.torsional_rigidity / (beam.inertia_per_length * beam.length**2)
    return _hertz(eigenvalue * scale), _interleave(vector[system.values], vector[system.others])


def node_at(nodes: Floats, at: float) -> int:
    """Return the number of the node at a place z/L."""
    return int(np.abs(nodes - at).argmin())


def _split(eigenvalue: Floats, vector: Floats, moments: Floats) -> tuple[Floats, Floats]:
    """Choose the modes of one eigenvalue by their moments over the span.

    Of a set of modes f_n with one eigenvalue any rotation is as good. The first one chosen takes
    all of the set's mean, sum f_n int f_n ds; the next, orthogonal to it in M, all of what is left
    of int f_n s ds; and so on. ``moments`` (p, n) are int f_n s^p ds.
    """
    eigenvalue, vector = eigenvalue.copy(), vector.copy()
    start = 0
    while start < eigenvalue.size:
        end = start + 1
        while end < eigenvalue.size and (
            eigenvalue[end] - eigenvalue[start] <= _DEGENERATE * eigenvalue[end]
        ):
            end += 1
        if end - start > 1:
            rotation = np.linalg.qr(moments[: end - start, start:end].T)[0]
            vector[:, start:end] = vector[:, start:end] @ rotation
            eigenvalue[start:end] = eigenvalue[start:end].mean()
        start = end
    return eigenvalue, vector


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
