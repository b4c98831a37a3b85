"""Learnt models from and to files: NetCDF of a run, and JSON and CSV for other programs."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
import xarray as xr

from equisection.aerodynamics.learnt_loads import TERMS, LearntLoads
from equisection.aerodynamics.learnt_strips import STRIP_TERMS, LearntStrips
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.strip_polars import StripPolars
from equisection.aerodynamics.unsteady_loads import APPARENT_INERTIA, APPARENT_MASS
from equisection.analysis.reduced_beam import ReducedBeam
from equisection.analysis.reduced_model import ReducedModel
from equisection.errors import ArgumentError, ResultFileError
from equisection.files import write_text

#: Version of the layout of the JSON file.
LAYOUT = 1
#: What each fit of a model has, with its variable in the NetCDF of a run.
_OF_FIT = {
    "rate": "rate",
    "moment": "moment_terms",
    "lift": "lift_terms",
    "residual_moment": "residual_moment",
    "residual_lift": "residual_lift",
    "learnt_until": "learnt_until",
}
EQUATIONS = (
    "incidence: alpha = theta_0 + theta - w_m', a = alpha - theta_0, with the twist theta (rad, "
    "nose up) and the deflection w_m (chords, up) of mid-chord",
    "time: s = t V/c, and ' = d/ds",
    "lag: x' = rate (a - x), h = a - x",
    "T: the terms",
    "c_m = polar.c_m(alpha) + moment . T - apparent_inertia theta'', about mid-chord, nose up",
    "c_l = polar.c_l(alpha) + lift . T + apparent_mass (theta' - w_m''), up",
)


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
        There is no model in it, but the reason why; or it is that of a beam on strips.
    """
    _require_model_of_section(data)
    first, *others = (LearntLoads(polar=polar.continued, **one) for one in _fits_of(data))
    return ReducedModel(loads=first, refits=tuple(others), **_origin_of(data))


def beam_model_of(data: xr.Dataset, polars: StripPolars) -> ReducedBeam:
    """Return the model of a file ``rom/<model>/model*.nc`` of a beam.

    ``polars`` are the loads along the span that it was learnt with. Errors are those of
    :func:`model_of`.
    """
    require_model(data)
    first, *others = (LearntStrips(polars=polars.continued, **one) for one in _fits_of(data))
    return ReducedBeam(loads=first, refits=tuple(others), **_origin_of(data))


def is_of_strips(data: xr.Dataset) -> bool:
    """Tell whether the model of a file is that of the strips of a beam."""
    return bool(data.sizes.get("term") == len(STRIP_TERMS))


def require_model(data: xr.Dataset) -> None:
    """Refuse a file without a model.

    Raises
    ------
    ResultFileError
        There is none in it, but the reason why.
    """
    if "rate" not in data:
        reason = data.attrs.get("refusal") or "it has no coefficients"
        raise ResultFileError(f"{data.attrs.get('model', 'the file')}: no model: {reason}")


def _require_model_of_section(data: xr.Dataset) -> None:
    require_model(data)
    if is_of_strips(data):
        raise ResultFileError(
            f"{data.attrs['model']}: a model of the strips of a beam, of {data.sizes['term']} "
            f"terms; allowed is that of a section, of {len(TERMS)}"
        )


def _fits_of(data: xr.Dataset) -> list[dict[str, Any]]:
    """Return the coefficients of the model and of its refits."""
    attrs = data.attrs
    return [
        _coefficients(
            {name: data[variable].values[place] for name, variable in _OF_FIT.items()},
            float(attrs["incidence_deg"]),
            (float(attrs["seen_least_deg"]), float(attrs["seen_most_deg"])),
        )
        for place in range(data.sizes["fit"])
    ]


def _origin_of(data: xr.Dataset) -> dict[str, Any]:
    attrs = data.attrs
    return {
        "learnt_from": str(attrs["learnt_from"]),
        "k_star": float(attrs["learnt_from_k_star"]),
        "source": str(attrs["source"]),
    }


def _coefficients(
    fit: Mapping[str, Any], incidence_deg: float, seen_deg: Sequence[float]
) -> dict[str, Any]:
    """Return coefficients of a fit by the names of :data:`_OF_FIT`, with where it was learnt."""
    low, high = map(math.radians, seen_deg)
    return {
        "incidence_rad": math.radians(incidence_deg),
        "rate": float(fit["rate"]),
        "moment": np.array(fit["moment"], dtype=np.float64),
        "lift": np.array(fit["lift"], dtype=np.float64),
        "residual_moment": float(fit["residual_moment"]),
        "residual_lift": float(fit["residual_lift"]),
        "seen": (low, high),
        "learnt_until": float(fit["learnt_until"]),
    }


