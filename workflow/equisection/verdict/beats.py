r"""Beats of a motion with what its own loads do not make, such as vortices near its frequency.

Two lasting motions of amplitudes 1 and r, whose frequencies are Δω apart, are one motion of the
complex amplitude z(s) = 1 + r exp(iφ), φ = Δω s, and of the rate

    λ = z'/z,    λ' = i Δω λ/z,    |λ'| ≥ Δω |λ|/(1 + r).

The falling half of a beat may pass for a decay, but its rate drifts, in frequency where it falls
the fastest: over a time T by D = |λ'| T ≥ |Re λ| Δω T/(1 + r). The rate of a decay stays. A D of
0.6 Re λ is a tenth of a beat, or two tenths of one with vortices as strong as the motion.

The ringing of a release drifts, too, and a frequency that goes with the amplitude. The twist obeys
I (λ' + λ² + ω_0²) z = R z with the load R z on the twist, so that R/(2 i ω_0 I) = λ - i ω_0 nearly:
the rate differs from that of the body in vacuum by what the loads make. Loads that follow the
motion keep R, vortices turn against it and change R. So a drift is a beat

- over the last periods, where it is a quarter of λ - i ω_0 or more, the rate may have another sign
  within three times as long, and the whole record is not known to drift less;
- over the whole record, where it is 0.6 of the rate and surely not none.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

# Parts of what the loads make of a rate, and of the rate, from which on a drift is a beat.
_OF_LOADS, _OF_RATE = 0.25, 1.0 / 3.0
# Part of the rate from which on a drift says that a fall does not go on.
_FAST = 0.6
# Standard errors of a drift that is hardly one of chance, and of one that surely is none.
_HARDLY, _SURELY = 2.0, 2.5


@dataclass(frozen=True)
class Drift:
    """Drift of the complex rate sigma + i omega of a motion over a window.

    Attributes
    ----------
    rate
        sigma (V/c).
    change
        Change D of the complex rate from the start of the window to its end, its modulus (V/c).
    error
        Its standard error (V/c).
    by_loads
        Distance of the complex rate to that of the body in vacuum, its modulus (V/c).
    """

    rate: float = math.nan
    change: float = math.nan
    error: float = math.nan
    by_loads: float = math.nan

    @property
    def is_fast(self) -> bool:
        """Tell whether the rate drifts too fast to be one that stays."""
        return self.change > self.error and self.change >= _FAST * abs(self.rate)

    @property
    def is_surely_fast(self) -> bool:
        """Tell whether that is not by chance."""
        return self.is_fast and self.change > _SURELY * self.error

    @property
    def is_surely_slow(self) -> bool:
        """Tell whether the rate is known to stay."""
        return self.change + _HARDLY * self.error < _FAST * abs(self.rate)

    @property
    def is_of_loads(self) -> bool:
        """Tell whether the loads are not those of the motion alone."""
        return (
            self.change > _HARDLY * self.error
            and self.change >= _OF_RATE * abs(self.rate)
            and self.change >= _OF_LOADS * self.by_loads
        )

    @property
    def words(self) -> str:
        """Drift in words."""
        part = 100.0 * self.change / self.by_loads
        return (
            f"its complex rate drifts by {self.change:.2g} V/c, {part:.0f} % of what the loads "
            "make of it, as where vortices beat with the motion"
        )


#: Drift of a record that does not tell it.
UNKNOWN_DRIFT = Drift()
