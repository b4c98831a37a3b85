"""Releases of the paper's plate and of its sections that differ in their mesh alone."""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Collection, Iterator, Sequence
from dataclasses import dataclass, replace
from operator import methodcaller
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd

from equisection.aerodynamics.filled_polar import filled, missing_angles
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.strip_polars import StripPolars
from equisection.cases import FREE, STEADY, UnsteadyCase
from equisection.config.groups.openfoam_keys import ON_CELLS_OF_PLATE
from equisection.results.loads_zigzag import loads_zigzag
from equisection.results.netcdf import read_dataset
from equisection.results.unsteady_result import Regime
from equisection.solvers.verdicts import Judge, TipMotion
from equisection.store.judged_again import tip_motion
from equisection.store.kept import Kept, kept_results
from equisection.verdict.growth import MOST_PERIODS, Growth, growth_of

#: Time (c/V) up to which releases are compared, and from which on growth is read: over the first
#: 20 c/V the release itself shows.
UNTIL, BEHIND_RELEASE = 100.0, 20.0
#: Meshes that are similar, coarsest first; others have no place in a series.
MESHES = ("coarse", "medium", "fine", "extra-fine")
#: Time step (c/V) of the releases that are compared, by dimension.
STEPS = {"2d": 0.02, "3d": 0.04}
#: Iterations of a time step of the section's releases: at most, until the residuals are small.
ITERATIONS_OF_SECTION = 8
#: Start of the releases from static equilibrium that are compared, with the twist that disturbs it.
FROM_EQUILIBRIUM = {"state": "equilibrium", "twist_deg": 0.3, "heave_rate": 0.0}
#: Range of the incidence (rad) in which a release of the section moves.
SEEN = (0.0, math.radians(5.0))
#: The section corrected by this project's plate on the section's cells, and what the names of the
#: folders have that its releases are kept in (``config/paper/own_ratios.yaml``).
OWN_RATIOS, _OWN_FOLDER = "2d-corrected, own ratios", "own-ratios"
_MODELS = ("2d", "2d-corrected", "3d")
_OF_MESH = "mesh"
#: Settings that the compared results differ in at most, and that of a mesh around the outline.
_USUAL = {_OF_MESH, "outer_correctors", "velocity_relaxation"}
_OF_OUTLINE = "mesher"


@dataclass(frozen=True, eq=False)
class MeshRelease:
    """A release on one of several similar meshes.

    Attributes
    ----------
    path
        File of the result.
    case
        Its case.
    cells
        Number of cells.
    tip
        Motion of the tip.
    iterations
        Iterations of a time step at most.
    zigzag
        Zigzag of its loads (-); NaN where it is unknown.
    """

    path: Path
    case: UnsteadyCase
    cells: int
    tip: TipMotion
    iterations: int
    zigzag: float

    @property
    def model(self) -> str:
        """Model of the sweep, and which plate corrects it."""
        return _model_of(self.path)

    @property
    def mesh(self) -> str:
        """Name of the mesh."""
        return str(self.case.solver.settings[_OF_MESH])

    @property
    def is_around_outline(self) -> bool:
        """Tell whether the mesh is one around the outline, and not of blocks."""
        return _OF_OUTLINE in self.case.solver.settings

    @property
    def end(self) -> float:
        """End of the history (c/V)."""
        return float(self.tip.time[-1])

    def growth(self, start: float, end: float, waves: int = 3) -> Growth:
        """Return the growth (V/c) over a window (c/V), fitted with so many motions at most."""
        return growth_over(self.case, self.tip, (start, end), waves)

    def behind_release(self, end: float = UNTIL) -> Growth:
        """Return the growth over the last periods before a time, behind the release (c/V)."""
        return growth_behind_release(self.case, self.tip, end)


def growth_over(
    case: UnsteadyCase, tip: TipMotion, window: tuple[float, float], waves: int = 3
) -> Growth:
    """Return the growth (V/c) over a window (c/V), fitted with so many motions at most."""
    natural = np.array(Judge.of(case).waves[:waves])
    return growth_of(tip.time, tip.records[:waves], natural, window)


