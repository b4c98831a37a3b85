"""Section ``embedded``: the solver that needs nothing but Python packages."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from equisection.config.groups.solver_keys import SolverKeys
from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import NULLABLE, NUMBER, WHOLE, Name, NotNegative, Number, Truth

#: Stands in the place of a polar file for thin-plate theory.
FLAT_PLATE = "flat-plate"


class Separation(KeyGroup):
    """Lags of the separation bubble (c/V); the defaults are identified from CFD releases."""

    relaxation: NotNegative = Field(2.37, description="tau_1 of the bubble (c/V).")
    delay: Number = Field(0.46, description="tau_2 of the bubble (c/V); 0 where `relaxation` is 0.")
    lift_lag: NotNegative = Field(0.59, description="tau_3 of the lift behind the bubble (c/V).")


#: The sweep that is kept, and the k* of its section that the lags are fitted to.
_KEPT = "results/reference/paper-plate-openfoam/unsteady"
_FITTED_TO = ("5", "10")
_K_STAR = ("4", "4.5", "5", "5.5", "6.44", "7.5", "8.5", "10", "14", "21")


class Identification(KeyGroup):
    """CFD releases behind the lags; `snakemake identification` identifies them again."""

    fitted_to: Annotated[tuple[str, ...], Field(min_length=1)] = Field(
        tuple(f"{_KEPT}/2d/k{k_star}.nc" for k_star in _FITTED_TO),
        description="Releases of the section that the lags are fitted to: results of unsteady "
        "cases (NetCDF files).",
    )
    judged_on: tuple[str, ...] = Field(
        (
            *(f"{_KEPT}/2d/k{k_star}.nc" for k_star in _K_STAR if k_star not in _FITTED_TO),
            *(f"{_KEPT}/2d-corrected/k{k_star}.nc" for k_star in _K_STAR),
        ),
        description="Releases that the fitted model is judged on and never sees (the same).",
    )


class Columns(KeyGroup):
    """Names of a CSV file's columns, where they are not the usual ones; empty for those that are.

    A file of another format has its own.
    """

    incidence_deg: str = Field(
        "", description="Column of the incidence (deg); by itself `incidence_deg`, `alpha`, `AoA`."
    )
    cl: str = Field("", description="Column of the lift coefficient; by itself `cl`, `C_L`.")
    cm: str = Field("", description="Column of the moment coefficient; by itself `cm`, `C_M`.")
    cd: str = Field("", description="Column of the drag coefficient; by itself `cd`, `C_D`.")

    @property
    def given(self) -> dict[str, str]:
        """Names that are given, by quantity."""
        return {quantity: name for quantity, name in self.model_dump().items() if name}


class Embedded(SolverKeys):
    """The embedded solver."""

    polars: Annotated[dict[Name, Annotated[str, Field(min_length=1)]], Field(min_length=1)] = Field(
        {"coarse": "config/polars/plate_2d_11136.csv"},
        description="Section polar of each resolution: a CSV file (`incidence_deg,cl,cm,cd`) or "
        "one of XFOIL, XFLR5, QBlade, airfoiltools.com or AeroDyn (`docs/polar-formats.md`; path "
        "from the working directory, or one of the project's), or `flat-plate` for the thin "
        "analytic plate.",
    )
    symmetric: Truth = Field(
        True,
        description="Whether the section is symmetric: its files hold incidences from 0 deg on "
        "and are mirrored. With `false` they are taken as they are, and `steady.incidence_deg` "
        "needs angles on both sides of `flow.incidence_deg`.",
    )
    moment_axis: Annotated[
        Annotated[float, Field(ge=0, le=1, allow_inf_nan=False), NUMBER] | None, NULLABLE
    ] = Field(
        None,
        description="Point that the moments of the polar files are about (x/c from the leading "
        "edge, 0.25 for the quarter chord). With null it is what a file's format says (0.25 for "
        "XFOIL and other programs), else mid-chord, 0.5.",
    )
    columns: Columns = Field(
        Columns(), description="Names of the columns of CSV files that are not the usual ones."
    )
    incidence_point: Annotated[float, Field(ge=0.25, le=0.75, allow_inf_nan=False), NUMBER] = Field(
        0.75,
        description="Point of the chord whose incidence sets the circulation of a section that "
        "moves (x/c from the leading edge): 0.75 of a thin section with a sharp trailing edge. Of "
        "a bluff one it is not known; 0.5 is mid-chord.",
    )
    separation: Separation = Field(Separation(), description="Lags of the separation bubble.")
    identification: Identification = Field(
        Identification(), description="Where the lags come from."
    )
    strips: Annotated[int, Field(ge=4, le=100), WHOLE] = Field(
        20, description="Strips along the span (-)."
    )

    def input_files(self) -> list[str]:
        """Return the files that the solver reads."""
        return [path for path in self.polars.values() if path != FLAT_PLATE]


@check("embedded.separation.delay", "embedded.separation.relaxation")
def _delay_of_a_lag(delay: float, relaxation: float) -> Iterator[Problem]:
    if relaxation == 0 and delay != 0:
        yield Problem(
            "embedded.separation.delay",
            delay,
            "allowed is 0 where relaxation is 0 (a bubble without lag)",
        )