def as_json(data: xr.Dataset, polar: Polar) -> dict[str, Any]:
    """Return all that a learnt model is, for other programs: in plain numbers, with its equations.

    Parameters
    ----------
    data
        ``rom/<model>/model*.nc``.
    polar
        The steady polar that it was learnt with.

    Raises
    ------
    ResultFileError
        There is no model in the file.
    """
    model = model_of(data, polar)
    whole, attrs = model.loads.polar, data.attrs
    return {
        "layout": LAYOUT,
        "model": attrs["model"],
        "words": attrs["words"],
        "learnt_from": model.learnt_from,
        "learnt_from_k_star": model.k_star,
        "source": model.source,
        "confirmation": attrs["confirmation"],
        "incidence_deg": float(attrs["incidence_deg"]),
        "seen_deg": [float(attrs[f"seen_{end}_deg"]) for end in ("least", "most")],
        "onset_k_star": {
            name: _or_null(attrs[f"onset_k_star{end}"])
            for name, end in (("value", ""), ("low", "_low"), ("high", "_high"))
        },
        "equations": list(EQUATIONS),
        "terms": list(TERMS),
        "apparent_mass": APPARENT_MASS,
        "apparent_inertia": APPARENT_INERTIA,
        "fits": [
            {name: _plain(getattr(fit, name)) for name in _OF_FIT}
            for fit in (model.loads, *model.refits)
        ],
        "polar": {
            "label": whole.label,
            "incidence_deg": np.degrees(whole.incidence).tolist(),
            "c_l": whole.lift.tolist(),
            "c_m": whole.moment.tolist(),
            "c_d": whole.drag.tolist(),
        },
    }


def _or_null(value: Any) -> float | None:
    return float(value) if math.isfinite(float(value)) else None


def _plain(value: Any) -> Any:
    return value.tolist() if isinstance(value, np.ndarray) else float(value)


def model_of_json(content: dict[str, Any]) -> ReducedModel:
    """Return the model of the content of a JSON file (:func:`as_json`).

    Raises
    ------
    ResultFileError
        It is of another layout.
    """
    if content.get("layout") != LAYOUT:
        raise ResultFileError(
            f"layout {content.get('layout')!r} of a learnt model: allowed is {LAYOUT}; export it "
            "again"
        )
    table = content["polar"]
    drag, lift, moment = (np.array(table[name], dtype=float) for name in ("c_d", "c_l", "c_m"))
    polar = Polar(np.radians(table["incidence_deg"]), drag, lift, moment, table["label"])
    first, *others = (
        LearntLoads(
            polar=polar, **_coefficients(fit, content["incidence_deg"], content["seen_deg"])
        )
        for fit in content["fits"]
    )
    return ReducedModel(
        loads=first,
        refits=tuple(others),
        learnt_from=content["learnt_from"],
        k_star=content["learnt_from_k_star"],
        source=content["source"],
    )


def as_table(data: xr.Dataset) -> pd.DataFrame:
    """Return what a learnt model predicts, a line for each value of k*, or of the speed (m/s).

    Columns are those of ``rom/<model>/model*.nc``: growth rates in V/c, frequencies f c/V.
    """
    axis = str(data.attrs["axis"])
    columns = [str(name) for name, one in data.data_vars.items() if one.dims == (axis,)]
    return data[columns].to_dataframe().reset_index()


def export(data: xr.Dataset, polar: Polar | None, output: Path) -> None:
    """Write a learnt model as JSON (:func:`as_json`), or its prediction as CSV (:func:`as_table`).

    Parameters
    ----------
    data
        ``rom/<model>/model*.nc``.
    polar
        The steady polar that it was learnt with, for JSON; CSV holds none.
    output
        The file.

    Raises
    ------
    ArgumentError
        The name of the file ends in neither ``.json`` nor ``.csv``.
    ResultFileError
        There is no model in the data, or no polar for JSON.
    """
    if output.suffix == ".json":
        _require_model_of_section(data)
        if polar is None:
            raise ResultFileError("there is no steady polar of the section")
        write_text(output, json.dumps(as_json(data, polar), indent=1) + "\n")
    elif output.suffix == ".csv":
        require_model(data)
        words = f"# {data.attrs['words']}; {data.attrs['confirmation']}\n"
        write_text(output, words + as_table(data).to_csv(index=False, float_format="%.6g"))
    else:
        raise ArgumentError(f"{output}: allowed is a name that ends in .json or .csv")
