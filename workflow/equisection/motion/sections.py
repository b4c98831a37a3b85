"""Sections with two degrees of freedom, released from a steady state.

    I* theta'' - S* (w/c)'' + c_theta* theta' + k* theta = c_m,ea
    m* (w/c)'' - S* theta'' + c_w* (w/c)'     + k_w* (w/c) = c_l

with the unsteady loads of ``aerodynamics.unsteady_loads``, and the moment transferred from
mid-chord to the elastic axis (``motion.strip_system``); any number of cases in one run.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.beam.section import Section
from equisection.motion.march import Failure, Monitor, Progress, Recording, march
from equisection.motion.steady_states import release_state
from equisection.motion.strip_system import StripStructure, StripSystem, assemble

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

SECTION_TIME_STEP = 0.05
"""Default step in convective times."""

OUTPUT_INTERVAL = 0.1
"""Default interval of the histories in convective times."""

_OF_STRIPS = ("elastic_axis", "static_imbalance", "flexural_damping", "torsional_damping")
"""Members beyond mass and springs that the strip model has."""


@dataclass(frozen=True)
class SectionHistories:
    """Histories of N sections; arrays of shape (n_times, N), NaN after the end of a lane.

    Parameters
    ----------
    time
        s = tV/c, shape (n_times,).
    twist, twist_rate
        theta (rad), d theta/ds.
    deflection, deflection_rate
        w/c, d(w/c)/ds.
    lift_coefficient, moment_coefficient
        c_l, and c_m about the moving mid-chord.
    axis_moment_coefficient
        c_m about the elastic axis, with the load factors; None where all axes are at mid-chord.
    samples
        Number of valid times of each section, shape (N,).
    failures
        Sections that left the polar, with time and incidence.
    """

    time: Floats
    twist: Floats
    twist_rate: Floats
    deflection: Floats
    deflection_rate: Floats
    lift_coefficient: Floats
    moment_coefficient: Floats
    axis_moment_coefficient: Floats | None
    samples: Indices
    failures: tuple[Failure, ...]


SectionMonitor = Callable[[SectionHistories, Indices], Indices]
"""Called with the histories so far and the running lanes; returns the lanes to stop."""


def section_system(
    sections: Sequence[Section],
    loads: UnsteadyLoads,
    incidence_rad: float | Floats,
    load_factors: Floats | None = None,
) -> StripSystem:
    """System of N sections at rigid incidence theta_0 (rad), one value or one per section.

    Parameters
    ----------
    sections
        The sections in their flow (:meth:`equisection.beam.section.Section.in_flow`).
    loads, incidence_rad
        Unsteady loads of the section's polar, and theta_0 (rad), one value or one per section.
    load_factors
        Factors of c_l and of c_m about mid-chord (-), shape (N, 2); None for 1.

    Raises
    ------
    EquisectionError
        A section is in SI units.
    """
    for section in sections:
        section.require_in_flow()
        section.require_defaults("the strip model", but=_OF_STRIPS)
    one = np.ones((1, 1))
    factors = np.ones((len(sections), 2)) if load_factors is None else load_factors
    structure = StripStructure(
        torsion_shapes=one,
        bending_shapes=one,
        weights=np.ones(1),
        torsion_inertia=_column(sections, "inertia"),
        torsion_stiffness=_column(sections, "torsional_stiffness"),
        bending_mass=_column(sections, "mass"),
        bending_stiffness=_column(sections, "flexural_stiffness"),
        imbalance=_column(sections, "static_imbalance")[:, :, None],
        torsion_damping=_column(sections, "torsional_damping")[:, :, None],
        bending_damping=_column(sections, "flexural_damping")[:, :, None],
        axis=_column(sections, "axis_behind_mid_chord")[:, 0],
        lift_factor=factors[:, 0],
        moment_factor=factors[:, 1],
    )
    return assemble(structure, loads, incidence_rad)


def _column(sections: Sequence[Section], member: str) -> Floats:
    """Return a member of each section, shape (N, 1)."""
    return np.array([[getattr(section, member)] for section in sections])


def release_sections(
    sections: Sequence[Section],
    loads: UnsteadyLoads,
    incidence_rad: float | Floats,
    duration: float,
    *,
    load_factors: Floats | None = None,
    twist: float | Floats = 0.0,
    heave_rate: float | Floats = 0.0,
    about: Floats | None = None,
    time_step: float = SECTION_TIME_STEP,
    output_interval: float = OUTPUT_INTERVAL,
    monitor: SectionMonitor | None = None,
    progress: Progress | None = None,
) -> SectionHistories:
    """Release N sections from steady flow at theta_0 (rad), at rest and untwisted by default.

    ``twist`` (rad) is that at which the sections are held until then, ``heave_rate`` (over V,
    up) the rate that they get, and ``about`` what the twist is beyond
    (:func:`equisection.motion.steady_states.release_state`), one value or one per section.
    ``load_factors`` are those of :func:`section_system`; the loads of the histories are without
    them. ``duration``, ``time_step`` and ``output_interval`` are convective times. A section whose
    bubble leaves the polar ends there and is named in ``failures``; the others go on.
    """
    system = section_system(sections, loads, incidence_rad, load_factors)
    states = np.eye(4, system.rates.shape[2])[None].repeat(system.structure.lanes, axis=0)
    loads_of_strip = [system.strip_loads]
    if system.structure.is_offset:
        loads_of_strip.append(system.axis_moments)
    outputs = np.concatenate([states, *loads_of_strip], axis=1)
    recording = march(
        system,
        release_state(system, twist, heave_rate, about),
        outputs,
        duration=duration,
        time_step=time_step,
        output_interval=output_interval,
        monitor=_on_recording(monitor),
        progress=progress,
    )
    return _histories(recording)


def _on_recording(monitor: SectionMonitor | None) -> Monitor | None:
    """Let a monitor of histories watch the recording of a march."""
    if monitor is None:
        return None

    def stop(recording: Recording, active: Indices) -> Indices:
        return monitor(_histories(recording), active)

    return stop


def _histories(recording: Recording) -> SectionHistories:
    # rows: Theta, Theta', W, W' as in the layout of the states, then c_l, c_m and c_m,ea
    rows = np.moveaxis(recording.values[: recording.recorded], 2, 0)
    return SectionHistories(
        time=recording.time[: recording.recorded],
        twist=rows[0],
        twist_rate=rows[1],
        deflection=rows[2],
        deflection_rate=rows[3],
        lift_coefficient=rows[4],
        moment_coefficient=rows[5],
        axis_moment_coefficient=rows[6] if len(rows) > 6 else None,
        samples=recording.samples,
        failures=tuple(recording.failures),
    )
