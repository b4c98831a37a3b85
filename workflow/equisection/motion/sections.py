"""Sections with two degrees of freedom, released from the rigid steady state.

    I* theta'' + k* theta = c_m,    m* (w/c)'' + k_w* (w/c) = c_l

with the unsteady loads of ``aerodynamics.unsteady_loads``; any number of cases in one run.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.motion.march import Failure, Monitor, Progress, Recording, march
from equisection.motion.steady_states import rigid_state
from equisection.motion.strip_system import StripStructure, StripSystem, assemble

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

SECTION_TIME_STEP = 0.05
"""Default step in convective times."""

OUTPUT_INTERVAL = 0.1
"""Default interval of the histories in convective times."""


@dataclass(frozen=True)
class SectionParameters:
    """Non-dimensional parameters of N sections, each of shape (N,).

    ``inertia`` I*, ``torsional_stiffness`` k*, ``mass`` m*, ``heave_stiffness`` k_w* (Eq. 18).
    """

    inertia: Floats
    torsional_stiffness: Floats
    mass: Floats
    heave_stiffness: Floats

    @classmethod
    def from_ratios(
        cls,
        k_star: ArrayLike,
        inertia: ArrayLike,
        mass_ratio: ArrayLike,
        stiffness_ratio: ArrayLike,
    ) -> SectionParameters:
        """From k*, I*, c^2 m_2D/I_2D = m*/I* and c^2 k_w/k_theta = k_w*/k*, broadcast."""
        k, i, m, s = np.broadcast_arrays(
            *(
                np.atleast_1d(np.asarray(v, float))
                for v in (k_star, inertia, mass_ratio, stiffness_ratio)
            )
        )
        return cls(i.copy(), k.copy(), i * m, k * s)

    def __post_init__(self) -> None:
        for name in ("inertia", "torsional_stiffness", "mass", "heave_stiffness"):
            values = np.asarray(getattr(self, name), dtype=np.float64)
            if values.shape != np.shape(self.inertia) or values.ndim != 1:
                raise ValueError(f"{name} has shape {values.shape}; one value a section is wanted")
            if not np.all(values > 0.0):
                raise ValueError(f"{name} has the value {values.min():g}; all must be positive")


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
    samples: Indices
    failures: tuple[Failure, ...]


SectionMonitor = Callable[[SectionHistories, Indices], Indices]
"""Called with the histories so far and the running lanes; returns the lanes to stop."""


def section_system(
    parameters: SectionParameters, loads: UnsteadyLoads, incidence_rad: float | Floats
) -> StripSystem:
    """System of N sections at rigid incidence theta_0 (rad), one value or one per section."""
    one = np.ones((1, 1))
    structure = StripStructure(
        torsion_shapes=one,
        bending_shapes=one,
        weights=np.ones(1),
        torsion_inertia=np.asarray(parameters.inertia)[:, None],
        torsion_stiffness=np.asarray(parameters.torsional_stiffness)[:, None],
        bending_mass=np.asarray(parameters.mass)[:, None],
        bending_stiffness=np.asarray(parameters.heave_stiffness)[:, None],
        induction=np.zeros((1, 1)),
    )
    return assemble(structure, loads, incidence_rad)


def release_sections(
    parameters: SectionParameters,
    loads: UnsteadyLoads,
    incidence_rad: float | Floats,
    duration: float,
    *,
    time_step: float = SECTION_TIME_STEP,
    output_interval: float = OUTPUT_INTERVAL,
    monitor: SectionMonitor | None = None,
    progress: Progress | None = None,
) -> SectionHistories:
    """Release N sections, at rest and untwisted, from steady flow at theta_0 (rad).

    ``duration``, ``time_step`` and ``output_interval`` are convective times. A section whose
    bubble leaves the polar ends there and is named in ``failures``; the others go on.
    """
    system = section_system(parameters, loads, incidence_rad)
    states = np.eye(4, system.rates.shape[2])[None].repeat(system.structure.lanes, axis=0)
    outputs = np.concatenate([states, system.strip_loads], axis=1)
    recording = march(
        system,
        rigid_state(system),
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
    # rows: Theta, Theta', W, W' as in the layout of the states, then c_l, c_m
    rows = np.moveaxis(recording.values[: recording.recorded], 2, 0)
    return SectionHistories(
        time=recording.time[: recording.recorded],
        twist=rows[0],
        twist_rate=rows[1],
        deflection=rows[2],
        deflection_rate=rows[3],
        lift_coefficient=rows[4],
        moment_coefficient=rows[5],
        samples=recording.samples,
        failures=tuple(recording.failures),
    )
