"""Beams of a few modes on strips of the span, released from a steady state.

Torsion and bending modes (``motion.strip_system``) carry the unsteady loads of the section polar
on every strip, and the strips act on each other as ``aerodynamics.finite_span`` has it. Many beams
that differ in stiffness run together: a sweep over k* is one call.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy
from numpy.typing import NDArray

from equisection.aerodynamics.finite_span import FiniteSpan
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.motion.march import Failure, Monitor, Progress, Recording, march
from equisection.motion.steady_states import release_state
from equisection.motion.strip_system import StripStructure, StripSystem, assemble, diagonal

Floats = NDArray[np.float64]
Indices = NDArray[np.intp]

BEAM_TIME_STEP = 0.05
"""Default step in convective times; the modes themselves are integrated exactly at any step."""

OUTPUT_INTERVAL = 0.1
"""Default interval of the histories in convective times."""


@dataclass(frozen=True)
class Fittings:
    """Lumped masses and dashpots of N beams on their modes, non-dimensional.

    Parameters
    ----------
    mass, inertia
        What they add to the mass of each bending mode, shape (N, n_b), and to the inertia of each
        torsion mode, (N, n_t).
    imbalance
        What they add to S_ij, shape (N, n_t, n_b).
    bending_dashpots, torsion_dashpots
        What they add to the dampings, shape (N, n_b, n_b) and (N, n_t, n_t).
    """

    mass: Floats
    inertia: Floats
    imbalance: Floats
    bending_dashpots: Floats
    torsion_dashpots: Floats


@dataclass(frozen=True)
class BeamParameters:
    """Modes of N beams at the strips.

    Parameters
    ----------
    structure
        Shapes at the strips, their weights, generalised inertias, masses and stiffnesses, and
        what the strips do to each other.
    torsion_at_tip, bending_at_tip
        Shapes at the tip, shape (n_t,) and (n_b,): where theta and w/c of the histories are
        taken.
    """

    structure: StripStructure
    torsion_at_tip: Floats
    bending_at_tip: Floats

    @property
    def axis(self) -> float:
        """Place of the elastic axis of all beams, chords behind mid-chord."""
        return float(self.structure.axis[0])

    @classmethod
    def from_modes(
        cls,
        *,
        span: Floats,
        torsion_shapes: Floats,
        torsion_frequencies: Floats,
        inertia: Floats,
        bending_shapes: Floats,
        bending_frequencies: Floats,
        mass: Floats,
        stations: Floats,
        weights: Floats,
        finite_span: FiniteSpan | None = None,
        imbalance: Floats | None = None,
        damping_ratios: tuple[float, float] = (0.0, 0.0),
        axis: float = 0.0,
        fittings: Fittings | None = None,
    ) -> BeamParameters:
        """Take the modes of N uniform beams to S strips.

        Parameters
        ----------
        span
            z/L where the shapes are given, from 0 to 1, shape (m,).
        torsion_shapes, bending_shapes
            f_i, g_j, shape (n_t, m) and (n_b, m).
        torsion_frequencies, bending_frequencies
            omega c/V, shape (N, n_t) and (N, n_b).
        inertia, mass
            Sectional I/(rho c^4/2) and m/(rho c^2/2), shape (N,).
        stations, weights
            z/L of the strips and their share of the span (sum 1), shape (S,).
        finite_span
            Induction and apparent mass of the strips on each other; None for strips that are
            sections, as of a beam between walls.
        imbalance
            Sectional S/(rho c^3/2), shape (N,); None for none.
        damping_ratios
            zeta_w and zeta_theta, of critical, of every bending and torsion mode.
        axis
            x_ea, chords from mid-chord back to the elastic axis.
        fittings
            Lumped masses and dashpots along the span; None for none.

        Notes
        -----
        The tip is where the first shape of each kind is largest (midspan of a beam held at both
        ends). The generalised inertia of mode i is I int f_i^2 dz/L and its stiffness
        omega_i^2 times that; its damping is 2 zeta omega_i times that, viscous. Frequencies are
        those of the modes without imbalance; this couples them by S_ij = S int f_i g_j dz/L.
        """
        torsion, bending = (
            scipy.interpolate.CubicSpline(span, torsion_shapes.T),
            scipy.interpolate.CubicSpline(span, bending_shapes.T),
        )
        torsion_inertia = np.outer(inertia, _square_integral(span, torsion_shapes))
        bending_mass = np.outer(mass, _square_integral(span, bending_shapes))
        across = _product_integral(span, torsion_shapes, bending_shapes)
        coupling = np.multiply.outer(
            np.zeros(inertia.size) if imbalance is None else imbalance, across
        )
        if fittings is not None:
            torsion_inertia = torsion_inertia + fittings.inertia
            bending_mass = bending_mass + fittings.mass
            coupling = coupling + fittings.imbalance
        bending_ratio, torsion_ratio = damping_ratios
        torsion_damping = diagonal(2.0 * torsion_ratio * torsion_frequencies * torsion_inertia)
        bending_damping = diagonal(2.0 * bending_ratio * bending_frequencies * bending_mass)
        if fittings is not None:
            torsion_damping = torsion_damping + fittings.torsion_dashpots
            bending_damping = bending_damping + fittings.bending_dashpots
        structure = StripStructure(
            torsion_shapes=torsion(stations),
            bending_shapes=bending(stations),
            weights=weights,
            torsion_inertia=torsion_inertia,
            torsion_stiffness=torsion_inertia * torsion_frequencies**2,
            bending_mass=bending_mass,
            bending_stiffness=bending_mass * bending_frequencies**2,
            imbalance=coupling,
            torsion_damping=torsion_damping,
            bending_damping=bending_damping,
            axis=np.full(inertia.size, axis),
            lift_factor=np.ones(inertia.size),
            moment_factor=np.ones(inertia.size),
            span=finite_span,
        )
        return cls(
            structure,
            torsion_shapes[:, np.abs(torsion_shapes[0]).argmax()],
            bending_shapes[:, np.abs(bending_shapes[0]).argmax()],
        )


def _square_integral(span: Floats, shapes: Floats) -> Floats:
    return np.asarray(
        scipy.interpolate.CubicSpline(span, (shapes**2).T).integrate(0.0, 1.0), dtype=np.float64
    )


def _product_integral(span: Floats, torsion: Floats, bending: Floats) -> Floats:
    """Integrals of f_i g_j over z/L, shape (n_t, n_b)."""
    products = torsion[:, None, :] * bending[None, :, :]
    return np.asarray(
        scipy.interpolate.CubicSpline(span, products, axis=-1).integrate(0.0, 1.0), dtype=np.float64
    )


@dataclass(frozen=True)
class BeamHistories:
    """Histories of N beams; arrays of shape (n_times, N), NaN after the end of a lane.

    Parameters
    ----------
    time
        s = tV/c, shape (n_times,).
    tip_twist, tip_twist_rate
        theta (rad) at the tip, d theta/ds.
    tip_deflection, tip_deflection_rate
        w/c at the tip, d(w/c)/ds.
    lift_coefficient, moment_coefficient
        C_L, and C_M about the moving mid-chords (Eq. 22).
    axis_moment_coefficient
        C_M about the elastic axis; None where that is at mid-chord.
    torsion_amplitudes, bending_amplitudes
        Theta_i (rad) and W_j (chords), shape (n_times, N, n_t) and (n_times, N, n_b).
    samples
        Number of valid times of each beam, shape (N,).
    failures
        Beams that left the polar, with time and incidence.
    """

    time: Floats
    tip_twist: Floats
    tip_twist_rate: Floats
    tip_deflection: Floats
    tip_deflection_rate: Floats
    lift_coefficient: Floats
    moment_coefficient: Floats
    axis_moment_coefficient: Floats | None
    torsion_amplitudes: Floats
    bending_amplitudes: Floats
    samples: Indices
    failures: tuple[Failure, ...]


BeamMonitor = Callable[[BeamHistories, Indices], Indices]
"""Called with the histories so far and the running lanes; returns the lanes to stop."""


def beam_system(
    parameters: BeamParameters, loads: UnsteadyLoads, incidence_rad: float | Floats
) -> StripSystem:
    """Return the system of N beams at rigid incidence theta_0 (rad), one value or one per beam."""
    return assemble(parameters.structure, loads, incidence_rad)


def release_beams(
    parameters: BeamParameters,
    loads: UnsteadyLoads,
    incidence_rad: float | Floats,
    duration: float,
    *,
    tip_twist: float = 0.0,
    tip_heave_rate: float = 0.0,
    about: Floats | None = None,
    time_step: float = BEAM_TIME_STEP,
    output_interval: float = OUTPUT_INTERVAL,
    monitor: BeamMonitor | None = None,
    progress: Progress | None = None,
) -> BeamHistories:
    """Release N beams from steady flow at theta_0 (rad), at rest and undeformed by default.

    ``tip_twist`` (rad) is that of the first torsion mode in which the beams are held until then,
    ``tip_heave_rate`` (over V, up) the rate of the first bending mode that they get, both at the
    tip, and ``about`` what the twist is beyond
    (:func:`equisection.motion.steady_states.release_state`). ``duration``, ``time_step`` and
    ``output_interval`` are convective times. A beam on which a bubble leaves the polar ends there
    and is named in ``failures``; the others go on.
    """
    system = beam_system(parameters, loads, incidence_rad)
    recording = march(
        system,
        release_state(
            system,
            tip_twist / parameters.torsion_at_tip[0],
            tip_heave_rate / parameters.bending_at_tip[0],
            about,
        ),
        _outputs(parameters, system),
        duration=duration,
        time_step=time_step,
        output_interval=output_interval,
        monitor=_on_recording(monitor, system),
        progress=progress,
    )
    return _histories(recording, system)


def _outputs(parameters: BeamParameters, system: StripSystem) -> Floats:
    """Rows: tip theta, theta', w, w', then C_L, C_M, Theta, W and, off mid-chord, C_M,ea."""
    layout, strips = system.layout, system.layout.strips
    lanes, _, columns = system.rates.shape
    unit = np.eye(layout.size, columns)
    tip = np.stack(
        [
            parameters.torsion_at_tip @ unit[layout.twist],
            parameters.torsion_at_tip @ unit[layout.twist_rate],
            parameters.bending_at_tip @ unit[layout.deflection],
            parameters.bending_at_tip @ unit[layout.deflection_rate],
        ]
    )
    weights = system.structure.weights
    loads = system.strip_loads
    total = np.stack([weights @ loads[:, :strips], weights @ loads[:, strips:]], axis=1)
    amplitudes = np.concatenate([unit[layout.twist], unit[layout.deflection]])

    def for_all(rows: Floats) -> Floats:
        return np.broadcast_to(rows, (lanes, *rows.shape))

    about_axis = (weights @ system.axis_moments)[:, None]
    return np.concatenate(
        [for_all(tip), total, for_all(amplitudes)]
        + ([about_axis] if system.structure.is_offset else []),
        axis=1,
    )


def _on_recording(monitor: BeamMonitor | None, system: StripSystem) -> Monitor | None:
    """Let a monitor of histories watch the recording of a march."""
    if monitor is None:
        return None

    def stop(recording: Recording, active: Indices) -> Indices:
        return monitor(_histories(recording, system), active)

    return stop


def _histories(recording: Recording, system: StripSystem) -> BeamHistories:
    values = recording.values[: recording.recorded]
    rows = np.moveaxis(values, 2, 0)
    first_bending = 6 + system.layout.torsion_modes
    end = first_bending + system.layout.bending_modes
    return BeamHistories(
        time=recording.time[: recording.recorded],
        tip_twist=rows[0],
        tip_twist_rate=rows[1],
        tip_deflection=rows[2],
        tip_deflection_rate=rows[3],
        lift_coefficient=rows[4],
        moment_coefficient=rows[5],
        axis_moment_coefficient=rows[end] if system.structure.is_offset else None,
        torsion_amplitudes=values[:, :, 6:first_bending],
        bending_amplitudes=values[:, :, first_bending:end],
        samples=recording.samples,
        failures=tuple(recording.failures),
    )
