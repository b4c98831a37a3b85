"""Generalised aerodynamic forces of the beam on its first modes, beside independent strips."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from numpy.typing import NDArray

from equisection.aerodynamics.derivatives import Derivatives
from equisection.aerodynamics.generalised_forces import GeneralisedForces
from equisection.figures.origin import add_provenance
from equisection.figures.panels import legend_above
from equisection.figures.style import COLOURS, GREY, MARKERS, PAGE_WIDTH
from equisection.results.modes_dataset import modes_from_dataset
from equisection.results.netcdf import read_dataset
from equisection.structure.span import gram

#: Points of the lines.
_POINTS = 80


def from_files(forces: Path, table: Path, modes: Path) -> Figure:
    """Draw ``derivatives/3d.csv`` with strips of the loads of ``derivatives/2d.csv``."""
    measured = GeneralisedForces.read(forces)
    found = modes_from_dataset(read_dataset(modes))
    shapes = [found.bending(1).shape[0], found.torsion(1).shape[0]]
    likeness = gram(found.span, np.array(shapes), np.array(shapes))
    return draw(measured, Derivatives.read(table), likeness)


def draw(forces: GeneralisedForces, section: Derivatives, likeness: NDArray[np.float64]) -> Figure:
    """Draw the forces on the first bending and torsion mode by the motion of either.

    Parameters
    ----------
    forces
        Forces on the modes of the beam.
    section
        Derivatives of the section.
    likeness
        Integrals of the products of both shapes over z/L, shape (2, 2).
    """
    figure = Figure(figsize=(PAGE_WIDTH, 4.4))
    panels = figure.subplots(2, 2, sharex=True)
    low, high = (
        max(forces.frequencies[0], section.frequencies[0]),
        min(forces.frequencies[1], section.frequencies[1]),
    )
    omega = np.geomspace(low, high, _POINTS)
    strips = section.influence(omega, forces.axis) * likeness
    places = (0, forces.bending)
    for row in range(2):
        for column in range(2):
            axes, pair = panels[row][column], (places[row], places[column])
            measured = forces.values[:, pair[0], pair[1]]
            spread = None if forces.spread is None else forces.spread[:, pair[0], pair[1]]
            for place, (part, values, line) in enumerate(
                (
                    ("real part", measured.real, strips[:, row, column].real),
                    ("imaginary part", measured.imag, strips[:, row, column].imag),
                )
            ):
                axes.plot(np.pi * 2.0 / omega, line, color=COLOURS[place], label=f"strips, {part}")
                axes.errorbar(
                    forces.reduced_velocity,
                    values,
                    yerr=spread,
                    color=COLOURS[place],
                    marker=MARKERS[place],
                    linestyle="none",
                    label=f"beam, {part}",
                )
            axes.axhline(0.0, color=GREY, linewidth=0.4)
            axes.set_ylabel(f"on {forces.modes[pair[0]]} by {forces.modes[pair[1]]}")
    for axes in panels[1]:
        axes.set_xlabel("$V/(f c)$")
    legend_above(figure, panels[0][0], columns=2)
    add_provenance(figure, "Q of the beam on its first modes, and of strips of the section")
    return figure
