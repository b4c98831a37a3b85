"""Whether time step and outer correctors of a run are fine enough, at a stable and an unstable k*,
and whether it matters how the mesh moves.

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
    """One choice of time step (c/V), outer correctors, and motion of the mesh."""

    time_step: float
    outer_correctors: int
    mesh_motion: str = "morph"

    @property
    def is_configured(self) -> bool:
        """Whether it is what `config/openfoam.yaml` computes."""
        return (self.time_step, self.outer_correctors, self.mesh_motion) == (0.02, 8, "morph")

    @property
    def run(self) -> str:
        """Name of its run."""
        if self.is_configured:
            return "paper-plate-openfoam"
        name = f"independence-step{self.time_step:g}-outer{self.outer_correctors}"
        return name if self.mesh_motion == "morph" else f"{name}-{self.mesh_motion}"

    def overrides(self, k_star: Sequence[float]) -> list[str]:
        """Return what the command line changes in the configuration."""
        if self.is_configured:
            return []
        unsteady = {
            "duration": DURATION,
            "time_step": self.time_step,
            "output_interval": 5 * self.time_step,
        }
        openfoam = {"outer_correctors": self.outer_correctors, "mesh_motion": self.mesh_motion}
        return [
            f"run={self.run}",
            f"sweep={json.dumps({'k_star': list(k_star), 'models': ['2d']})}",
            f"unsteady={json.dumps(unsteady)}",
            f"openfoam={json.dumps(openfoam)}",
        ]


VARIANTS = (
    Variant(0.02, 8),
    Variant(0.01, 8),
    Variant(0.04, 8),
    Variant(0.02, 3),
    Variant(0.02, 16),
    Variant(0.04, 8, "overset"),
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


def oscillation(history: xr.Dataset, periods: float = 3.0) -> tuple[float, float]:
    """Return growth rate (V/c) and frequency (f c/V) of the twist at the end of a history.

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
    return float(found.x[0]), abs(float(found.x[1])) / (2 * np.pi)


def table(k_star: Sequence[float]) -> pd.DataFrame:
    """Return growth rate (V/c), frequency, last twist and cost of each variant with a result."""
    rows = []
    for value in k_star:
        for variant in VARIANTS:
            path = result(variant, value)
            if path.exists():
                whole = xr.load_dataset(path)
                steps = whole.attrs["end_time"] / variant.time_step
                history = whole.sel(time=slice(0.0, DURATION))
                growth_rate, frequency = oscillation(history)
                rows.append(
                    {
                        "k_star": value,
                        "time_step": variant.time_step,
                        "outer_correctors": variant.outer_correctors,
                        "mesh_motion": variant.mesh_motion,
                        "growth_rate": growth_rate,
                        "frequency": frequency,
                        "tip_twist_deg": np.degrees(history["tip_twist"].values[-1]),
                        "cpu_seconds_a_step": whole.attrs["cpu_seconds"] / steps,
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
