"""Modes of a beam in a flow, as a case has them: non-dimensional by density, speed and chord."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from equisection.beam.beam import Beam
from equisection.cases.case import BeamModes, FittedModes
from equisection.structure.fittings import (
    deflection_dashpots,
    imbalances,
    inertias,
    lumped,
    masses,
    twist_dashpots,
)
from equisection.structure.mode_set import ModeSet


def beam_modes_in_flow(
    beam: Beam,
    modes: ModeSet,
    numbers: tuple[int, int],
    *,
    density: float,
    speed: float,
    stiffness_scale: float = 1.0,
) -> BeamModes:
    """Return the first modes of a beam in a flow.

    Parameters
    ----------
    beam
        The beam.
    modes
        Its modes.
    numbers
        Number of modes of bending and of torsion.
    density, speed
        rho (kg/m^3) and V (m/s).
    stiffness_scale
        Factor s of all stiffness; frequencies, and dashpots with them, go with its square root.

    Raises
    ------
    ModesError
        There are fewer modes.
    """
    bending, torsion = modes.bending(numbers[0]), modes.torsion(numbers[1])
    chord, pressure = beam.chord, 0.5 * density
    to_reduced = 2 * math.pi * chord / speed * math.sqrt(stiffness_scale)  # Hz to omega c/V
    return BeamModes(
        span=tuple(modes.span),
        bending_frequency=tuple(to_reduced * bending.frequency),
        bending_shape=tuple(map(tuple, bending.shape)),
        torsion_frequency=tuple(to_reduced * torsion.frequency),
        torsion_shape=tuple(map(tuple, torsion.shape)),
        inertia=beam.inertia_per_length / (pressure * chord**4),
        mass=beam.mass_per_length / (pressure * chord**2),
        imbalance=beam.imbalance_per_length / (pressure * chord**3),
        bending_damping=beam.damping.bending,
        torsion_damping=beam.damping.torsion,
        elastic_axis=beam.elastic_axis,
        fittings=_fitted(
            beam,
            bending,
            torsion,
            pressure=pressure,
            rate=math.sqrt(stiffness_scale) / (pressure * speed * chord),
        ),
    )


def _fitted(
    beam: Beam, bending: ModeSet, torsion: ModeSet, *, pressure: float, rate: float
) -> FittedModes | None:
    """Return lumped masses and dashpots on the modes; None of a beam without.

    ``rate`` is the factor of dashpots per unit span. Another stiffness scale s is the same beam at
    another speed: c* goes with the square root of s.
    """
    if not beam.supports and not beam.lumps:
        return None
    span, f, g = bending.span, torsion.shape, bending.shape
    mass = lumped(span, g, g, masses(beam)).diagonal() * beam.mass_per_length
    inertia = lumped(span, f, f, inertias(beam)).diagonal() * beam.inertia_per_length
    return FittedModes(
        mass=tuple(mass / (pressure * beam.chord**2)),
        inertia=tuple(inertia / (pressure * beam.chord**4)),
        imbalance=_rows(lumped(span, f, g, imbalances(beam)) / (pressure * beam.chord**3)),
        bending_dashpots=_rows(rate * lumped(span, g, g, deflection_dashpots(beam))),
        torsion_dashpots=_rows(rate / beam.chord**2 * lumped(span, f, f, twist_dashpots(beam))),
    )


def _rows(matrix: NDArray[np.float64]) -> tuple[tuple[float, ...], ...]:
    return tuple(map(tuple, matrix))
