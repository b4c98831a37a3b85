r"""Static equilibria of a section on the branch that comes from rest, and the end of the branch.

A section is in equilibrium at the incidence alpha = theta_0 + theta where its spring carries the
moment of the polar about the elastic axis,

    k* (alpha - theta_0) = c_m(alpha),    k* = k_theta/(q c^2).

So each alpha has its own dynamic pressure, q c^2/k_theta = (alpha - theta_0)/c_m(alpha), and no
equation has to be solved to find all equilibria. As the speed rises from zero, alpha leaves
theta_0 in the direction of the moment, and goes on

* until q has a maximum, where k* = dc_m/dalpha: a *fold*. At a higher speed there is no
  equilibrium near, and the section diverges, even if another branch has one at a larger twist;
* or to the end of the polar, beyond which nothing is known;
* or for ever, towards an incidence without moment.

Where c_m(theta_0) = 0 the section does not twist at any speed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.polar import Polar
from equisection.beam.section import Section
from equisection.errors import ArgumentError, IncidenceOutOfRangeError
from equisection.motion.strip_system import StripSystem

Floats = NDArray[np.float64]

HALVINGS = 60
"""Halvings of the interval that an incidence is looked for in: to the last digit."""


class BranchEnd(StrEnum):
    """End of a branch of static equilibria, at the highest speed that it reaches."""

    FOLD = "fold"
    POLAR = "end of the polar"
    MISSING = "no steady flow at rest"
    NONE = "none"


@dataclass(frozen=True)
class StaticBranch:
    """Equilibria of a section from rest on.

    Attributes
    ----------
    polar
        Polar of the section.
    start
        Rigid incidence theta_0 (rad), that of the equilibrium at rest.
    stop
        Incidence (rad) at the end of the branch.
    end
        Kind of the end.
    k_star_end
        k* at the end, the lowest of the branch; 0 for a branch without an end.
    axis
        x_ea, chords from mid-chord back to the elastic axis.
    """

    polar: Polar
    start: float
    stop: float
    end: BranchEnd
    k_star_end: float
    axis: float = 0.0

    @cached_property
    def _moment(self) -> scipy.interpolate.PPoly:
        return self.polar.moment_cubic_about(self.axis)

    @classmethod
    def from_rest(cls, polar: Polar, incidence_rad: float, axis: float = 0.0) -> StaticBranch:
        """Follow the branch from theta_0 (rad) to its end, with the axis x_ea behind mid-chord.

        Raises
        ------
        IncidenceOutOfRangeError
            The polar does not cover theta_0.
        """
        polar.require(incidence_rad)
        cubic = polar.moment_cubic_about(axis)
        moment = float(cubic(incidence_rad))
        if moment == 0.0:
            return cls(polar, incidence_rad, incidence_rad, BranchEnd.NONE, 0.0, axis)
        way = math.copysign(1.0, moment)
        limit = polar.incidence_range[1 if way > 0 else 0]
        ends = {
            BranchEnd.FOLD: _first(fold_function(cubic, incidence_rad), incidence_rad, way),
            BranchEnd.NONE: _first(cubic, incidence_rad, way),
            BranchEnd.POLAR: limit,
        }
        end = min(ends, key=lambda each: way * ends[each])
        stop = ends[end]
        k_star_end = 0.0 if end is BranchEnd.NONE else float(cubic(stop)) / (stop - incidence_rad)
        return cls(polar, incidence_rad, stop, end, k_star_end, axis)

    def incidence(self, k_star: ArrayLike) -> Floats:
        """Incidence alpha (rad) of equilibrium at k* (-), any shape; NaN beyond the end."""
        wanted = np.asarray(k_star, dtype=np.float64)
        near = np.full(wanted.shape, self.start)
        if self.stop == self.start:
            return near
        far = np.full(wanted.shape, self.stop)
        way = math.copysign(1.0, self.stop - self.start)
        for _ in range(HALVINGS):
            middle = 0.5 * (near + far)
            carried = way * (wanted * (middle - self.start) - self._moment(middle))
            near = np.where(carried < 0.0, middle, near)
            far = np.where(carried < 0.0, far, middle)
        return np.where(wanted > self.k_star_end, 0.5 * (near + far), np.nan)


def section_in_equilibrium(
    section: Section,
    polar: Polar,
    incidence_rad: float,
    load_factors: tuple[float, float] = (1.0, 1.0),
) -> tuple[float, float] | None:
    """Twist (rad) and deflection (chords) of a section in equilibrium on the branch from rest.

    None beyond the end of the branch, and where the polar does not cover theta_0. With an offset
    axis factors of the loads have no branch in closed form; they are refused.

    Parameters
    ----------
    section
        The section in its flow (:meth:`~equisection.beam.section.Section.in_flow`).
    polar
        Its polar.
    incidence_rad
        Rigid incidence theta_0 (rad).
    load_factors
        Factors of c_l and c_m.

    Raises
    ------
    ArgumentError
        There are factors and an offset axis.
    """
    lift_factor, moment_factor = load_factors
    axis = section.axis_behind_mid_chord
    if load_factors != (1.0, 1.0) and axis:
        raise ArgumentError(
            f"load_factors is {load_factors}; allowed with an elastic axis off mid-chord is (1, 1)"
        )
    try:
        branch = StaticBranch.from_rest(polar, incidence_rad, axis)
    except IncidenceOutOfRangeError:
        return None
    alpha = float(branch.incidence(section.torsional_stiffness / moment_factor))
    if not math.isfinite(alpha):
        return None
    lift = lift_factor * float(polar.lift_coefficient(alpha))
    return alpha - incidence_rad, lift / section.flexural_stiffness


def section_equilibrium(system: StripSystem, incidence_rad: Floats) -> tuple[Floats, Floats]:
    """States Y (N, n) and deficits u (N, d) of N sections in equilibrium at known incidences.

    Every lag has come to rest at alpha, and the springs carry lift and moment of the polar there.

    Parameters
    ----------
    system
        System of N sections, each one strip.
    incidence_rad
        alpha (rad) of each, shape (N,), from :meth:`StaticBranch.incidence`.
    """
    alpha = np.asarray(incidence_rad, dtype=np.float64)
    lift = system.loads.branches.polar.lift_coefficient(alpha)
    layout = system.layout
    states = np.zeros((alpha.size, layout.size))
    states[:, layout.twist] = (alpha - system.incidence)[:, None]
    carried = system.structure.lift_factor * lift
    states[:, layout.deflection] = carried[:, None] / system.structure.bending_stiffness
    for number, value in enumerate((alpha, alpha, alpha, lift)):
        states[:, layout.lag(number)] = value[:, None]
    return states, system.deficits(alpha[:, None])


def fold_function(cubic: scipy.interpolate.PPoly, start: float) -> scipy.interpolate.PPoly:
    """c_m - (alpha - theta_0) dc_m/dalpha, which vanishes where q has a maximum or minimum."""
    third, second, first, constant = cubic.c
    arm = cubic.x[:-1] - start
    return scipy.interpolate.PPoly(
        [
            -2.0 * third,
            -second - 3.0 * third * arm,
            -2.0 * second * arm,
            constant - first * arm,
        ],
        cubic.x,
    )


def _first(function: scipy.interpolate.PPoly, start: float, way: float) -> float:
    """First zero beyond ``start`` in a direction, infinite where there is none."""
    zeros = np.asarray(function.roots(extrapolate=False), dtype=np.float64)
    beyond = zeros[np.isfinite(zeros) & (way * (zeros - start) > 0.0)]
    return float(beyond[np.abs(beyond - start).argmin()]) if beyond.size else way * math.inf
