"""Onset of the plate in the limit of cells that shrink in the plane and along the span apart.

The next finer mesh of the plate has three times the cells, one that is finer along the span alone
half as many more. So three meshes with the cells of ``coarse`` in the plane tell the error along
the span, and the section on the cells that the plate's meshes have in the plane tells how the error
there falls. The four meshes of ``coarse`` and ``medium`` in either direction show by how much the
two errors do not add up; that is in the interval.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from equisection.analysis.grid_limit import GridLimit
from equisection.config.groups.openfoam_keys import ON_CELLS_OF_PLATE
from equisection.paper.mesh_convergence.kept_releases import (
    FROM_EQUILIBRIUM,
    MESHES,
    MeshRelease,
    mesh_releases,
)
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, MeshValue
from equisection.paper.mesh_convergence.onset_by_mesh import (
    EARLY,
    GROWTH,
    PLATE_ITERATIONS,
    half_width,
)
from equisection.paper.mesh_convergence.onset_from_equilibrium import BY_EQUILIBRIUM, GrowthCurve
from equisection.solvers.openfoam.mesh.beam_mesh import layers_of_beam
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.verdict.growth import AFTER_RELEASE

#: Basis of the onset, and of the growth in one direction.
BY_DIRECTION = "by direction"
ALONG_SPAN, IN_PLANE = "along the span", "in the plane"
_FINER_ALONG_SPAN = ("coarse", "coarse-medium-span", "coarse-fine-span")
_FINER_IN_PLANE = "medium-coarse-span"
_FINER_IN_BOTH = "medium"
#: Meshes of the plate that the limit rests on.
_NEEDED = {*_FINER_ALONG_SPAN, _FINER_IN_PLANE, _FINER_IN_BOTH}


@dataclass(frozen=True)
class GrowthByDirection:
    """Growth of the plate at one k* on meshes that are finer in one direction.

    Attributes
    ----------
    k_star
        The k*.
    along_span
        Growth (V/c) on meshes that are finer along the span alone, by their layers.
    in_plane
        Growth of the section on the cells that the plate has in the plane.
    finer_in_plane, finer_in_both
        Growth of the plate on the mesh that is finer in the plane alone, and in both directions.
    """

    k_star: float
    along_span: MeshSeries
    in_plane: MeshSeries
    finer_in_plane: MeshValue
    finer_in_both: MeshValue

    @property
    def mixed(self) -> float:
        """By how much (V/c) the changes in both directions are not the sum of those in one."""
        coarse, finer = self.along_span.values[:2]
        return self.finer_in_both.value - finer.value - self.finer_in_plane.value + coarse.value

    @property
    def limit(self) -> tuple[float, float]:
        """Growth (V/c) in the limit, and half of its interval.

        The mesh that is finer in both directions, and what is left in each: along the span from
        the limit of the plate itself, in the plane in proportion to what is left of the section.
        """
        coarse, finer = self.along_span.values[:2]
        span = self.along_span.limit.value - finer.value
        change = self.finer_in_plane.value - coarse.value
        change_error = math.hypot(self.finer_in_plane.half_width, coarse.half_width)
        of_section = {value.mesh: value.value for value in self.in_plane.values}
        step = of_section["medium"] - of_section["coarse"]
        part = (self.in_plane.limit.value - of_section["medium"]) / step
        errors = (
            self.finer_in_both.half_width,
            self.along_span.limit.half_width,
            self.in_plane.limit.half_width / step * change,
            part * change_error,
            self.mixed,
        )
        return self.finer_in_both.value + span + part * change, math.hypot(*errors)


def growths_by_direction(reference: Path) -> Iterator[GrowthByDirection]:
    """Yield the growth at each k* that has a release from equilibrium on every mesh."""
    plates = mesh_releases(reference, FROM_EQUILIBRIUM, _NEEDED)
    on_cells = [ON_CELLS_OF_PLATE + name for name in MESHES]
    sections = mesh_releases(reference, FROM_EQUILIBRIUM, on_cells)
    yield from by_direction(
        [one for one in plates if (one.model, one.iterations) == ("3d", PLATE_ITERATIONS)],
        [one for one in sections if one.model == "2d"],
    )


def by_direction(
    plates: Sequence[MeshRelease], sections: Sequence[MeshRelease]
) -> Iterator[GrowthByDirection]:
    """Yield the same of releases of plate and section, the latter on the plate's cells."""
    for k_star in sorted({one.case.k_star for one in plates}):
        at = f"k* = {k_star:g}"
        of_plate = {one.mesh: _value(one) for one in plates if one.case.k_star == k_star}
        in_plane = [_value(one) for one in sections if one.case.k_star == k_star]
        if not (of_plate.keys() >= _NEEDED and len(in_plane) > 2):
            continue
        along = tuple(
            replace(of_plate[mesh], mesh=name, cells=sum(layers_of_beam(PRESETS[name].plate)))
            for mesh, name in zip(_FINER_ALONG_SPAN, MESHES, strict=False)
        )
        yield GrowthByDirection(
            k_star,
            MeshSeries(GROWTH, "3d", at, ALONG_SPAN, 1, along),
            MeshSeries(GROWTH, "2d", at, IN_PLANE, 2, tuple(in_plane)),
            of_plate[_FINER_IN_PLANE],
            of_plate[_FINER_IN_BOTH],
        )


def onset_by_direction(
    growths: Sequence[GrowthByDirection],
    series: Sequence[MeshSeries],
    curve: GrowthCurve | None,
    change: float,
) -> Iterator[MeshSeries]:
    """Yield the onset of the plate: where its growth curve is zero that is moved to the limit.

    Parameters
    ----------
    growths
        Growth at one k* or more; that nearest to its onset counts.
    series
        Series of the onset, of which that from equilibrium has the values on the meshes.
    curve
        Growth over k* of the plate on one mesh.
    change
        Part of a shift by which it changes over a k* of 1.
    """
    of_meshes = next(
        (one for one in series if (one.model, one.basis) == ("3d", BY_EQUILIBRIUM)), None
    )
    if not growths or of_meshes is None or curve is None:
        return
    found = [(one, curve.moved(one.k_star, one.limit, change)) for one in growths]
    growth, onset = min(found, key=lambda pair: pair[1].away)
    rate, half = growth.limit
    words = (
        f"limit of the growth {rate:+.4f} +- {half:.4f} V/c at k* = {growth.k_star:g}; the "
        f"directions' changes miss their sum by {growth.mixed:+.4f}"
    )
    limit = GridLimit(*onset.ends, 3, growth.along_span.limit.order, "limits of both directions")
    *coarser, finest = (replace(one, note="") for one in of_meshes.values)
    values = (*coarser, replace(finest, note=words))
    yield replace(of_meshes, basis=BY_DIRECTION, values=values, derived=limit)


def _value(release: MeshRelease) -> MeshValue:
    growth = release.growth(AFTER_RELEASE, min(release.end, EARLY))
    half = half_width(growth)
    mesh = release.mesh.removeprefix(ON_CELLS_OF_PLATE)
    return MeshValue(mesh, release.cells, growth.rate, growth.rate - half, growth.rate + half)
