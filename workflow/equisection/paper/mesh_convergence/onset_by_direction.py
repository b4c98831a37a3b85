"""Onset of the plate in the limit of cells that shrink in the plane and along the span apart.

The next finer mesh of the plate has three times the cells, one that is finer along the span alone
half as many more, one that is finer in the plane alone twice as many. So meshes with the cells of
``coarse`` in the plane tell the error along the span, and meshes with its layers along the span the
error in the plane. The mesh that is finer in both directions shows by how much the two changes miss
their sum; three times that is in the interval.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from equisection.analysis.grid_limit import SAFETY_WITHOUT_ORDER, GridLimit
from equisection.config.groups.openfoam_keys import ON_CELLS_OF_PLATE
from equisection.paper.mesh_convergence.kept_releases import MESHES, MeshRelease
from equisection.paper.mesh_convergence.mesh_series import MeshSeries, MeshValue
from equisection.paper.mesh_convergence.onset_by_mesh import (
    EARLY,
    GROWTH,
    PLATE_ITERATIONS,
    SECTIONS,
)
from equisection.paper.mesh_convergence.onset_from_equilibrium import (
    BY_EQUILIBRIUM,
    GrowthCurve,
    early_growth,
)
from equisection.solvers.openfoam.mesh.presets import PRESETS

#: Basis of the onset, and of the growth in one direction.
BY_DIRECTION = "by direction"
ALONG_SPAN, IN_PLANE = "along the span", "in the plane"
#: Half of the layers of ``coarse`` along the span.
SPARSE = "sparse"
#: Meshes of the plate that have the cells of ``coarse`` in the plane, by those along the span.
_OF_SPAN = {
    SPARSE: f"coarse-{SPARSE}-span",
    "coarse": "coarse",
    "medium": "coarse-medium-span",
    "fine": "coarse-fine-span",
}
#: Meshes of the plate that have the layers of ``coarse`` along the span, by the cells in the plane.
_OF_PLANE = {"coarse": "coarse", "medium": "medium-coarse-span", "fine": "fine-coarse-span"}
#: Mesh of the plate that is finer in both directions.
_OF_BOTH = "medium"
#: Meshes of releases that count in one direction, or in both.
MESHES_BY_DIRECTION = {
    *MESHES,
    *_OF_SPAN.values(),
    *_OF_PLANE.values(),
    *(ON_CELLS_OF_PLATE + name for name in MESHES),
}
#: Fewest meshes of a direction, which show an order.
FEWEST = 3


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
        Growth on meshes that are finer in the plane alone, by their cells there.
    finer_in_both
        Growth on the mesh that is finer in both directions.
    """

    k_star: float
    along_span: MeshSeries
    in_plane: MeshSeries
    finer_in_both: MeshValue

    @property
    def missed(self) -> float:
        """By how much (V/c) the change in both directions is not the sum of those in one."""
        both, mesh = self.finer_in_both.value, self.finer_in_both.mesh
        in_plane = _on(self.in_plane, mesh).value - _on(self.in_plane, "coarse").value
        return both - _on(self.along_span, mesh).value - in_plane

    @property
    def left_along_span(self) -> float:
        """Growth (V/c) in the limit of cells along the span, less that on the layers of coarse.

        To the mesh that is finer in both directions from that with its cells in the plane, and from
        there to the limit as with the cells of ``coarse``.
        """
        both, mesh = self.finer_in_both.value, self.finer_in_both.mesh
        change = both - _on(self.in_plane, mesh).value
        return change + self.along_span.limit.value - _on(self.along_span, mesh).value

    @property
    def limit(self) -> tuple[float, float]:
        """Growth (V/c) in the limit of both directions, and half of its interval."""
        errors = (
            self.in_plane.limit.half_width,
            self.along_span.limit.half_width,
            self.finer_in_both.half_width,
            _on(self.in_plane, self.finer_in_both.mesh).half_width,
            SAFETY_WITHOUT_ORDER * self.missed,
        )
        return self.in_plane.limit.value + self.left_along_span, math.hypot(*errors)


def _on(series: MeshSeries, mesh: str) -> MeshValue:
    return next(value for value in series.values if value.mesh == mesh)


