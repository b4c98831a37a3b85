"""Onset of the paper's section by its kept forced motions in OpenFOAM, and by its kept releases.

    python -m tests.benchmarks.moved_section

All are on the same 3,132 cells: moved about 2.95 deg, its equilibrium near the onset, and about 2.5
deg, its rigid incidence; released from equilibrium and from rest.
"""

from collections.abc import Iterator

import numpy as np

import equisection as eq
from equisection.aerodynamics.derivatives import Derivatives
from equisection.analysis.forced_derivatives import derivatives_of
from equisection.cases import ForcedCase, UnsteadyCase
from equisection.io.derivative_table import DERIVATIVES
from equisection.results.netcdf import read_dataset
from equisection.store.kept import kept_results
from tests.workflow.project import ROOT

KEPT = ROOT / "results" / "reference"
MOVED = ("openfoam-equilibrium/forced", "plate-forced/forced")
RELEASED = ("openfoam-equilibrium/unsteady/2d", "paper-reductions/unsteady/2d-consistent")
#: Speeds among which the onset is looked for, over that of the release whose section is taken.
SPEEDS = (0.6, 1.5)


def moved(folder: str) -> Derivatives:
    """Return the derivatives of kept forced motions."""
    kept = kept_results(KEPT / folder)
    pairs = {
        one.path.stem: (ForcedCase.model_validate(one.case), read_dataset(one.path)) for one in kept
    }
    return derivatives_of(pairs).derivatives


def section() -> tuple[eq.Section, float]:
    """Return the section at the speed 1, for a density of 2 and a chord of 1, and its k*."""
    kept = kept_results(KEPT / RELEASED[0])[-1]
    case = UnsteadyCase.model_validate(kept.case)
    assert case.section is not None
    own = case.section
    return (
        eq.Section(
            mass=own.mass,
            inertia=own.inertia,
            flexural_stiffness=own.flexural_stiffness,
            torsional_stiffness=own.torsional_stiffness,
            chord=1.0,
        ),
        case.k_star,
    )


def lines() -> Iterator[str]:
    """Yield what is to be printed."""
    body, k_star = section()
    for folder in MOVED:
        table = moved(folder)
        onset = eq.critical_speed(body, table, speed=SPEEDS, density=2.0)
        middle, high, low = (
            k_star / float(speed) ** 2
            for speed in (onset.critical_speed, onset.speed_low, onset.speed_high)
        )
        yield (
            f"moved at {table.incidence_deg:g} deg: {onset.mechanism.item()} at k* = {middle:.2f} "
            f"({low:.2f} to {high:.2f}), V/(f c) = {onset.critical_speed / onset.frequency:.2f}"
        )
        assert table.spread is not None
        first = [
            f"{name}* = {value:.4f} +- {spread:.4f}"
            for name, value, spread in zip(
                DERIVATIVES, table.values[0], table.spread[0], strict=True
            )
            if name in ("H1", "A2")
        ]
        yield f"    at V/(f c) = {table.reduced_velocity[0]:.3g} {', '.join(first)}"
    for folder in RELEASED:
        rates = sorted(
            (float(one.attrs["k_star"]), float(one.attrs["growth_rate"]))
            for one in (read_dataset(path) for path in sorted((KEPT / folder).glob("k*.nc")))
        )
        k, growth = np.array([rate for rate in rates if 6.0 <= rate[0] <= 10.0]).T
        pairs = ", ".join(f"{one:g}: {rate:+.4f}" for one, rate in zip(k, growth, strict=True))
        yield f"released ({folder}): growth (V/c) at k* {pairs}"
        yield f"    0 at k* = {np.interp(0.0, -growth, k):.2f}, in a straight line"


if __name__ == "__main__":
    print("\n".join(lines()))
