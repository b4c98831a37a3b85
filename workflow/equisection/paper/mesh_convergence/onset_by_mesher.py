"""Onset on meshes around the outline, and what both meshers say of it together.

Meshes of blocks and meshes around the outline are two families, each with a limit of its own. Where
the limits' intervals meet, the narrower one counts, widened to hold the other limit; where they do
not, at least one of them is too narrow, and the interval has both.

The plate's meshes around the outline shrink in the plane alone. What is left along the span is that
of blocks, whose layers they have. Two meshes can hide an error in the plane: what the section's
growth changes by between the next finer ones, on the plate's cells of blocks, is in the interval.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from equisection.analysis.grid_limit import GridLimit
from equisection.paper.mesh_convergence.kept_releases import MeshRelease
from equisection.paper.mesh_convergence.mesh_series import MeshSeries
from equisection.paper.mesh_convergence.onset_by_direction import (
    FEWEST,
    ReleasesByDirection,
    hidden_in_plane,
)
from equisection.paper.mesh_convergence.onset_by_mesh import EARLY, ONSET, onset_on
from equisection.paper.mesh_convergence.onset_from_equilibrium import (
    AROUND_OUTLINE,
    BY_EQUILIBRIUM,
    GrowthCurve,
    curve_of,
    onsets_on_meshes,
)

#: Basis of the onset by the meshes of both meshers.
BOTH_MESHERS = "both meshers"
#: Origin of its limit.
MEET, DO_NOT_MEET = "limits of both meshers, which meet", "limits of both meshers, which do not"
#: Basis of the onset on meshes around the outline.
AROUND = BY_EQUILIBRIUM + AROUND_OUTLINE


@dataclass(frozen=True)
class _GrowthAroundOutline:
    """Growth of the plate at one k* around the outline, and what is left along the span."""

    k_star: float
    in_plane: MeshSeries
    along_span: MeshSeries
    hidden: float

    @property
    def left_along_span(self) -> float:
        """Growth (V/c) in the limit of cells along the span, less that on the layers of coarse."""
        (coarse,) = (value for value in self.along_span.values if value.mesh == "coarse")
        return self.along_span.limit.value - coarse.value

    @property
    def limit(self) -> tuple[float, float]:
        """Growth (V/c) in the limit of both directions, and half of its interval."""
        plane, span = self.in_plane.limit, self.along_span.limit
        half = math.hypot(plane.half_width, span.half_width, self.hidden)
        return plane.value + self.left_along_span, half


def _growths_around_outline(
    around: ReleasesByDirection, blocks: ReleasesByDirection
) -> Iterator[_GrowthAroundOutline]:
    """Yield the growth at each k* that has a limit in either direction."""
    for k_star in around.k_star:
        plane, span = around.in_plane(k_star), blocks.along_span(k_star)
        if all(math.isfinite(one.limit.half_width) for one in (plane, span)):
            hidden = hidden_in_plane(blocks, k_star) if plane.limit.meshes < FEWEST else 0.0
            yield _GrowthAroundOutline(k_star, plane, span, hidden)


def section_around_outline(releases: Sequence[MeshRelease], change: float) -> Iterator[MeshSeries]:
    """Yield the onset of the section over the meshes around the outline.

    Parameters
    ----------
    releases
        Releases from equilibrium, around the outline.
    change
        Part of a shift by which it changes over a k* of 1.
    """
    curve = curve_of(releases, "2d")
    if curve is not None:
        values = tuple(onsets_on_meshes(releases, "2d", curve, change))
        yield MeshSeries(ONSET, "2d", "", AROUND, 2, values)


def plate_around_outline(
    around: ReleasesByDirection,
    blocks: ReleasesByDirection,
    curve: GrowthCurve | None,
    change: float,
) -> Iterator[MeshSeries]:
    """Yield the onset of the plate over the meshes that shrink in the plane, around the outline.

    It is where the growth curve of blocks is zero that is moved to the growth on each mesh, or to
    its limit in the plane and along the span.

    Parameters
    ----------
    around, blocks
        Releases around the outline and on blocks.
    curve
        Growth over k* on blocks.
    change
        Part of a shift by which it changes over a k* of 1.
    """
    if curve is None:
        return
    found = [
        (growth, curve.moved(growth.k_star, growth.limit, change, EARLY))
        for growth in _growths_around_outline(around, blocks)
        if curve.runs.at(growth.k_star)
    ]
    if not found:
        return
    growth, onset = min(found, key=lambda pair: pair[1].away)
    rate, half = growth.limit
    words = (
        f"limit of the growth {rate:+.4f} +- {half:.4f} V/c at k* = {growth.k_star:g}; along the "
        f"span {growth.left_along_span:+.4f} of it, as on blocks, whose curve over k* it has; the "
        f"interval has {growth.hidden:.4f}, what a section changes by from medium to fine on the "
        "plate's cells"
    )
    values = []
    for value in growth.in_plane.values:
        moved = curve.moved(growth.k_star, (value.value, value.half_width), change, EARLY)
        values.append(onset_on(value.mesh, value.cells, moved.ends))
    values[-1] = replace(values[-1], note=words)
    of_plane = growth.in_plane.limit
    limit = GridLimit(*onset.ends, of_plane.meshes, of_plane.order, "limits of both directions")
    yield MeshSeries(ONSET, "3d", "", AROUND, 2, tuple(values), derived=limit)


def onsets_of_both_meshers(series: Sequence[MeshSeries]) -> Iterator[MeshSeries]:
    """Yield the onset of each model that has a limit with an interval by either mesher.

    Of several series on blocks the one with the narrowest interval counts. The values are those of
    blocks.
    """
    known = [
        one
        for one in series
        if (one.quantity, one.at) == (ONSET, "") and math.isfinite(one.limit.half_width)
    ]
    for around in (one for one in known if one.basis == AROUND):
        blocks = [one for one in known if one.model == around.model and one.basis != AROUND]
        if blocks:
            best = min(blocks, key=lambda one: one.limit.half_width)
            values = tuple(replace(value, note="") for value in best.values)
            limit = limit_of_both(best.limit, around.limit)
            yield replace(best, basis=BOTH_MESHERS, values=values, derived=limit)


def limit_of_both(one: GridLimit, other: GridLimit) -> GridLimit:
    """Return the limit of two families of meshes.

    Its value is the middle of its interval. That is the narrower interval, widened to the value of
    the other limit; or where they do not meet both.
    """
    narrow, wide = sorted((one, other), key=lambda limit: limit.half_width)
    meet = narrow.low <= wide.high and wide.low <= narrow.high
    ends = (wide.value,) if meet else (wide.low, wide.high)
    low, high = min(narrow.low, *ends), max(narrow.high, *ends)
    words = MEET if meet else DO_NOT_MEET
    return GridLimit(0.5 * (low + high), low, high, narrow.meshes, math.nan, words)
