"""Free vibration of the plate as a three-dimensional elastic solid.

Find u and omega with

    integral of sigma(u) : eps(v)  =  omega^2 integral of rho_s u . v      for every v,

on quadratic hexahedra of 27 nodes. (Linear hexahedra lock in bending: 19 % too stiff with 8.5e3 of
them.) The mesh is uniform, so that one element matrix serves all elements.

The plate is its own mirror image in mid-chord and in mid-thickness. Its modes therefore fall
into four classes, even or odd in each mirror, which are solved one by one on the unknowns of
a quarter: the same frequencies as the whole mesh gives, for a fraction of time and memory.
Node (i, j, k) counts half elements in chord x, thickness y and span z; z varies slowest, so
that the unknowns are banded along the span.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix, csc_matrix
from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigsh, splu
from skfem import Basis, ElementHex2, ElementVector, MeshHex
from skfem.models.elasticity import lame_parameters

from equisection.beam.beam import Beam
from equisection.errors import ModesError
from equisection.structure.slenderness import most_slender

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

# Displacement components (0 chord, 1 thickness, 2 span) held at root and tip. A fork (pinned end)
# is a diaphragm: it holds the section's outline and leaves warping and bending slope free.
_CLAMP, _FORK, _FREE = (0, 1, 2), (0, 1), ()
_HELD: dict[str, tuple[tuple[int, ...], tuple[int, ...]]] = {
    "clamped-free": (_CLAMP, _FREE),
    "clamped-clamped": (_CLAMP, _CLAMP),
    "pinned-pinned": (_FORK, _FORK),
    "clamped-pinned": (_CLAMP, _FORK),
}
SOLID_BOUNDARIES = tuple(_HELD)

# (parity of u_y in chord, parity of u_y in thickness): bending, torsion, in-plane and extension.
_CLASSES = ((1, 1), (-1, 1), (-1, -1), (1, -1))
#: Modes that a class odd in thickness is asked for at first: a flat plate is stiff in its plane, so
#: few of these are among the lowest.
_FEW = 4


@dataclass(frozen=True)
class SolidModes:
    """Modes of the solid on its mid-surface, in order of frequency.

    Attributes
    ----------
    frequency : (n,) array
        Natural frequencies (Hz).
    chord_position : (p,) array
        x of the nodes, from -c/2 to c/2 (m).
    span : (m,) array
        z/L of the nodes (-).
    displacement : (n, m, p, 3) array
        Displacement (chord, thickness, span) at mid-thickness, of unit modal mass.
    """

    frequency: Floats
    chord_position: Floats
    span: Floats
    displacement: Floats


def solid_modes(beam: Beam, elements: tuple[int, int, int], count: int) -> SolidModes:
    """Lowest modes of the beam, a plate, as an elastic solid.

    Parameters
    ----------
    beam : Beam
        Its boundary must be one of `SOLID_BOUNDARIES`.
    elements : tuple of int
        Elements along chord, span and thickness.
    count : int
        Number of modes n.

    Raises
    ------
    ModesError
        The boundary or the mesh is none, the eigensolver did not converge, or the plate is so
        slender that rounding would decide (:mod:`equisection.structure.slenderness`).
    """
    if beam.boundary not in SOLID_BOUNDARIES:
        raise ModesError(
            f"boundary {beam.boundary!r} has no counterpart on a solid plate (it allows "
            f"{', '.join(SOLID_BOUNDARIES)}); use method 'beam' or 'analytic'"
        )
    if min(elements) < 1 or len(elements) != 3:
        raise ModesError(
            f"elements is {elements}; give three counts of at least 1 (chord, span, thickness)"
        )
    slender, most = beam.length / beam.thickness, most_slender(elements[2])
    if slender > most:
        raise ModesError(
            f"the plate is {slender:.3g} times as long as thick; on {elements[2]} solid elements "
            f"through its thickness allowed is up to {most:.0f}, beyond which rounding decides the "
            "frequencies; use method 'beam' or 'analytic'"
        )
    element = _one_element(beam, elements)
    frequencies: list[Floats] = []
    fields: list[Floats] = []
    for parity in _CLASSES:
        found = np.sort(np.concatenate([np.empty(0), *frequencies]))
        highest = found[count - 1] if found.size >= count else np.inf
        frequency, field = _class_modes(beam, element, elements, parity, count, highest=highest)
        frequencies.append(frequency)
        fields.append(field)
    frequency = np.concatenate(frequencies)
    order = np.argsort(frequency)[:count]
    nodes_x, nodes_z = 2 * elements[0] + 1, 2 * elements[1] + 1
    return SolidModes(
        frequency=frequency[order],
        chord_position=np.linspace(-0.5, 0.5, nodes_x) * beam.chord,
        span=np.linspace(0.0, 1.0, nodes_z),
        displacement=np.concatenate(fields)[order],
    )


@dataclass(frozen=True)
class _Element:
    """The one element of the mesh.

    ``stiffness`` (N/m) and ``mass`` (kg) are (81, 81); ``place`` (3, 81) is each unknown's
    half-element coordinate 0, 1 or 2 along x, y, z and ``component`` (81,) is 0, 1, 2 for
    u_x, u_y, u_z.
    """

    stiffness: Floats
    mass: Floats
    place: Ints
    component: Ints


def _one_element(beam: Beam, elements: tuple[int, int, int]) -> _Element:
    """Return the element's matrices: the integrals above of each pair of its shape functions."""
    along_chord, along_span, through = elements
    size = np.array([beam.chord / along_chord, beam.thickness / through, beam.length / along_span])
    basis = Basis(MeshHex().scaled(tuple(size)), ElementVector(ElementHex2()), intorder=4)
    number = np.argsort(basis.element_dofs[:, 0])
    shapes = [basis.basis[i][0] for i in number]
    value = np.stack([np.asarray(shape)[:, 0] for shape in shapes])  # (81, 3, points)
    gradient = np.stack([shape.grad[:, :, 0] for shape in shapes])  # (81, 3, 3, points)
    weight = basis.dx[0]
    lame, shear = lame_parameters(beam.youngs_modulus, beam.poisson_ratio)
    strain = (gradient + gradient.swapaxes(1, 2)) / 2.0
    dilatation = np.einsum("naaq->nq", strain)
    stiffness = 2.0 * shear * np.tensordot(strain * weight, strain, axes=((1, 2, 3),) * 2)
    stiffness += lame * (dilatation * weight) @ dilatation.T
    mass = beam.density * np.tensordot(value * weight, value, axes=((1, 2),) * 2)
    place = np.rint(2.0 * basis.doflocs / size[:, None]).astype(np.int64)
    component = np.empty(basis.N, dtype=np.int64)
    dofs = basis.dofs
    for table in (dofs.nodal_dofs, dofs.edge_dofs, dofs.facet_dofs, dofs.interior_dofs):
        for row, numbers in enumerate(table):
            component[numbers] = row
    return _Element(stiffness, mass, place, component)


