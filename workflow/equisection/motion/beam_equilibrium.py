"""Static equilibrium of a beam in the steady loads along the span of the rigid beam.

The strips of the beam have the loads of the rigid beam at their stations, each at its own
incidence. So the finite span is in them as it is without a twist; what the twist itself induces is
left out.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.learnt_strips import LearntStrips
from equisection.aerodynamics.strip_polars import StripPolars
from equisection.motion.beams import BeamParameters
from equisection.motion.learnt_beams import LearntBeams

Floats = NDArray[np.float64]


def beam_in_equilibrium(
    beam: BeamParameters, polars: StripPolars, incidence_rad: float
) -> Floats | None:
    """Position of the modes of a beam in equilibrium on the branch from rest, shape (n_t + n_b,).

    Theta of the torsion modes (rad), then W/c of the bending modes. None beyond the end of the
    branch (:meth:`equisection.motion.learnt_beams.LearntBeams.equilibria`), and where the polars do
    not cover theta_0.

    Parameters
    ----------
    beam
        Modes of one beam in its flow, at the strips of the polars.
    polars
        Steady loads along the span of the rigid beam.
    incidence_rad
        Rigid incidence theta_0 (rad).
    """
    low, high = polars.incidence_range
    if not low <= incidence_rad <= high:
        return None
    loads = LearntStrips.of_steady_loads(polars, incidence_rad)
    found = LearntBeams(beam, loads).equilibria()[0]
    return found if np.isfinite(found).all() else None
