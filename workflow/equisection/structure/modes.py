"""The modes of a beam by any of three methods, in one form.

``solid`` has quadratic hexahedra. ``beam`` (one-dimensional elements) and ``analytic`` cover every
boundary. They differ from it since a beam leaves out restrained warping and Poisson contraction at
a clamp.
"""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from equisection.beam.beam import MID_CHORD, Beam
from equisection.errors import ModesError
from equisection.structure import analytic, beam_elements
from equisection.structure.classify import classify
from equisection.structure.mode_set import MeshStudy, ModeSet
from equisection.structure.solid import solid_modes
from equisection.structure.span import normalise

Floats = NDArray[np.float64]

METHODS = ("solid", "beam", "analytic")
#: Where the search for modes of a kind ends: a beam that lacks them among so many has none.
MOST_MODES = 200

#: Bending modes, at least, of a beam with supports along its span, among which the one most like
#: the first torsion mode is looked for: of n equal spans it is the n-th.
PAIRED_AMONG = 8

logger = logging.getLogger(__name__)


def compute_modes(
    beam: Beam,
    method: str = "solid",
    elements: tuple[int, int, int] = (24, 89, 2),
    count: int = 12,
) -> ModeSet:
    """Lowest modes of a beam.

    Parameters
    ----------
    beam : Beam
        Geometry, material and boundary.
    method : str
        One of `METHODS`.
    elements : tuple of int
        Elements along chord, span and thickness. ``beam`` uses those along the span only, and
        ``analytic`` takes its stations from them (ends and middles of the elements).
    count : int
        Number of modes. Of a cantilever of L/c = 3.7, 12 hold four of bending, four of torsion.
    """
    if count < 1:
        raise ModesError(f"count is {count}; ask for at least one mode")
    if method in ("solid", "analytic") and beam.has_fittings:
        raise ModesError(
            f"method is {method!r}, which holds a beam at its ends alone, and the beam has "
            "supports or lumps along its span; use method 'beam'"
        )
    if method == "solid":
        solid = solid_modes(beam, elements, count)
        sorted_out = classify(solid.chord_position, solid.span, solid.displacement)
        label = " x ".join(str(n) for n in elements)
        shape = normalise(sorted_out.shape)
        return ModeSet(solid.frequency, sorted_out.kind, solid.span, shape, method, label)
    along_span = elements[1]
    span = np.linspace(0.0, 1.0, 2 * along_span + 1)
    if method == "beam":
        if beam.has_fittings:
            span = beam_elements.stations(beam, along_span)
        bending = beam_elements.bending_modes(beam, along_span, count)
        torsion = beam_elements.torsion_modes(beam, along_span, count)
    elif method == "analytic":
        bending = analytic.bending_modes(beam, span, count)
        torsion = analytic.torsion_modes(beam, span, count)
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


def require_method(beam: Beam, method: str) -> None:
    """Refuse a method that cannot have a beam.

    Raises
    ------
    ModesError
        The message says which methods can.
    """
    if method != "beam" and beam.has_fittings:
        raise ModesError(
            f"method is {method!r}, which holds a beam at its ends alone, and the beam has "
            "supports or lumps along its span; give method='beam'"
        )
    if method == "solid" and beam.cross_section is not None:
        raise ModesError(
            "method is 'solid', which meshes a homogeneous plate, and the beam has a "
            "cross_section; give method='beam' or 'analytic'"
        )
    if method == "solid" and (beam.elastic_axis, beam.mass_axis) != (MID_CHORD, MID_CHORD):
        raise ModesError(
            "method is 'solid', which meshes a homogeneous plate, and the beam has its "
            f"{beam.axes_in_words}; give method='beam' or 'analytic'"
        )


def modes_of_kinds(
    beam: Beam,
    method: str,
    elements: tuple[int, int, int],
    numbers: tuple[int, int],
    count: int,
) -> ModeSet:
    """Lowest modes of a beam, ``count`` or as many more as hold so many of bending and torsion.

    A slender beam has many bending modes below its first few of torsion.

    Raises
    ------
    ModesError
        The mesh has too few modes of a kind.
    """
    wanted = dict(zip(("bending", "torsion"), numbers, strict=True))
    least = PAIRED_AMONG if beam.has_fittings else 0
    sought = {**wanted, "bending": max(wanted["bending"], least)}
    modes = _holding(beam, method, elements, sought, count)
    for kind, number in wanted.items():
        modes.of_kind(kind, number)
    return modes


def mesh_study(
    beam: Beam,
    levels: Sequence[tuple[int, int, int]],
    method: str = "solid",
    count: int = 8,
    solved: ModeSet | None = None,
) -> MeshStudy:
    """Solve on each mesh level (coarse to fine) and compare the first ``count`` frequencies.

    Modes are paired by kind, the n-th of bending with the n-th of bending, since a coarse mesh may
    have them in another order. One that a level lacks is NaN there, with a warning. ``solved`` are
    modes that are known already: where they are of the finest level it is not solved again.

    Raises
    ------
    ModesError
        The finest level has no modes.
    """
    label = " x ".join(map(str, levels[-1]))
    if solved and (solved.method, solved.elements) == (method, label) and len(solved.kind) >= count:
        finest = solved.lowest(count)
    else:
        finest = compute_modes(beam, method, levels[-1], count)
    coarser = [_paired(beam, method, level, finest.kind) for level in levels[:-1]]
    return MeshStudy(tuple(levels), finest.kind, np.array([*coarser, finest.frequency]))


def _paired(beam: Beam, method: str, level: tuple[int, int, int], kinds: tuple[str, ...]) -> Floats:
    """Return the frequencies (Hz) of modes of these kinds on a mesh; NaN of those it lacks."""
    frequency = np.full(len(kinds), np.nan)
    reason = ""
    try:
        modes = _holding(beam, method, level, Counter(kinds), len(kinds))
    except ModesError as error:
        reason = f" ({error})"
    else:
        for kind in set(kinds):
            wanted = [i for i, this in enumerate(kinds) if this == kind]
            found = [i for i, this in enumerate(modes.kind) if this == kind]
            for i, j in zip(wanted, found, strict=False):
                frequency[i] = modes.frequency[j]
    lacking = sorted({kinds[i] for i in np.flatnonzero(np.isnan(frequency))})
    if lacking:
        logger.warning(
            "structure.mesh_study: the mesh of %s elements lacks modes of %s that the finest has%s;"
            " they stay empty there, refine it or leave it out",
            " x ".join(map(str, level)),
            ", ".join(lacking),
            reason,
        )
    return frequency


def _holding(
    beam: Beam,
    method: str,
    elements: tuple[int, int, int],
    wanted: Mapping[str, int],
    count: int,
) -> ModeSet:
    """Return the lowest modes, ``count`` or as many more as hold so many of each kind.

    Where the mesh has no more, or at `MOST_MODES`, what there is comes back.
    """
    asked = count
    while True:
        modes = compute_modes(beam, method, elements, asked)
        places = [_place(modes.kind, kind, number) for kind, number in wanted.items()]
        held = [place for place in places if place is not None]
        if len(held) == len(places):
            return modes.lowest(max([count, *(place + 1 for place in held)]))
        if len(modes.kind) < asked or asked >= MOST_MODES:
            return modes
        asked *= 2


def _place(kinds: Sequence[str], kind: str, number: int) -> int | None:
    """Return where the last of so many modes of a kind is; None if there are fewer."""
    found = [i for i, this in enumerate(kinds) if this == kind]
    return found[number - 1] if len(found) >= number else None
