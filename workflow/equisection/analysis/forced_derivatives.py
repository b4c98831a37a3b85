"""Flutter derivatives from the histories of forced motion."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from equisection.aerodynamics.derivatives import Derivatives
from equisection.aerodynamics.load_response import LoadResponse, load_response
from equisection.cases import ForcedCase
from equisection.errors import ResultFileError
from equisection.motion.forced_signal import ForcedSignal
from equisection.results.forced_result import signal_of

Floats = NDArray[np.float64]

#: Columns of ``derivatives/<name>-fit.csv``, in order.
FIT_COLUMNS = ("case", "component", "load", "reduced_velocity", "mean", "rest")
#: Rows of Q by the loads, and columns by the components of the motion.
_LOADS, _COMPONENTS = ("cl", "cm"), ("heave", "pitch")
#: Part of the loads at other frequencies than those of the motion that is worth a warning.
LARGE_REST = 0.2


@dataclass(frozen=True)
class ForcedAnswers:
    """Derivatives, how well each history is fitted, and what there is to say of it."""

    derivatives: Derivatives
    fits: pd.DataFrame
    remarks: tuple[str, ...]


def derivatives_of(results: Mapping[str, tuple[ForcedCase, xr.Dataset]]) -> ForcedAnswers:
    """Return the derivatives of the cases of one section, in pitch and in heave.

    Parameters
    ----------
    results
        Case and data set of each result, by name.

    Raises
    ------
    ResultFileError
        A case has no whole history, or a component is missing at a reduced velocity.
    """
    answers: dict[tuple[str, str, float], tuple[complex, float]] = {}
    fits, remarks = [], []
    for name, (case, data) in results.items():
        signal = signal_of(case)
        kept = record_of(name, case, data)
        for load in _LOADS:
            found = load_response(
                kept["time"].to_numpy(), kept[load].to_numpy(), signal.frequencies
            )
            remarks += remark_on_rest(name, load, found.rest)
            for velocity, value, spread in zip(*per_motion(signal, found), strict=True):
                answers[load, case.component, velocity] = value, spread
                fits.append((name, case.component, load, velocity, found.mean, found.rest))
    case = next(case for case, _ in results.values())
    table = _table(answers, case)
    return ForcedAnswers(table, pd.DataFrame(fits, columns=list(FIT_COLUMNS)), tuple(remarks))


def remark_on_rest(name: str, load: str, rest: float) -> list[str]:
    """Return what there is to say of the part of a load at other frequencies than the motion's."""
    if rest <= LARGE_REST:
        return []
    return [
        f"{name}: {100 * rest:.0f} % of {load} is not at the frequencies of the motion: the loads "
        "are not linear in it, or the flow moves by itself"
    ]


def record_of(name: str, case: ForcedCase, data: xr.Dataset) -> xr.Dataset:
    """Return the samples after the settling time."""
    if data.attrs.get("failure"):
        raise ResultFileError(f"forced case {name}: {data.attrs['failure']}")
    time = data["time"].to_numpy()
    end = float(time.max(initial=0.0))
    if end < case.duration - 2.0 * case.output_interval:
        raise ResultFileError(
            f"forced case {name}: its history ends at {end:g} c/V of {case.duration:g}; "
            "run it again"
        )
    return data.isel(time=time >= case.settling - 1e-9)


def per_motion(
    signal: ForcedSignal, found: LoadResponse
) -> tuple[list[float], list[complex], list[float]]:
    """Return reduced velocities, load over motion and its spread."""
    velocity = [float(f"{one:.6g}") for one in math.tau / signal.frequencies]
    moved = signal.response
    return velocity, list(found.response / moved), list(found.spread / np.abs(moved))


def _table(
    answers: dict[tuple[str, str, float], tuple[complex, float]], case: ForcedCase
) -> Derivatives:
    velocities = sorted({velocity for _, _, velocity in answers})
    loads = np.empty((len(velocities), 2, 2), dtype=np.complex128)
    spread = np.empty(loads.shape)
    for place, velocity in enumerate(velocities):
        for row, load in enumerate(_LOADS):
            for column, component in enumerate(_COMPONENTS):
                if (load, component, velocity) not in answers:
                    raise ResultFileError(
                        f"forced motion: no {component} at the reduced velocity {velocity:g}; "
                        "run both components at each"
                    )
                loads[place, row, column], spread[place, row, column] = answers[
                    load, component, velocity
                ]
    of_velocity = np.array(velocities)
    by_k = spread / (math.tau / of_velocity[:, None, None]) ** 2
    (lift_w, lift_twist), (moment_w, moment_twist) = np.moveaxis(by_k, 0, -1)
    columns = (
        lift_w,
        lift_twist,
        lift_twist,
        lift_w,
        moment_w,
        moment_twist,
        moment_twist,
        moment_w,
    )
    return Derivatives.of_loads(
        of_velocity,
        loads,
        spread=np.stack(columns, axis=1),
        incidence_deg=case.incidence_deg,
        label=f"forced motion, solver {case.solver.name}, {case.resolution}",
    )
