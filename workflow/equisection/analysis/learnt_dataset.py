"""Learnt models as data sets, ``rom/<model>/model*.nc``, and their onsets.

:mod:`equisection.analysis.learnt_file` reads a model back.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Sequence

import numpy as np
import pandas as pd
import xarray as xr

from equisection.analysis.learning import Lessons
from equisection.analysis.learnt_course import Course
from equisection.analysis.learnt_cycles import with_cycles
from equisection.analysis.reduced_beam import ReducedBeam
from equisection.errors import EquisectionError
from equisection.study.axes import INCIDENCE, Axis

_LOG = logging.getLogger(__name__)


def datasets_of(lessons: Lessons) -> list[xr.Dataset]:
    """Return the models that are learnt at all incidences, in the order of ``plan.learnt_names``.

    Where an incidence of several has nothing to learn from, its data set has the ``refusal`` alone.
    """
    each = lessons.at_each_incidence()
    found = []
    for one in each:
        try:
            course = one.course()
        except EquisectionError as error:
            if len(each) == 1:
                raise
            _LOG.warning("%s at %g deg: %s", one.name, one.incidence_deg, error)
            found.append(_refused(one, str(error)))
            continue
        (_LOG.warning if course.at_odds or course.reservations else _LOG.info)(
            "%s, %s: %s",
            one.name,
            course.words,
            "; ".join(filter(None, (course.confirmation, course.reservations))),
        )
        data = dataset_of(course, one.name, one.axis)
        found.append(with_cycles(data, one.limit_cycles(), one.axis))
    return found


def _refused(lessons: Lessons, reason: str) -> xr.Dataset:
    """Return what is written where there is no model."""
    unknown = dict.fromkeys((f"onset_k_star{end}" for end in ("", "_low", "_high")), math.nan)
    return xr.Dataset(
        attrs={
            "model": lessons.name,
            "axis": lessons.axis.name,
            "incidence_deg": lessons.incidence_deg,
            "words": f"no model: {reason}",
            "refusal": reason,
            "confirmation": "",
            "reservations": "",
            **unknown,
        }
    )


def dataset_of(course: Course, name: str, axis: Axis) -> xr.Dataset:
    """Return what is written to ``rom/<model>/model.nc``."""
    loads, model = course.model.loads, course.model
    table = course.table
    moved = "tip" if isinstance(model, ReducedBeam) else "section"
    described = {
        "k_star": ("1", "k* = k_theta/(q c^2)"),
        "growth_rate": ("V/c", "growth rate of the pitch after a release"),
        "growth_low": ("V/c", "lower end of the band of the growth rate"),
        "growth_high": ("V/c", "upper end of the band of the growth rate"),
        "frequency_strouhal": ("1", "frequency f c/V"),
        "frequency_low": ("1", "lowest frequency of the refits"),
        "frequency_high": ("1", "highest frequency of the refits"),
        "twist_amplitude_deg": ("deg", f"half the range of the {moved}'s twist at the end"),
        "extrapolated": ("1", "1: the motion goes to an incidence that the model has not seen"),
    }
    variables = {
        column: (
            axis.name,
            table[column].replace([math.inf, -math.inf], math.nan).to_numpy(dtype=float),
            {"units": units, "long_name": text, "missing_allowed": "1"},
        )
        for column, (units, text) in described.items()
        if column != axis.name
    }
    fits = [loads, *model.refits]
    per_fit = {
        "rate": ("V/c", "rate g of the lag", [fit.rate for fit in fits]),
        "residual_moment": ("1", "part of the moment left", [fit.residual_moment for fit in fits]),
        "residual_lift": ("1", "part of the lift left", [fit.residual_lift for fit in fits]),
        "learnt_until": ("c/V", "end of the record", [fit.learnt_until for fit in fits]),
    }
    return xr.Dataset(
        {
            **variables,
            "moment_terms": (
                ("fit", "term"),
                np.array([fit.moment for fit in fits]),
                {
                    "units": "1",
                    "long_name": f"B_m of {', '.join(model.terms)}",
                },
            ),
            "lift_terms": (
                ("fit", "term"),
                np.array([fit.lift for fit in fits]),
                {"units": "1", "long_name": "B_l of the same terms"},
            ),
            **{
                one: ("fit", np.array(values), {"units": units, "long_name": text})
                for one, (units, text, values) in per_fit.items()
            },
        },
        coords={
            axis.name: (
                axis.name,
                table[axis.name].to_numpy(dtype=float),
                {"units": axis.unit, "long_name": f"value of the study's axis, {axis.symbol}"},
            )
        },
        attrs={
            "model": name,
            "axis": axis.name,
            "learnt_from": model.learnt_from,
            "learnt_from_k_star": model.k_star,
            "source": model.source,
            "words": course.words,
            "incidence_deg": round(math.degrees(loads.incidence_rad), 9),
            "seen_least_deg": math.degrees(loads.seen[0]),
            "seen_most_deg": math.degrees(loads.seen[1]),
            "missing_angles": " ".join(f"{angle:g}" for angle in model.missing_angles),
            "onset_k_star": course.onset.k_star,
            "onset_k_star_low": course.onset.low,
            "onset_k_star_high": course.onset.high,
            "confirmation": course.confirmation,
            "reservations": course.reservations,
            "at_odds": course.at_odds,
        },
    )


def onsets_of(learnt: Sequence[xr.Dataset], *, over_incidence: bool = False) -> pd.DataFrame:
    """Return the onsets of learnt models, ``rom/<model>/model*.nc``, as columns of the onsets.

    The incidence is one of them in a study that varies it.
    """
    rows = []
    for data in learnt:
        row: dict[str, object] = {"model": data.attrs["model"]}
        if over_incidence:
            row[INCIDENCE.name] = float(data.attrs["incidence_deg"])
        for end in ("", "_low", "_high"):
            row[f"k_star_learnt{end}"] = float(data.attrs[f"onset_k_star{end}"])
        row["learnt"] = data.attrs["words"]
        row |= {name: data.attrs[name] for name in ("confirmation", "reservations")}
        rows.append(row)
    return pd.DataFrame(rows)
