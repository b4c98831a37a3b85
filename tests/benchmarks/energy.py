"""Whether the work of the air is the change of the mechanical energy, cycle by cycle.

    python -m tests.benchmarks.energy [result.nc ...]

Section (Eq. 18: pitch and heave) and plate (its modes) are coordinates q of mass M, damping C and
stiffness K under loads Q, M q'' + C q' + K q = Q, so that

    d/ds 1/2 (q' M q' + q K q) = Q q' - q' C q'

with lengths in chords, s = tV/c and moments about the moving elastic axis. What the dampers take is
counted as work of the air that does not arrive. The rates are those of cubic
splines through the samples. Without results the kept ones of the section on OpenFOAM at k* = 5 and
10 are taken.
"""

import argparse
import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from equisection.beam.section import Section
from equisection.cases import BeamModes, UnsteadyCase
from equisection.results.netcdf import read_dataset
from equisection.structure.span import gram, integrate
from tests.benchmarks.early_verdict import KEPT, case_of
from tests.benchmarks.needed import needed

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Swing:
    """Coordinates under loads: M, C, K (n, n), motion and loads (samples, n)."""

    time: Floats
    mass: Floats
    damping: Floats
    stiffness: Floats
    motion: Floats
    loads: Floats


def section_swing(section: Section, history: xr.Dataset) -> Swing:
    """Return pitch and heave of the section."""
    moment = history["cm_axis"] if "cm_axis" in history else history["cm"]
    pitch_first = np.ix_([1, 0], [1, 0])
    return Swing(
        time=history["time"].values,
        mass=section.mass_matrix[pitch_first],
        damping=section.damping_matrix[pitch_first],
        stiffness=section.stiffness_matrix[pitch_first],
        motion=np.stack(
            [history["twist"].values, history["deflection"].values / history.attrs["chord"]], axis=1
        ),
        loads=np.stack([moment.values, history["cl"].values], axis=1),
    )


def plate_swing(modes: BeamModes, history: xr.Dataset) -> Swing:
    """Return the modes of the plate, torsion before bending."""
    frequency = np.array([*modes.torsion_frequency, *modes.bending_frequency])
    span, torsion = np.array(modes.span), np.array(modes.torsion_shape)
    bending = np.array(modes.bending_shape)
    inertia = np.concatenate(
        [modes.inertia * integrate(span, torsion**2), modes.mass * integrate(span, bending**2)]
    )
    ratio = np.repeat([modes.torsion_damping, modes.bending_damping], [len(torsion), len(bending)])
    mass = np.diag(inertia)
    across = -modes.imbalance * gram(span, torsion, bending)
    mass[: len(torsion), len(torsion) :] = across
    mass[len(torsion) :, : len(torsion)] = across.T
    names = ("torsion", "bending")
    motion = np.concatenate([history[f"{name}_amplitude"].values for name in names]).T
    loads = np.concatenate([history[f"{name}_load"].values for name in names]).T
    return Swing(
        time=history["time"].values,
        mass=mass,
        damping=np.diag(2.0 * ratio * frequency * inertia),
        stiffness=np.diag(inertia * frequency**2),
        motion=motion,
        loads=inertia * loads,
    )


def swing_of(case: UnsteadyCase, history: xr.Dataset) -> Swing:
    """Return what swings in a result."""
    if case.beam is not None:
        return plate_swing(case.beam, history)
    assert case.section is not None
    return section_swing(case.section, history)


@dataclass(frozen=True)
class Cycle:
    """Balance of one cycle of the twist, from one bottom to the next.

    Attributes
    ----------
    start, period
        c/V.
    work, change
        Of the air less what the dampers take, and of the energy of what swings (of the section
        rho V^2 c^2/2 per unit span).
    swing
        Mean energy of the motion about its mean position, by which a small work is judged.
    """

    start: float
    period: float
    work: float
    change: float
    swing: float

    @property
    def imbalance(self) -> float:
        """What is missing, as a part of the work, or of a hundredth of the swing if that is more.

        A hundredth of the energy a cycle is a change of the amplitude by half a percent.
        """
        return (self.change - self.work) / max(abs(self.work), 0.01 * self.swing)


def _form(matrix: Floats, rows: Floats) -> Floats:
    """Return x A x of each row x."""
    return np.asarray((rows @ matrix * rows).sum(axis=-1))


def cycles(swing: Swing) -> list[Cycle]:
    """Return the balance of each whole cycle of the twist; the first, from rest, is left out."""
    motion = CubicSpline(swing.time, swing.motion)
    rates = motion(swing.time, 1)
    power = (swing.loads * rates).sum(axis=1) - _form(swing.damping, rates)
    work = CubicSpline(swing.time, power).antiderivative()

    def energy(s: Floats | float, mean: Floats | float = 0.0) -> Floats:
        return (_form(swing.mass, motion(s, 1)) + _form(swing.stiffness, motion(s) - mean)) / 2

    twist = CubicSpline(swing.time, swing.motion[:, 0])
    turns = twist.derivative().roots(extrapolate=False)
    bottoms = turns[twist(turns, 2) > 0]
    found = []
    for start, end in itertools.pairwise(bottoms[1:]):
        inside = np.linspace(start, end, 200)
        found.append(
            Cycle(
                start=float(start),
                period=float(end - start),
                work=float(work(end) - work(start)),
                change=float(energy(end) - energy(start)),
                swing=float(energy(inside, motion(inside).mean(axis=0)).mean()),
            )
        )
    return found


def table(paths: Sequence[Path]) -> pd.DataFrame:
    """Return the cycles of some results."""
    rows = []
    for path in paths:
        history = read_dataset(path)
        case = case_of(history)
        for cycle in cycles(swing_of(case, history)):
            rows.append(
                {"k_star": case.k_star, **vars(cycle), "imbalance_%": 100 * cycle.imbalance}
            )
    return pd.DataFrame(rows)


def surplus(path: Path) -> str:
    """Return what is missing as a growth rate, over twice the swing's energy and the period."""
    known = read_dataset(path)
    rates = [
        (one.change - one.work) / (2 * one.swing * one.period)
        for one in cycles(swing_of(case_of(known), known))
    ]
    words = (f"{rate:+.1e}" for rate in (max(rates), rates[-1]))
    return " ".join((path.parent.name, path.stem, *words, f"{known.growth_rate:+.4f}"))


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.energy")
    kept = [KEPT / "2d" / f"k{k_star}.nc" for k_star in (5, 10)]
    parser.add_argument("results", nargs="*", type=Path, default=kept, metavar="result.nc")
    parser.add_argument(
        "--surplus", action="store_true", help="as a growth rate (V/c): largest and last of a run"
    )
    chosen = parser.parse_args()
    with needed("the run that it is a result of"):
        if chosen.surplus:
            for path in chosen.results:
                print(surplus(path))
        else:
            print(table(chosen.results).to_string(index=False, float_format="%.3g"))
