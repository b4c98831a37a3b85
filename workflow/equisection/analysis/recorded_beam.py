"""Results of unsteady cases of a beam, read as releases to learn the loads of its strips from."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import xarray as xr
from pydantic import ValidationError

from equisection.aerodynamics.span_strips import SpanStrips
from equisection.cases import BeamModes, UnsteadyCase
from equisection.errors import ResultFileError
from equisection.motion.beam_lesson import BeamRelease
from equisection.motion.beams import BeamParameters
from equisection.results.netcdf import read_dataset
from equisection.solvers.embedded.releases import beam_parameters


def read_recorded_beam(path: Path, strips: SpanStrips) -> BeamRelease:
    """Read the result of an unsteady case of a beam, which holds its case.

    Raises
    ------
    ResultFileError
        The file is missing or broken, or of no beam.
    """
    data = read_dataset(path)
    try:
        case = UnsteadyCase.model_validate_json(data.attrs.get("case", ""))
    except ValidationError:
        case = None
    if case is None or case.beam is None:
        raise ResultFileError(
            f"{path}: its attribute 'case' holds no unsteady case of a beam; give "
            "results/<run>/unsteady/3d/*.nc of a flow solver"
        )
    return release_of(path, data, case, strips)


def release_of(path: Path, data: xr.Dataset, case: UnsteadyCase, strips: SpanStrips) -> BeamRelease:
    """Return the release of the result of a case, of the beam that it moves."""
    assert case.beam is not None, "a case of the beam"
    return BeamRelease(
        time=data["time"].to_numpy().astype(np.float64),
        torsion=data["torsion_amplitude"].to_numpy().astype(np.float64),
        bending=data["bending_amplitude"].to_numpy().astype(np.float64),
        parameters=on_strips([case.beam], strips),
        incidence_rad=math.radians(case.incidence_deg),
        k_star=case.k_star,
        name=f"{path.parent.name}/{path.stem}",
        source=str(data.attrs["solver_description"]),
    )


def on_strips(beams: Sequence[BeamModes], strips: SpanStrips) -> BeamParameters:
    """Return the modes of beams that differ in stiffness at the strips, whose wakes are not."""
    return beam_parameters(list(beams), strips, None)
