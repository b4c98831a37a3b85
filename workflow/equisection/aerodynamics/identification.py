"""Identification of the bubble's lags from the loads of a section that moves as recorded.

The recorded twist and deflection drive the load model, and its c_l and c_m are compared with the
recorded ones. Nothing is integrated in a closed loop: what the motion then does (its growth, its
frequency, its means) is a consequence, and can be judged.

Least squares over all samples after ``start``, each coefficient in units of its own standard
deviation. The means are left out: where the steady polar and the unsteady run differ at rest
(they must not, but on coarse meshes they do) that is an error of the polar, and is reported as
an offset instead of being hidden in a lag.
"""

from __future__ import annotations

from collections.abc import Sequence
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
"""tau_1, tau_2, tau_3 from which the search starts."""

BOUNDS = ((0.05, 0.0, 0.02), (40.0, 20.0, 5.0))
"""Least and greatest tau_1, tau_2, tau_3."""

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

    def residuals(values: Floats) -> Floats:
        loads = UnsteadyLoads(branches, SeparationLags(*values))
        parts = [part for history in histories for part in _scaled_errors(history, loads, start)]
        return np.concatenate(parts)

    found = scipy.optimize.least_squares(residuals, FIRST_GUESS, bounds=BOUNDS, x_scale=FIRST_GUESS)
    sources = "; ".join(history.name for history in histories)
    relaxation, delay, lift_lag = (float(value) for value in found.x)
    lags = SeparationLags(relaxation, delay, lift_lag, provenance=sources)
    loads = UnsteadyLoads(branches, lags)
    misfits = tuple(load_misfit(history, loads, start) for history in histories)
    return IdentifiedLags(lags, misfits, int(found.nfev), _untold(found.x, found.jac))


def _untold(values: Floats, jacobian: Floats) -> tuple[str, ...]:
    """Return the names of the lags at a bound, or by whose own size the loads hardly change."""
    least, greatest = np.array(BOUNDS)
    at_bound = (values < (1 + _AT_BOUND) * least) | (values > (1 - _AT_BOUND) * greatest)
    effect = np.abs(values) * np.linalg.norm(jacobian, axis=0)
    names = ("relaxation", "delay", "lift_lag")
    unknown = at_bound | (effect < _LEAST_EFFECT)
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
