"""Whether time step and outer correctors of a run are fine enough, at a stable and an unstable k*,
and whether it matters how the mesh of the section moves.

    python -m tests.benchmarks.independence [--plate | --plate-medium] [k* ...]

Each variant is a run of its own (`results/independence-...`), made by the workflow from
`config/openfoam.yaml`, or for the plate from `config/openfoam3d.yaml`, so that what was computed or
is kept is not computed again. The step and the correctors of that configuration are in its own
sweep, of which the beginning is taken.
"""

import argparse
import json
import os
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from equisection.verdict.zigzag import zigzag_of
from tests.benchmarks.needed import needed


@dataclass(frozen=True)
class Variant:
    """One choice of time step (c/V), outer correctors, and motion of the mesh."""

    time_step: float
    outer_correctors: int
    mesh_motion: str = "morph"

    @property
    def name(self) -> str:
        """Its name in the names of runs."""
        name = f"step{self.time_step:g}-outer{self.outer_correctors}"
        return name if self.mesh_motion == "morph" else f"{name}-{self.mesh_motion}"


@dataclass(frozen=True)
class Study:
    """What is varied: a model by a configuration, whose own choice is the first variant.

    ``duration`` (c/V) is that of the others, and of what is compared; ``resolution`` is that of
    all, in the place of the configuration's.
    """

    configuration: str
    model: str
    run: str
    variants: tuple[Variant, ...]
    duration: float
    k_star: tuple[float, ...]
    resolution: str = ""

    def run_of(self, variant: Variant) -> str:
        """Return the name of a variant's run."""
        if variant == self.variants[0]:
            return self.run
        parts = [self.model] if self.model != "2d" else []
        parts += [self.resolution] if self.resolution else []
        return "-".join(["independence", *parts, variant.name])

    def overrides(self, variant: Variant, k_star: Sequence[float]) -> list[str]:
        """Return what the command line changes in the configuration."""
        if variant == self.variants[0] and not self.resolution:
            return []
        unsteady: dict[str, float] = {"duration": self.duration, "time_step": variant.time_step}
        openfoam: dict[str, object] = {"outer_correctors": variant.outer_correctors}
        if self.model == "2d":
            unsteady["output_interval"] = 5 * variant.time_step
            openfoam["mesh_motion"] = variant.mesh_motion
        steady = {"resolution": self.resolution}
        return [
            f"run={self.run_of(variant)}",
            *([f"steady={json.dumps(steady)}"] if self.resolution else []),
            f"sweep={json.dumps({'k_star': list(k_star), 'models': [self.model]})}",
            f"unsteady={json.dumps(unsteady)}",
            f"openfoam={json.dumps(openfoam)}",
        ]

    def result(self, variant: Variant, k_star: float) -> Path:
        """Return where a variant's result at a k* is."""
        folder = Path("results") / self.run_of(variant) / "unsteady" / self.model
        return folder / f"k{k_star:.6g}.nc"

    def compute(self, variant: Variant, k_star: Sequence[float], cores: int) -> None:
        """Run a variant by the workflow."""
        targets = [str(self.result(variant, value)) for value in k_star]
        command = [sys.executable, "-m", "snakemake", "--cores", str(cores), "--quiet", "rules"]
        configuration = ["--configfile", self.configuration]
        overrides = self.overrides(variant, k_star)
        if overrides:
            configuration += ["--config", *overrides]
        subprocess.run([*command, *configuration, "--", *targets], check=True)


#: Long enough for five periods at the lowest k*.
SECTION = Study(
    "config/openfoam.yaml",
    "2d",
    "paper-plate-openfoam",
    (
        Variant(0.02, 8),
        Variant(0.01, 8),
        Variant(0.04, 8),
        Variant(0.02, 3),
        Variant(0.02, 16),
        Variant(0.04, 8, "overset"),
    ),
    duration=45.0,
    k_star=(5.0, 10.0),
)
#: Long enough for four periods.
PLATE = Study(
    "config/openfoam3d.yaml",
    "3d",
    "paper-plate-openfoam-3d",
    (Variant(0.04, 2), Variant(0.02, 2), Variant(0.04, 4)),
    duration=30.0,
    k_star=(6.44,),
)
#: The same on finer cells, where two iterations do not suffice.
PLATE_MEDIUM = replace(
    PLATE,
    run="paper-plate-openfoam-3d-medium",
    variants=(Variant(0.04, 2), Variant(0.04, 4)),
    resolution="medium",
)


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


def table(study: Study, k_star: Sequence[float]) -> pd.DataFrame:
    """Return growth rate (V/c), frequency, last twist and cost of each variant with a result."""
    rows = []
    for value in k_star:
        for variant in study.variants:
            path = study.result(variant, value)
            if path.exists():
                whole = xr.load_dataset(path)
                steps = whole.attrs["end_time"] / variant.time_step
                history = whole.sel(time=slice(0.0, study.duration))
                growth_rate, frequency = oscillation(history)
                sampled = float(np.median(np.diff(history["time"].values)))
                rows.append(
                    {
                        "k_star": value,
                        "time_step": variant.time_step,
                        "outer_correctors": variant.outer_correctors,
                        "mesh_motion": variant.mesh_motion,
                        "growth_rate": growth_rate,
                        "frequency": frequency,
                        "tip_twist_deg": np.degrees(history["tip_twist"].values[-1]),
                        "mean_lift": float(history["cl"].sel(time=slice(10.0, None)).mean()),
                        "mean_moment": float(history["cm"].sel(time=slice(10.0, None)).mean()),
                        "zigzag": zigzag_of(
                            *(history[name].values for name in ("time", "cl", "cm")),
                            steps_per_sample=round(sampled / variant.time_step),
                        ),
                        "cpu_seconds_a_step": whole.attrs["cpu_seconds"] / steps,
                    }
                )
    return pd.DataFrame(rows)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.independence")
    parser.add_argument("--plate", action="store_true", help="of the plate, not of the section")
    parser.add_argument("--plate-medium", action="store_true", help="of the plate on medium")
    parser.add_argument(
        "k_star", nargs="*", type=float, help="(default: 5 and 10; of the plate 6.44)"
    )
    parser.add_argument("--of", type=Path, metavar="result.nc", help="growth, f c/V of a release")
    options = parser.parse_args()
    chosen = PLATE_MEDIUM if options.plate_medium else PLATE if options.plate else SECTION
    if options.of:
        with needed("the run that it is a result of"):
            print(*oscillation(xr.load_dataset(options.of).sel(time=slice(0.0, chosen.duration))))
        raise SystemExit
    at = options.k_star or chosen.k_star
    for each in chosen.variants:
        chosen.compute(each, at, os.cpu_count() or 1)
    print(table(chosen, at).to_string(index=False, float_format="%.4g"))
