"""Zigzag of the loads of a stored result: told by its solver, or seen in its samples."""

from __future__ import annotations

import json
import logging
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from equisection.verdict.zigzag import LARGEST_ZIGZAG, zigzag_of

#: Attribute of a result, and name in indices and tables.
NAME = "loads_zigzag"


def loads_zigzag(path: Path, attributes: Mapping[str, Any]) -> dict[str, float]:
    """Return the zigzag of the loads of a result (-), by its name in an index.

    Parameters
    ----------
    path
        File of the result.
    attributes
        Its attributes. Where these have the zigzag, the solver saw it in every time step.

    Returns
    -------
    dict
        Empty for a result without a history, and for one whose loads are not iterated.

    Raises
    ------
    ResultFileError
        The file cannot be read.
    """
    case = json.loads(attributes.get("case", "{}"))
    if "output_interval" not in case:
        return {}
    if NAME in attributes:
        return {NAME: float(attributes[NAME])}
    from equisection.results.netcdf import read_dataset  # noqa: PLC0415, only where it is needed

    found = read_dataset(path)
    return {
        NAME: zigzag_of(
            found["time"].values,
            found["cl"].values,
            found["cm"].values,
            steps_per_sample=round(case["output_interval"] / case["time_step"]),
        )
    }


def warning_of_zigzag(zigzag: float) -> str:
    """Return what is wrong with loads of a zigzag (-), and what to change; '' if nothing is."""
    if math.isnan(zigzag) or zigzag <= LARGEST_ZIGZAG:
        return ""
    return (
        f"not converged in its time step: the loads zigzag from step to step by "
        f"{100 * zigzag:.1f} % of their variation ({100 * LARGEST_ZIGZAG:g} % is allowed); "
        "raise openfoam.outer_correctors or halve unsteady.time_step"
    )


def with_zigzag(path: Path, attributes: Mapping[str, Any]) -> dict[str, Any]:
    """Return the attributes of a result with the zigzag of its loads, and log what is too large.

    Parameters and errors are those of :func:`loads_zigzag`.
    """
    found = loads_zigzag(path, attributes)
    warning = warning_of_zigzag(found.get(NAME, math.nan))
    if warning:
        logging.getLogger(__name__).warning("%s: %s", path.stem, warning)
    return {**attributes, **found}
