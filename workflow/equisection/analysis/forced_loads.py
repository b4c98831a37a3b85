"""Loads over motion from the histories of prescribed motion, of a section or a beam."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from equisection.aerodynamics.load_response import LoadResponse, load_response
from equisection.cases import ForcedCase, case_hash, read_cases
from equisection.errors import ResultFileError
from equisection.motion.forced_signal import ForcedSignal
from equisection.results.forced_result import signal_of
from equisection.results.netcdf import read_dataset
from equisection.store.index import read_index, result_file

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
#: Case and data set of each result, by name.
ForcedResults = Mapping[str, tuple[ForcedCase, xr.Dataset]]

#: Columns of ``derivatives/<name>-fit.csv``, in order.
FIT_COLUMNS = ("case", "component", "load", "reduced_velocity", "mean", "rest")
#: Part of the loads at other frequencies than those of the motion that is worth a warning.
LARGE_REST = 0.2


@dataclass(frozen=True)
class LoadsOverMotion:
    """Loads over motion, how well each history is fitted, and what there is to say of it.

    Attributes
    ----------
    reduced_velocity : ndarray, shape (n,)
        V/(f c), ascending.
    values : ndarray, shape (n, l, m)
        Q (-), rows by loads and columns by motions.
    spread : ndarray, shape (n, l, m)
        Standard deviation of the real and of the imaginary part.
    fits : DataFrame
        Columns :data:`FIT_COLUMNS`.
    remarks : tuple of str
        What there is to say.
    """

    reduced_velocity: Floats
    values: Complexes
    spread: Floats
    fits: pd.DataFrame
    remarks: tuple[str, ...]


def read_results(case_files: Sequence[Path], index: Path) -> ForcedResults:
    """Return case and data set of each result that an index names, by name."""
    cases = {name: case for file in case_files for name, case in read_cases(file).items()}
    results = {}
    for name in read_index(index):
        case = cases[name]
        assert isinstance(case, ForcedCase)
        results[name] = case, read_dataset(result_file(index, name), case_hash(case))
    return results


def loads_over_motion(
    results: ForcedResults,
    loads: Sequence[str],
    motions: Sequence[str],
    *,
    moved: Callable[[ForcedCase], str],
    histories: Callable[[xr.Dataset], Iterable[NDArray[np.float64]]],
    called: str = "",
) -> LoadsOverMotion:
    """Return the loads over the motion of some cases, each moved in one of the motions.

    Parameters
    ----------
    results
        Case and data set of each result, by name.
    loads, motions
        Names of the loads and of the motions, in order.
    moved
        Gives the motion of a case.
    histories
        Gives the history of each load, in their order.
    called
        Words before the name of a load in a remark.

    Raises
    ------
    ResultFileError
        A case has no whole history, or a motion is missing at a reduced velocity.
    """
    answers: dict[tuple[str, str, float], tuple[complex, float]] = {}
    fits, remarks = [], []
    for name, (case, data) in results.items():
        signal, motion, kept = signal_of(case), moved(case), _record_of(name, case, data)
        for load, history in zip(loads, histories(kept), strict=True):
            found = load_response(kept["time"].to_numpy(), history, signal.frequencies)
            remarks += _remark_on_rest(name, f"{called}{load}", found.rest)
            for velocity, value, spread in zip(*_per_motion(signal, found), strict=True):
                answers[load, motion, velocity] = value, spread
                fits.append((name, motion, load, velocity, found.mean, found.rest))
    velocities = sorted({velocity for _, _, velocity in answers})
    try:
        both = np.array(
            [[[answers[a, b, v] for b in motions] for a in loads] for v in velocities],
            dtype=np.complex128,
        )
    except KeyError as error:
        _, motion, velocity = error.args[0]
        raise ResultFileError(
            f"forced motion: no {motion} at the reduced velocity {velocity:g}; run each of "
            f"{', '.join(motions)} at each"
        ) from None
    return LoadsOverMotion(
        np.array(velocities),
        both[..., 0],
        both[..., 1].real,
        pd.DataFrame(fits, columns=list(FIT_COLUMNS)),
        tuple(remarks),
    )


def _remark_on_rest(name: str, load: str, rest: float) -> list[str]:
    """Return what there is to say of the part of a load at other frequencies than the motion's."""
    if rest <= LARGE_REST:
        return []
    return [
        f"{name}: {100 * rest:.0f} % of {load} is not at the frequencies of the motion: the loads "
        "are not linear in it, or the flow moves by itself"
    ]


def _record_of(name: str, case: ForcedCase, data: xr.Dataset) -> xr.Dataset:
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


def _per_motion(
    signal: ForcedSignal, found: LoadResponse
) -> tuple[list[float], list[complex], list[float]]:
    """Return reduced velocities, load over motion and its spread."""
    velocity = [float(f"{one:.6g}") for one in math.tau / signal.frequencies]
    moved = signal.response
    return velocity, list(found.response / moved), list(found.spread / np.abs(moved))
