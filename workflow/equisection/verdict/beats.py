r"""Beats of a motion with what its own loads do not make, such as vortices near its frequency.

Two lasting motions of amplitudes 1 and r, whose frequencies are Δω apart, are one motion of the
complex amplitude z(s) = 1 + r exp(iφ), φ = Δω s, and of the rate

    λ = z'/z,    λ' = i Δω λ/z,    |λ'| ≥ Δω |λ|/(1 + r).

So the falling half of a beat, however well it passes for a decay, has a rate that drifts: over a
window T by D = |λ'| T ≥ |Re λ| Δω T/(1 + r), in frequency where it falls the fastest. The rate of a
decay stays. A run is not ended by a fall whose rate drifts by more than 0.6 of itself, which is a
tenth of a beat in the window, or two tenths of one with vortices as strong as the motion. At its
end more is asked, since the ringing of the release drifts, too. The twist obeys I (λ' + λ² + ω_0²) z = R z with the load R on the twist over the twist,
and so R/(2 i ω_0 I) = λ - i ω_0 nearly: the rate differs from that of the body in vacuum by what
the loads make. Loads that follow the motion keep R; vortices turn against it and change R. A drift
is a beat if it is a third of the rate or more, which may then have another sign in the beat, and a
quarter of λ - i ω_0 or more: the loads on the twist are not those of its motion alone. A frequency
that goes with the amplitude drifts by less.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

# Parts of the rate and of what the loads make of it, from which on a drift is a beat.
_OF_RATE, _OF_LOADS = 1.0 / 3.0, 0.25
# Part of the rate from which on a drift lets no run end.
_TOO_MUCH = 0.6


@dataclass(frozen=True)
class Drift:
    """Drift of the complex rate sigma + i omega of a motion over its window.

    Attributes
    ----------
    change
        Change D of the rate from the start of the window to its end, its modulus (V/c).
    error
        Its standard error (V/c).
    by_loads
        Distance of the rate to that of the body in vacuum, its modulus (V/c).
    """

    change: float = math.nan
    error: float = math.nan
    by_loads: float = math.nan

    def is_fast(self, rate: float) -> bool:
        """Tell whether a growth (V/c) drifts too fast to end a run by it."""
        return self.change > self.error and self.change >= _TOO_MUCH * abs(rate)

    def beats(self, rate: float) -> bool:
        """Tell whether a growth (V/c) may be no more than a part of a beat."""
        return (
            self.change > self.error
            and self.change >= _OF_RATE * abs(rate)
            and self.change >= _OF_LOADS * self.by_loads
        )

    def unknown(self, rate: float) -> float:
        """Half-width of what a beat leaves unknown of a decay (V/c), at least all of it.

        0 of a growth: it changes with its amplitude, too, and calls no speed stable.
        """
        return max(0.5 * self.change, abs(rate)) if rate < 0.0 and self.beats(rate) else 0.0

    @property
    def words(self) -> str:
        """Drift in words."""
        part = 100.0 * self.change / self.by_loads
        return (
            f"the complex rate drifts by {self.change:.2g} V/c in its window, {part:.0f} % of what "
            "the loads make of it, as where vortices beat with the motion"
        )
