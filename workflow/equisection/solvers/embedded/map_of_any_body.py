"""Stability of a section or a beam over incidence and speed, without a configuration."""

from __future__ import annotations

import math
import warnings
from typing import Literal

import numpy as np
import xarray as xr
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.polar import Polar, require_polar
from equisection.aerodynamics.separation import IDENTIFIED_LAGS, SeparationLags
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.beam import Beam
from equisection.beam.section import Section
from equisection.cases import Geometry
from equisection.cases.beam_in_flow import beam_modes_in_flow
from equisection.config.groups import Embedded, Structure
from equisection.conventions import STANDARD_AIR
from equisection.errors import ArgumentError
from equisection.keys.arguments import require_positive
from equisection.keys.written_number import LARGEST, SMALLEST
from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.map_dataset import map_of_body
from equisection.reduction.reduce import section_of_pair
from equisection.solvers.embedded.adapter import Adapter
from equisection.structure.modes import modes_of_kinds, require_method
from equisection.structure.warping import warping_warnings

Floats = NDArray[np.float64]

_STRUCTURE, _EMBEDDED = Structure(), Embedded()
_MODES = (_STRUCTURE.bending_modes, _STRUCTURE.torsion_modes)
_ELEMENTS = (
    _STRUCTURE.elements.chord,
    _STRUCTURE.elements.span,
    _STRUCTURE.elements.thickness,
)
#: Modes that are computed beyond those that are wanted, since some are in the chord's plane.
_OTHER_MODES = 4
FEWEST_STRIPS, MOST_STRIPS = 4, 100


def stability_map(
    body: Section | Beam,
    polar: Polar,
    *,
    incidence_deg: ArrayLike,
    speed: ArrayLike,
    density: float = STANDARD_AIR,
    lags: SeparationLags = IDENTIFIED_LAGS,
    method: Literal["solid", "beam", "analytic"] = "solid",
    elements: tuple[int, int, int] = _ELEMENTS,
    modes: tuple[int, int] = _MODES,
    strips: int = _EMBEDDED.strips,
    root_on_wall: bool = True,
    channel: tuple[float, float] | None = None,
) -> xr.Dataset:
    """Stability of a section or a beam over incidence and speed, with its critical speeds.

    Beyond :func:`equisection.motion.stability.stability` the modes are followed from near vacuum,
    the critical speed at each incidence comes with its mechanism and its motion, and what one has
    to know of it (a band of instability that ends, an incidence beyond the polar) is in ``note``.

    A beam carries the loads of the section's polar on strips of its span, which act on each other
    as those of a finite wing do; its supports may be any that :class:`Beam` has.

    Parameters
    ----------
    body
        The section (SI), or the beam.
    polar
        Steady coefficients of the section.
    incidence_deg
        Rigid incidences theta_0 (deg); a single number leaves no dimension of it.
    speed
        Two speeds V (m/s) or more, rising; an onset is looked for up to the last.
    density
        Density of the fluid rho (kg/m^3); by default that of air at sea level.
    lags
        Lags of the separation bubble, by default those of a thin plate with sharp edges.
    method, elements
        Computation of a beam's modes (:func:`equisection.reduction.beam_section.reduce`). Supports
        and lumped masses need ``beam``, a ``cross_section`` that or ``analytic``.
    modes
        Numbers of modes of bending and of torsion of a beam.
    strips
        Strips of a beam along its span.
    root_on_wall
        Presence of a wall at the root of a beam, which mirrors the flow; with False both ends
        are free in it.
    channel
        Height and tip gap (chords) of a channel around a beam (``flow.channel``); None for free
        air.

    Returns
    -------
    xarray.Dataset
        Over ``incidence_deg``, ``speed`` and ``mode``; every variable has units and a long name.

    Raises
    ------
    ArgumentError
        An incidence is not finite, the speeds do not rise from above 0, the density is not
        positive, or there are no modes or too few strips.
    ModesError
        The method cannot have this beam; the message says which can.
    ReductionError
        Nothing restrains the beam.
    """
    require_polar(polar)
    angles = np.atleast_1d(np.asarray(incidence_deg, dtype=np.float64))
    speeds = np.atleast_1d(np.asarray(speed, dtype=np.float64))
    if angles.ndim > 1 or not angles.size or not np.isfinite(angles).all():
        raise ArgumentError(f"incidence_deg is {incidence_deg!r}; wanted finite numbers (deg)")
    rises = speeds.ndim == 1 and speeds.size > 1 and bool((np.diff(speeds) > 0.0).all())
    if not (rises and speeds[0] >= SMALLEST and speeds[-1] <= LARGEST):
        raise ArgumentError(f"speed is {speed!r}; wanted two rising numbers above 0 (m/s) or more")
    require_positive("density", density, "kg/m3")
    if isinstance(body, Section):
        flowing = BodyInFlow.of_section(body, UnsteadyLoads.from_polar(polar, lags), density)
    else:
        _require_numbers(modes, strips, channel)
        solver = Adapter(polar, strips, lags, _EMBEDDED.incidence_point)
        flowing = _of_beam(
            body,
            solver,
            _geometry(body, channel, root_on_wall),
            density=density,
            method=method,
            elements=elements,
            numbers=modes,
        )
    data = map_of_body(flowing, list(angles), list(speeds))
    if np.ndim(incidence_deg) == 0:
        data = data.isel(incidence_deg=0)
    return data.assign_attrs(density=density, density_units="kg m-3")


