"""Result of a forced case: motion and loads over time."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from equisection.motion.forced_signal import ForcedSignal
from equisection.results.spent import Spent

if TYPE_CHECKING:
    from equisection.cases import ForcedCase

Floats = NDArray[np.float64]


def signal_of(case: ForcedCase) -> ForcedSignal:
    """Return the motion of a case."""
    rows = [(one.frequency, one.amplitude, one.phase) for one in case.harmonics]
    frequencies, amplitudes, phases = np.array(rows).T
    return ForcedSignal(frequencies, amplitudes, phases, case.ramp)


def motion_of(case: ForcedCase, time: ArrayLike) -> tuple[Floats, Floats]:
    """Return twist (rad) and deflection (chords) of a case at times (c/V).

    The deflection is that of mid-chord. Of a beam they are those of the mode that moves, where that
    is largest, without the mean twist.
    """
    moved = signal_of(case).at(time)
    still = np.zeros_like(moved)
    return (moved, still) if case.component == "pitch" else (still, moved)


@dataclass(frozen=True)
class ForcedResult:
    """Prescribed motion of a section or beam, and its loads.

    Attributes
    ----------
    time
        s = tV/c, shape (n,).
    twist, deflection
        Nose up (rad); of mid-chord, up (chords); shape (n,). Of a beam those of the mode that
        moves, where it is largest.
    lift, moment
        c_l, and c_m about the moving mid-chord, shape (n,). Of a beam C_L and C_M (Eq. 22).
    failure
        Reason for a history that ends early; else empty.
    bending_load, torsion_load
        int c_l g_j dz/L and int c_m f_i dz/L of a beam, about its elastic axis, shape (modes, n);
        empty of a section.
    spent
        Time that the case took, where the solver knows it better than its job.
    """

    time: Floats
    twist: Floats
    deflection: Floats
    lift: Floats
    moment: Floats
    failure: str = ""
    bending_load: Floats = field(default_factory=lambda: np.empty((0, 0)))
    torsion_load: Floats = field(default_factory=lambda: np.empty((0, 0)))
    spent: Spent | None = None

    @classmethod
    def without_history(cls, failure: str) -> ForcedResult:
        """Return the result of a case that failed before its motion began."""
        nothing = np.empty(0)
        return cls(nothing, nothing, nothing, nothing, nothing, failure)

    def of_case(self, case: ForcedCase) -> xr.Dataset:
        """Return the data set that is written to the file of a case."""
        chord = case.geometry.chord
        data = {
            "twist": (self.twist, "rad", "prescribed twist, nose up"),
            "deflection": (self.deflection * chord, "m", "prescribed deflection of mid-chord, up"),
            "cl": (self.lift, "1", "lift coefficient"),
            "cm": (self.moment, "1", "moment coefficient about the moving mid-chord, nose up"),
        }
        attributes: dict[str, Any] = {
            "chord": chord,
            "component": case.component,
            "failure": self.failure,
            "end_time": float(self.time[-1]) if self.time.size else 0.0,
        }
        variables: dict[str, Any] = {
            name: ("time", values, {"units": units, "long_name": text})
            for name, (values, units, text) in data.items()
        }
        if case.shapes is not None:
            attributes |= {"mode": case.mode, "mean_twist_deg": case.mean_twist_deg}
            for kind, load, of in (
                ("bending", self.bending_load, "int c_l g_j dz/L"),
                ("torsion", self.torsion_load, "int c_m f_i dz/L about the elastic axis"),
            ):
                told = {"units": "1", "long_name": f"load on the {kind} modes, {of}"}
                modes = len(getattr(case.shapes, kind))
                shaped = np.reshape(load, (modes, self.time.size))
                variables[f"{kind}_load"] = ((f"{kind}_mode", "time"), shaped, told)
        return xr.Dataset(
            variables,
            {"time": ("time", self.time, {"units": "c/V", "long_name": "convective time t V/c"})},
            attrs=attributes,
        )
