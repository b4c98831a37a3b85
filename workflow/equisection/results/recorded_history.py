"""Results of unsteady cases of a section, read as histories to identify the lags from."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from pydantic import ValidationError

from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.beam.section import Section
from equisection.cases import UnsteadyCase
from equisection.errors import ResultFileError
from equisection.results.netcdf import read_dataset

Floats = NDArray[np.float64]


def read_reference_history(path: Path) -> ReferenceHistory:
    """Read the result of an unsteady case of a section, which holds its case.

    Raises
    ------
    ResultFileError
        The file is missing or broken, or of no section.
    """
    data = read_dataset(path)
    case, section = _case(path, data)
    return history_of(path, data, case, section)


def history_of(
    path: Path, data: xr.Dataset, case: UnsteadyCase, section: Section
) -> ReferenceHistory:
    """Return the history of the result of a case, and of the section that it moves."""

    def values(name: str) -> Floats:
        return data[name].to_numpy().astype(np.float64)

    return ReferenceHistory(
        values("time"),
        values("twist"),
        values("deflection") / case.geometry.chord,
        values("cl"),
        values("cm"),
        math.radians(case.incidence_deg),
        k_star=case.k_star,
        section=section,
        name=f"{path.parent.name}/{path.stem}",
        source=str(data.attrs["solver_description"]),
    )


def _case(path: Path, data: xr.Dataset) -> tuple[UnsteadyCase, Section]:
    try:
        case = UnsteadyCase.model_validate_json(data.attrs.get("case", ""))
    except ValidationError:
        case = None
    if case is None or case.section is None:
        raise ResultFileError(
            f"{path}: its attribute 'case' holds no unsteady case of a section; give "
            "results/<run>/unsteady/2d*/*.nc of a flow solver"
        )
    return case, case.section
