"""Known loads of sections of any outline by OpenFOAM, from results that are kept."""

from __future__ import annotations

from functools import cache, partial

from equisection.aerodynamics.derivatives import Derivatives
from equisection.analysis.forced_derivatives import derivatives_of
from equisection.cases import ForcedCase
from equisection.clone import CLONE
from equisection.results.netcdf import read_dataset
from equisection.results.surface import surface_from_dataset
from equisection.store.kept import kept_results
from equisection.validation.known_values import KnownValue, Source

_KEPT = CLONE / "results" / "reference"
_TRIPPED, _LAMINAR = "naca0012/steady/2d/coarse", "naca0012-laminar/steady/2d/coarse"

_LADSON = Source(
    "published",
    "Ladson, NASA TM 4074, 1988: Mach 0.15, Re 6e6, boundary layer tripped by grit 80, c_l "
    "0.4316 at 4.04 deg and -0.4417 at -4.04 deg, in NASA's Turbulence Modeling Resource",
)
_LOCKARD = Source(
    "unconfirmed",
    "Lockard, Luo, Milder and Singer, Journal of Statistical Physics 107, 2002",
)
_THEODORSEN = Source("published", "Theodorsen, NACA Report 496, 1935")
_SOHANKAR = Source(
    "published",
    "Sohankar, Norberg and Davidson, International Journal for Numerical Methods in Fluids 26, "
    "1998, their finest grid, 5 % of blockage, read in a transcript of their tables III and IV",
)
_DENNIS = Source(
    "unconfirmed",
    "Dennis and Chang, Journal of Fluid Mechanics 42, 1970, as others quote them",
)
_DJILALI = Source(
    "published",
    "Djilali, thesis, University of British Columbia, 1987, its abstract in a "
    "catalogue that does not name the author; Reynolds number from the abstract of Djilali and "
    "Gartshore, Journal of Fluids Engineering 113, 1991; blockage of 5.6 % from that of a "
    "large-eddy simulation of the same flow",
)
_SYMMETRY = Source("independent", "symmetry of section and flow")

_MOVED = "Thin plate moved in pitch and heave by OpenFOAM, Re 1.3e5"
#: Reduced velocities V/(f c) of the kept forced motion.
VELOCITIES = (3.0, 4.5, 7.0, 12.0)
#: Motion and load, and the derivatives that are real and imaginary part of it.
LOADS = {
    "lift by heave": (0, 3),
    "lift by pitch": (1, 2),
    "moment by heave": (4, 7),
    "moment by pitch": (5, 6),
}
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


def _reattachment(name: str, thickness: float) -> float:
    """Return the length of the bubble behind the upper leading edge, in thicknesses.

    ``thickness`` is that of the plate over its chord.
    """
    surface = surface_from_dataset(read_dataset(_KEPT / f"{name}.nc"))
    assert surface is not None
    return surface.reattachment("upper") / thickness


def _lift_slope(name: str, incidence_deg: float) -> float:
    """Return dc_l/dalpha (1/deg) between an incidence and its negative."""
    up, down = (kept_load(f"{name}_a{angle:g}", "cl") for angle in (incidence_deg, -incidence_deg))
    return (up - down) / (2 * incidence_deg)


def _negative_over_positive(name: str) -> float:
    """Return c_l at -4 deg over c_l at 4 deg."""
    return kept_load(f"{name}_a-4", "cl") / kept_load(f"{name}_a4", "cl")


@cache
def derivatives_of_moved_plate() -> Derivatives:
    """Return the flutter derivatives of the plate whose forced motion is kept."""
    kept = kept_results(_KEPT / "thin-plate-forced")
    return derivatives_of(
        {
            one.path.stem: (ForcedCase.model_validate(one.case), read_dataset(one.path))
            for one in kept
        }
    ).derivatives


def _size(derivatives: Derivatives, load: str, row: int) -> float:
    """Return |real + i imaginary| of a load in a row."""
    real, imaginary = (float(derivatives.values[row, at]) for at in LOADS[load])
    return abs(complex(real, imaginary))


def _size_of_moved(load: str, row: int) -> float:
    return _size(derivatives_of_moved_plate(), load, row)


def _moved_plate() -> list[KnownValue]:
    """Return the loads of a thin plate in motion: size of each pair of its derivatives."""
    known = Derivatives.theodorsen(VELOCITIES)
    return [
        KnownValue(
            _MOVED,
            f"{load}, V/(f c) = {velocity:g}",
            "-",
            _size(known, load, row),
            _THEODORSEN,
            partial(_size_of_moved, load, row),
            0.05 if load.startswith("lift") else 0.1,
            "coarse mesh, a plate of 2 % thickness with a boundary layer; the moment hangs on "
            "where the lift acts, too",
        )
        for load in LOADS
        for row, velocity in enumerate(VELOCITIES)
        if velocity in (3.0, 12.0)
    ]


def outline_values() -> list[KnownValue]:
    """Return known loads of an airfoil and of thin plates, and the bubble of a blunt one."""
    coarse = "coarse mesh, some 1e4 cells"
    return [
        KnownValue(
            _AIRFOIL,
            "lift slope up to 4 deg",
            "1/deg",
            (0.4316 + 0.4417) / (2 * 4.04),
            _LADSON,
            partial(_lift_slope, _TRIPPED, 4.0),
            0.06,
            "Reynolds number below the experiment's, whose Mach number of 0.15 is 1 % of lift",
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
        *(
            KnownValue(
                "Square cylinder by OpenFOAM, Re 100, laminar",
                quantity,
                "-",
                known,
                _SOHANKAR,
                partial(kept_load, "square-cylinder/steady/2d/coarse_a0", coefficient),
                0.02,
                "C_D of the source's three grids is 1.460 to 1.478; here of 12 periods on one "
                "mesh, whose halves are 1.5 % apart",
            )
            for quantity, known, coefficient in (
                ("mean drag", 1.478, "cd"),
                ("Strouhal number", 0.146, "strouhal"),
            )
        ),
        *(
            KnownValue(
                "Circular cylinder by OpenFOAM, laminar and steady",
                f"drag at Re {reynolds}",
                "-",
                known,
                _DENNIS,
                partial(kept_load, f"{run}/steady/2d/coarse_a0", "cd"),
                0.02,
                f"{coarse}; walls 60 chords away; others have 2.00 to 2.09 and 1.50 to 1.58",
            )
            for reynolds, known, run in (
                (20, 2.045, "circular-cylinder-20"),
                (40, 1.522, "circular-cylinder"),
            )
        ),
        KnownValue(
            "Blunt plate at 0 deg by OpenFOAM, Re 5e4 by its thickness",
            "reattachment, in thicknesses",
            "-",
            4.7,
            _DJILALI,
            partial(_reattachment, "blunt-plate/steady/2d/medium_a0", 0.05),
            0.18,
            "turbulence model of two equations (k-epsilon misses the source by 30 %, to the other "
            "side); blockage of 2 % here; mesh medium, 1.5 % below coarse",
        ),
        *_moved_plate(),
    ]
