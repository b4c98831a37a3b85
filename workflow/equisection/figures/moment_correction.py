"""Fig. 14: moment of section, root and beam over incidence, and the factor c_m/C_M."""

from __future__ import annotations

from matplotlib.figure import Figure

from equisection.figures.load_correction import Coefficient, SteadyData, draw_correction

MOMENT = Coefficient("cm", "moment_factor", "c_m", "C_M", "moment about mid-chord")


def draw(data: SteadyData) -> Figure:
    """Draw the moment (left) and its correction factor (right)."""
    return draw_correction(data, MOMENT)