def growth_behind_release(case: UnsteadyCase, tip: TipMotion, end: float = UNTIL) -> Growth:
    """Return the growth over the last periods before a time (c/V), from 20 c/V on."""
    last = min(end, float(tip.time[-1]))
    start = max(BEHIND_RELEASE, last - MOST_PERIODS / Judge.of(case).natural_frequency)
    return growth_over(case, tip, (start, last))


def mesh_releases(
    reference: Path,
    start: dict[str, Any] | None = None,
    meshes: Collection[str] = MESHES,
    *,
    with_outlines: bool = False,
) -> list[MeshRelease]:
    """Return the kept releases of the plate and its sections on meshes of one family.

    They have the time step of :data:`STEPS`; of several of a model, k*, mesh and number of
    iterations the longest is taken.

    Parameters
    ----------
    reference
        Folder with what is kept.
    start
        Their start, as :data:`FROM_EQUILIBRIUM`; None: from rest, rigid.
    meshes
        Names of the meshes.
    with_outlines
        Whether those on meshes around the outline, which are no family with blocks, are taken too.
    """
    usual = _USUAL | ({_OF_OUTLINE} if with_outlines else set())
    chosen: dict[tuple[Any, ...], MeshRelease] = {}
    for kept in kept_results(reference):  # the longest first
        if not (_is_compared(kept, meshes, usual) and _starts_from(kept.case, start)):
            continue
        settings = kept.case["solver"]["settings"]
        iterations = int(settings["outer_correctors"])
        mesh = settings[_OF_MESH], settings.get(_OF_OUTLINE)
        key = (_model_of(kept.path), kept.case["k_star"], mesh, iterations)
        if key not in chosen:
            chosen[key] = MeshRelease(
                kept.path,
                UnsteadyCase.model_validate(kept.case),
                _cells_of(kept),
                tip_motion(read_dataset(kept.path)),
                iterations,
                loads_zigzag(kept.path, kept.attributes).get("loads_zigzag", math.nan),
            )
    return sorted(
        chosen.values(), key=lambda one: (one.model, one.case.k_star, one.cells, one.iterations)
    )


def alike_sections(
    releases: Sequence[MeshRelease],
) -> Iterator[tuple[float, list[MeshRelease], float]]:
    """Yield each k* that the section has a release at on two meshes, with these and their end.

    The end (c/V) is that of the shortest, up to which they are compared.
    """
    sections = [one for one in releases if one.model == "2d"]
    for k_star in sorted({one.case.k_star for one in sections}):
        alike = [one for one in sections if one.case.k_star == k_star]
        if len(alike) > 1:
            yield k_star, alike, min(one.end for one in alike)


def _is_compared(kept: Kept, meshes: Collection[str], usual: set[str]) -> bool:
    case = kept.case
    if case.get("kind") != FREE.folder or "outline" in case["geometry"]:
        return False
    settings = case["solver"]["settings"]
    if settings.keys() - usual or settings.get(_OF_MESH) not in meshes:
        return False
    if case["time_step"] != STEPS[case["dimension"]]:
        return False
    is_section = case["dimension"] == "2d"
    return kept.path.parent.name in _MODELS and (
        not is_section or settings["outer_correctors"] == ITERATIONS_OF_SECTION
    )


def _starts_from(case: dict[str, Any], start: dict[str, Any] | None) -> bool:
    """Tell whether a case has a start, wherever its equilibrium is."""
    own = case.get("start")
    if own is None or start is None:
        return own is start
    return {name: own.get(name) for name in start} == start


def _model_of(path: Path) -> str:
    """Return the model of a result, by the folders that it is in."""
    return OWN_RATIOS if _OWN_FOLDER in path.parents[2].name else path.parent.name


def cells_of(description: str) -> float:
    """Return the number of cells that a solver's description names; NaN if it names none."""
    found = re.search(r"(\d+) cells", description)
    return float(found[1]) if found else math.nan


def _cells_of(kept: Kept) -> int:
    return int(cells_of(str(kept.attributes["solver_description"])))


