"""Generalised aerodynamic forces of a beam from the histories of its forced modes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from equisection.aerodynamics.generalised_forces import GeneralisedForces, mode_names
from equisection.analysis.forced_loads import ForcedResults, loads_over_motion
from equisection.cases import ForcedCase


@dataclass(frozen=True)
class MovedModes:
    """Generalised forces, how well each history is fitted, and what there is to say of it."""

    forces: GeneralisedForces
    fits: pd.DataFrame
    remarks: tuple[str, ...]


def _mode_of(case: ForcedCase) -> str:
    """Return the name of the mode that a case moves."""
    return f"{'torsion' if case.component == 'pitch' else 'bending'}{case.mode}"


def _amplitude(case: ForcedCase, data: xr.Dataset) -> NDArray[np.float64]:
    """Return the amplitude of that mode over time, in rad or chords."""
    if case.component == "pitch":
        return data["twist"].to_numpy()
    return data["deflection"].to_numpy() / case.geometry.chord


def generalised_forces_of(results: ForcedResults) -> MovedModes:
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
    first = next(case for case, _ in results.values())
    assert first.shapes is not None
    modes = mode_names(len(first.shapes.bending), len(first.shapes.torsion))
    found = loads_over_motion(
        results,
        modes,
        modes,
        moved=_mode_of,
        histories=lambda data: np.concatenate(
            [data["bending_load"].to_numpy(), data["torsion_load"].to_numpy()]
        ),
        driven=lambda case, data: {_mode_of(case): _amplitude(case, data)},
        called="the load on ",
    )
    forces = GeneralisedForces(
        found.reduced_velocity,
        found.values,
        found.spread,
        bending=len(first.shapes.bending),
        axis=first.shapes.elastic_axis,
        incidence_deg=first.incidence_deg,
        twist_deg=first.mean_twist_deg,
        label=f"forced modes, solver {first.solver.name}, {first.resolution}",
    )
    return MovedModes(forces, found.fits, found.remarks)
