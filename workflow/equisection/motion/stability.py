"""Stability of a section over incidence and speed, from eigenvalues about its static equilibrium.

The system of the embedded solver (:mod:`equisection.motion.strip_system`) is linearised about the
equilibrium on the branch that comes from rest (:mod:`equisection.motion.static_branch`). A small
motion then goes with exp(p s), s = tV/c, and the eigenvalue p = sigma + i omega of largest sigma
decides: with sigma > 0 the section is unstable, by *divergence* where omega = 0. What grows where
omega > 0 is told apart by the power that the air puts into each motion
(:mod:`equisection.motion.mechanism`). Where the branch has ended in a fold there is nothing to
linearise about: that is divergence too. Where it has left the polar the stability is unknown, never
assumed.

Loads are those of a thin section in attached flow with the polar's own slopes, and a lagging
separation bubble (:mod:`equisection.aerodynamics.unsteady_loads`).
"""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from functools import cached_property
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.derivatives import Derivatives
from equisection.aerodynamics.polar import Polar, require_polar
from equisection.aerodynamics.separation import IDENTIFIED_LAGS, SeparationLags
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.section import Section
from equisection.conventions import STANDARD_AIR
from equisection.errors import ArgumentError
from equisection.keys.arguments import require_positive
from equisection.keys.written_number import LARGEST, SMALLEST
from equisection.motion.derivative_flutter import (
    critical_speed_by_derivatives,
    stability_by_derivatives,
)
from equisection.motion.mechanism import (
    Instabilities,
    Mechanism,
    least_stable_instabilities,
)
from equisection.motion.sections import section_system
from equisection.motion.static_branch import BranchEnd, StaticBranch, section_equilibrium

Floats = NDArray[np.float64]
Texts = NDArray[np.str_]

#: Parts of the power of the air, and with them what tells a mechanism (:class:`Instabilities`).
SHARES = ("heave_share", "twist_share", "coupling_share")
_TOLD = (*SHARES, "heave_phase")
STEP = 0.005
"""Relative step of the speeds at which an onset is looked for."""
WIDTH = 1e-6
"""Relative width of the interval of speed that an onset is known to."""


def stability(
    section: Section,
    polar: Polar | Derivatives,
    *,
    incidence_deg: ArrayLike | None = None,
    speed: ArrayLike,
    density: float = STANDARD_AIR,
    lags: SeparationLags = IDENTIFIED_LAGS,
) -> xr.Dataset:
    """Growth, frequency and mechanism of the least stable motion of a section.

    Parameters
    ----------
    section
        The section (SI).
    polar
        Steady coefficients of the section, or its flutter derivatives
        (:func:`equisection.motion.derivative_flutter.stability_by_derivatives`).
    incidence_deg
        Rigid incidence theta_0 (deg), one or a list; none with derivatives, which have their own.
    speed
        Speed V (m/s), one or a list.
    density
        Density of the fluid rho (kg/m^3); by default that of air at sea level.
    lags
        Lags of the separation bubble. The default was identified for a thin plate with sharp
        edges; `SeparationLags.none()` is for flow that stays attached.

    Returns
    -------
    xarray.Dataset
        Over ``incidence_deg`` and ``speed``, each only where a list was given: ``growth_rate``
        (1/s), ``growth_rate_convective`` (V/c), ``frequency`` (Hz), ``frequency_strouhal``
        (f c/V), ``mechanism`` (:class:`equisection.motion.mechanism.Mechanism`), ``reason``,
        ``equilibrium_twist`` (rad), ``equilibrium_deflection`` (m), ``k_star``; of oscillations
        that grow, by which the mechanism is told, ``heave_share``, ``twist_share`` and
        ``coupling_share`` of the power of the air, and ``heave_phase`` (deg). Where there is no
        equilibrium the numbers are NaN, and ``reason`` says why.

    Raises
    ------
    ArgumentError
        A speed or the density is not positive.
    IncidenceOutOfRangeError
        The polar does not cover a rigid incidence.
    """
    if isinstance(polar, Derivatives):
        _of_the_table(incidence_deg)
        return stability_by_derivatives(section, polar, speed=speed, density=density)
    angles = _finite("incidence_deg", incidence_deg)
    speeds = _positive("speed", speed, "m/s")
    air = _Air(section, polar, density, lags)
    rows = [air.points(float(angle), np.atleast_1d(speeds)) for angle in np.atleast_1d(angles)]
    time = section.chord / np.atleast_1d(speeds)
    values: dict[str, list[Any]] = {
        "growth_rate": [row.eigenvalue.real / time for row in rows],
        "growth_rate_convective": [row.eigenvalue.real for row in rows],
        "frequency": [row.strouhal / time for row in rows],
        "frequency_strouhal": [row.strouhal for row in rows],
        "mechanism": [row.mechanism for row in rows],
        "reason": [row.reason for row in rows],
        "equilibrium_twist": [row.twist for row in rows],
        "equilibrium_deflection": [row.deflection * section.chord for row in rows],
        **{name: [getattr(row.told, name) for row in rows] for name in _TOLD},
    }
    dataset = xr.Dataset(
        {
            **{name: (("incidence_deg", "speed"), np.array(rows)) for name, rows in values.items()},
            "k_star": ("speed", air.k_star(np.atleast_1d(speeds))),
        },
        {"incidence_deg": np.atleast_1d(angles), "speed": np.atleast_1d(speeds)},
        attrs=air.attributes,
    )
    return _described(dataset, {"incidence_deg": angles, "speed": speeds})


