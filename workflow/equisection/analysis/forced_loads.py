"""Loads over motion from the histories of prescribed motion, of a section or a beam.

The motion is taken as it was recorded: a run that is to be a pitch may have a heave in it, for
instance by turning about another axis than that of the table. At each frequency the runs have the
motions X (rows by motions, columns by runs) and the loads Y, so that Q = Y X^-1.
"""

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
from equisection.results.forced_result import signal_of
from equisection.results.netcdf import read_dataset
from equisection.store.index import read_index, read_missing, result_file

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]
#: Case and data set of each result, by name.
ForcedResults = Mapping[str, tuple[ForcedCase, xr.Dataset]]

#: Columns of ``derivatives/<name>-fit.csv``, in order.
FIT_COLUMNS = ("case", "component", "load", "reduced_velocity", "mean", "rest")
#: Answer of a load or motion, by its name, the run and the reduced velocity, and the standard error
#: of its parts.
_Answers = dict[tuple[str, str, float], tuple[complex, float]]
#: Largest condition of the motions of the runs, each over its size, that tells them apart.
LARGEST_CONDITION = 30.0
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
    if missing := read_missing(index):
        reasons = "; ".join(f"{name}: {reason}" for name, reason in missing.items())
        raise ResultFileError(f"forced motion: there is no result of {reasons}")
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
    driven: Callable[[ForcedCase, xr.Dataset], Mapping[str, NDArray[np.float64]]],
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
        Gives the motion that a case is a run of.
    histories
        Gives the history of each load, in their order.
    driven
        Gives the history of the motions that a case has, by their names; others are at rest.
    called
        Words before the name of a load in a remark.

    Raises
    ------
    ResultFileError
        A case has no whole history, a motion is missing at a reduced velocity, or runs that are to
        be different motions are the same.
    """
    moves: _Answers = {}
    answers: _Answers = {}
    fits, remarks = [], []
    for name, (case, data) in results.items():
        run, kept = moved(case), _record_of(name, case, data)
        time, frequencies = kept["time"].to_numpy(), signal_of(case).frequencies
        velocities = [float(f"{one:.6g}") for one in math.tau / frequencies]
        for motion, history in driven(case, kept).items():
            found = load_response(time, history, frequencies)
            moves |= _answers_of(motion, run, velocities, found)
        for load, history in zip(loads, histories(kept), strict=True):
            found = load_response(time, history, frequencies)
            remarks += _remark_on_rest(name, f"{called}{load}", found.rest)
            answers |= _answers_of(load, run, velocities, found)
            fits += [(name, run, load, one, found.mean, found.rest) for one in velocities]
    at = sorted({velocity for _, _, velocity in answers})
    over = [_over_motion(answers, loads, moves, motions, velocity) for velocity in at]
    return LoadsOverMotion(
        np.array(at),
        np.array([value for value, _ in over]),
        np.array([spread for _, spread in over]),
        pd.DataFrame(fits, columns=list(FIT_COLUMNS)),
        tuple(remarks),
    )


def _answers_of(name: str, run: str, velocities: Sequence[float], found: LoadResponse) -> _Answers:
    """Return the answers of a load or motion in a run, by name, run and reduced velocity."""
    parts = zip(velocities, found.response, found.spread, strict=True)
    return {(name, run, one): (complex(value), float(spread)) for one, value, spread in parts}


def _over_motion(
    answers: _Answers,
    loads: Sequence[str],
    moves: _Answers,
    motions: Sequence[str],
    velocity: float,
) -> tuple[Complexes, Floats]:
    """Return Q and its spread at a reduced velocity, each of shape (loads, motions)."""

    def gathered(of: _Answers, rows: Sequence[str]) -> tuple[Complexes, Floats]:
        each = [[of.get((row, run, velocity), (0j, 0.0)) for run in motions] for row in rows]
        both = np.array(each, dtype=np.complex128)
        return both[..., 0], both[..., 1].real

    for run in motions:
        if (loads[0], run, velocity) not in answers:
            raise ResultFileError(
                f"forced motion: no {run} at the reduced velocity {velocity:g}; run each of "
                f"{', '.join(motions)} at each"
            )
    (moved, moved_error), (found, error) = gathered(moves, motions), gathered(answers, loads)
    sizes = np.linalg.norm(moved, axis=1, keepdims=True)
    if not sizes.all() or np.linalg.cond(moved / sizes) > LARGEST_CONDITION:
        raise ResultFileError(
            f"forced motion: at the reduced velocity {velocity:g} the runs of "
            f"{', '.join(motions)} are the same motion; each has to move in its own"
        )
    inverse = np.linalg.inv(moved)
    value = found @ inverse
    variance = (error**2 + np.abs(value) ** 2 @ moved_error**2) @ np.abs(inverse) ** 2
    return value, np.sqrt(variance)


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
