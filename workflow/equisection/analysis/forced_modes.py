"""Generalised aerodynamic forces of a beam from the histories of its forced modes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import pandas as pd
import xarray as xr

from equisection.aerodynamics.generalised_forces import GeneralisedForces, mode_names
from equisection.aerodynamics.load_response import load_response
from equisection.analysis.forced_derivatives import (
    FIT_COLUMNS,
    per_motion,
    record_of,
    remark_on_rest,
)
from equisection.cases import ForcedCase
from equisection.errors import ResultFileError
from equisection.results.forced_result import signal_of


@dataclass(frozen=True)
class MovedModes:
    """Generalised forces, how well each history is fitted, and what there is to say of it."""

    forces: GeneralisedForces
    fits: pd.DataFrame
    remarks: tuple[str, ...]


def generalised_forces_of(results: Mapping[str, tuple[ForcedCase, xr.Dataset]]) -> MovedModes:
    """Return the generalised forces of the cases of one beam, each moved in one mode.

    Parameters
    ----------
    results
        Case and data set of each result, by name.

    Raises
    ------
    ResultFileError
        A case has no whole history, or a mode is missing at a reduced velocity.
    """
    answers: dict[tuple[str, str, float], tuple[complex, float]] = {}
    fits, remarks = [], []
    first = next(case for case, _ in results.values())
    assert first.shapes is not None
    modes = mode_names(len(first.shapes.bending), len(first.shapes.torsion))
    for name, (case, data) in results.items():
        signal, kept = signal_of(case), record_of(name, case, data)
        moved = f"{'torsion' if case.component == 'pitch' else 'bending'}{case.mode}"
        for load in modes:
            kind, number = load[:7], int(load[7:])
            history = kept[f"{kind}_load"].isel({f"{kind}_mode": number - 1}).to_numpy()
            found = load_response(kept["time"].to_numpy(), history, signal.frequencies)
            remarks += remark_on_rest(name, f"the load on {load}", found.rest)
            for velocity, value, spread in zip(*per_motion(signal, found), strict=True):
                answers[load, moved, velocity] = value, spread
                fits.append((name, moved, load, velocity, found.mean, found.rest))
    velocities = sorted({velocity for _, _, velocity in answers})
    try:
        both = np.array(
            [[[answers[a, b, v] for b in modes] for a in modes] for v in velocities], dtype=complex
        )
    except KeyError as error:
        load, moved, velocity = error.args[0]
        raise ResultFileError(
            f"forced motion: no {moved} at the reduced velocity {velocity:g}, for the load on "
            f"{load}; move each mode at each"
        ) from None
    forces = GeneralisedForces(
        np.array(velocities),
        both[..., 0],
        len(first.shapes.bending),
        both[..., 1].real,
        axis=first.shapes.elastic_axis,
        incidence_deg=first.incidence_deg,
        twist_deg=first.mean_twist_deg,
        label=f"forced modes, solver {first.solver.name}, {first.resolution}",
    )
    return MovedModes(forces, pd.DataFrame(fits, columns=list(FIT_COLUMNS)), tuple(remarks))
