"""Known loads of sections of any outline by OpenFOAM, from results that are kept."""

from __future__ import annotations

from functools import partial
from pathlib import Path

from equisection.results.netcdf import read_dataset
from equisection.validation.known_values import KnownValue, Source

_KEPT = Path(__file__).parents[3] / "results" / "reference"
_TRIPPED, _LAMINAR = "naca0012/steady/2d/coarse", "naca0012-laminar/steady/2d/coarse"

_LADSON = Source(
    "published",
    "Ladson, NASA TM 4074, 1988: Mach 0.15, Re 6e6, boundary layer tripped by grit 80, c_l of "
    "0.4316 at 4.04 deg and -0.4417 at -4.04 deg, read in a copy of the data in NASA's Turbulence "
    "Modeling Resource",
)
_LOCKARD = Source(
    "unconfirmed",
    "Lockard, Luo, Milder and Singer, Journal of Statistical Physics 107, 2002, by CFL3D (0.1741) "
    "and PowerFLOW (0.1717)",
)
_SYMMETRY = Source("independent", "symmetry of section and flow")

_AIRFOIL, _SLOW = "NACA 0012 by OpenFOAM, Re 3.4e5", "NACA 0012 by OpenFOAM, Re 500, laminar"


def kept_load(name: str, coefficient: str) -> float:
    """Return a coefficient of a kept steady result.

    Parameters
    ----------
    name
        The result below ``results/reference``, without its suffix.
    coefficient
        Its variable.

    Raises
    ------
    ResultFileError
        The result is missing or altered.
    """
    return float(read_dataset(_KEPT / f"{name}.nc")[coefficient])


def _lift_slope(name: str, incidence_deg: float) -> float:
    """Return dc_l/dalpha (1/deg) between an incidence and its negative."""
    up, down = (kept_load(f"{name}_a{angle:g}", "cl") for angle in (incidence_deg, -incidence_deg))
    return (up - down) / (2 * incidence_deg)


def _negative_over_positive(name: str) -> float:
    """Return c_l at -4 deg over c_l at 4 deg."""
    return kept_load(f"{name}_a-4", "cl") / kept_load(f"{name}_a4", "cl")


def outline_values() -> list[KnownValue]:
    """Return known loads of an airfoil."""
    coarse = "coarse mesh, of some 1e4 cells"
    return [
        KnownValue(
            _AIRFOIL,
            "lift slope up to 4 deg",
            "1/deg",
            (0.4316 + 0.4417) / (2 * 4.04),
            _LADSON,
            partial(_lift_slope, _TRIPPED, 4.0),
            0.06,
            "Reynolds number below that of the experiment, and a Mach number of 0.15 there, "
            "which is 1 % of lift",
        ),
        KnownValue(
            _AIRFOIL,
            "c_l at -4 deg over c_l at 4 deg",
            "-",
            -1.0,
            _SYMMETRY,
            partial(_negative_over_positive, _TRIPPED),
            0.01,
            coarse,
        ),
        *(
            KnownValue(
                _SLOW,
                f"c_d at 0 deg, {code}",
                "-",
                known,
                _LOCKARD,
                partial(kept_load, f"{_LAMINAR}_a0", "cd"),
                0.02,
                "difference of the two codes, 1.4 %",
            )
            for code, known in (("CFL3D", 0.1741), ("PowerFLOW", 0.1717))
        ),
    ]
