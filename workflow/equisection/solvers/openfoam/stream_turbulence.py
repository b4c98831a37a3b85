"""Turbulence of the stream at the inlet, and what is left of it at the plate.

At the inlet k = 3/2 (I V)^2 and omega = k/nu_t. In a uniform stream without walls the k-omega SST
model has its outer constants, and both decay along the stream by

    V k' = -beta* omega k,    V omega' = -beta omega^2,

so that omega = omega_0/(1 + beta omega_0 x/V) and k = k_0 (1 + beta omega_0 x/V)^(-beta*/beta)
(Menter 1994, AIAA J. 32, 1598; Spalart and Rumsey 2007, AIAA J. 45, 2544, Eqs. 5 and 6). A high
intensity at the inlet with a low viscosity ratio is gone before it reaches the plate.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from equisection.config.groups.openfoam_keys import (
    SST,
    TURBULENCE_INTENSITY,
    VISCOSITY_RATIO,
)

#: Constants beta* and beta of the SST model away from walls (Menter 1994).
DISSIPATION_OF_K, DISSIPATION_OF_OMEGA = 0.09, 0.0828


@dataclass(frozen=True)
class StreamTurbulence:
    """Turbulence of the stream at the inlet, and the model of the flow's turbulence.

    Attributes
    ----------
    model
        Model; a laminar one has no use for the rest.
    intensity
        I, rms velocity over V (-).
    viscosity_ratio
        Eddy viscosity over viscosity, nu_t/nu (-).
    """

    model: str = SST
    intensity: float = TURBULENCE_INTENSITY
    viscosity_ratio: float = VISCOSITY_RATIO

    @property
    def energy(self) -> float:
        """k/V^2 (-)."""
        return 1.5 * self.intensity**2

    def frequency(self, viscosity: float) -> float:
        """Return omega c/V (-) of a viscosity nu/(V c) (-)."""
        return self.energy / (self.viscosity_ratio * viscosity)

    def after(self, distance: float, viscosity: float) -> StreamTurbulence:
        """Return the turbulence of the uniform stream a distance (chords) behind the inlet."""
        omega = self.frequency(viscosity)
        slowed = 1.0 + DISSIPATION_OF_OMEGA * omega * distance
        energy = self.energy * slowed ** (-DISSIPATION_OF_K / DISSIPATION_OF_OMEGA)
        return StreamTurbulence(
            self.model,
            math.sqrt(energy / 1.5),
            energy * slowed / (omega * viscosity),
        )


#: That of a stream of which nothing else is said.
STREAM = StreamTurbulence()
