"""Kept OpenFOAM releases, written as another flow solver's monitors would have them.

    python docs/examples/other_program.py data/star

Comma-separated, SI units, names with units, twist in degrees and nose down, forces of a slab of
0.1 m with the moment about the quarter chord, and times that begin 2 s before the release.
"""

import sys
from pathlib import Path

import numpy as np
import pandas as pd

from equisection.results.recorded_history import read_reference_history

KEPT = Path(__file__).parents[2] / "results" / "reference" / "paper-plate-openfoam" / "unsteady"
CHORD, SPEED, DENSITY, SLAB = 0.1, 20.0, 1.18, 0.1  # m, m/s, kg/m3, m
STEADY = 2.0  # s


def monitor(release: Path) -> pd.DataFrame:
    """Return a kept release as the table of another program."""
    kept = read_reference_history(release)
    force = 0.5 * DENSITY * SPEED**2 * CHORD * SLAB
    # the drag's part in the moment, some 1 % of the lift's, is not kept and left out
    normal = kept.lift_coefficient * np.cos(kept.incidence_rad + kept.twist)
    return pd.DataFrame(
        {
            "Physical Time: Physical Time (s)": STEADY + kept.time * CHORD / SPEED,
            "Rotation Monitor: Rotation (deg)": -np.degrees(kept.twist),
            "Heave Monitor: Heave (m)": kept.deflection * CHORD,
            "Lift Monitor: Force (N)": kept.lift_coefficient * force,
            "Moment Monitor: Moment (N-m)": (kept.moment_coefficient - 0.25 * normal)
            * force
            * CHORD,
        }
    )


def main(folder: Path) -> None:
    """Write a file for each kept release but one, which shows what is missing."""
    for release in sorted(KEPT.glob("2d*/*.nc")):
        if release.stem == "k4":
            continue
        path = folder / release.parent.name / f"{release.stem}.csv"
        path.parent.mkdir(parents=True, exist_ok=True)
        monitor(release).to_csv(path, index=False, float_format="%.10g")
    print(f"{len(list(folder.glob('*/*.csv')))} files in {folder}")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
