"""Meshes of outlines: how many of random polygons are sound, what they cost, how far to trust them.

Random polygons; the outlines of the examples at rest, and turned by 10 deg half a chord up; the
rectangle of the paper on its three meshes; and the time that an airfoil takes from its digits to a
verdict. Every polygon without a sound mesh is named on the error output, with the reason.
"""

from __future__ import annotations

import math
import re
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.beam.outline import Outline, outline_of, placed
from equisection.errors import EquisectionError
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.dictionaries import control, write_system
from equisection.solvers.openfoam.installation import Installation, find
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox
from equisection.solvers.openfoam.mesh.mesh_quality import MorphingMesh
from equisection.solvers.openfoam.mesh.outline_mesh import LOG, OutlineMesh
from equisection.solvers.openfoam.mesh.presets import PRESETS
from equisection.solvers.openfoam.rigid_flow import WINDOW
from equisection.solvers.openfoam.section.free_section import SectionRun
from equisection.solvers.openfoam.section.overset_section import OversetRun
from equisection.solvers.openfoam.section.rigid_section import (
    check_mesh,
    outline_mesh_of,
    rigid_loads,
)
from tests.benchmarks.measure import (
    Row,
    limit,
    measured,
    most_megabytes,
    processor_seconds,
)
from tests.sample_cases import STEADY, UNSTEADY
from tests.sample_outlines import EXAMPLES, SHAPES
from tests.watching import nothing
from tests.workflow.project import ROOT

#: Number of polygons, and of those that are to have a sound mesh.
POLYGONS, WANTED = 200, 195
#: Corners of a polygon, fewest and most, incidence (deg), and channel.
CORNERS, INCIDENCE_DEG = (3, 12), 5.0
CHANNEL = ChannelBox(0.1, 4.0, 5.0, 15.0)
#: Processor seconds and megabytes of a mesh, at the most.
SECONDS, MEGABYTES = 5.0, 400.0
#: Twist (deg) and deflection (chords) at which the examples' meshes are to be sound.
TWIST_DEG, DEFLECTION = 10.0, 0.5
#: Incidence of the rectangle (deg), and the range of its loads over the meshes (%), at the most.
RECTANGLE_DEG, RANGE = 2.5, 1.0
#: Outlines and incidences (deg) whose loads on overset meshes are compared.
OVERSET_LOADS = (("rectangle", 2.5), ("naca 0012", 4.0))
#: Test that leads an airfoil from its digits to a verdict, and the seconds that it may take.
TO_VERDICT = "tests/openfoam/test_outline.py::test_airfoil_from_digits_to_verdict"
VERDICT_SECONDS = 90.0


def random_polygon(generator: np.random.Generator) -> NDArray[np.float64]:
    """Return a polygon of random corners around a point, 1 c long and 0.1 to 1 c high."""
    count = generator.integers(*CORNERS, endpoint=True)
    angle = np.sort(generator.uniform(0.0, 2 * np.pi, count))
    radius = generator.uniform(0.3, 1.0, count)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
    points = np.concatenate([points, points[:1]]) - points.min(axis=0)
    height = generator.uniform(0.1, 1.0)
    return points / points.max(axis=0) * np.array([1.0, height])


def cells_of(installation: Installation, outline: Outline, folder: Path) -> int:
    """Return the number of cells of a mesh that ``checkMesh`` finds sound."""
    OutlineMesh(outline.as_pairs(), CHANNEL, np.radians(INCIDENCE_DEG), 1.0).write(folder)
    return checked(installation, folder)


def checked(installation: Installation, folder: Path) -> int:
    """Have ``checkMesh`` find the mesh of an outline sound; return its number of cells."""
    entries = control("simpleFoam", 1, 1, 1)
    write_system(folder, entries, flow.schemes(steady=True), flow.steady_solution())
    check_mesh(installation, folder)
    found = re.match(r"\d+", (folder / LOG).read_text().splitlines()[-1])
    assert found
    return int(found[0])


def rows(polygons: int = POLYGONS) -> Iterator[Row]:
    """Yield the rows, those of the random polygons last."""
    installation = find()
    yield from _moved(installation)
    yield from _on_three_meshes(installation)
    yield from overset(installation)
    command = [sys.executable, "-m", "pytest", "-q", TO_VERDICT]
    cost = measured(command, ROOT)
    yield limit("airfoil from digits to verdict", cost.processor_seconds, VERDICT_SECONDS, "s")
    yield Row("the same by the clock of this machine", f"{cost.seconds:.3g} s")
    yield from _random(installation, polygons)


