"""Result of a steady case: coefficients of the section or of the rigid beam."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from equisection.results.fluctuation import Fluctuation
from equisection.results.plate_surface import PlateSurface
from equisection.results.spent import Spent
from equisection.results.surface import SectionSurface
from equisection.results.tip_flow import TipFlow

if TYPE_CHECKING:
    from equisection.cases import SteadyCase


@dataclass(frozen=True)
class SteadyResult:
    """Coefficients at one incidence; for a beam also those along the span.

    Attributes
    ----------
    drag, lift, moment
        c_d, c_l, c_m about mid-chord (Eq. 21), or C_D, C_L, C_M (Eq. 22).
    span
        z/L of the sections, shape (n,); empty in 2D.
    section_lift, section_moment
        c_l and c_m of each section over its own chord, shape (n,); empty in 2D.
    method
        Origin of the value, for instance ``steady`` or ``mean of unsteady``.
    failure
        Reason for a missing value, with coefficients that are NaN; else empty.
    surface
        Pressure and friction around the section or over the plate, where the solver has them.
    tip_flow
        Flow near the tip, where the solver has it.
    spent
        Time that the case took, where the solver knows it better than its job.
    fluctuation
        Fluctuation of the loads about their means, where these are those of an unsteady flow.
    """

    drag: float
    lift: float
    moment: float
    span: NDArray[np.float64]
    section_lift: NDArray[np.float64]
    section_moment: NDArray[np.float64]
    method: str
    failure: str = ""
    surface: SectionSurface | PlateSurface | None = None
    tip_flow: TipFlow | None = None
    spent: Spent | None = None
    fluctuation: Fluctuation | None = None

    @classmethod
    def without_value(cls, reason: str) -> SteadyResult:
        """Return the result of a case that has none, with its reason."""
        nothing = np.empty(0)
        return cls(math.nan, math.nan, math.nan, nothing, nothing, nothing, "none", failure=reason)

    def of_case(self, case: SteadyCase) -> xr.Dataset:
        """Return the data set that is written to the file of a case."""
        del case
        return self.to_dataset()

    def to_dataset(self) -> xr.Dataset:
        """Return the data set that is written to file."""
        data = {
            "cd": ((), self.drag, {"units": "1", "long_name": "drag coefficient"}),
            "cl": ((), self.lift, {"units": "1", "long_name": "lift coefficient"}),
            "cm": (
                (),
                self.moment,
                {"units": "1", "long_name": "moment coefficient about mid-chord, nose up"},
            ),
        }
        if self.failure:
            for _, _, attributes in data.values():
                attributes["missing_allowed"] = "1"
        coordinates = {}
        if self.span.size:
            coordinates["span"] = (
                "span",
                self.span,
                {"units": "1", "long_name": "position along the span z/L"},
            )
            data["cl_section"] = (
                ("span",),  # type: ignore[assignment]
                self.section_lift,
                {"units": "1", "long_name": "sectional lift coefficient"},
            )
            data["cm_section"] = (
                ("span",),  # type: ignore[assignment]
                self.section_moment,
                {"units": "1", "long_name": "sectional moment coefficient about mid-chord"},
            )
        if self.fluctuation is not None:
            data |= self.fluctuation.variables()
        if self.surface is not None:
            data |= self.surface.variables()  # type: ignore[arg-type]
        attributes = {"method": self.method, "failure": self.failure}
        dataset = xr.Dataset(data, coordinates, attrs=attributes)
        return self.tip_flow.with_dataset(dataset) if self.tip_flow is not None else dataset
