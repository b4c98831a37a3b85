"""Meshes of random polygons: how many are sound, and what they cost.

Every polygon without a sound mesh is named on the error output, with the reason.
"""

from __future__ import annotations

import re
import resource
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.beam.outline import outline_of, placed
from equisection.errors import EquisectionError
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.dictionaries import control, write_system
from equisection.solvers.openfoam.installation import Installation, find
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox
from equisection.solvers.openfoam.mesh.outline_mesh import LOG, OutlineMesh
from equisection.solvers.openfoam.section.rigid_section import check_mesh
from tests.benchmarks.measure import Row, limit, processor_seconds

#: Number of polygons, and of those that are to have a sound mesh.
POLYGONS, WANTED = 200, 195
#: Corners of a polygon, fewest and most, incidence (deg), and channel.
CORNERS, INCIDENCE_DEG = (3, 12), 5.0
CHANNEL = ChannelBox(0.1, 4.0, 5.0, 15.0)
#: Processor seconds and megabytes of a mesh, at the most.
SECONDS, MEGABYTES = 5.0, 400.0


def random_polygon(generator: np.random.Generator) -> NDArray[np.float64]:
    """Return a polygon of random corners around a point, 1 c long and 0.1 to 1 c high."""
    count = generator.integers(*CORNERS, endpoint=True)
    angle = np.sort(generator.uniform(0.0, 2 * np.pi, count))
    radius = generator.uniform(0.3, 1.0, count)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
    points = np.concatenate([points, points[:1]]) - points.min(axis=0)
    height = generator.uniform(0.1, 1.0)
    return points / points.max(axis=0) * np.array([1.0, height])


def cells_of(installation: Installation, points: NDArray[np.float64], folder: Path) -> int:
    """Return the number of cells of a mesh that ``checkMesh`` finds sound."""
    outline = outline_of(placed(points))
    OutlineMesh(outline.as_pairs(), CHANNEL, np.radians(INCIDENCE_DEG), 1.0).write(folder)
    entries = control("simpleFoam", 1, 1, 1)
    write_system(folder, entries, flow.schemes(steady=True), flow.steady_solution())
    check_mesh(installation, folder)
    found = re.match(r"\d+", (folder / LOG).read_text().splitlines()[-1])
    assert found
    return int(found[0])


def rows(polygons: int = POLYGONS) -> Iterator[Row]:
    """Yield number of sound meshes, their cells, and what the dearest mesh takes."""
    generator, installation = np.random.default_rng(1), find()
    cells, seconds = [], []
    for number in range(polygons):
        points = random_polygon(generator)
        before = processor_seconds()
        with tempfile.TemporaryDirectory() as place:
            try:
                cells.append(cells_of(installation, points, Path(place)))
            except EquisectionError as error:
                print(f"polygon {number}: {error}", file=sys.stderr, flush=True)
        seconds.append(processor_seconds() - before)
    least = WANTED * polygons // POLYGONS
    sound = f"{len(cells)} of {polygons}"
    yield Row("random polygons with a sound mesh", sound, f">= {least}", len(cells) >= least)
    yield Row("cells", f"{np.min(cells)} to {np.max(cells)}, median {np.median(cells):.0f}")
    yield limit("mesh and check of one, median", float(np.median(seconds)), SECONDS, "processor s")
    memory = resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss / 1024
    yield limit("memory of one, most", memory, MEGABYTES, "MB")