def critical_speed(
    section: Section,
    polar: Polar | Derivatives,
    *,
    incidence_deg: ArrayLike | None = None,
    speed: tuple[float, float],
    density: float = STANDARD_AIR,
    lags: SeparationLags = IDENTIFIED_LAGS,
) -> xr.Dataset:
    """Lowest speed at which a section loses its stability, within a range of speeds.

    The range is searched in steps of half a per cent, so that a band of instability narrower than
    that may be missed; the first step across is halved to an interval of a millionth.

    Parameters
    ----------
    section, polar, density, lags
        As of :func:`stability`.
    incidence_deg
        Rigid incidence theta_0 (deg), one or a list; none with derivatives.
    speed
        Lowest and highest speed (m/s) of the range.

    Returns
    -------
    xarray.Dataset
        Over ``incidence_deg``, if a list was given: ``critical_speed`` (m/s), the interval
        ``speed_low`` (stable) and ``speed_high`` (unstable) that it is known to, ``mechanism``,
        ``frequency`` (Hz), ``k_star``, ``equilibrium_twist`` (rad), ``reason``, and at
        ``speed_high`` what the mechanism is told by, as of :func:`stability`. Where there is no
        onset in the range ``critical_speed`` is NaN, ``reason`` says why, and of the interval
        there is what is known: of a section that is stable throughout ``speed_low`` alone.

    Raises
    ------
    ArgumentError
        The range is no two rising positive speeds, or the density is not positive.
    IncidenceOutOfRangeError
        The polar does not cover a rigid incidence.
    """
    low, high = _range(speed)
    if isinstance(polar, Derivatives):
        _of_the_table(incidence_deg)
        return critical_speed_by_derivatives(section, polar, speed=(low, high), density=density)
    angles = _finite("incidence_deg", incidence_deg)
    air = _Air(section, polar, density, lags)
    found = [air.onset(float(angle), low, high) for angle in np.atleast_1d(angles)]
    dataset = xr.Dataset(
        {
            name: ("incidence_deg", np.array([getattr(onset, name) for onset in found]))
            for name in (field.name for field in fields(_Onset))
        },
        {"incidence_deg": np.atleast_1d(angles)},
        attrs={**air.attributes, "speed_range": f"{low:g} to {high:g} m/s", "basis": "eigenvalue"},
    )
    return _described(dataset, {"incidence_deg": angles})


@dataclass(frozen=True)
class _Points:
    """Equilibrium and least stable motion at N speeds, each of shape (N,).

    ``eigenvalue`` p (V/c), ``twist`` (rad) and ``deflection`` (chords) of equilibrium; all NaN
    where there is none. ``mechanism`` names a Mechanism, ``told`` has what it is told by, and
    ``reason`` says why there is none.
    """

    speed: Floats
    eigenvalue: NDArray[np.complex128]
    twist: Floats
    deflection: Floats
    mechanism: Texts
    reason: Texts
    told: Instabilities

    @property
    def strouhal(self) -> Floats:
        """Frequency f c/V (-)."""
        return self.eigenvalue.imag / math.tau


