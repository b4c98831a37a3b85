"""Critical speeds of sections and of the beam from a table of flutter derivatives."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import pandas as pd

from equisection.aerodynamics.derivatives import Derivatives
from equisection.aerodynamics.generalised_forces import GeneralisedForces
from equisection.analysis.critical_speeds import BEFORE_MARGIN, DERIVATIVES
from equisection.motion.derivative_flutter import (
    DerivativeOnset,
    FlowingBody,
    derivative_onset,
)
from equisection.study.axes import AsGiven

#: Incidence (deg) of equilibrium of a model at a speed (m/s).
Equilibrium = Callable[[str, float], float]
#: Difference of two incidences (deg) beyond which derivatives may be others.
OFF_EQUILIBRIUM = 0.2
#: Model of the beam.
BEAM = "3d"


def from_derivatives(
    bodies: Mapping[str, FlowingBody],
    table: Derivatives,
    *,
    given: AsGiven,
    incidence_deg: float,
    equilibrium: Equilibrium | None = None,
) -> tuple[pd.DataFrame, list[str]]:
    """Return the critical speeds by flutter derivatives, and what there is to say of them.

    Parameters
    ----------
    bodies
        Sections or beam by the names of their models.
    table
        The derivatives.
    given
        The beam as given.
    incidence_deg
        Rigid incidence (deg), that of a table that does not say its own.
    equilibrium
        Incidence (deg) of static equilibrium of a model at a speed (m/s), NaN where it is not
        known. Where the onset of a model is elsewhere than the derivatives, it is said.

    Returns
    -------
    table : pd.DataFrame
        Columns of ``comparison/critical_speed.csv`` without the margin. The interval is that of the
        interpolation and of the spread of the derivatives; divergence is not looked for.
    remarks : list of str
        Doubts of the convention, and why a body has no onset or no interval.
    """
    rows, remarks = [], list(table.doubts)
    mean = incidence_deg if math.isnan(table.incidence_deg) else table.incidence_deg
    for model, body in bodies.items():
        found = derivative_onset(body, table)
        if found.reason:
            remarks.append(f"{model} ({DERIVATIVES}): {found.reason}")
        if model == BEAM:
            remarks.append(
                f"{model} ({DERIVATIVES}): each strip has the loads of the section, without those "
                "that a finite span induces: a short beam flutters later than this says; "
                "forced.beam_modes moves the beam itself"
            )
        if equilibrium is not None and not math.isnan(found.speed):
            there = equilibrium(model, found.speed)
            if abs(there - mean) > OFF_EQUILIBRIUM:
                remarks.append(
                    f"{model} ({DERIVATIVES}): at {found.speed:.4g} m/s it is in equilibrium at "
                    f"{there:.3g} deg, and the derivatives are those at {mean:.3g} deg: take them "
                    "there (forced.incidence_deg)"
                )
        rows.append(_row(model, mean, found, given))
    return pd.DataFrame(rows, columns=list(BEFORE_MARGIN)), remarks


def from_moved_beam(
    model: str, body: FlowingBody, forces: GeneralisedForces, *, given: AsGiven
) -> tuple[pd.DataFrame, list[str]]:
    """Return the critical speed of a beam by the forces on its moved modes, and remarks.

    Parameters
    ----------
    model
        Name of its model.
    body
        The beam on the modes that were moved.
    forces
        Generalised forces on these modes.
    given
        The beam as given.
    """
    found = derivative_onset(body, forces)
    remarks = [f"{model} ({DERIVATIVES}): {found.reason}"] if found.reason else []
    rows = [_row(model, forces.incidence_deg, found, given)]
    return pd.DataFrame(rows, columns=list(BEFORE_MARGIN)), remarks


def _row(
    model: str, incidence_deg: float, found: DerivativeOnset, given: AsGiven
) -> dict[str, Any]:
    """Return the row of an onset."""
    return {
        "model": model,
        "incidence_deg": incidence_deg,
        "speed": found.speed,
        "speed_low": found.speed_low,
        "speed_high": found.speed_high,
        "mechanism": found.mechanism,
        "frequency_hz": found.frequency,
        "k_star": given.k_star_at(found.speed),
        "basis": DERIVATIVES,
    }
