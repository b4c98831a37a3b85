"""Onset of the plate in the limit of cells that shrink in the plane and along the span apart.

The next finer mesh of the plate has three times the cells, one that is finer along the span alone
half as many more. So meshes with the cells of ``coarse`` in the plane tell the error along the
span. The section on the cells that the plate's meshes have in the plane tells how the error there
falls, and one mesh of the plate that is finer in the plane alone, how much of it the plate has. The
mesh that is finer in both directions shows by how much the two changes miss their sum; that is in
the interval.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace

from equisection.analysis.grid_limit import GridLimit
from equisection.config.groups.openfoam_keys import ON_CELLS_OF_PLATE
from equisection.paper.mesh_convergence.kept_releases import MESHES, MeshRelease
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, MeshValue
from equisection.paper.mesh_convergence.onset_by_mesh import (
    EARLY,
    GROWTH,
    PLATE_ITERATIONS,
)
from equisection.paper.mesh_convergence.onset_from_equilibrium import (
    BY_EQUILIBRIUM,
    GrowthCurve,
    early_growth,
)
from equisection.solvers.openfoam.mesh.beam_mesh import layers_of_beam
from equisection.solvers.openfoam.mesh.presets import PRESETS

#: Basis of the onset, and of the growth in one direction.
BY_DIRECTION = "by direction"
ALONG_SPAN, IN_PLANE = "along the span", "in the plane"
#: Meshes of the plate that have the cells of ``coarse`` in the plane, by those along the span.
_OF_SPAN = {name: f"coarse-{name}-span" for name in MESHES} | {"coarse": "coarse"}
#: Mesh of the plate that is finer in the plane alone, with its cells there, and one finer in both.
_OF_PLANE, _IN_PLANE, _OF_BOTH = "fine-coarse-span", "fine", "medium"
#: Meshes of releases that count in one direction, or in both.
MESHES_BY_DIRECTION = {
    *MESHES,
    *_OF_SPAN.values(),
    _OF_PLANE,
    *(ON_CELLS_OF_PLATE + name for name in MESHES),
}
#: Fewest meshes of a direction, which show an order.
_FEWEST = 3


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
    def part(self) -> tuple[float, float]:
        """Change of the plate over that of the section, in the plane, and half of its interval."""
        pair = self.finer_in_plane, _on(self.along_span, "coarse")
        of_section = _on(self.in_plane, _IN_PLANE), _on(self.in_plane, "coarse")
        change, own = (one.value - other.value for one, other in (pair, of_section))
        part = change / own
        errors, own_errors = (
            math.hypot(*(one.half_width for one in both)) for both in (pair, of_section)
        )
        return part, math.hypot(errors / own, part * own_errors / own)

    @property
    def missed(self) -> float:
        """By how much (V/c) the change in both directions is not the sum of those in one."""
        both = self.finer_in_both
        span = _on(self.along_span, both.mesh).value
        plane = _on(self.in_plane, both.mesh).value - _on(self.in_plane, "coarse").value
        return both.value - span - self.part[0] * plane

    @property
    def limit(self) -> tuple[float, float]:
        """Growth (V/c) in the limit, and half of its interval.

        The mesh that is finer in both directions, and what is left in each: along the span to the
        limit of the plate itself, in the plane the part of what is left of the section.
        """
        both, (part, of_part) = self.finer_in_both, self.part
        span = self.along_span.limit.value - _on(self.along_span, both.mesh).value
        plane = self.in_plane.limit.value - _on(self.in_plane, both.mesh).value
        errors = (
            both.half_width,
            self.along_span.limit.half_width,
            part * self.in_plane.limit.half_width,
            of_part * plane,
            self.missed,
        )
        return both.value + span + part * plane, math.hypot(*errors)


def _on(series: MeshSeries, mesh: str) -> MeshValue:
    return next(value for value in series.values if value.mesh == mesh)


@dataclass(frozen=True)
class ReleasesByDirection:
    """Releases from equilibrium of the plate on every mesh, and of the section on its cells.

    Those of the plate with fewer than four iterations of a time step do not count.

    Attributes
    ----------
    plates, sections
        The releases.
    """

    plates: tuple[MeshRelease, ...]
    sections: tuple[MeshRelease, ...]

    @classmethod
    def of(cls, releases: Sequence[MeshRelease]) -> ReleasesByDirection:
        """Return those among releases from equilibrium on any meshes."""
        return cls(
            tuple(one for one in releases if one.model == "3d"),
            tuple(
                one
                for one in releases
                if one.model == "2d" and one.mesh.startswith(ON_CELLS_OF_PLATE)
            ),
        )

    @property
    def k_star(self) -> list[float]:
        """Each k* that there is a release at."""
        return sorted({one.case.k_star for one in (*self.plates, *self.sections)})

    def of_plate(self, k_star: float) -> dict[str, MeshValue]:
        """Return the plate's growth (V/c) at a k* by mesh."""
        return {
            one.mesh: early_growth(one)
            for one in self.plates
            if one.case.k_star == k_star and one.iterations >= PLATE_ITERATIONS
        }

    def along_span(self, k_star: float) -> MeshSeries:
        """Return the plate's growth on meshes that are finer along the span alone, by layers."""
        of_plate = self.of_plate(k_star)
        values = [
            replace(of_plate[mesh], mesh=name, cells=sum(layers_of_beam(PRESETS[name].plate)))
            for name, mesh in _OF_SPAN.items()
            if mesh in of_plate
        ]
        return MeshSeries(GROWTH, "3d", f"k* = {k_star:g}", ALONG_SPAN, 1, tuple(values))

    def in_plane(self, k_star: float) -> MeshSeries:
        """Return the section's growth on the cells that the plate's meshes have in the plane."""
        values = (
            replace(early_growth(one), mesh=one.mesh.removeprefix(ON_CELLS_OF_PLATE))
            for one in self.sections
            if one.case.k_star == k_star
        )
        return MeshSeries(GROWTH, "2d", f"k* = {k_star:g}", IN_PLANE, 2, tuple(values))

    def series(self) -> Iterator[MeshSeries]:
        """Yield the growth in either direction at each k* that has it on two meshes or more."""
        for k_star in self.k_star:
            both = self.along_span(k_star), self.in_plane(k_star)
            yield from (one for one in both if len(one.values) > 1)

    def growths(self) -> Iterator[GrowthByDirection]:
        """Yield the growth at each k* that has a release on every mesh that a limit rests on."""
        for k_star in self.k_star:
            of_plate = self.of_plate(k_star)
            along, plane = self.along_span(k_star), self.in_plane(k_star)
            there = [{value.mesh for value in one.values} for one in (along, plane)]
            if (
                {_OF_PLANE, _OF_BOTH} <= of_plate.keys()
                and {"coarse", _OF_BOTH} <= there[0]
                and {"coarse", _OF_BOTH, _IN_PLANE} <= there[1]
                and len(along.values) >= _FEWEST
            ):
                yield GrowthByDirection(
                    k_star, along, plane, of_plate[_OF_PLANE], of_plate[_OF_BOTH]
                )