@dataclass(frozen=True)
class _Onset:
    """First loss of stability in a range of speeds; NaN where there is none."""

    critical_speed: float
    speed_low: float
    speed_high: float
    mechanism: str
    frequency: float
    k_star: float
    equilibrium_twist: float
    reason: str
    heave_share: float = math.nan
    twist_share: float = math.nan
    coupling_share: float = math.nan
    heave_phase: float = math.nan


@dataclass(frozen=True)
class _Air:
    """A section in a fluid of one density."""

    section: Section
    polar: Polar
    density: float
    lags: SeparationLags

    def __post_init__(self) -> None:
        require_polar(self.polar)
        require_positive("density", self.density, "kg/m3")

    @cached_property
    def loads(self) -> UnsteadyLoads:
        return UnsteadyLoads.from_polar(self.polar, self.lags)

    @property
    def attributes(self) -> dict[str, str | float]:
        """Return all that decides the answer but incidence and speed."""
        return {
            "density": self.density,
            "density_units": "kg m-3",
            "chord": self.section.chord,
            "chord_units": "m",
            "polar": self.polar.label,
            "lags": self.lags.provenance,
            "equilibrium": "on the branch that comes from rest",
        }

    def k_star(self, speeds: Floats) -> Floats:
        """k* (-) at speeds (m/s)."""
        return np.array([self.section.k_star(self.density, float(speed)) for speed in speeds])

    def points(self, incidence_deg: float, speeds: Floats) -> _Points:
        """Equilibrium and least stable motion at speeds (m/s)."""
        rigid = math.radians(incidence_deg)
        branch = StaticBranch.from_rest(self.polar, rigid, self.section.axis_behind_mid_chord)
        alpha = branch.incidence(self.k_star(speeds))
        system = section_system(
            [self.section.in_flow(self.density, float(speed)) for speed in speeds],
            self.loads,
            rigid,
        )
        states, deficits = section_equilibrium(system, alpha)
        eigenvalue, found = least_stable_instabilities(system, states, deficits)
        lost = ~np.isfinite(eigenvalue)
        folded = np.isnan(alpha) & (branch.end is BranchEnd.FOLD)
        mechanism = np.where(folded, Mechanism.DIVERGENCE, found.mechanism)
        reason = np.where(lost, self._end(branch), "")
        twist, deflection = states[:, system.layout.twist], states[:, system.layout.deflection]
        return _Points(speeds, eigenvalue, twist[:, 0], deflection[:, 0], mechanism, reason, found)

    def _end(self, branch: StaticBranch) -> str:
        """Say why there is no equilibrium beyond the end of a branch."""
        at = f"{math.degrees(branch.stop - branch.start):.3g} deg"
        if branch.end is BranchEnd.FOLD:
            speed = self._speed(branch.k_star_end)
            return f"no equilibrium near: the twist has a fold at {at} and {speed:.5g} m/s"
        least, greatest = np.degrees(self.polar.incidence_range)
        return (
            f"the equilibrium leaves the polar, which covers {least:.4g} to {greatest:.4g} deg: "
            "extend it"
        )

    def _speed(self, k_star: float) -> float:
        """Speed (m/s) at which the section has a k* (-)."""
        return math.sqrt(self.section.k_star(self.density, 1.0) / k_star)

    def onset(self, incidence_deg: float, low: float, high: float) -> _Onset:
        """First loss of stability between two speeds (m/s)."""
        count = math.ceil(math.log(high / low) / STEP) + 1
        points = self.points(incidence_deg, np.geomspace(low, high, count))
        lost = np.flatnonzero(points.mechanism != "none")
        if not lost.size:
            return _no_onset(high, math.nan, "none", f"none up to {high:g} m/s")
        if lost[0] == 0:
            mechanism = str(points.mechanism[0])
            reason = str(points.reason[0]) or f"unstable already at {low:g} m/s: begin below"
            below = math.nan if mechanism == "unknown" else low
            return _no_onset(math.nan, below, mechanism, reason)
        return self._refined(incidence_deg, *points.speed[lost[0] - 1 : lost[0] + 1])

    def _refined(self, incidence_deg: float, stable: float, unstable: float) -> _Onset:
        """Onset between two speeds (m/s) that are close, by halving what is between."""
        after = self.points(incidence_deg, np.array([unstable]))
        while unstable - stable > WIDTH * stable:
            middle = self.points(incidence_deg, np.array([0.5 * (stable + unstable)]))
            if middle.mechanism[0] == "none":
                stable = float(middle.speed[0])
            else:
                unstable, after = float(middle.speed[0]), middle
        mechanism, reason = str(after.mechanism[0]), str(after.reason[0])
        if mechanism == "unknown":
            return _no_onset(
                stable, math.nan, mechanism, f"none up to {stable:.5g} m/s, where {reason}"
            )
        last = self.points(incidence_deg, np.array([stable]))
        speed = 0.5 * (stable + unstable)
        return _Onset(
            critical_speed=speed,
            speed_low=stable,
            speed_high=unstable,
            mechanism=mechanism,
            frequency=float(last.strouhal[0]) * speed / self.section.chord,
            k_star=self.section.k_star(self.density, speed),
            equilibrium_twist=float(last.twist[0]),
            reason=reason,
            **{name: float(getattr(after.told, name)[0]) for name in _TOLD},
        )


