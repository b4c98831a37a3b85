"""Critical speeds of sections and of the beam from a table of flutter derivatives."""

from __future__ import annotations

from collections.abc import Mapping

import pandas as pd

from equisection.aerodynamics.derivatives import Derivatives
from equisection.analysis.critical_speeds import COLUMNS, DERIVATIVES
from equisection.motion.derivative_flutter import FlowingBody, derivative_onset
from equisection.study.axes import AsGiven


def from_derivatives(
    bodies: Mapping[str, FlowingBody],
    table: Derivatives,
    *,
    given: AsGiven,
    incidence_deg: float,
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
        Mean incidence of the table (deg).

    Returns
    -------
    table : pd.DataFrame
        Columns of ``comparison/critical_speed.csv`` without the margin. The interval is that of the
        interpolation and of the spread of the derivatives; divergence is not looked for.
    remarks : list of str
        Doubts of the convention, and why a body has no onset or no interval.
    """
    rows, remarks = [], list(table.doubts)
    for model, body in bodies.items():
        found = derivative_onset(body, table)
        if found.reason:
            remarks.append(f"{model} ({DERIVATIVES}): {found.reason}")
        rows.append(
            {
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
        )
    names = [name for name in COLUMNS if name != "margin"]
    return pd.DataFrame(rows, columns=names), remarks
