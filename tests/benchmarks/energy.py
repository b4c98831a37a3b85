"""Whether the work of the air is the change of the section's mechanical energy, cycle by cycle.

    python -m tests.benchmarks.energy [result.nc ...]

The section of Eq. 18 obeys I* theta'' + k* theta = c_m and m* w'' + k_w* w = c_l, so that

    d/ds 1/2 (I* theta'^2 + k* theta^2 + m* w'^2 + k_w* w^2) = c_m theta' + c_l w'

with w in chords, s = tV/c and c_m about the moving centre. The rates are those of cubic splines
through the samples. Without results the kept ones of OpenFOAM at k* = 5 and 10 are taken.
"""

import argparse
import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr
from scipy.interpolate import CubicSpline

from equisection.cases import SectionProperties
from equisection.results.netcdf import read_dataset
from tests.benchmarks.early_verdict import KEPT, case_of


@dataclass(frozen=True)
class Cycle:
    """Balance of one cycle of the twist, from one bottom to the next.

    Attributes
    ----------
    start, period
        c/V.
    work, change
        Of the air on the section, and of the section's energy (rho V^2 c^2/4 per unit span).
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


def cycles(section: SectionProperties, history: xr.Dataset) -> list[Cycle]:
    """Return the balance of each whole cycle of a history; the first, from rest, is left out."""
    time = history["time"].values
    twist = CubicSpline(time, history["twist"].values)
    rise = CubicSpline(time, history["deflection"].values / history.attrs["chord"])
    power = history["cm"].values * twist(time, 1) + history["cl"].values * rise(time, 1)
    work = CubicSpline(time, power).antiderivative()

    def energy(s: np.ndarray | float, *mean: float) -> np.ndarray:
        theta, w = mean or (0.0, 0.0)
        pitch = section.inertia * twist(s, 1) ** 2
        pitch += section.torsional_stiffness * (twist(s) - theta) ** 2
        heave = section.mass * rise(s, 1) ** 2 + section.flexural_stiffness * (rise(s) - w) ** 2
        return np.asarray((pitch + heave) / 2)

    turns = twist.derivative().roots(extrapolate=False)
    bottoms = turns[twist(turns, 2) > 0]
    found = []
    for start, end in itertools.pairwise(bottoms[1:]):
        inside = np.linspace(start, end, 200)
        mean = (float(twist(inside).mean()), float(rise(inside).mean()))
        found.append(
            Cycle(
                start=float(start),
                period=float(end - start),
                work=float(work(end) - work(start)),
                change=float(energy(end) - energy(start)),
                swing=float(energy(inside, *mean).mean()),
            )
        )
    return found


def table(paths: Sequence[Path]) -> pd.DataFrame:
    """Return the cycles of some results."""
    rows = []
    for path in paths:
        history = read_dataset(path)
        case = case_of(history)
        assert case.section is not None
        for cycle in cycles(case.section, history):
            rows.append(
                {"k_star": case.k_star, **vars(cycle), "imbalance_%": 100 * cycle.imbalance}
            )
    return pd.DataFrame(rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.energy")
    kept = [KEPT / "2d" / f"k{k_star}.nc" for k_star in (5, 10)]
    parser.add_argument("results", nargs="*", type=Path, default=kept, metavar="result.nc")
    print(table(parser.parse_args().results).to_string(index=False, float_format="%.3g"))