def _no_onset(low: float, high: float, mechanism: str, reason: str) -> _Onset:
    nan = math.nan
    return _Onset(nan, low, high, mechanism, nan, nan, nan, reason)


#: Units and meaning of coordinates and variables.
_MEANING = {
    "incidence_deg": ("deg", "rigid incidence theta_0, nose up"),
    "speed": ("m s-1", "speed V of the flow"),
    "growth_rate": ("s-1", "growth rate of the least stable motion"),
    "growth_rate_convective": ("V/c", "growth rate of the least stable motion"),
    "frequency": ("Hz", "frequency of the least stable motion"),
    "frequency_strouhal": ("1", "frequency of the least stable motion f c/V"),
    "mechanism": ("1", f"mechanism of the instability: {', '.join(Mechanism)}"),
    "heave_share": ("1", "part of the power of the air that comes by heave alone"),
    "twist_share": ("1", "part of the power of the air that comes by twist alone"),
    "coupling_share": ("1", "part of the power of the air that comes by coupling"),
    "heave_phase": ("deg", "phase of the heave, up, ahead of the twist, nose up"),
    "reason": ("1", "why there is no equilibrium or no onset"),
    "equilibrium_twist": ("rad", "twist of the section in static equilibrium, nose up"),
    "equilibrium_deflection": ("m", "deflection of the section in static equilibrium, up"),
    "k_star": ("1", "k* = k_theta/(q c^2)"),
    "critical_speed": ("m s-1", "lowest speed at which the section is unstable"),
    "speed_low": ("m s-1", "highest speed up to which the section is known to be stable"),
    "speed_high": ("m s-1", "lowest speed at which the section is known to be unstable"),
}


def _described(dataset: xr.Dataset, given: dict[str, Floats]) -> xr.Dataset:
    """Put units and names on a data set, and take away the dimensions of single values."""
    for name in dataset.variables:
        units, long_name = _MEANING[str(name)]
        dataset[name].attrs = {"units": units, "long_name": long_name}
    return dataset.isel({name: 0 for name, values in given.items() if values.ndim == 0})


def _range(speed: tuple[float, float]) -> tuple[float, float]:
    values = _positive("speed", speed, "m/s")
    if values.shape != (2,) or values[0] >= values[1]:
        raise ArgumentError(
            f"speed is {speed!r}; wanted the lowest and the highest speed (m/s) of the range, for "
            "instance (5.0, 60.0)"
        )
    return float(values[0]), float(values[1])


def _of_the_table(incidence_deg: ArrayLike | None) -> None:
    """Refuse an incidence beside derivatives, which are those of one."""
    if incidence_deg is not None:
        raise ArgumentError(
            f"incidence_deg is {incidence_deg!r}; leave it out with flutter derivatives, which are "
            "of the mean incidence that they were found at"
        )


def _finite(name: str, given: ArrayLike | None) -> Floats:
    """Return one number or a list of them."""
    try:
        values = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        values = np.array(np.nan)
    if values.ndim > 1 or not values.size or not np.isfinite(values).all():
        raise ArgumentError(f"{name} is {given!r}; wanted a finite number or a list of them")
    return values


def _positive(name: str, given: ArrayLike, units: str) -> Floats:
    values = _finite(name, given)
    if not np.all(values > 0.0):
        raise ArgumentError(f"{name} is {given!r}; wanted numbers above 0 ({units})")
    if not np.all((values >= SMALLEST) & (values <= LARGEST)):
        raise ArgumentError(
            f"{name} is {given!r}; wanted numbers from {SMALLEST:g} to {LARGEST:g} ({units})"
        )
    return values
