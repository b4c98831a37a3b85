"""The modes of a plate by any of three methods, in one form.

``solid`` (quadratic hexahedra) is what the paper does; ``beam`` (one-dimensional elements)
and ``analytic`` cover every boundary and differ from it by what a beam leaves out: restrained
warping and Poisson contraction at a clamp.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from equisection.errors import ModesError
from equisection.structure import analytic, beam_elements
from equisection.structure.classify import classify
from equisection.structure.mode_set import MeshStudy, ModeSet
from equisection.structure.plate import Plate
from equisection.structure.solid import solid_modes
from equisection.structure.span import normalise

Floats = NDArray[np.float64]

METHODS = ("solid", "beam", "analytic")


def compute_modes(
    plate: Plate,
    method: str = "solid",
    elements: tuple[int, int, int] = (24, 89, 2),
    count: int = 12,
) -> ModeSet:
    """Lowest modes of a plate.

    Parameters
    ----------
    plate : Plate
        Geometry, material and boundary.
    method : str
        One of `METHODS`.
    elements : tuple of int
        Elements along chord, span and thickness. ``beam`` uses those along the span only, and
        ``analytic`` takes its stations from them (ends and middles of the elements).
    count : int
        Number of modes. For the paper's plate, 12 hold four of bending, four of torsion.
    """
    if count < 1:
        raise ModesError(f"count is {count}; ask for at least one mode")
    if method == "solid":
        solid = solid_modes(plate, elements, count)
        sorted_out = classify(solid.chord_position, solid.span, solid.displacement)
        label = " x ".join(str(n) for n in elements)
        shape = normalise(sorted_out.shape)
        return ModeSet(solid.frequency, sorted_out.kind, solid.span, shape, method, label)
    along_span = elements[1]
    span = np.linspace(0.0, 1.0, 2 * along_span + 1)
    if method == "beam":
        bending = beam_elements.bending_modes(plate, along_span, count)
        torsion = beam_elements.torsion_modes(plate, along_span, count)
    elif method == "analytic":
        bending = analytic.bending_modes(plate, span, count)
        torsion = analytic.torsion_modes(plate, span, count)
    else:
        raise ModesError(f"modes.method is {method!r}; choose one of {', '.join(METHODS)}")
    frequency = np.concatenate([bending[0], torsion[0]])
    kind = ("bending",) * len(bending[0]) + ("torsion",) * len(torsion[0])
    order = np.argsort(frequency, kind="stable")[:count]
    return ModeSet(
        frequency[order],
        tuple(kind[i] for i in order),
        span,
        normalise(np.concatenate([bending[1], torsion[1]]))[order],
        method,
        f"{along_span} along the span" if method == "beam" else "none",
    )


def mesh_study(
    plate: Plate, levels: Sequence[tuple[int, int, int]], method: str = "solid", count: int = 8
) -> MeshStudy:
    """Solve on each mesh level (coarse to fine) and compare the first ``count`` frequencies."""
    solved = [compute_modes(plate, method, level, count) for level in levels]
    for level, modes in zip(levels, solved, strict=True):
        if modes.kind != solved[-1].kind:
            raise ModesError(
                f"on {level} elements the modes are {', '.join(modes.kind)}, on {levels[-1]} "
                f"{', '.join(solved[-1].kind)}; the coarse mesh does not resolve them, refine it"
            )
    return MeshStudy(
        tuple(levels), solved[-1].kind, np.array([modes.frequency for modes in solved])
    )
