"""Flutter of a section, or of a beam on its modes, from flutter derivatives.

The loads Q(K) of a table (:mod:`equisection.aerodynamics.derivatives`), K = omega c/V, take the
place of Theodorsen's in p^2 M + p sqrt(s) C + s K - Q: on a section, or on each strip of a beam,
weighted by the products of its modes. Structural dampers are in C.

Onset
    The neutral oscillation (:func:`equisection.motion.linear_flutter.neutral_oscillations`) of the
    lowest speed beyond which a motion grows. It is exact for the loads between the rows.
Growth
    p at a speed is a root of the equations with the loads of its own frequency, Im p = K (p-k
    method, Hassig, Journal of Aircraft 8, 1971); exact where it is zero. The imaginary parts of all
    roots at a K, in order, are continuous in K, so that each change of sign of Im p - K within the
    table is a motion, and none is lost or taken twice.

A table says nothing of frequencies outside of its rows, and nothing of divergence, which is none of
its frequencies: where it ends the answer is ``unknown``.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
import scipy
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.derivatives import Derivatives
from equisection.aerodynamics.generalised_forces import GeneralisedForces
from equisection.aerodynamics.load_table import LoadTable
from equisection.beam.section import Section
from equisection.conventions import STANDARD_AIR
from equisection.errors import ArgumentError
from equisection.motion.beam_flutter import BeamInFlow, reference_speed
from equisection.motion.linear_flutter import FlutterEquations, Neutral, neutral_oscillations
from equisection.structure.modal_matrices import ModalMatrices

Floats = NDArray[np.float64]
Complexes = NDArray[np.complex128]

#: Frequencies within a table at which oscillations are looked for.
_FREQUENCIES = 300
#: Relative distance in speed from a neutral oscillation at which growth is looked at.
_ASIDE = 2e-3
#: Growth (V/c) that is round-off.
_ROUND_OFF = 1e-9
#: Speeds at which a body without an onset is looked at.
_SPEEDS = 40


@dataclass(frozen=True)
class DerivativeOnset:
    """First onset of flutter by a table of derivatives; NaN for what is not known.

    Attributes
    ----------
    speed : float
        Speed of the onset (m/s).
    speed_low, speed_high : float
        Interval of the onset: of the interpolation, by tables of half the rows, and of the spread
        of the derivatives, by one standard deviation of each. Without an onset ``speed_low`` is the
        highest speed at which the table has all motions, and they decay.
    omega : float
        Its angular frequency (rad/s).
    mechanism : str
        ``flutter``, ``none`` or ``unknown``.
    reason : str
        What there is to say of it.
    """

    speed: float
    speed_low: float
    speed_high: float
    omega: float
    mechanism: str
    reason: str = ""

    @property
    def frequency(self) -> float:
        """Frequency of the onset (Hz)."""
        return self.omega / math.tau


@dataclass(frozen=True)
class FlowingBody:
    """Body at the speed at which its k* is 1, to be put into the loads of a table.

    Attributes
    ----------
    reference_speed
        That speed (m/s).
    chord
        c (m).
    in_vacuum
        Its natural frequencies (rad/s), rising.
    equations
        Equations of its motions with the loads of a table, of which it takes one kind.
    """

    reference_speed: float
    chord: float
    in_vacuum: Floats
    equations: Callable[[Any], FlutterEquations]

    @classmethod
    def of_section(cls, section: Section, density: float) -> FlowingBody:
        """Body of a section (SI) in a fluid of a density (kg/m^3)."""
        speed = reference_speed(section.torsional_stiffness, section.chord, density)
        flow = section.in_flow(density, speed)

        def equations(table: Derivatives) -> FlutterEquations:
            return FlutterEquations(
                flow.mass_matrix,
                flow.damping_matrix,
                flow.stiffness_matrix,
                lambda omega: table.influence(omega, section.elastic_axis),
            )

        return cls(speed, section.chord, section.natural_frequencies, equations)

    @classmethod
    def of_beam(
        cls, matrices: ModalMatrices, chord: float, elastic_axis: float, density: float
    ) -> FlowingBody:
        """Body of a beam on its modes (SI), as of :func:`..beam_flutter.beam_flutter`."""
        flow = BeamInFlow(matrices, chord, elastic_axis, density)

        def equations(table: Derivatives) -> FlutterEquations:
            return flow.equations_with(lambda omega: table.influence(omega, elastic_axis))

        return cls(flow.speed, chord, matrices.natural_frequencies, equations)

    @classmethod
    def of_moved_beam(
        cls, matrices: ModalMatrices, chord: float, elastic_axis: float, density: float
    ) -> FlowingBody:
        """Body of a beam on its modes (SI) that takes generalised forces on the same modes."""
        flow = BeamInFlow(matrices, chord, elastic_axis, density)

        def equations(forces: GeneralisedForces) -> FlutterEquations:
            return FlutterEquations(flow.mass, flow.damping, flow.stiffness, forces.influence)

        return cls(flow.speed, chord, matrices.natural_frequencies, equations)


class _OfTable:
    """A body in the loads of one table."""

    def __init__(self, body: FlowingBody, table: LoadTable) -> None:
        self.body = body
        self.equations = body.equations(table)
        self.frequencies = np.geomspace(*table.frequencies, _FREQUENCIES)
        self.velocities = float(table.reduced_velocity[0]), float(table.reduced_velocity[-1])

    @cached_property
    def loads(self) -> Complexes:
        """Q at each frequency, shape (m, n, n)."""
        return np.array([self.equations.influence(float(k)) for k in self.frequencies])

    @cached_property
    def neutral(self) -> list[Neutral]:
        """Neutral oscillations by rising speed."""
        found = neutral_oscillations(self.equations, self.frequencies)
        return sorted(found, key=lambda each: -each.scale)

    def _p(self, scale: float, loads: Complexes) -> Complexes:
        """Return the n roots p that turn fastest forwards, by rising Im p; loads (..., n, n)."""
        mass, size = np.linalg.inv(self.equations.mass), len(self.equations.mass)
        above = np.broadcast_to(np.eye(size), loads.shape)
        companion = np.zeros((*loads.shape[:-2], 2 * size, 2 * size), dtype=np.complex128)
        companion[..., :size, size:] = above
        companion[..., size:, :size] = mass @ (loads - scale * self.equations.stiffness)
        companion[..., size:, size:] = -math.sqrt(scale) * mass @ self.equations.damping
        p = np.linalg.eigvals(companion)
        order = np.argsort(p.imag, axis=-1)[..., size:]
        return np.asarray(np.take_along_axis(p, order, axis=-1))

    def motions(self, speed: float) -> Complexes:
        """Return p (V/c) of the motions at a speed (m/s) whose frequencies the table has."""
        scale = (self.body.reference_speed / speed) ** 2
        missed = self._p(scale, self.loads).imag - self.frequencies[:, None]
        found = []
        for place, number in np.argwhere(missed[:-1] * missed[1:] <= 0.0):

            def of(k: float, number: int = int(number)) -> complex:
                return complex(self._p(scale, self.equations.influence(k))[number])

            low, high = self.frequencies[place : place + 2]
            k = scipy.optimize.brentq(lambda k, of=of: of(k).imag - k, low, high, xtol=1e-14)
            found.append(of(float(k)))
        return np.array(found, dtype=np.complex128)

    def speed(self, neutral: Neutral) -> float:
        """Return the speed (m/s) of a neutral oscillation."""
        return self.body.reference_speed / math.sqrt(neutral.scale)

    def grows(self, speed: float) -> bool:
        """Tell whether a motion grows at a speed (m/s)."""
        return bool((self.motions(speed).real > _ROUND_OFF).any())

    def first(self, within: tuple[float, float]) -> tuple[Neutral | None, str]:
        """Return the first onset between two speeds (m/s), and a reason where there is none."""
        there = [n for n in self.neutral if within[0] <= self.speed(n) <= within[1]]
        for neutral in there:
            speed = self.speed(neutral)
            if self.grows(speed * (1.0 - _ASIDE)):
                return (
                    None,
                    f"unstable already below {speed:.5g} m/s, where the motion comes to rest",
                )
            if self.grows(speed * (1.0 + _ASIDE)):
                return neutral, ""
        low, high = self.velocities
        return None, f"no neutral oscillation at reduced velocities {low:.4g} to {high:.4g}"

    def looked_at(self, within: tuple[float, float]) -> Iterator[float]:
        """Give rising speeds (m/s) at which a natural frequency is one of the table."""
        low, high = self.velocities
        per_velocity = self.body.chord / math.tau
        slowest = max(low * self.body.in_vacuum[0] * per_velocity, within[0])
        fastest = min(high * self.body.in_vacuum[-1] * per_velocity, within[1])
        if slowest < fastest:
            yield from map(float, np.geomspace(slowest, fastest, _SPEEDS))


def derivative_onset(
    body: FlowingBody, table: LoadTable, speed: tuple[float, float] = (0.0, math.inf)
) -> DerivativeOnset:
    """First onset of flutter of a body in the loads of a table.

    Parameters
    ----------
    body
        Section or beam.
    table
        Flutter derivatives, or generalised forces of a moved beam.
    speed
        Lowest and highest speed (m/s) looked at.
    """
    flow = _OfTable(body, table)
    neutral, reason = flow.first(speed)
    if neutral is None:
        return _without_onset(flow, speed, reason)
    found = flow.speed(neutral)
    if not table.thinned() and table.spread is None:
        reason = "without an interval: too few rows to leave some out, and no spread"
        low = high = math.nan
    else:
        below, above = _half_widths(body, table, found)
        low, high = found - below, found + above
    omega = neutral.omega * found / body.chord
    return DerivativeOnset(found, low, high, omega, "flutter", reason)


def _without_onset(flow: _OfTable, within: tuple[float, float], reason: str) -> DerivativeOnset:
    """Say what is known where no onset was found."""
    stable = math.nan
    for speed in flow.looked_at(within):
        p = flow.motions(speed)
        if (p.real > _ROUND_OFF).any():
            omega = float(p[np.argmax(p.real)].imag) * speed / flow.body.chord
            text = f"unstable at {speed:.5g} m/s, the lowest speed whose motion the table has"
            if not math.isnan(stable):
                text = f"a motion that grows enters the table at {speed:.5g} m/s"
            return DerivativeOnset(math.nan, stable, speed, omega, "flutter", text)
        if len(p) >= len(flow.equations.mass):
            stable = speed
    mechanism = "unknown" if math.isnan(stable) else "none"
    return DerivativeOnset(math.nan, stable, math.nan, math.nan, mechanism, reason)


def _half_widths(body: FlowingBody, table: LoadTable, found: float) -> tuple[float, float]:
    """Return how far the onset (m/s) may be below and above what was found.

    The largest change by a table of half the rows, and the root of the sum of squares of the
    changes by one standard deviation of each derivative at all reduced velocities together.
    Infinite where another table has no onset.
    """

    def change(other: LoadTable) -> float:
        flow = _OfTable(body, other)
        speeds = [flow.speed(n) for n in flow.neutral if flow.grows(flow.speed(n) * (1 + _ASIDE))]
        return min((one - found for one in speeds), key=abs, default=math.inf)

    thinned = max((abs(change(one)) for one in table.thinned()), default=0.0)
    below = above = 0.0
    if table.spread is not None:
        for number in range(table.quantities):
            both = [change(table.shifted(number, times)) for times in (-1.0, 1.0)]
            below += max(0.0, *(-one for one in both)) ** 2
            above += max(0.0, *both) ** 2
    return min(math.hypot(thinned, math.sqrt(below)), found), math.hypot(thinned, math.sqrt(above))


def stability_by_derivatives(
    section: Section, table: Derivatives, *, speed: ArrayLike, density: float = STANDARD_AIR
) -> xr.Dataset:
    """Growth, frequency and mechanism of the least stable motion of a section by its derivatives.

    Parameters
    ----------
    section
        The section (SI).
    table
        Flutter derivatives.
    speed
        Speed V (m/s), one or a list.
    density
        Density of the fluid rho (kg/m^3); by default that of air at sea level.

    Returns
    -------
    xarray.Dataset
        Over ``speed``, where a list was given: ``growth_rate`` (1/s), ``growth_rate_convective``
        (V/c), ``frequency`` (Hz), ``frequency_strouhal`` (f c/V), ``mechanism``, ``reason`` and
        ``k_star``. The mechanism is `unknown` where no motion grows and the table does not have the
        frequency of each.

    Raises
    ------
    ArgumentError
        A speed or the density is not positive.
    """
    speeds = np.asarray(speed, dtype=np.float64)
    if not (np.isfinite(speeds).all() and (speeds > 0.0).all() and speeds.ndim <= 1):
        raise ArgumentError(f"speed is {speed!r}; allowed are positive numbers (m/s)")
    if not (math.isfinite(density) and density > 0.0):
        raise ArgumentError(f"density is {density!r}; allowed is a positive number (kg/m3)")
    flow = _OfTable(FlowingBody.of_section(section, density), table)
    rows = [_row(flow, float(one)) for one in np.atleast_1d(speeds)]
    p = np.array([row[0] for row in rows])
    rate = np.atleast_1d(speeds) / section.chord
    k_star = [section.k_star(density, float(one)) for one in np.atleast_1d(speeds)]
    variables = {
        "growth_rate": (p.real * rate, "s-1", "growth rate of the least stable motion"),
        "growth_rate_convective": (p.real, "V/c", "growth rate of the least stable motion"),
        "frequency": (p.imag / math.tau * rate, "Hz", "frequency of the least stable motion"),
        "frequency_strouhal": (p.imag / math.tau, "1", "frequency of that motion f c/V"),
        "mechanism": (np.array([row[1] for row in rows]), "1", "none, flutter or unknown"),
        "reason": (np.array([row[2] for row in rows]), "1", "why it is unknown"),
        "k_star": (np.array(k_star), "1", "k* = k_theta/(q c^2)"),
    }
    dataset = xr.Dataset(
        {
            name: ("speed", values, {"units": units, "long_name": long_name})
            for name, (values, units, long_name) in variables.items()
        },
        {"speed": ("speed", np.atleast_1d(speeds), {"units": "m s-1", "long_name": "speed V"})},
        attrs={"density": density, "density_units": "kg m-3", "derivatives": table.label},
    )
    return dataset if speeds.ndim else dataset.isel(speed=0)


def _row(flow: _OfTable, speed: float) -> tuple[complex, str, str]:
    """Return p (V/c) of the least stable motion at a speed (m/s), mechanism and reason."""
    p = flow.motions(speed)
    least = complex(p[np.argmax(p.real)]) if p.size else complex(math.nan, math.nan)
    if p.size and least.real > _ROUND_OFF:
        return least, "flutter", ""
    wanted = len(flow.equations.mass)
    if len(p) >= wanted:
        return least, "none", ""
    low, high = flow.velocities
    return (
        least,
        "unknown",
        f"{len(p)} of {wanted} motions at reduced velocities {low:.4g} to {high:.4g}, which the "
        "table has",
    )


def critical_speed_by_derivatives(
    section: Section,
    table: Derivatives,
    *,
    speed: tuple[float, float],
    density: float = STANDARD_AIR,
) -> xr.Dataset:
    """Lowest speed at which a section flutters by its derivatives, within a range of speeds.

    Parameters
    ----------
    section, table, density
        As of :func:`stability_by_derivatives`.
    speed
        Lowest and highest speed (m/s) of the range.

    Returns
    -------
    xarray.Dataset
        The members of :class:`DerivativeOnset` with ``critical_speed`` for its speed, and
        ``frequency`` (Hz) and ``k_star``.

    Raises
    ------
    ArgumentError
        The range is no two rising positive speeds, or the density is not positive.
    """
    low, high = np.asarray(speed, dtype=np.float64).tolist()
    if not 0.0 < low < high < math.inf:
        raise ArgumentError(f"speed is {speed!r}; wanted two rising positive speeds (m/s)")
    if not (math.isfinite(density) and density > 0.0):
        raise ArgumentError(f"density is {density!r}; allowed is a positive number (kg/m3)")
    found = derivative_onset(FlowingBody.of_section(section, density), table, (low, high))
    variables = {
        "critical_speed": (found.speed, "m s-1", "lowest speed at which the section flutters"),
        "speed_low": (found.speed_low, "m s-1", "lower end of its interval"),
        "speed_high": (found.speed_high, "m s-1", "upper end of its interval"),
        "mechanism": (found.mechanism, "1", "flutter, none or unknown"),
        "frequency": (found.frequency, "Hz", "frequency at the onset"),
        "k_star": (
            math.nan if math.isnan(found.speed) else section.k_star(density, found.speed),
            "1",
            "k* = k_theta/(q c^2)",
        ),
        "reason": (found.reason, "1", "why there is no onset or no interval"),
    }
    return xr.Dataset(
        {
            name: ((), value, {"units": units, "long_name": long_name})
            for name, (value, units, long_name) in variables.items()
        },
        attrs={
            "density": density,
            "density_units": "kg m-3",
            "derivatives": table.label,
            "basis": "derivatives",
        },
    )