@dataclass(frozen=True)
class _Folding:
    """Relation of the whole mesh's unknowns to those of a quarter, for one class.

    ``number`` (k, i, j, component) gives the row in the quarter's system or -1 where held;
    ``sign`` the factor, zero where held or odd on a mirror. ``free`` (k, unknowns of a plane across
    the span) is false where the beam's ends hold.
    """

    number: Ints
    sign: Floats
    free: NDArray[np.bool_]

    @property
    def unknowns(self) -> int:
        """Number of unknowns of the quarter."""
        return int(self.free.sum())


def _fold(beam: Beam, elements: tuple[int, int, int], parity: tuple[int, int]) -> _Folding:
    """Assign numbers to the unknowns of a quarter and mirror them onto the whole mesh."""
    nx, nz, ny = (2 * n for n in elements)
    shape = (nz + 1, nx + 1, ny + 1, 3)
    # Parity of u_y is given; u_x differs from it in the chord's mirror, u_y in the thickness's
    # (its own direction), u_z in neither, for a thickness-odd bending field u_z = -y w'.
    in_chord = np.array([-parity[0], parity[0], parity[0]])
    in_thickness = np.array([-parity[1], parity[1], -parity[1]])
    i = np.minimum(np.arange(nx + 1), nx - np.arange(nx + 1))
    j = np.minimum(np.arange(ny + 1), ny - np.arange(ny + 1))
    sign_x = np.where(np.arange(nx + 1)[:, None] > nx // 2, in_chord, 1)
    sign_y = np.where(np.arange(ny + 1)[:, None] > ny // 2, in_thickness, 1)
    sign_x[nx // 2] = (1 + in_chord) // 2
    sign_y[ny // 2] = (1 + in_thickness) // 2
    sign = np.broadcast_to(sign_x[None, :, None] * sign_y[None, None], shape).astype(float)
    for end, held in zip((0, nz), _HELD[beam.boundary], strict=True):
        sign[end][..., list(held)] = 0.0
    quarter = sign[:, : nx // 2 + 1, : ny // 2 + 1] != 0.0
    numbers = np.where(quarter, np.cumsum(quarter).reshape(quarter.shape) - 1, -1)
    return _Folding(numbers[:, i][:, :, j], sign, quarter[:, quarter[1]])


def _class_matrices(
    element: _Element, elements: tuple[int, int, int], folding: _Folding
) -> tuple[csc_matrix, csc_matrix]:
    """Stiffness and mass of one class of modes.

    One element's matrices are scattered over one layer across the span. All layers are alike, and
    the unknowns that the ends hold are left out at last.
    """
    along_chord, along_span, through = elements
    ex, ey = np.meshgrid(
        np.arange((along_chord + 1) // 2), np.arange((through + 1) // 2), indexing="ij"
    )
    origin = np.stack([ex.ravel(), ey.ravel()]).astype(np.int64)
    # An element and its images contribute alike; one on a mirror is its own image.
    images = np.where(2 * origin[0] + 1 == along_chord, 1.0, 2.0)
    images *= np.where(2 * origin[1] + 1 == through, 1.0, 2.0)
    x, y = (2 * origin[d][:, None] + element.place[d] for d in range(2))
    planes, of_plane = folding.free.shape
    inside = folding.number[1] - folding.free[0].sum()  # numbers within a plane that is not held
    number = of_plane * element.place[2] + inside[x, y, element.component]
    sign = folding.sign[1][x, y, element.component]
    rows = np.repeat(number[:, :, None], number.shape[1], axis=2)
    weight = images[:, None, None] * sign[:, :, None] * sign[:, None, :]
    kept = weight != 0.0
    index = rows[kept], rows.transpose(0, 2, 1)[kept]
    below = 2 * of_plane * np.arange(along_span)[:, None]  # unknowns below each layer
    free = np.flatnonzero(folding.free)

    def whole(matrix: Floats) -> csc_matrix:
        """Return the matrix of all layers from that of one element."""
        layer = coo_matrix(((weight * matrix)[kept], index), shape=(3 * of_plane,) * 2).tocsc()
        entries = layer.tocoo()
        of_layers = (
            np.tile(entries.data, along_span),
            ((entries.row + below).ravel(), (entries.col + below).ravel()),
        )
        return coo_matrix(of_layers, shape=(planes * of_plane,) * 2).tocsc()[free][:, free]

    return whole(element.stiffness), whole(element.mass)


def _class_modes(
    beam: Beam,
    element: _Element,
    elements: tuple[int, int, int],
    parity: tuple[int, int],
    count: int,
    *,
    highest: float,
) -> tuple[Floats, Floats]:
    """Frequencies (Hz) and mid-thickness displacements of one class of modes.

    They are the lowest ``count``, or of a class odd in thickness at least all below ``highest``
    (Hz): the others are not among the lowest of all classes.
    """
    folding = _fold(beam, elements, parity)
    stiffness, mass = _class_matrices(element, elements, folding)
    # A shift just below zero keeps the factor regular where a class can move rigidly (pinned-pinned
    # slides along the span). The scale is that of the first bending frequency of a beam.
    scale = beam.bending_rigidity / beam.mass_per_length / beam.length**4
    shift = -1e-2 * scale
    factor = splu(
        stiffness - shift * mass,
        permc_spec="MMD_AT_PLUS_A",
        diag_pivot_thresh=0.0,
        options={"SymmetricMode": True},
    )
    inverse = LinearOperator(stiffness.shape, matvec=factor.solve, dtype=float)
    most = min(count, folding.unknowns - 2)
    wanted = most if parity[1] > 0 else min(_FEW, most)
    start = np.ones(folding.unknowns)  # a fixed start makes runs repeatable
    try:
        while True:
            eigenvalue, vector = eigsh(
                stiffness, wanted, mass, sigma=shift, OPinv=inverse, v0=start
            )
            if wanted == most or eigenvalue.max() > (2.0 * np.pi * highest) ** 2:
                break
            wanted = min(2 * wanted, most)
    except ArpackNoConvergence as error:
        raise ModesError(
            f"the eigensolver did not converge on {elements} elements for {count} modes ({error}); "
            "ask for fewer modes or check the beam's dimensions"
        ) from error
    elastic = eigenvalue > 1e-3 * scale
    mid = elements[2]
    number, sign = folding.number[:, :, mid], folding.sign[:, :, mid]
    field = np.moveaxis(vector[:, elastic][number], -1, 0) * sign
    return np.sqrt(eigenvalue[elastic]) / (2.0 * np.pi), field