def growth_table(
    releases: Sequence[MeshRelease],
    growth_in: Callable[[MeshRelease], Growth] = methodcaller("behind_release"),
) -> pd.DataFrame:
    """Return growth rates of releases with their errors, as ``summary.csv`` has them.

    Parameters
    ----------
    releases
        The releases.
    growth_in
        Growth of one of them; by default that of its last periods, from 20 c/V on.
    """
    rows = []
    for one in releases:
        growth = growth_in(one)
        low, high = growth.interval
        rows.append(
            (one.case.k_star, str(Regime.GROWING), growth.rate, growth.standard_error, low, high)
        )
    columns = ["k_star", "regime", "growth_rate", "growth_standard_error"]
    return pd.DataFrame(rows, columns=[*columns, "growth_low", "growth_high"])


@dataclass(frozen=True)
class MeshLoads:
    """Loads of a rigid body on one mesh.

    Attributes
    ----------
    mesh
        Name of the mesh.
    cells
        Number of its cells.
    incidence_deg
        Incidence (deg).
    loads
        ``cd``, ``cl``, ``cm``.
    path
        File of the result.
    """

    mesh: str
    cells: int
    incidence_deg: float
    loads: dict[str, float]
    path: Path


def rigid_loads(reference: Path, dimension: str) -> list[MeshLoads]:
    """Return the kept steady results of the paper's section (``2d``) or plate (``3d``).

    They are on similar meshes, of the section also on the plate's cells. Those with settings of
    their own, beside mesh and iterations, are left out. Of several at one incidence the first is
    taken, by the folders' names.
    """
    found: dict[tuple[str, float], MeshLoads] = {}
    for kept in kept_results(reference):
        case = kept.case
        if case.get("kind") != STEADY.folder or case.get("dimension") != dimension:
            continue
        settings = case["solver"]["settings"]
        mesh, angle = str(settings.get(_OF_MESH)), float(case["incidence_deg"])
        is_similar = mesh.removeprefix(ON_CELLS_OF_PLATE) in MESHES
        if "outline" in case["geometry"] or settings.keys() - _USUAL or not is_similar:
            continue
        data = read_dataset(kept.path)
        loads = {name: float(data[name]) for name in ("cd", "cl", "cm")}
        found.setdefault((mesh, angle), MeshLoads(mesh, _cells_of(kept), angle, loads, kept.path))
    return sorted(found.values(), key=lambda one: (one.cells, one.incidence_deg))


def is_on_cells_of_plate(loads: MeshLoads) -> bool:
    """Tell whether loads are of the section on the cells that its plate has in the plane."""
    return loads.mesh.startswith(ON_CELLS_OF_PLATE)


def polars_of(loads: list[MeshLoads]) -> dict[str, Polar]:
    """Return the polar of each mesh with four incidences or more, coarsest first.

    One with gaps where a release moves is filled in the shape of the next coarser one.
    """
    found: dict[str, Polar] = {}
    for mesh in dict.fromkeys(one.mesh for one in loads):
        points = [one for one in loads if one.mesh == mesh]
        if len(points) < 4:
            continue
        drag, lift, moment = (
            np.array([one.loads[name] for one in points]) for name in ("cd", "cl", "cm")
        )
        angles = np.radians([one.incidence_deg for one in points])
        polar = Polar(angles, drag, lift, moment, mesh)
        denser = next(reversed(found.values()), None)
        if denser is not None and missing_angles(polar, SEEN):
            polar = replace(filled(polar, denser), label=f"{mesh}, in the shape of {denser.label}")
        found[mesh] = polar
    return found


def strip_polars_of(loads: list[MeshLoads], mesh: str) -> StripPolars:
    """Return the polars along the span of a mesh of the plate."""
    points = [one for one in loads if one.mesh == mesh]
    read = [read_dataset(one.path) for one in points]
    return StripPolars(
        np.radians([one.incidence_deg for one in points]),
        read[0]["span"].values.astype(np.float64),
        np.array([data["cl_section"].values for data in read]),
        np.array([data["cm_section"].values for data in read]),
        mesh,
    )
