r"""Bodies with one parameter varied: mass, stiffness, damping, axes, lags, polar and density.

A parameter that is never zero varies by a part of itself; one that may be zero (damping ratio,
static imbalance, place of the elastic axis) by an amount in its unit. What is not named stays:
under another mass, inertia or stiffness the damping *ratios* stay, so that the damping goes with
the square root.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.strip_system import StripStructure

Floats = NDArray[np.float64]
Change = Callable[[BodyInFlow, float], BodyInFlow]


@dataclass(frozen=True)
class BodyParameter:
    """Parameter of a body in its flow.

    Attributes
    ----------
    name
        Its name.
    unit
        Unit of its value.
    by_a_part
        Variation by a part of the value; else by an amount in its unit.
    value
        Function of the body and the density (kg/m^3) that returns its value; of a beam the
        generalised one of the first mode (shapes as the solver has them), over the span.
    changed
        Function of the body and a part or an amount that returns the body with the parameter
        varied.
    """

    name: str
    unit: str
    by_a_part: bool
    value: Callable[[BodyInFlow, float], float]
    changed: Change


def parameters_of(body: BodyInFlow) -> list[BodyParameter]:
    """Return the parameters that a body has: lags that are zero, or drag that is, are none."""
    lags = body.loads.lags
    absent = {
        "tau_1": lags.relaxation == 0.0,
        "tau_2": lags.delay == 0.0,
        "tau_3": lags.lift_lag == 0.0,
        "drag": not body.loads.has_drag,
    }
    return [one for one in PARAMETERS if not absent.get(one.name)]


def _with(body: BodyInFlow, **changes: Any) -> BodyInFlow:
    return replace(body, structure=replace(body.structure, **changes))


def _scaled(member: str, damping: str) -> Change:
    """Return the change of a mass, inertia or stiffness under which the damping ratios stay."""

    def changed(body: BodyInFlow, part: float) -> BodyInFlow:
        one, factor = body.structure, 1.0 + part
        values = {
            member: factor * getattr(one, member),
            damping: math.sqrt(factor) * getattr(one, damping),
        }
        return _with(body, **values)

    return changed


def _sectional_mass(one: StripStructure) -> float:
    """M/(rho c^2/2) of a uniform body: the first generalised mass over the integral of g^2."""
    square = float(one.weights @ one.bending_shapes[:, 0] ** 2)
    return float(one.bending_mass[0, 0]) / square


def _across(one: StripStructure) -> Floats:
    """Integrals of f_i g_j over the span, over its length, shape (n_t, n_b)."""
    return np.asarray((one.torsion_shapes * one.weights[:, None]).T @ one.bending_shapes)


def _with_mass_behind(body: BodyInFlow, amount: float) -> BodyInFlow:
    one = body.structure
    more = amount * _sectional_mass(one) * _across(one)
    return _with(body, imbalance=one.imbalance + more)


def _mass_behind(body: BodyInFlow, density: float) -> float:
    del density
    one = body.structure
    return float(one.imbalance[0, 0, 0]) / _sectional_mass(one) / float(_across(one)[0, 0])


def _with_axis_behind(body: BodyInFlow, amount: float) -> BodyInFlow:
    return _with(body, axis=body.structure.axis + amount)


def _critical_damping(stiffness: Floats, inertia: Floats) -> Floats:
    """Critical damping of each mode as a matrix, shape (N, m, m)."""
    return np.asarray(2.0 * np.sqrt(stiffness * inertia)[:, :, None] * np.eye(stiffness.shape[1]))


def _critical_in_bending(one: StripStructure) -> Floats:
    return _critical_damping(one.bending_stiffness, one.bending_mass)


def _critical_in_torsion(one: StripStructure) -> Floats:
    return _critical_damping(one.torsion_stiffness, one.torsion_inertia)


def _damped_in_bending(body: BodyInFlow, amount: float) -> BodyInFlow:
    one = body.structure
    return _with(body, bending_damping=one.bending_damping + amount * _critical_in_bending(one))


def _damped_in_torsion(body: BodyInFlow, amount: float) -> BodyInFlow:
    one = body.structure
    return _with(body, torsion_damping=one.torsion_damping + amount * _critical_in_torsion(one))


def _lagging(member: str) -> Change:
    def changed(body: BodyInFlow, part: float) -> BodyInFlow:
        old = body.loads.lags
        values = {name: getattr(old, name) for name in ("relaxation", "delay", "lift_lag")}
        values[member] *= 1.0 + part
        lags = SeparationLags(**values, provenance="varied")
        return replace(body, loads=replace(body.loads, lags=lags))

    return changed


def _with_polar(coefficient: str) -> Change:
    def scaled(polar: Polar, factor: float) -> Polar:
        values = {name: getattr(polar, name) for name in ("drag", "lift", "moment")}
        values[coefficient] = factor * values[coefficient]
        return Polar(polar.incidence, **values, label=polar.label)

    def changed(body: BodyInFlow, part: float) -> BodyInFlow:
        loads, correction = body.loads, body.correction
        polar = scaled(loads.branches.polar, 1.0 + part)
        if correction is not None:
            correction = replace(correction, polar=scaled(correction.polar, 1.0 + part))
        return replace(
            body,
            loads=UnsteadyLoads.from_polar(polar, loads.lags, loads.rear_point),
            correction=correction,
        )

    return changed


def _in_denser_fluid(body: BodyInFlow, part: float) -> BodyInFlow:
    one, factor = body.structure, 1.0 / (1.0 + part)
    thinner = {
        name: factor * getattr(one, name)
        for name in (
            "torsion_inertia",
            "torsion_stiffness",
            "torsion_damping",
            "bending_mass",
            "bending_stiffness",
            "bending_damping",
            "imbalance",
        )
    }
    return replace(_with(body, **thinner), k_star=factor * body.k_star)


def _dimensional(member: str, chords: int, speeds: int) -> Callable[[BodyInFlow, float], float]:
    """Return a reader of a quantity in SI from its value over (rho/2) V^speeds c^chords."""

    def value(body: BodyInFlow, density: float) -> float:
        first = float(getattr(body.structure, member).flat[0])
        return first * 0.5 * density * body.speed**speeds * body.chord**chords

    return value


#: Parameters of any body, in the order of tables. Lift, moment and drag scale the whole polar; the
#: value of the first two is the slope at zero lift, that of the drag a factor.
PARAMETERS = (
    BodyParameter(
        "mass",
        "kg/m",
        True,
        _dimensional("bending_mass", 2, 0),
        _scaled("bending_mass", "bending_damping"),
    ),
    BodyParameter(
        "inertia",
        "kg m",
        True,
        _dimensional("torsion_inertia", 4, 0),
        _scaled("torsion_inertia", "torsion_damping"),
    ),
    BodyParameter(
        "k_w",
        "N/m2",
        True,
        _dimensional("bending_stiffness", 0, 2),
        _scaled("bending_stiffness", "bending_damping"),
    ),
    BodyParameter(
        "k_theta",
        "N/rad",
        True,
        _dimensional("torsion_stiffness", 2, 2),
        _scaled("torsion_stiffness", "torsion_damping"),
    ),
    BodyParameter("mass_axis", "chord", False, _mass_behind, _with_mass_behind),
    BodyParameter(
        "elastic_axis",
        "chord",
        False,
        lambda body, _: float(body.structure.axis[0]),
        _with_axis_behind,
    ),
    BodyParameter(
        "damping_bending",
        "of critical",
        False,
        lambda body, _: float(
            body.structure.bending_damping[0, 0, 0] / _critical_in_bending(body.structure)[0, 0, 0]
        ),
        _damped_in_bending,
    ),
    BodyParameter(
        "damping_torsion",
        "of critical",
        False,
        lambda body, _: float(
            body.structure.torsion_damping[0, 0, 0] / _critical_in_torsion(body.structure)[0, 0, 0]
        ),
        _damped_in_torsion,
    ),
    BodyParameter(
        "tau_1", "c/V", True, lambda body, _: body.loads.lags.relaxation, _lagging("relaxation")
    ),
    BodyParameter("tau_2", "c/V", True, lambda body, _: body.loads.lags.delay, _lagging("delay")),
    BodyParameter(
        "tau_3", "c/V", True, lambda body, _: body.loads.lags.lift_lag, _lagging("lift_lag")
    ),
    BodyParameter(
        "lift", "1/rad", True, lambda body, _: body.loads.branches.lift_slope, _with_polar("lift")
    ),
    BodyParameter(
        "moment",
        "1/rad",
        True,
        lambda body, _: body.loads.branches.moment_slope,
        _with_polar("moment"),
    ),
    BodyParameter("drag", "1", True, lambda body, _: 1.0, _with_polar("drag")),
    BodyParameter("density", "kg/m3", True, lambda _, density: density, _in_denser_fluid),
)
