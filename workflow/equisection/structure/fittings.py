r"""Lumped masses and dashpots of a beam on its modes.

What sits at the places s_p along the span adds

    sum over p of a_p h_i(s_p) h_j(s_p)

to the integral of h_i h_j over z/L, with a_p the mass, the inertia, the imbalance or the dashpot of
the place over the length of the beam.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from equisection.beam.beam import Beam

Floats = NDArray[np.float64]
#: Places z/L and what is there.
Places = Sequence[tuple[float, float]]


def lumped(span: Floats, first: Floats, second: Floats, places: Places) -> Floats:
    """Matrix (i, j) of the sums of a_p first_i(s_p) second_j(s_p), in the unit of a.

    Each place has to be among the stations ``span``, as :mod:`.beam_elements` has it.
    """
    total = np.zeros((len(first), len(second)))
    for at, amount in places:
        station = int(np.abs(span - at).argmin())
        total += amount * np.outer(first[:, station], second[:, station])
    return total


def masses(beam: Beam) -> Places:
    """Return masses over the beam's own (-)."""
    whole = beam.mass_per_length * beam.length
    return [(lump.at, lump.mass / whole) for lump in beam.lumps]


def inertias(beam: Beam) -> Places:
    """Return inertias about the elastic axis over the beam's own (-)."""
    whole = beam.inertia_per_length * beam.length
    return [(lump.at, lump.inertia_about_axis / whole) for lump in beam.lumps]


def imbalances(beam: Beam) -> Places:
    """Return static imbalances per unit span (kg)."""
    return [(lump.at, lump.imbalance / beam.length) for lump in beam.lumps]


def deflection_dashpots(beam: Beam) -> Places:
    """Return dashpots of the deflection per unit span (N s/m per m)."""
    return [(s.at, s.deflection_damping / beam.length) for s in beam.supports]


def twist_dashpots(beam: Beam) -> Places:
    """Return dashpots of the twist per unit span (N m s/rad per m)."""
    return [(s.at, s.twist_damping / beam.length) for s in beam.supports]
