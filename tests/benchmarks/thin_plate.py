"""Flutter derivatives of a thin plate by OpenFOAM beside Theodorsen's, in % of the load's size.

python -m tests.benchmarks.thin_plate
"""

from pathlib import Path

import equisection as eq

PAIRS = {"H1, H4": (0, 3), "H2, H3": (1, 2), "A1, A4": (4, 7), "A2, A3": (5, 6)}

if __name__ == "__main__":
    table = eq.Derivatives.read(Path("results/thin-plate-forced/derivatives/2d.csv"))
    plate = eq.Derivatives.theodorsen(table.reduced_velocity, table.axis)
    print("V/(f c)", *table.reduced_velocity)
    for name, (one, other) in PAIRS.items():
        here, there = (t.values[:, one] + 1j * t.values[:, other] for t in (table, plate))
        print(name, *(f"{100 * off:.1f}" for off in abs(here - there) / abs(there)))
