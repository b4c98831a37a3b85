"""Whether time step and outer correctors of a run are fine enough, at a stable and an unstable k*.

    python -m tests.benchmarks.independence [k* ...]

Each variant is a run of its own (`results/independence-...`), made by the workflow from
`config/openfoam.yaml`, so that what was computed or is kept is not computed again. The step and the
correctors of that configuration are in its own sweep, of which the beginning is taken.
"""

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

#: c/V: long enough for five periods at the lowest k*.
DURATION = 45.0
K_STAR = (5.0, 10.0)


@dataclass(frozen=True)
class Variant:
    """One choice of time step (c/V) and outer correctors."""

    time_step: float
    outer_correctors: int

    @property
    def run(self) -> str:
        """Name of its run."""
        if self == CONFIGURED:
            return "paper-plate-openfoam"
        return f"independence-step{self.time_step:g}-outer{self.outer_correctors}"

    def overrides(self, k_star: Sequence[float]) -> list[str]:
        """Return what the command line changes in the configuration."""
        if self == CONFIGURED:
            return []
        unsteady = {
            "duration": DURATION,
            "time_step": self.time_step,
            "output_interval": 5 * self.time_step,
        }
        return [
            f"run={self.run}",
            f"sweep={json.dumps({'k_star': list(k_star), 'models': ['2d']})}",
            f"unsteady={json.dumps(unsteady)}",
            f"openfoam={json.dumps({'outer_correctors': self.outer_correctors})}",
        ]


#: Those of `config/openfoam.yaml`.
CONFIGURED = Variant(0.02, 3)
VARIANTS = (
    CONFIGURED,
    Variant(0.01, 3),
    Variant(0.04, 3),
    Variant(0.02, 2),
    Variant(0.02, 5),
)


def compute(variant: Variant, k_star: Sequence[float], cores: int) -> None:
    """Run a variant by the workflow."""
    targets = [str(result(variant, value)) for value in k_star]
    command = [sys.executable, "-m", "snakemake", "--cores", str(cores), "--quiet", "rules"]
    configuration = ["--configfile", "config/openfoam.yaml"]
    overrides = variant.overrides(k_star)
    if overrides:
        configuration += ["--config", *overrides]
    subprocess.run([*command, *configuration, "--", *targets], check=True)


def result(variant: Variant, k_star: float) -> Path:
    """Return where a variant's result at a k* is."""
    return Path("results") / variant.run / "unsteady" / "2d" / f"k{k_star:.6g}.nc"


def growth_rate(history: xr.Dataset, periods: float = 3.0) -> float:
    """Return the growth rate (V/c) of the twist at the end of a history.

    Least squares of a growing oscillation about a constant over the last periods, so that it
    depends on no choice of peaks.
    """
    from scipy.optimize import least_squares  # noqa: PLC0415

    time, twist = history["time"].values, np.degrees(history["tip_twist"].values)
    omega = 2 * np.pi * float(history.attrs["frequency_strouhal"])
    late = time > time[-1] - periods * 2 * np.pi / omega
    time, twist = time[late] - time[-1], twist[late]

    def residual(parameters: np.ndarray) -> np.ndarray:
        rate, omega, mean, cosine, sine = parameters
        wave = cosine * np.cos(omega * time) + sine * np.sin(omega * time)
        return mean + np.exp(rate * time) * wave - twist

    size = float(np.ptp(twist)) / 2
    found = min(
        (
            least_squares(residual, [0.0, omega, twist.mean(), *wave])
            for wave in ((size, 0.0), (0.0, size))
        ),
        key=lambda fit: fit.cost,
    )
    return float(found.x[0])


def table(k_star: Sequence[float]) -> pd.DataFrame:
    """Return growth rate (V/c) and last twist of each variant that has a result."""
    rows = []
    for value in k_star:
        for variant in VARIANTS:
            path = result(variant, value)
            if path.exists():
                history = xr.load_dataset(path).sel(time=slice(0.0, DURATION))
                rows.append(
                    {
                        "k_star": value,
                        "time_step": variant.time_step,
                        "outer_correctors": variant.outer_correctors,
                        "growth_rate": growth_rate(history),
                        "tip_twist_deg": np.degrees(history["tip_twist"].values[-1]),
                    }
                )
    return pd.DataFrame(rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.independence")
    parser.add_argument("k_star", nargs="*", type=float, default=K_STAR, help="(default: 5 10)")
    chosen = parser.parse_args().k_star
    for each in VARIANTS:
        compute(each, chosen, os.cpu_count() or 1)
    print(table(chosen).to_string(index=False, float_format="%.4g"))
