"""Known flutter in attached flow of a long wing and of a typical section, by other authors."""

from __future__ import annotations

import math
from functools import cache

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.beam.beam import Beam
from equisection.beam.section import Section
from equisection.clone import CLONE
from equisection.motion.beam_flutter import FlutterOnset, beam_flutter
from equisection.motion.stability import critical_speed
from equisection.reduction.reduce import reduce_beam
from equisection.structure.modal_matrices import modal_matrices
from equisection.structure.modes import modes_of_kinds
from equisection.validation.flutter_values import divergence_speed
from equisection.validation.known_values import DIGITS, KnownValue, Source

_CONFIGURATION = CLONE / "config" / "validation" / "patil_wing.yaml"
_HIGH_AIR = 0.0889
_PATIL = Source(
    "unconfirmed",
    "Patil, Hodges and Cesnik, Journal of Aircraft 38, 2001, undeformed wing, as AeroBeams.jl "
    "quotes them: mixed finite elements, loads by finite states",
)
_PATIL_EXACT = Source(
    "unconfirmed",
    "exact solution that the same authors compare theirs with",
)
_LEE = Source(
    "unconfirmed",
    "Lee, Price and Wong, Progress in Aerospace Sciences 35, 1999: linear flutter of their section "
    "with Wagner's function by R. T. Jones",
)


def long_wing() -> Beam:
    """Return the wing of Patil, Hodges and Cesnik (2001), from its configuration."""
    return Beam.from_yaml(_CONFIGURATION)


@cache
def _long_wing_flutter() -> FlutterOnset:
    wing = long_wing()
    modes = modes_of_kinds(wing, "analytic", (1, 60, 1), (8, 8), 8)
    matrices = modal_matrices(wing, modes, 8, 8)
    return beam_flutter(matrices, wing.chord, wing.elastic_axis, _HIGH_AIR)


def _long_wing_divergence() -> float:
    wing = long_wing()
    modes = modes_of_kinds(wing, "analytic", (1, 60, 1), (1, 1), 8)
    return divergence_speed(reduce_beam(wing, modes, "consistent"), _HIGH_AIR)


def _long_wing() -> list[KnownValue]:
    values = (
        ("flutter", "m/s", 32.21, 32.51, lambda: _long_wing_flutter().speed),
        ("flutter", "rad/s", 22.61, 22.37, lambda: _long_wing_flutter().omega),
        ("divergence", "m/s", 37.29, 37.15, _long_wing_divergence),
    )
    found = []
    for quantity, unit, solution, exact, compute in values:
        for known, source, tolerance, reason in (
            (exact, _PATIL_EXACT, 2e-4, DIGITS),
            (solution, _PATIL, 0.012, "elements and finite states of the published solution"),
        ):
            found.append(
                KnownValue(
                    "Long wing of Patil, Hodges and Cesnik",
                    quantity, unit, known, source, compute, tolerance, reason,
                )
            )  # fmt: skip
    return found


def typical_section(frequency_ratio: float, density: float = 1.0) -> Section:
    """Return the section of Lee, Price and Wong (1999), chord 2 m and omega_alpha 1 rad/s.

    mu = 100, axis a quarter of the chord behind the leading edge (a = -1/2), x_alpha = 1/4 and
    r_alpha = 1/2, in semi-chords, without damping.

    Parameters
    ----------
    frequency_ratio
        omega_xi/omega_alpha, of heave and pitch by themselves (-).
    density
        Density of the fluid (kg/m^3).
    """
    mass = 100.0 * math.pi * density
    return Section(
        mass=mass,
        inertia=0.25 * mass,
        static_imbalance=0.25 * mass,
        flexural_stiffness=mass * frequency_ratio**2,
        torsional_stiffness=0.25 * mass,
        chord=2.0,
        elastic_axis=0.25,
    )


def _typical_section_flutter() -> float:
    """Return U/(b omega_alpha) of the onset by the embedded solver's states."""
    onset = critical_speed(
        typical_section(0.2),
        Polar.flat_plate(10.0),
        incidence_deg=0.0,
        speed=(4.0, 8.0),
        density=1.0,
        lags=SeparationLags.none(),
    )
    return float(onset["critical_speed"])


def attached_values() -> list[KnownValue]:
    """Known flutter and divergence of the long wing and the typical section."""
    return [
        *_long_wing(),
        KnownValue(
            "Typical section of Lee, Price and Wong",
            "flutter, U/(b omega_alpha), embedded solver",
            "-",
            6.2851,
            _LEE,
            _typical_section_flutter,
            2e-5,
            DIGITS,
        ),
    ]
