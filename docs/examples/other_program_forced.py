"""Kept forced motions of OpenFOAM, written as another flow solver would have them.

    python docs/examples/other_program_forced.py data/other-program-forced

A thin plate of the chord of Goland's wing, moved in its air at 100 m/s: blank-separated with a
line of names behind ``#``, milliseconds, degrees nose down, millimetres downwards, and forces of a
slab of 0.1 m. Heave and moment are those of the quarter chord.
"""

import sys
from pathlib import Path

import numpy as np
import pandas as pd

from equisection.results.netcdf import read_dataset

KEPT = Path(__file__).parents[2] / "results" / "reference" / "thin-plate-forced" / "forced" / "2d"
CHORD, SPEED, DENSITY, SLAB = 1.8288, 100.0, 1.225, 0.1  # m, m/s, kg/m3, m
AXIS = 0.25  # x/c


def table(motion: Path) -> pd.DataFrame:
    """Return a kept motion as the table of another program."""
    kept = read_dataset(motion)
    force = 0.5 * DENSITY * SPEED**2 * CHORD * SLAB
    twist = kept["twist"].values
    in_chords = kept["deflection"].values / kept.attrs["chord"] + (0.5 - AXIS) * np.sin(twist)
    normal = kept["cl"].values * np.cos(twist)  # without the drag, which is not kept
    return pd.DataFrame(
        {
            "t_ms": 1e3 * kept["time"].values * CHORD / SPEED,
            "theta_deg": -np.degrees(twist),
            "y_mm": -1e3 * in_chords * CHORD,
            "Fy_N": kept["cl"].values * force,
            "Mz_Nm": (kept["cm"].values - (0.5 - AXIS) * normal) * force * CHORD,
        }
    )


def main(folder: Path) -> None:
    """Write a file for each kept motion."""
    folder.mkdir(parents=True, exist_ok=True)
    for motion in sorted(KEPT.glob("*.nc")):
        rows = table(motion)
        path = folder / f"{motion.stem}.dat"
        with path.open("w", encoding="utf-8") as file:
            file.write(f"# {' '.join(rows.columns)}\n")
            rows.to_csv(file, sep=" ", index=False, header=False, float_format="%.10g")
    print(f"{len(list(folder.glob('*.dat')))} files in {folder}")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
