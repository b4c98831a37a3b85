"""Onset of the corrected sections over the cell size, from that of the section and a difference.

The finest meshes have releases of the section alone. What a correction moves the onset by is known
from releases on coarser meshes, and how that changes from the finest of these on from the models
that are learnt on each mesh (:func:`.onset_by_mesh.sections_by_model`): most of a model's error is
in the onsets of both and falls out of their difference.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

from equisection.analysis.grid_limit import GridLimit
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, MeshValue
from equisection.paper.mesh_convergence.onset_by_mesh import (
    BY_MODEL,
    BY_RELEASES,
    ONSET,
    SECTIONS,
)
from equisection.paper.mesh_convergence.onset_by_mesher import BOTH_MESHERS
from equisection.paper.mesh_convergence.onset_from_equilibrium import BY_EQUILIBRIUM

#: Basis of the onset.
BY_DIFFERENCE = "2d and difference"
DIFFERENCE_OF_BOTH = f"{BY_DIFFERENCE}, {BOTH_MESHERS}"


def onsets_by_difference(series: Sequence[MeshSeries]) -> Iterator[MeshSeries]:
    """Yield the onset of each corrected section over the meshes of the section.

    Where it has releases it is by these. On finer meshes it is that of the section, plus the
    difference of both by releases on the finest mesh that has them, plus the change of the learnt
    difference from that mesh on. The change is as uncertain as it is large, or as the learnt
    difference misses that of the releases. Both errors are of all these meshes and of the limit
    alike.

    Parameters
    ----------
    series
        Series of the onset without damping; those that are of other quantities are left out.
    """
    onsets = {
        (one.model, one.basis): one for one in series if (one.quantity, one.at) == (ONSET, "")
    }
    plain = [
        one
        for basis in (BY_EQUILIBRIUM, BY_RELEASES)
        if (one := onsets.get(("2d", basis))) and math.isfinite(one.limit.half_width)
    ]
    if not plain:
        return
    narrowest = min(plain, key=lambda one: one.limit.half_width)
    base = onsets.get(("2d", BOTH_MESHERS), narrowest)
    of_section = onsets.get(("2d", BY_MODEL))
    for model in SECTIONS[1:]:
        releases = onsets.get((model, BY_EQUILIBRIUM)) or onsets.get((model, BY_RELEASES))
        learnt = onsets.get((model, BY_MODEL))
        if releases and learnt and of_section:
            moved = _moved(releases, base, _difference(learnt, of_section))
            if moved:
                yield moved


def _difference(one: MeshSeries, other: MeshSeries) -> dict[str, float]:
    """Return the difference of two series on the meshes of both, the coarsest first."""
    there = {value.mesh: value.value for value in other.values}
    return {v.mesh: v.value - there[v.mesh] for v in one.values if v.mesh in there}


def _moved(releases: MeshSeries, base: MeshSeries, learnt: dict[str, float]) -> MeshSeries | None:
    """Return the series of the section, moved by a difference; None where it is not known."""
    by_mesh, known = {value.mesh: value for value in releases.values}, releases.values[-1]
    here = next((value for value in base.values if value.mesh == known.mesh), None)
    if here is None or known.mesh not in learnt:
        return None
    difference = known.value - here.value
    error = math.hypot(known.half_width, here.half_width)
    miss = abs(learnt[known.mesh] - difference)
    finest = list(learnt)[-1]
    note = f"difference from 2d {difference:+.2f} +- {error:.2f}, learnt {learnt[known.mesh]:+.2f}"
    note += f", on {finest} {learnt[finest]:+.2f}" if finest != known.mesh else ""

    def moved(mesh: str, value: float, own: float) -> tuple[float, float, float]:
        change = learnt.get(mesh, learnt[finest]) - learnt[known.mesh]
        centre = value + difference + change
        half = math.hypot(own, error, max(abs(change), miss))
        return centre, centre - half, centre + half

    values = []
    for one in base.values:
        if one.mesh in by_mesh:
            own = by_mesh[one.mesh]
            ends = own.value, own.low, own.high
        else:
            ends = moved(one.mesh, one.value, one.half_width)
        values.append(MeshValue(one.mesh, one.cells, *ends, note if one is here else ""))
    of_base = base.limit
    limit = GridLimit(
        *moved("", of_base.value, of_base.half_width),
        of_base.meshes,
        of_base.order,
        f"limit of 2d ({base.basis}), and the difference from it",
    )
    basis = DIFFERENCE_OF_BOTH if base.basis == BOTH_MESHERS else BY_DIFFERENCE
    return MeshSeries(
        ONSET, releases.model, "", basis, base.dimensions, tuple(values), derived=limit
    )
