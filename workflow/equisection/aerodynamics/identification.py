"""Identification of the bubble's lags from the loads of a section that moves as recorded.

The recorded twist and deflection drive the load model, and its c_l and c_m are compared with the
recorded ones. Nothing is integrated in a closed loop: what the motion then does (its growth, its
frequency, its means) is a consequence, and can be judged.

There are two steps, since each lag has the coefficient that tells it: tau_1 and tau_2 of the bubble
are those with which c_m fits, which does not depend on tau_3; then tau_3 is that with which c_l
fits. One fit of all three to both would trade the bubble's lag against the lift's. Each is a least
squares over all samples after ``start``, in units of the coefficient's standard deviation. The
means are left out: where the steady polar and the unsteady run differ at rest
(they must not, but on coarse meshes they do) that is an error of the polar, and is reported as
an offset instead of being hidden in a lag.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.aerodynamics.separation import Branches, SeparationLags
from equisection.aerodynamics.unsteady_loads import ForcedMotion, UnsteadyLoads, forced_loads

Floats = NDArray[np.float64]

START = 5.0
"""Convective times after the release that are left out: the start-up of a steady flow field."""

FIRST_GUESS = (2.0, 1.0, 0.5)
"""tau_1, tau_2, tau_3 from which the searches start."""

BOUNDS = ((0.05, 0.0, 0.02), (40.0, 20.0, 5.0))
"""Least and greatest tau_1, tau_2, tau_3."""

#: Lags of the two steps among the three, and the coefficients that tell them.
_BUBBLE, _LIFT_LAG = slice(0, 2), slice(2, 3)
_LIFT, _MOMENT = 0, 1

#: Relative distance from a bound that is none, and the least root mean square, over the standard
#: deviation of the loads, that a lag changes them by.
_AT_BOUND, _LEAST_EFFECT = 1e-3, 0.01


@dataclass(frozen=True)
class LoadMisfit:
    """Loads of the model against those recorded, under the recorded motion, after ``START``.

    Parameters
    ----------
    lift_offset, moment_offset
        Mean of recorded minus modelled c_l and c_m.
    lift_residual, moment_residual
        Standard deviation of the same over that of the recorded coefficient.
    """

    lift_offset: float
    moment_offset: float
    lift_residual: float
    moment_residual: float


@dataclass(frozen=True)
class IdentifiedLags:
    """Outcome of an identification.

    ``lags`` are the values, ``misfits`` how the model does with them, one a history, and
    ``evaluations`` the number of evaluations that the search took. ``untold`` are the names of
    lags that the histories don't tell: they ended at a bound of the search, or change the loads by
    next to nothing.
    """

    lags: SeparationLags
    misfits: tuple[LoadMisfit, ...]
    evaluations: int
    untold: tuple[str, ...] = ()


def identify_lags(
    polar: Polar, histories: Sequence[ReferenceHistory], start: float = START
) -> IdentifiedLags:
    """Find the lags with which the model explains the loads of ``histories`` best.

    Parameters
    ----------
    polar
        Steady polar of the same section, from the same flow solver and mesh.
    histories
        Moving sections.
    start
        Convective times left out at the beginning of each history.
    """
    branches = Branches.from_polar(polar)

    def errors(lags: SeparationLags, coefficient: int) -> Floats:
        loads = UnsteadyLoads(branches, lags)
        parts = [_scaled_errors(history, loads, start)[coefficient] for history in histories]
        return np.concatenate(parts)

    bubble = _search(
        lambda values: errors(SeparationLags(values[0], values[1], 0.0), _MOMENT), _BUBBLE
    )
    relaxation, delay = (float(value) for value in bubble.x)
    lift = _search(
        lambda values: errors(SeparationLags(relaxation, delay, values[0]), _LIFT), _LIFT_LAG
    )
    sources = "; ".join(history.name for history in histories)
    lags = SeparationLags(relaxation, delay, float(lift.x[0]), provenance=sources)
    loads = UnsteadyLoads(branches, lags)
    misfits = tuple(load_misfit(history, loads, start) for history in histories)
    untold = _untold(bubble, _BUBBLE) + _untold(lift, _LIFT_LAG)
    return IdentifiedLags(lags, misfits, int(bubble.nfev + lift.nfev), untold)


def _search(errors: Callable[[Floats], Floats], searched: slice) -> scipy.optimize.OptimizeResult:
    """Find the lags of one step by least squares."""
    least, greatest = (bounds[searched] for bounds in BOUNDS)
    guess = FIRST_GUESS[searched]
    return scipy.optimize.least_squares(errors, guess, bounds=(least, greatest), x_scale=guess)


def _untold(found: scipy.optimize.OptimizeResult, searched: slice) -> tuple[str, ...]:
    """Return the names of the lags at a bound, or by whose own size the loads hardly change."""
    least, greatest = np.array(BOUNDS)[:, searched]
    values = found.x
    at_bound = (values < (1 + _AT_BOUND) * least) | (values > (1 - _AT_BOUND) * greatest)
    effect = np.abs(values) * np.linalg.norm(found.jac, axis=0)
    unknown = at_bound | (effect < _LEAST_EFFECT)
    names = ("relaxation", "delay", "lift_lag")[searched]
    return tuple(name for name, is_unknown in zip(names, unknown, strict=True) if is_unknown)


def load_misfit(
    history: ReferenceHistory, loads: UnsteadyLoads, start: float = START
) -> LoadMisfit:
    """Compare the loads of the model with those of a history, under the recorded motion."""
    lift, moment = _errors(history, loads, start)
    late = history.time > start
    spread = [
        max(float(np.std(values[late])), np.finfo(float).tiny)
        for values in (history.lift_coefficient, history.moment_coefficient)
    ]
    return LoadMisfit(
        float(lift.mean()),
        float(moment.mean()),
        float(lift.std()) / spread[0],
        float(moment.std()) / spread[1],
    )


def _errors(history: ReferenceHistory, loads: UnsteadyLoads, start: float) -> tuple[Floats, Floats]:
    """Return recorded minus modelled c_l and c_m after ``start``."""
    motion = ForcedMotion(history.time, history.incidence_rad + history.twist, history.deflection)
    modelled = forced_loads(motion, loads)
    late = history.time > start
    lift = history.lift_coefficient - modelled.lift_coefficient
    moment = history.moment_coefficient - modelled.moment_coefficient
    return lift[late], moment[late]


def _scaled_errors(
    history: ReferenceHistory, loads: UnsteadyLoads, start: float
) -> tuple[Floats, Floats]:
    lift, moment = _errors(history, loads, start)
    late = history.time > start
    weight = 1.0 / np.sqrt(lift.size)
    return (
        weight * (lift - lift.mean()) / history.lift_coefficient[late].std(),
        weight * (moment - moment.mean()) / history.moment_coefficient[late].std(),
    )