def _require_numbers(
    modes: tuple[int, int], strips: int, channel: tuple[float, float] | None
) -> None:
    if not (_is_pair(modes) and all(_is_whole(one) and one >= 1 for one in modes)):
        raise ArgumentError(
            f"modes is {modes!r}; wanted two whole numbers from 1 on, of bending and of torsion"
        )
    if not (_is_whole(strips) and FEWEST_STRIPS <= strips <= MOST_STRIPS):
        raise ArgumentError(
            f"strips is {strips!r}; wanted a whole number from {FEWEST_STRIPS} to {MOST_STRIPS}"
        )
    if channel is not None and not (
        _is_pair(channel) and 1.0 < channel[0] < math.inf and 0.0 <= channel[1] < math.inf
    ):
        raise ArgumentError(
            f"channel is {channel!r}; wanted a height above 1 and a tip gap from 0 on (chords)"
        )


def _is_pair(value: object) -> bool:
    return isinstance(value, tuple | list) and len(value) == 2


def _is_whole(value: object) -> bool:
    return isinstance(value, int | np.integer) and not isinstance(value, bool)


def _of_beam(
    beam: Beam,
    solver: Adapter,
    geometry: Geometry,
    *,
    density: float,
    method: str,
    elements: tuple[int, int, int],
    numbers: tuple[int, int],
) -> BodyInFlow:
    """Return a beam in a fluid of a density (kg/m^3), at the speed at which k* is 1."""
    require_method(beam, method)
    for text in (*beam.warnings, *warping_warnings(beam, method)):
        warnings.warn(text, stacklevel=3)
    found = modes_of_kinds(beam, method, elements, numbers, sum(numbers) + _OTHER_MODES)
    section = section_of_pair(beam, found.section_pair()[0], "paper")
    speed = section.k_star(density, 1.0) ** 0.5
    flowing = beam_modes_in_flow(beam, found, numbers, density=density, speed=speed)
    return solver.beam_body(flowing, geometry, speed=speed, k_star=1.0)


def _geometry(beam: Beam, channel: tuple[float, float] | None, root_on_wall: bool) -> Geometry:
    height, gap = channel or (None, None)
    return Geometry(
        chord=beam.chord,
        span=beam.length / beam.chord,
        thickness=beam.thickness / beam.chord,
        root_on_wall=root_on_wall,
        channel_height=height,
        tip_gap=gap,
        upstream=None,
        downstream=None,
    )