def hides_error(in_plane: MeshSeries) -> bool:
    """Tell whether the change from coarse to medium is smaller than that from there to fine.

    The cells of both are then too coarse for their difference to say what is left.
    """
    of = {value.mesh: value.value for value in in_plane.values}
    if not {"coarse", "medium", "fine"} <= of.keys():
        return False
    return abs(of["medium"] - of["coarse"]) < abs(of["fine"] - of["medium"])


def onset_by_direction(
    growths: Iterable[GrowthByDirection],
    series: Sequence[MeshSeries],
    curve: GrowthCurve | None,
    change: float,
) -> Iterator[MeshSeries]:
    """Yield the onset of the plate: where its growth curve is zero that is moved to the limit.

    Parameters
    ----------
    growths
        Growth at any k*; that nearest to its onset counts, where the curve has a release too.
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
    if of_meshes is None or curve is None:
        return
    found = [
        (one, curve.moved(one.k_star, one.limit, change, EARLY))
        for one in growths
        if curve.runs.at(one.k_star)
    ]
    if not found:
        return
    growth, onset = min(found, key=lambda pair: pair[1].away)
    rate, half = growth.limit
    words = (
        f"limit of the growth {rate:+.4f} +- {half:.4f} V/c at k* = {growth.k_star:g}; in the "
        f"plane {growth.part[0]:.2f} times the section's change, both directions' changes miss "
        f"their sum by {growth.missed:+.4f}"
    )
    of_span = growth.along_span.limit
    limit = GridLimit(*onset.ends, of_span.meshes, of_span.order, "limits of both directions")
    *coarser, finest = (replace(one, note="") for one in of_meshes.values)
    values = (*coarser, replace(finest, note=words))
    yield replace(of_meshes, basis=BY_DIRECTION, values=values, derived=limit)
