"""Result of an unsteady case: histories over time, and the verdict on them."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from enum import StrEnum
from typing import TYPE_CHECKING

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from equisection.results.spent import Spent
from equisection.results.tip_flow import TipFlow

if TYPE_CHECKING:
    from equisection.cases import UnsteadyCase


class Regime(StrEnum):
    """Regime of a run that has ended."""

    SETTLED = "settled"
    DECAYING = "decaying"
    LIMIT_CYCLE = "limit-cycle"
    GROWING = "growing"
    UNDECIDED = "undecided"
    FAILED = "failed"


#: Regimes of a run that has shown the body to be stable.
STABLE = frozenset({Regime.SETTLED, Regime.DECAYING})
#: Regimes of a run whose motion has stayed about a mean.
BOUNDED = STABLE | {Regime.LIMIT_CYCLE}
#: Regimes of a run that says nothing of the stability of its body.
UNKNOWN = frozenset({Regime.UNDECIDED, Regime.FAILED})

#: Attributes that carry the verdict, with what they mean.
VERDICT_ATTRIBUTES = {
    "regime": "settled, decaying, limit-cycle, growing, undecided or failed",
    "reason": "why, in a sentence",
    "periods_used": "whole periods that the verdict rests on",
    "window_start": "start of the window that the verdict rests on (c/V)",
    "mean_twist_deg": "mean twist of the tip (section twist over its recovery factor) (deg)",
    "mean_deflection_chords": "mean deflection of the tip (chords)",
    "mean_known": "1 where both means are settled, 0 where the motion still grows or drifts",
    "twist_amplitude_deg": "amplitude of the tip's twist (deg)",
    "frequency_strouhal": "frequency of the twist f c/V",
    "growth_rate": "growth rate of the motion, of twist and deflection together (V/c)",
    "growth_standard_error": "its standard error (V/c)",
    "growth_low": "lower end of its interval of 95 % (V/c)",
    "growth_high": "upper end of its interval of 95 % (V/c)",
    "growth_start": "start of the window that it is read from (c/V)",
    "growth_end": "end of that window (c/V)",
    "growth_note": "how it was read, or that the window has beats in it; empty without a remark",
    "deflection_amplitude_chords": "amplitude of the deflection as recovered (chords)",
    "heave_grows": "1 where the heave grows beneath a twist that does not",
    "twist_turns": "number of times that the twist turned",
}
#: Their units; text has none.
VERDICT_UNITS = {
    "regime": "",
    "reason": "",
    "periods_used": "1",
    "window_start": "c/V",
    "mean_twist_deg": "deg",
    "mean_deflection_chords": "c",
    "mean_known": "1",
    "twist_amplitude_deg": "deg",
    "frequency_strouhal": "1",
    "growth_rate": "V/c",
    "growth_standard_error": "V/c",
    "growth_low": "V/c",
    "growth_high": "V/c",
    "growth_start": "c/V",
    "growth_end": "c/V",
    "growth_note": "",
    "deflection_amplitude_chords": "c",
    "heave_grows": "1",
    "twist_turns": "1",
}


@dataclass(frozen=True)
class UnsteadyResult:
    """Histories of one case over convective time, and the verdict on them.

    Attributes
    ----------
    time
        s = tV/c, shape (n,).
    twist, deflection
        Of the section in 2D and of the tip in 3D: rad and chords, shape (n,).
    tip_twist, tip_deflection
        The tip's, recovered from the section's in 2D, shape (n,).
    lift, moment
        c_l and c_m about the moving mid-chord (2D), C_L and C_M (3D), shape (n,).
    incidence
        theta_0 + twist of the section or tip (rad), shape (n,).
    axis_moment
        c_m or C_M about the elastic axis where that is off mid-chord, shape (n,); else empty.
    torsion_amplitudes, bending_amplitudes
        Theta_i (rad) and W_i (chords), shape (modes, n); empty in 2D.
    torsion_loads, bending_loads
        Loads of these modes over their generalised inertia (rad and chords, times (V/c)^2), shape
        (modes, n); empty where the solver does not have them.
    tip_flow
        Flow near the tip at the end, where the solver has it.
    spent
        Time that the case took, where the solver knows it better than its job.
    verdict
        The values of :data:`VERDICT_ATTRIBUTES`.
    loads_zigzag
        Zigzag of the loads from time step to time step over their standard deviation; NaN where
        the loads of a step are not iterated.
    """

    time: NDArray[np.float64]
    twist: NDArray[np.float64]
    deflection: NDArray[np.float64]
    tip_twist: NDArray[np.float64]
    tip_deflection: NDArray[np.float64]
    lift: NDArray[np.float64]
    moment: NDArray[np.float64]
    incidence: NDArray[np.float64]
    verdict: dict[str, str | float | int]
    axis_moment: NDArray[np.float64] = field(default_factory=lambda: np.empty(0))
    torsion_amplitudes: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 0)))
    bending_amplitudes: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 0)))
    torsion_loads: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 0)))
    bending_loads: NDArray[np.float64] = field(default_factory=lambda: np.empty((0, 0)))
    tip_flow: TipFlow | None = None
    spent: Spent | None = None
    loads_zigzag: float = math.nan

    def of_case(self, case: UnsteadyCase) -> xr.Dataset:
        """Return the data set that is written to the file of a case."""
        return self.to_dataset(case.geometry.chord)

    def to_dataset(self, chord: float) -> xr.Dataset:
        """Return the data set that is written to file, lengths in metres of a chord ``chord``."""
        data = {
            "twist": (self.twist, "rad", "twist, nose up (section in 2D, tip in 3D)"),
            "deflection": (self.deflection * chord, "m", "deflection (section in 2D, tip in 3D)"),
            "tip_twist": (self.tip_twist, "rad", "twist of the tip"),
            "tip_deflection": (self.tip_deflection * chord, "m", "deflection of the tip"),
            "cl": (self.lift, "1", "lift coefficient"),
            "cm": (self.moment, "1", "moment coefficient about the moving mid-chord, nose up"),
            "incidence": (self.incidence, "rad", "rigid incidence plus twist"),
        }
        if self.axis_moment.size:
            text = "moment coefficient about the elastic axis, nose up"
            data["cm_axis"] = (self.axis_moment, "1", text)
        variables = {
            name: (("time",), values, {"units": units, "long_name": text})
            for name, (values, units, text) in data.items()
        }
        for name, values, units, text in (
            ("torsion_amplitude", self.torsion_amplitudes, "rad", "amplitude of torsion modes"),
            ("bending_amplitude", self.bending_amplitudes, "1", "amplitude W_i of bending modes"),
            (
                "torsion_load",
                self.torsion_loads,
                "rad (V/c)^2",
                "loads of torsion modes, over inertia",
            ),
            ("bending_load", self.bending_loads, "(V/c)^2", "loads of bending modes, over inertia"),
        ):
            if values.size:
                variables[name] = (
                    (f"{name.split('_')[0]}_mode", "time"),  # type: ignore[assignment]
                    values,
                    {"units": units, "long_name": text},
                )
        attributes: dict[str, str | float | int] = {
            "chord": chord,
            "end_time": float(self.time[-1]) if self.time.size else 0.0,
        }
        if not math.isnan(self.loads_zigzag):
            attributes["loads_zigzag"] = self.loads_zigzag
        dataset = xr.Dataset(
            variables,
            {"time": ("time", self.time, {"units": "c/V", "long_name": "convective time t V/c"})},
            attrs={**attributes, **self.verdict},
        )
        return self.tip_flow.with_dataset(dataset) if self.tip_flow is not None else dataset
