"""OpenFOAM's dictionaries as text, and those that steady and unsteady runs share."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from equisection.files import write_text
from equisection.solvers.openfoam.mesh.block_mesh import Mesh

#: Patch of the section.
PLATE = "plate"
#: Name of the function object of the loads.
LOADS = "loads"
#: While a file of this name is in the case, the program writes its state and ends.
STOP_FILE = "stop"

Entries = Mapping[str, Any]


def dictionary(name: str, entries: Entries, kind: str = "dictionary") -> str:
    """Return the text of a dictionary file.

    Parameters
    ----------
    name
        Name of the file, without its folder.
    entries
        Mappings become sub-dictionaries, sequences lists, ``True`` and ``False`` become ``yes``
        and ``no``; text stays as it is.
    kind
        The file's class in OpenFOAM.
    """
    head = {"version": "2.0", "format": "ascii", "class": kind, "object": name}
    return "\n".join([*_lines({"FoamFile": head}), "", *_lines(entries), ""])


def _lines(entries: Entries, indent: str = "") -> list[str]:
    lines = []
    for key, value in entries.items():
        if isinstance(value, Mapping):
            lines += [f"{indent}{key}", f"{indent}{{", *_lines(value, indent + "    ")]
            lines.append(f"{indent}}}")
        else:
            lines.append(f"{indent}{key} {_value(value)};")
    return lines


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.12g}"
    if isinstance(value, list | tuple):
        return f"({' '.join(map(_value, value))})"
    return str(value)


def write_mesh_dictionary(folder: Path, mesh: Mesh) -> None:
    """Write ``system/blockMeshDict``."""
    write_text(folder / "system" / "blockMeshDict", mesh.block_mesh_dict())


def write_system(folder: Path, control: Entries, schemes: Entries, solution: Entries) -> None:
    """Write the three dictionaries of ``system`` that every program reads."""
    for name, entries in (
        ("controlDict", control),
        ("fvSchemes", schemes),
        ("fvSolution", solution),
    ):
        write_text(folder / "system" / name, dictionary(name, entries))


def control(application: str, end: float, step: float, write_every: float) -> dict[str, Any]:
    """Return ``controlDict``: loads at each step, the state now and then, and a way to stop.

    Parameters
    ----------
    application
        The program.
    end, step
        End and step of time (c/V; iterations in a steady run).
    write_every
        Interval of the states written (c/V or iterations), from which a run goes on.
    """
    steady = application == "simpleFoam"
    return {
        "application": application,
        "startFrom": "latestTime",
        "startTime": 0,
        "stopAt": "endTime",
        "endTime": end,
        "deltaT": step,
        "writeControl": "timeStep" if steady else "runTime",
        "writeInterval": write_every,
        "purgeWrite": 2,
        "writeFormat": "binary",
        "writePrecision": 16,
        "timeFormat": "general",
        "timePrecision": 10,
        "runTimeModifiable": False,
        "functions": {LOADS: _loads(), "stopping": _stopping()},
    }


def _loads() -> dict[str, Any]:
    """Return the loads on the plate, about the centre at rest; pitch is about lift x drag."""
    return {
        "type": "forceCoeffs",
        "libs": ['"libforces.so"'],
        "patches": [PLATE],
        "rho": "rhoInf",
        "rhoInf": 1.0,
        "magUInf": 1.0,
        "lRef": 1.0,
        "Aref": 1.0,
        "CofR": (0, 0, 0),
        "dragDir": (1, 0, 0),
        "liftDir": (0, 1, 0),
        "pitchAxis": (0, 0, -1),
        "log": False,
        "writeControl": "timeStep",
        "writeInterval": 1,
    }


def _stopping() -> dict[str, Any]:
    return {
        "type": "abort",
        "libs": ['"libutilityFunctionObjects.so"'],
        "file": f'"{STOP_FILE}"',
        "action": "writeNow",
    }
