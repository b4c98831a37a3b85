"""A case on several ranks of MPI: divided along the span, never put together again.

Loads are summed by the programs themselves, and a run starts from the parts of the one before. So
the files of each rank stay there.
"""

from __future__ import annotations

import math
from pathlib import Path

from equisection.files import write_text
from equisection.solvers.openfoam.case_folder import copy_flow
from equisection.solvers.openfoam.dictionaries import dictionary
from equisection.solvers.openfoam.installation import Installation
from equisection.solvers.openfoam.process import run_program

#: Layers of cells along the span that a rank has at least, before the chord is divided too.
_LAYERS = 4


def divide(installation: Installation, folder: Path, ranks: int, layers: int) -> None:
    """Divide mesh and fields at time 0 among the ranks; with one rank nothing is done.

    Parameters
    ----------
    layers
        Layers of cells along the span. Cuts across it do not part the cells of the boundary
        layer, whose pressures hang together most.

    Raises
    ------
    SolverError
        The program failed.
    """
    if ranks == 1:
        return
    entries = {
        "numberOfSubdomains": ranks,
        "method": "simple",
        "coeffs": {"n": divisions(ranks, layers)},
    }
    write_text(folder / "system" / "decomposeParDict", dictionary("decomposeParDict", entries))
    run_program(installation, "decomposePar", folder)


def divisions(ranks: int, layers: int) -> tuple[int, int, int]:
    """Return the number of parts along x, y and z."""
    most = max(1, layers // _LAYERS)
    along = max(n for n in range(1, ranks + 1) if ranks % n == 0 and n <= most)
    upstream = ranks // along
    across = math.gcd(upstream, 2) if upstream > 8 else 1
    return upstream // across, across, along


def parts(folder: Path) -> list[Path]:
    """Return the folders with the states of each rank; the case itself, if it is not divided."""
    return sorted(folder.glob("processor*")) or [folder]


def copy_flow_of_all(source: Path, target: Path) -> None:
    """Copy the mesh and the last state of a run to time 0 of another, on all ranks."""
    for part in parts(source):
        copy_flow(part, target / part.relative_to(source))
    if parts(source) != [source]:
        for path in [*source.glob("constant/*Properties"), source / "system/decomposeParDict"]:
            write_text(target / path.relative_to(source), path.read_text(encoding="ascii"))
