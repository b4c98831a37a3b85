"""Growth of kept releases of the section as their amplitude rises, and as their record gets longer.

python -m tests.benchmarks.growth_falls
"""

from pathlib import Path

import numpy as np
import xarray as xr

from equisection.results.netcdf import read_dataset
from equisection.store.judged_again import tip_motion
from equisection.verdict import assess
from equisection.verdict.cycles import find_cycles
from tests.benchmarks.early_verdict import KEPT


def release(name: str) -> xr.Dataset:
    """Return a kept release of the sweep."""
    return read_dataset(Path(KEPT / f"{name}.nc"))


def over_amplitude(name: str) -> str:
    """Return amplitudes (deg) every 30 c/V from 60 on, growth between, and where it would end."""
    known, times = release(name), np.arange(60, 190, 30)
    cycles = find_cycles(known["time"].values, known["tip_twist"].values)
    amplitude = np.interp(times, cycles.amplitude_time, np.degrees(cycles.amplitude))
    rate = np.diff(np.log(amplitude)) / np.diff(times)
    slope, start = np.polyfit((amplitude[1:] + amplitude[:-1])[1:] / 2, rate[1:], 1)
    words = (*(f"{one:.2f}" for one in amplitude), *(f"{one:+.4f}" for one in rate))
    return " ".join((name, *words, f"{-start / slope:.1f} deg"))


def over_length(name: str, end: float) -> str:
    """Return growth (V/c) and mean deflection (chords) of a record up to a time (c/V)."""
    motion = tip_motion(release(name), end)
    verdict = assess(motion.time, motion.twist, motion.deflection, final=True)
    return f"{name} {end} {verdict.growth_rate:+.4f} {verdict.mean_deflection:.3f}"


if __name__ == "__main__":
    for each in ("2d/k6.44", "2d/k7.5", "2d-corrected/k5", "2d-corrected/k6.44"):
        print(over_amplitude(each))
    for each in ("2d/k6.44", "2d-corrected/k5"):
        for until in (60, 80, 100, 150, 200):
            print(over_length(each, until))
