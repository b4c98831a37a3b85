"""Fig. 13: lift of section, root and beam over incidence, and the factor c_l/C_L."""

from __future__ import annotations

from matplotlib.figure import Figure

from equisection.figures.load_correction import Coefficient, SteadyData, draw_correction

LIFT = Coefficient("cl", "lift_factor", "c_l", "C_L", "lift")


def draw(data: SteadyData) -> Figure:
    """Draw the lift (left) and its correction factor (right)."""
    return draw_correction(data, LIFT)
