"""Loads along the span, from the force on each face of the plate.

The function object ``forces`` writes force and moment on each face of its patches, pressure and
friction together; the faces of a layer of cells make a section.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from equisection.errors import SolverError
from equisection.solvers.openfoam.dictionaries import PLATE
from equisection.solvers.openfoam.ranks import parts

#: Names of the function objects.
_FORCES, _CENTRES = "surface", "centres"

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class SpanLoads:
    """Section coefficients along the span, shape (n,).

    Attributes
    ----------
    span
        z/L of the middle of each layer of cells.
    lift, moment
        c_l, and c_m about mid-chord, nose up.
    """

    span: Floats
    lift: Floats
    moment: Floats


def surface_output(control: Mapping[str, Any]) -> dict[str, Any]:
    """Return the function objects that write the force on each face, at times by ``control``."""
    return {
        _FORCES: {
            "type": "forces",
            "libs": ['"libforces.so"'],
            "patches": [PLATE],
            "rho": "rhoInf",
            "rhoInf": 1.0,
            "CofR": (0, 0, 0),
            "writeFields": True,
            "log": False,
            **control,
        },
        _CENTRES: {
            "type": "writeCellCentres",
            "libs": ['"libfieldFunctionObjects.so"'],
            **control,
        },
    }


def read_span_loads(folder: Path, time: str, edges: Floats, *, mean: bool = False) -> SpanLoads:
    """Return the section coefficients at a time of a run.

    Parameters
    ----------
    folder
        The case, divided or not.
    time
        Name of the time.
    edges
        z/c of the planes between the layers of cells, root to tip, shape (n + 1,).
    mean
        True reads the means over time.

    Raises
    ------
    SolverError
        The run wrote no forces on the faces.
    """
    suffix = "Mean" if mean else ""
    lift, moment = np.zeros(edges.size - 1), np.zeros(edges.size - 1)
    for part in parts(folder):
        place = part / time
        z = plate_vectors(part / _last_with(part, "C") / "C")[:, 2]
        force = plate_vectors(place / f"{_FORCES}:force{suffix}")
        torque = plate_vectors(place / f"{_FORCES}:moment{suffix}")
        layer = np.clip(np.searchsorted(edges, z) - 1, 0, lift.size - 1)
        np.add.at(lift, layer, force[:, 1])
        np.add.at(moment, layer, -torque[:, 2])
    size = 0.5 * np.diff(edges)  # q c
    middle = 0.5 * (edges[1:] + edges[:-1]) / edges[-1]
    return SpanLoads(middle, lift / size, moment / size)


def _last_with(part: Path, name: str) -> str:
    times = [path.parent.name for path in part.glob(f"*/{name}")]
    if not times:
        raise SolverError(f"{part}: no field {name}; the run wrote no loads of the plate's faces")
    return max(times, key=float)


def plate_vectors(path: Path) -> Floats:
    """Return the vectors on the plate of a field that OpenFOAM wrote in binary, shape (n, 3).

    Raises
    ------
    SolverError
        The file is missing or holds no such list.
    """
    if not path.is_file():
        raise SolverError(f"{path} is missing; the run wrote no loads of the plate's faces")
    text = path.read_bytes()
    start = text.rfind(b"boundaryField")
    match = re.compile(
        rb"\b" + PLATE.encode() + rb"\s*\{[^}]*?value\s+nonuniform (?:List<vector>\s*)?(\d+)\s*\(?"
    ).search(text, max(start, 0))
    if start < 0 or match is None:
        raise SolverError(f"{path}: no vectors of the patch '{PLATE}' written in binary")
    count = int(match[1])
    values = np.frombuffer(text, dtype=np.float64, count=3 * count, offset=match.end())
    return values.reshape(-1, 3)
