"""A known history judged by other criteria, in the place of another run."""

from __future__ import annotations

import math

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from equisection.cases import Case, UnsteadyCase
from equisection.solvers.verdicts import TipMotion, decided_at, first_modes, is_decided, judge

#: Costs of a run, which grow with its length.
_COSTS = ("wall_seconds", "cpu_seconds")


def judged_again(case: Case, known: xr.Dataset) -> xr.Dataset | None:
    """Return the result of a case from a result with the same history.

    The history ends where the run would have ended: at the first look that finds a verdict, or at
    the longest duration.

    Parameters
    ----------
    case
        The case, with criteria and duration of its own.
    known
        Result of a case of the same history, of whatever length.

    Returns
    -------
    Dataset or None
        None where the known history is too short to tell, or the case asks for no verdict.
    """
    if not isinstance(case, UnsteadyCase):
        return None
    time = known["time"].values
    last = float(time[-1]) if time.size else 0.0
    end = decided_at(case, tip_motion(known))
    if math.isfinite(end):
        return _cut(case, known, end)
    if is_decided(case, tip_motion(known, case.duration)) or last >= _last_sample(case):
        return _cut(case, known, case.duration)
    return None


def _last_sample(case: UnsteadyCase) -> float:
    """Return the time from which on a history is as long as it may be (c/V)."""
    return case.duration - 1.5 * case.output_interval


def _upto(known: xr.Dataset, end: float) -> xr.Dataset:
    return known.sel(time=slice(None, end * (1 + 1e-9)))


def tip_motion(known: xr.Dataset, end: float = math.inf) -> TipMotion:
    """Return the motion of the tip up to a time (c/V), in chords where the file has metres."""
    part = _upto(known, end)
    deflection = part["tip_deflection"].values / float(known.attrs["chord"])
    return TipMotion(part["time"].values, part["tip_twist"].values, deflection, _first_modes(part))


def _first_modes(known: xr.Dataset) -> NDArray[np.float64]:
    """Return the amplitudes of the modes that a growth is fitted to; none of a section."""
    names = ("torsion_amplitude", "bending_amplitude")
    if not all(name in known for name in names):
        return np.empty((0, 0))
    return first_modes(*(known[name].values for name in names))


def _cut(case: UnsteadyCase, known: xr.Dataset, end: float) -> xr.Dataset:
    part = _upto(known, end)
    length = float(part["time"].values[-1])
    share = length / float(known["time"].values[-1])
    return part.assign_attrs(
        judge(case, tip_motion(known, end)),
        end_time=length,
        **{name: share * float(known.attrs[name]) for name in _COSTS},
    )
