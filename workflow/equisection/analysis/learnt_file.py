"""Learnt models read back from their files."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr

from equisection.aerodynamics.learnt_loads import LearntLoads
from equisection.aerodynamics.polar import Polar
from equisection.analysis.reduced_model import ReducedModel
from equisection.errors import ResultFileError


def model_of(data: xr.Dataset, polar: Polar) -> ReducedModel:
    """Return the model of a file ``rom/<model>/model*.nc``.

    Parameters
    ----------
    data
        The file.
    polar
        The steady polar that it was learnt with.

    Raises
    ------
    ResultFileError
        There is no model in it, but the reason why.
    """
    if "rate" not in data:
        reason = data.attrs.get("refusal") or "it has no coefficients"
        raise ResultFileError(f"{data.attrs.get('model', 'the file')}: no model: {reason}")
    seen = tuple(math.radians(float(data.attrs[f"seen_{end}_deg"])) for end in ("least", "most"))
    fits = [
        LearntLoads(
            polar=polar.continued,
            incidence_rad=math.radians(float(data.attrs["incidence_deg"])),
            rate=float(data["rate"][place]),
            moment=np.asarray(data["moment_terms"][place], dtype=np.float64),
            lift=np.asarray(data["lift_terms"][place], dtype=np.float64),
            residual_moment=float(data["residual_moment"][place]),
            residual_lift=float(data["residual_lift"][place]),
            seen=(seen[0], seen[1]),
            learnt_until=float(data["learnt_until"][place]),
        )
        for place in range(data.sizes["fit"])
    ]
    return ReducedModel(
        loads=fits[0],
        refits=tuple(fits[1:]),
        learnt_from=str(data.attrs["learnt_from"]),
        k_star=float(data.attrs["learnt_from_k_star"]),
        source=str(data.attrs["source"]),
    )
