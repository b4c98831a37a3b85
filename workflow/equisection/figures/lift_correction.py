"""Lift of section, root and beam over incidence, and the factor c_l/C_L."""

from __future__ import annotations

from pathlib import Path

from matplotlib.figure import Figure

from equisection.figures.load_correction import (
    Coefficient,
    SteadyData,
    draw_correction,
    read_steady,
)

LIFT = Coefficient("cl", "lift_factor", "c_l", "C_L", "lift")


def from_files(polar_2d: Path, polar_3d: Path, correction: Path, resolution: str) -> Figure:
    """Draw ``steady/polar_2d.nc``, ``polar_3d.nc`` and ``correction.nc`` at a resolution."""
    return draw(read_steady(polar_2d, polar_3d, correction, resolution))


def draw(data: SteadyData) -> Figure:
    """Draw the lift (left) and its correction factor (right)."""
    return draw_correction(data, LIFT)
