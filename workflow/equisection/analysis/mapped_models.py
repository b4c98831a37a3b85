"""Models of a run as bodies in a flow, and their map of stability over incidence and speed."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray

from equisection.config import Config
from equisection.errors import EquisectionError
from equisection.motion.body_in_flow import BodyInFlow, SpanCorrection
from equisection.motion.critical import Critical, critical_of
from equisection.motion.map_dataset import described, map_of_lines, maps_of_models
from equisection.motion.stability_map import MapLine, map_lines
from equisection.reduction.correction import CorrectionFactors
from equisection.results.correction_dataset import factors_from_dataset
from equisection.results.section_dataset import nominal_k_star
from equisection.solvers.protocol import HasStates, Solver
from equisection.study import plan
from equisection.study.assemble import case_at
from equisection.study.axes import SPEED, AsGiven, Point, onset_axis, varied

Floats = NDArray[np.float64]

#: Columns of ``comparison/stability.csv`` by the members of :class:`Critical`, with the factor of
#: their units; None of words.
_COLUMNS = {
    "speed": ("critical_speed", 1.0),
    "speed_low": ("speed_low", 1.0),
    "speed_high": ("speed_high", 1.0),
    "mechanism": ("critical_mechanism", None),
    "mode": ("critical_mode", None),
    "frequency_hz": ("critical_frequency", 1.0),
    "k_star": ("critical_k_star", 1.0),
    "twist_deg": ("critical_twist", math.degrees(1.0)),
    "deflection_m": ("critical_deflection", 1.0),
    "divergence_speed": ("divergence_speed", 1.0),
    "growth_slope": ("growth_slope", 1.0),
    "tip_ratio": ("tip_ratio", 1.0),
    "tip_phase_deg": ("tip_phase", 1.0),
    "heave_share": ("heave_share", 1.0),
    "twist_share": ("twist_share", 1.0),
    "coupling_share": ("coupling_share", 1.0),
    "unstable_to": ("unstable_to", 1.0),
    "note": ("note", None),
}


@dataclass(frozen=True)
class MappedModel:
    """A model of a run over incidence and speed.

    Attributes
    ----------
    name
        Name of the model.
    lines
        Its motions at each incidence; none of a model that is refused.
    refusal
        Reason for which there is no such model.
    """

    name: str
    lines: tuple[MapLine, ...]
    refusal: str = ""


def speeds_of_map(config: Config, given: AsGiven) -> Floats:
    """Return the speeds (m/s) of a map, rising: those of the sweep, or of its k*."""
    values = np.asarray(config.sweep.values())
    if onset_axis(varied(config)) is SPEED:
        return values
    return np.sort(np.asarray(given.speed_at(values)))


def mapped_models(
    config: Config, data: Mapping[str, xr.Dataset], solver: Solver
) -> list[MappedModel]:
    """Return the models of a run over its incidences and speeds.

    Parameters
    ----------
    config
        The configuration.
    data
        ``equivalent``, with ``modes`` for a beam and ``correction`` for a corrected section.
    solver
        A solver with states.
    """
    given = AsGiven(nominal_k_star(data["equivalent"]), config.flow.speed)
    speeds = speeds_of_map(config, given)
    looked = np.unique([*speeds, speeds[-1] * config.sweep.onset_reach])
    angles = [math.radians(angle) for angle in sorted(config.sweep.incidence_deg)]
    found = []
    for name in config.sweep.models:
        body = body_of_model(config, name, data, solver, given)
        if isinstance(body, str):
            found.append(MappedModel(name, (), body))
        else:
            found.append(MappedModel(name, tuple(map_lines(body, angles, looked))))
    return found


def body_of_model(
    config: Config, name: str, data: Mapping[str, xr.Dataset], solver: Solver, given: AsGiven
) -> BodyInFlow | str:
    """Return a model as a body in the flow, or the reason why there is none."""
    assert isinstance(solver, HasStates), "the plan asks no other solver for a map"
    model = plan.model(name, config.reduction)
    axis = onset_axis(varied(config))
    softest = config.sweep.values()[-1 if axis is SPEED else 0]
    point = Point.at({axis: softest})
    try:
        case = case_at(config, replace(model, corrected=False), point, data, solver)
    except EquisectionError as error:
        return str(error)
    if case.refusal:
        return case.refusal
    body = replace(solver.body(case), speed=float(given.speed_at(case.k_star)))
    if not model.corrected:
        return body
    return replace(body, correction=_correction(factors_from_dataset(data["correction"])))


def _correction(factors: CorrectionFactors) -> SpanCorrection:
    """Return the loads of the finite beam in the place of those of the section."""
    section, beam = factors.section.continued, factors.beam.continued

    def load_factors(alpha: Floats) -> Floats:
        found = np.full((alpha.size, 2), np.nan)
        known = np.array([section.covers(one) and beam.covers(one) for one in alpha], dtype=bool)
        if known.any():
            lift = factors.lift_factor(alpha[known])
            moment = factors.moment_factor(alpha[known])
            found[known] = 1.0 / np.stack([lift, moment], axis=1)
        return found

    return SpanCorrection(beam, load_factors)


def map_dataset(models: Sequence[MappedModel], speeds: Floats) -> xr.Dataset:
    """Return ``comparison/stability_map.nc`` over ``model``, ``incidence_deg`` and ``speed``."""
    found = {one.name: map_of_lines(one.lines, speeds) for one in models if one.lines}
    if not found:
        reasons = "; ".join(f"{one.name}: {one.refusal}" for one in models)
        raise EquisectionError(f"no model of the sweep has a map of stability ({reasons})")
    joined = maps_of_models(found)
    joined["k_star"] = next(iter(found.values()))["k_star"]
    return described(joined)


def stability_table(models: Sequence[MappedModel], design_speed: float | None) -> pd.DataFrame:
    """Return ``comparison/stability.csv``: a row for each model and incidence."""
    rows = []
    for model in models:
        for line in model.lines:
            critical = critical_of(line)
            rows.append(_row(model.name, math.degrees(line.incidence_rad), critical))
        if model.refusal:
            rows.append(_row(model.name, math.nan, Critical(note=model.refusal)))
    table = pd.DataFrame(rows)
    design = math.nan if design_speed is None else design_speed
    table.insert(len(table.columns) - 1, "margin", table["speed_low"] / design)
    return table


def _row(model: str, incidence_deg: float, critical: Critical) -> dict[str, object]:
    values = {
        column: getattr(critical, member) * factor if factor else getattr(critical, member)
        for column, (member, factor) in _COLUMNS.items()
    }
    return {"model": model, "incidence_deg": round(incidence_deg, 9), **values}
