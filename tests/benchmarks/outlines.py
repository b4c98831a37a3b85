"""Meshes of random polygons: how many are sound, and what they cost.

::

    python -m tests.benchmarks.outlines [NUMBER]
"""

from __future__ import annotations

import re
import resource
import sys
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from equisection.beam.outline import outline_of, placed
from equisection.errors import EquisectionError
from equisection.solvers.openfoam import flow_setup as flow
from equisection.solvers.openfoam.dictionaries import control, write_system
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox
from equisection.solvers.openfoam.mesh.outline_mesh import OutlineMesh
from equisection.solvers.openfoam.process import run_program

#: Corners of a polygon, fewest and most, and incidence (deg).
CORNERS, INCIDENCE_DEG = (3, 12), 5.0
CHANNEL = ChannelBox(0.1, 4.0, 5.0, 15.0)


def random_polygon(generator: np.random.Generator) -> NDArray[np.float64]:
    """Return a polygon of random corners around a point, 1 c long and 0.1 to 1 c high."""
    count = generator.integers(*CORNERS, endpoint=True)
    angle = np.sort(generator.uniform(0.0, 2 * np.pi, count))
    radius = generator.uniform(0.3, 1.0, count)
    points = np.stack([radius * np.cos(angle), radius * np.sin(angle)], axis=-1)
    points = np.concatenate([points, points[:1]]) - points.min(axis=0)
    height = generator.uniform(0.1, 1.0)
    return points / points.max(axis=0) * np.array([1.0, height])


def main() -> None:
    """Print a line for each polygon without a sound mesh, and the sums."""
    number = int(sys.argv[1]) if len(sys.argv) > 1 else 200
    generator, installation = np.random.default_rng(1), find()
    sound, refused, cells, oblique = 0, 0, [], []
    for one in range(number):
        points = random_polygon(generator)
        try:
            outline = outline_of(placed(points))
            with tempfile.TemporaryDirectory() as place:
                folder = Path(place)
                mesh = OutlineMesh(
                    outline.as_pairs(),
                    ChannelBox(0.1, 4.0, 5.0, 15.0),
                    np.radians(INCIDENCE_DEG),
                    1.0,
                )
                mesh.write(folder)
                cells.append(int((folder / "log.outline").read_text().split()[0]))
                entries = control("simpleFoam", 1, 1, 1)
                write_system(folder, entries, flow.schemes(steady=True), flow.steady_solution())
                run_program(installation, "checkMesh", folder)
                said = (folder / "log.checkMesh").read_text()
        except EquisectionError as error:
            refused += 1
            print(f"{one}: refused: {error}", flush=True)
            continue
        angle = re.search(r"non-orthogonality Max: (\S+)", said)
        oblique.append(float(angle[1]) if angle else np.nan)
        if "Mesh OK." in said:
            sound += 1
        else:
            faults = [line.strip(" *") for line in said.splitlines() if "***" in line]
            print(f"{one}: not sound: {'; '.join(faults)}", flush=True)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = (used.ru_utime + used.ru_stime) / number
    print(
        f"{sound} of {number} sound, {refused} refused; {np.median(cells):.0f} cells (median), "
        f"{np.max(oblique):.0f} deg oblique at most; {seconds:.1f} "
        f"processor seconds each with checkMesh, {used.ru_maxrss / 1024:.0f} MB at most"
    )


if __name__ == "__main__":
    main()
