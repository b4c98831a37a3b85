"""Section ``quasi_steady``: the solver of linear sections whose loads follow the motion at once."""

from __future__ import annotations

import math

from pydantic import Field

from equisection.config.groups.solver_keys import SolverKeys
from equisection.keys.values import Positive


class QuasiSteady(SolverKeys):
    """The quasi-steady solver, which runs sections alone."""

    lift_slope: Positive = Field(
        2 * math.pi, description="Slope of the section's lift dc_l/dalpha (1/rad)."
    )
