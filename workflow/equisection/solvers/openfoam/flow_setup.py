"""The flow without dimensions: fields at the start, turbulence model, numerical schemes.

Incompressible Reynolds-averaged equations with the k-omega SST model, or laminar ones, walls
resolved. Boundary and initial values are those of a uniform stream of speed 1 and its turbulence,
which a laminar flow does not read.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from equisection.cases import Geometry, Medium
from equisection.config.groups.openfoam_keys import LAMINAR
from equisection.files import write_text
from equisection.solvers.openfoam.case_folder import OF_TURBULENCE
from equisection.solvers.openfoam.dictionaries import PLATE, dictionary
from equisection.solvers.openfoam.stream_turbulence import STREAM, StreamTurbulence


def reynolds_number(geometry: Geometry, medium: Medium) -> float:
    """Return Re = rho V c/mu."""
    return medium.density * medium.speed * geometry.chord / medium.dynamic_viscosity


#: The planes of one layer of cells, between which the flow is two-dimensional.
IN_THE_PLANE: Mapping[str, str] = {"sides": "empty"}


def write_flow(
    folder: Path,
    reynolds: float,
    sides: Mapping[str, str] = IN_THE_PLANE,
    turbulence: StreamTurbulence = STREAM,
) -> None:
    """Write ``constant`` and the fields at time 0; ``sides`` are patches and types along z."""
    viscosity = 1.0 / reynolds
    is_laminar = turbulence.model == LAMINAR
    energy, eddy_viscosity = turbulence.energy, turbulence.viscosity_ratio * viscosity
    for name, entries in (
        ("transportProperties", {"transportModel": "Newtonian", "nu": viscosity}),
        ("turbulenceProperties", _LAMINAR if is_laminar else _REYNOLDS_AVERAGED),
    ):
        write_text(folder / "constant" / name, dictionary(name, entries))
    for name, kind, dimensions, value, on_plate in (
        ("U", "volVectorField", "[0 1 -1 0 0 0 0]", "uniform (1 0 0)", _NO_SLIP),
        ("p", "volScalarField", "[0 2 -2 0 0 0 0]", "uniform 0", {"type": "zeroGradient"}),
        ("k", "volScalarField", "[0 2 -2 0 0 0 0]", f"uniform {energy:.10g}", _NO_TURBULENCE),
        (
            "omega",
            "volScalarField",
            "[0 0 -1 0 0 0 0]",
            f"uniform {energy / eddy_viscosity:.10g}",
            {"type": "omegaWallFunction", "value": "$internalField"},
        ),
        (
            "nut",
            "volScalarField",
            "[0 2 -1 0 0 0 0]",
            f"uniform {eddy_viscosity:.10g}",
            {"type": "nutLowReWallFunction", "value": "uniform 0"},
        ),
    ):
        if is_laminar and name in OF_TURBULENCE:
            continue
        entries = {
            "dimensions": dimensions,
            "internalField": value,
            "boundaryField": _boundary(name, value, on_plate, sides),
        }
        write_text(folder / "0" / name, dictionary(name, entries, kind))


_REYNOLDS_AVERAGED = {
    "simulationType": "RAS",
    "RAS": {"RASModel": "kOmegaSST", "turbulence": True, "printCoeffs": False},
}
_LAMINAR = {"simulationType": "laminar"}
#: A wall that moves with the mesh; where the mesh stands still its velocity stays 0, so that one
#: and the same field serves a steady run and the unsteady one that starts from it.
_NO_SLIP = {"type": "movingWallVelocity", "value": "uniform (0 0 0)"}
_NO_TURBULENCE = {"type": "fixedValue", "value": "uniform 1e-14"}


def _boundary(
    name: str, value: str, on_plate: dict[str, str], sides: Mapping[str, str]
) -> dict[str, Any]:
    inlet: dict[str, str] = {"type": "fixedValue", "value": value}
    outlet: dict[str, str] = {"type": "inletOutlet", "inletValue": value, "value": value}
    if name == "p":
        inlet, outlet = {"type": "zeroGradient"}, {"type": "fixedValue", "value": value}
    if name == "nut":
        inlet = outlet = {"type": "calculated", "value": value}
    return {
        "inlet": inlet,
        "outlet": outlet,
        "floor": {"type": "symmetryPlane"},
        "ceiling": {"type": "symmetryPlane"},
        PLATE: on_plate,
        **{patch: {"type": kind} for patch, kind in sides.items()},
    }


def schemes(*, steady: bool) -> dict[str, Any]:
    """Return ``fvSchemes``: second order in space and, where it matters, in time."""
    bounded = "bounded " if steady else ""
    return {
        "ddtSchemes": {"default": "steadyState" if steady else "backward"},
        "gradSchemes": {
            "default": "Gauss linear",
            "grad(k)": "cellLimited Gauss linear 1",
            "grad(omega)": "cellLimited Gauss linear 1",
        },
        "divSchemes": {
            "default": "none",
            "div(phi,U)": f"{bounded}Gauss linearUpwind grad(U)",
            "div(phi,k)": f"{bounded}Gauss limitedLinear 1",
            "div(phi,omega)": f"{bounded}Gauss limitedLinear 1",
            "div((nuEff*dev2(T(grad(U)))))": "Gauss linear",
        },
        "laplacianSchemes": {"default": "Gauss linear corrected"},
        "interpolationSchemes": {"default": "linear"},
        "snGradSchemes": {"default": "corrected"},
        "wallDist": {"method": "meshWave"},
    }


@dataclass(frozen=True)
class Coupling:
    """Coupling of flow, loads and motion in a time step of PIMPLE.

    Attributes
    ----------
    outer_correctors
        Iterations of flow, loads and motion, at most: they end once :data:`COUPLED` is reached.
    velocity_relaxation
        Under-relaxation of the velocity in each of them, including the last. The iterations then
        converge, where a last one without relaxation would undo it.
    """

    outer_correctors: int = 8
    velocity_relaxation: float = 0.95


#: Initial residuals of velocity and pressure in an iteration after which one more ends the step.
COUPLED = {"U": 1e-5, "p": 5e-3}

_PRESSURE = {"solver": "GAMG", "smoother": "DICGaussSeidel", "tolerance": 1e-7, "relTol": 0.05}
_TRANSPORTED = {
    "solver": "smoothSolver",
    "smoother": "symGaussSeidel",
    "tolerance": 1e-9,
    "relTol": 0.1,
}


def steady_solution() -> dict[str, Any]:
    """Return ``fvSolution`` of a steady flow: SIMPLEC, under-relaxed."""
    return {
        "solvers": {"p": _PRESSURE, '"(U|k|omega)"': _TRANSPORTED},
        "SIMPLE": {"consistent": True, "nNonOrthogonalCorrectors": 0},
        "relaxationFactors": {"equations": {"U": 0.8, "k": 0.7, "omega": 0.7}},
    }


def unsteady_solution(coupling: Coupling = Coupling()) -> dict[str, Any]:
    """Return ``fvSolution`` of an unsteady flow: PIMPLE with SIMPLEC's pressure equation."""
    adjusted = {**_PRESSURE, "tolerance": 1e-4, "relTol": 0}
    last = {**_TRANSPORTED, "relTol": 0.01}
    return {
        "solvers": {
            "p": _PRESSURE,
            "pFinal": {**_PRESSURE, "relTol": 0.01},
            "pcorr": adjusted,
            "pcorrFinal": adjusted,
            "U": _TRANSPORTED,
            # solved in the last iteration alone
            '"(k|omega)"': last,
            '"(U|k|omega)Final"': last,
        },
        "PIMPLE": {
            "momentumPredictor": True,
            "consistent": True,
            "nOuterCorrectors": coupling.outer_correctors,
            "nCorrectors": 1,
            "nNonOrthogonalCorrectors": 0,
            "moveMeshOuterCorrectors": True,
            "correctPhi": False,
            "turbOnFinalIterOnly": True,
            "residualControl": {
                field: {"tolerance": tolerance, "relTol": 0} for field, tolerance in COUPLED.items()
            },
        },
        "relaxationFactors": {
            "equations": {'"U.*"': coupling.velocity_relaxation, '"(k|omega).*"': 1}
        },
    }