def _moved(installation: Installation) -> Iterator[Row]:
    """Yield whether the examples' meshes are sound at rest and where the section has moved."""
    for name in EXAMPLES:
        before = processor_seconds()
        with tempfile.TemporaryDirectory() as place:
            rest = Path(place) / "rest"
            cells = cells_of(installation, SHAPES[name], rest)
            seconds = processor_seconds() - before
            moving = MorphingMesh(installation, rest, CHANNEL.height)
            twist = math.radians(TWIST_DEG)
            found = moving.along(twist, DEFLECTION, 1, Path(place) / "moved")[-1]
        yield limit(f"{name}, {cells} cells: mesh and check", seconds, SECONDS, "processor s")
        yield Row(
            f"{name}, {TWIST_DEG:g} deg and {DEFLECTION:g} c on",
            found.faults or f"sound, {found.non_orthogonality_deg:.0f} deg oblique at most",
            "sound",
            not found.faults,
        )


def _on_three_meshes(installation: Installation) -> Iterator[Row]:
    """Yield the loads of the paper's rectangle on three meshes, and their ranges."""
    case = STEADY.model_copy(update={"incidence_deg": RECTANGLE_DEG})
    found = []
    for name in ("coarse", "medium", "fine"):
        mesh = outline_mesh_of(case, PRESETS[name].refinement)
        with tempfile.TemporaryDirectory() as place:
            loads = rigid_loads(
                installation, case, mesh, Path(place), nothing, coupling=flow.Coupling()
            )
        found.append((loads.lift, loads.moment))
        yield Row(
            f"rectangle, {RECTANGLE_DEG:g} deg, {name}: c_l, c_m, c_d",
            f"{loads.lift:.4f}, {loads.moment:.4f}, {loads.drag:.4f}; {loads.method}",
        )
    for what, values in zip(("c_l", "c_m"), np.transpose(found), strict=True):
        apart = 100.0 * float(np.ptp(values) / np.mean(values))
        yield limit(f"range of {what} over the three", apart, RANGE, "%")


def overset(installation: Installation) -> Iterator[Row]:
    """Yield steady loads on overset meshes and on the one mesh of as fine cells."""
    for name, incidence_deg in OVERSET_LOADS:
        geometry = UNSTEADY.geometry.model_copy(update={"outline": SHAPES[name].as_pairs()})
        given = {"incidence_deg": incidence_deg, "geometry": geometry}
        mesh = outline_mesh_of(case := UNSTEADY.model_copy(update=given), 1.0)
        for kind in (SectionRun, OversetRun):
            before = processor_seconds()
            with tempfile.TemporaryDirectory() as place:
                run = kind(installation, case, mesh, flow.Coupling(), Path(place))
                _, loads, _ = run.steady(nothing)
            drag, lift, moment = loads.last(WINDOW // 3).means()
            on = "one mesh" if kind is SectionRun else "overset"
            yield Row(
                f"{name}, {incidence_deg:g} deg, coarse, {on}: c_l, c_m, c_d",
                f"{lift:.4f}, {moment:.4f}, {drag:.4f}; {loads.time.size} iterations, "
                f"{processor_seconds() - before:.0f} processor s",
            )


def _random(installation: Installation, polygons: int) -> Iterator[Row]:
    """Yield number of sound meshes of polygons, their cells, and what the dearest mesh takes."""
    generator = np.random.default_rng(1)
    cells, seconds = [], []
    for number in range(polygons):
        points = random_polygon(generator)
        before = processor_seconds()
        with tempfile.TemporaryDirectory() as place:
            try:
                cells.append(cells_of(installation, outline_of(placed(points)), Path(place)))
            except EquisectionError as error:
                print(f"polygon {number}: {error}", file=sys.stderr, flush=True)
        seconds.append(processor_seconds() - before)
    least = WANTED * polygons // POLYGONS
    sound = f"{len(cells)} of {polygons}"
    yield Row("random polygons with a sound mesh", sound, f">= {least}", len(cells) >= least)
    yield Row("cells", f"{np.min(cells)} to {np.max(cells)}, median {np.median(cells):.0f}")
    yield limit("mesh and check of one, median", float(np.median(seconds)), SECONDS, "processor s")
    yield limit("memory of one, most", most_megabytes(), MEGABYTES, "MB")
