"""Known natural frequencies of beams and plates."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache, partial

import numpy as np

from equisection.beam.beam import Beam
from equisection.structure.modes import compute_modes
from equisection.validation.flutter_values import goland
from equisection.validation.known_values import DIGITS, KnownValue, Source

_FV16 = Source(
    "published",
    "NAFEMS R0015, test FV16, in Altair's verification manual OS-V 0430",
)
_LEISSA = Source("unconfirmed", "Leissa, Journal of Sound and Vibration 31, 1973, CFFF, a/b 2.5")


@cache
def _square_plate() -> tuple[float, ...]:
    """Frequencies (Hz) of 10 m x 10 m x 0.05 m, longer by a part in 10^9 since L > c is asked."""
    plate = Beam(
        chord=10.0,
        length=10.0 * (1 + 1e-9),
        thickness=0.05,
        youngs_modulus=200e9,
        poisson_ratio=0.3,
        density=8000.0,
    )
    return tuple(compute_modes(plate, "solid", (12, 12, 1), 6).frequency.tolist())


@cache
def _long_plate() -> tuple[float, ...]:
    """Leissa's omega a^2 sqrt(rho h/D) of a cantilever plate of L/c = 2.5, h/c = 0.01."""
    length, chord, thickness, modulus, density = 2.5, 1.0, 0.01, 70e9, 2700.0
    plate = Beam(
        chord=chord,
        length=length,
        thickness=thickness,
        youngs_modulus=modulus,
        poisson_ratio=0.3,
        density=density,
    )
    rigidity = modulus * thickness**3 / (12 * (1 - 0.3**2))
    scale = 2 * np.pi * length**2 * np.sqrt(density * thickness / rigidity)
    frequency = compute_modes(plate, "solid", (12, 30, 1), 8).frequency
    return tuple((scale * frequency).tolist())


@cache
def _uncoupled() -> tuple[float, ...]:
    modes = compute_modes(goland(), "beam", (1, 40, 1), 8)
    kinds = [modes.bending(2).frequency, modes.torsion(2).frequency]
    return tuple((2 * np.pi * np.concatenate(kinds)).tolist())


def structure_values() -> list[KnownValue]:
    """Known natural frequencies."""
    contour_roots = Source("published", "ContourRoots 0.6, tutorial 11, closed form")
    names = ("bending 1", "bending 2", "torsion 1", "torsion 2")
    return [
        *(
            KnownValue(
                "Goland's wing, uncoupled",
                name,
                "rad/s",
                value,
                contour_roots,
                partial(_of, _uncoupled, n),
                2e-4,
                DIGITS,
            )
            for n, (name, value) in enumerate(
                zip(names, (49.49, 310.16, 87.11, 261.32), strict=True)
            )
        ),
        *(
            KnownValue(
                "Square cantilever plate, NAFEMS FV16",
                f"frequency {n + 1}",
                "Hz",
                value,
                _FV16,
                partial(_of, _square_plate, n),
                0.01,
                "the known values, a series of beam functions, are off by up to 1 %",
            )
            for n, value in enumerate((0.421, 1.029, 2.582, 3.306, 3.753, 6.555))
        ),
        *(
            KnownValue(
                "Cantilever plate, L/c 2.5",
                f"frequency parameter {n + 1}",
                "-",
                value,
                _LEISSA,
                partial(_of, _long_plate, n),
                0.012,
                "Ritz's method with 36 beam functions comes from above",
            )
            for n, value in enumerate((3.456, 17.99, 21.56, 57.46, 60.58))
        ),
    ]


def _of(compute: Callable[[], tuple[float, ...]], number: int) -> float:
    return compute()[number]