@dataclass(frozen=True)
class ReleasesByDirection:
    """Releases from equilibrium of the plate on every mesh, and of the sections on its cells.

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
        """Return those among releases from equilibrium on any meshes of one mesher."""
        return cls(
            tuple(one for one in releases if one.model == "3d"),
            tuple(
                one
                for one in releases
                if one.model in SECTIONS and one.mesh.startswith(ON_CELLS_OF_PLATE)
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
        values = self._named(k_star, _OF_SPAN)
        by_layers = (replace(one, cells=PRESETS[_OF_SPAN[one.mesh]].plate_layers) for one in values)
        return MeshSeries(GROWTH, "3d", f"k* = {k_star:g}", ALONG_SPAN, 1, tuple(by_layers))

    def in_plane(self, k_star: float) -> MeshSeries:
        """Return the plate's growth on meshes that are finer in the plane alone."""
        values = self._named(k_star, _OF_PLANE)
        there = (replace(one, cells=PRESETS[ON_CELLS_OF_PLATE + one.mesh].cells) for one in values)
        return MeshSeries(GROWTH, "3d", f"k* = {k_star:g}", IN_PLANE, 2, tuple(there))

    def _named(self, k_star: float, meshes: Mapping[str, str]) -> list[MeshValue]:
        """Return the plate's growth on meshes, by the names that these have in one direction."""
        of_plate = self.of_plate(k_star)
        return [
            replace(of_plate[mesh], mesh=name) for name, mesh in meshes.items() if mesh in of_plate
        ]

    def of_section(self, k_star: float, model: str) -> MeshSeries:
        """Return a section's growth on the cells that the plate's meshes have in the plane."""
        values = (
            replace(early_growth(one), mesh=one.mesh.removeprefix(ON_CELLS_OF_PLATE))
            for one in self.sections
            if (one.model, one.case.k_star) == (model, k_star)
        )
        return MeshSeries(GROWTH, model, f"k* = {k_star:g}", IN_PLANE, 2, tuple(values))

    def series(self) -> Iterator[MeshSeries]:
        """Yield the growth in either direction at each k* that has it on two meshes or more."""
        for k_star in self.k_star:
            found = [self.along_span(k_star), self.in_plane(k_star)]
            found += [self.of_section(k_star, model) for model in SECTIONS]
            yield from (one for one in found if len(one.values) > 1)

    def growths(self) -> Iterator[GrowthByDirection]:
        """Yield the growth at each k* that has a release on every mesh that a limit rests on."""
        for k_star in self.k_star:
            both = self.of_plate(k_star).get(_OF_BOTH)
            along, plane = self.along_span(k_star), self.in_plane(k_star)
            there = [{value.mesh for value in one.values} for one in (along, plane)]
            if (
                both is not None
                and all({"coarse", _OF_BOTH} <= one for one in there)
                and min(map(len, there)) >= FEWEST
            ):
                yield GrowthByDirection(k_star, along, plane, both)


def hidden_in_plane(releases: ReleasesByDirection, k_star: float) -> float:
    """Return by how much (V/c) a section's growth changes where two coarser meshes hide it.

    It is the largest change of a section from medium to fine on the plate's cells in the plane,
    where :func:`hides_error`; else 0.
    """
    found = [0.0]
    for model in SECTIONS:
        series = releases.of_section(k_star, model)
        if hides_error(series):
            found.append(abs(_on(series, "fine").value - _on(series, "medium").value))
    return max(found)


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
        f"limit of the growth {rate:+.4f} +- {half:.4f} V/c at k* = {growth.k_star:g}; along the "
        f"span {growth.left_along_span:+.4f} of it, and both directions' changes miss their sum "
        f"by {growth.missed:+.4f}"
    )
    of_plane = growth.in_plane.limit
    limit = GridLimit(*onset.ends, of_plane.meshes, of_plane.order, "limits of both directions")
    *coarser, finest = (replace(one, note="") for one in of_meshes.values)
    values = (*coarser, replace(finest, note=words))
    yield replace(of_meshes, basis=BY_DIRECTION, values=values, derived=limit)
