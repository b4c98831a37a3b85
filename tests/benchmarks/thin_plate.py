"""Flutter derivatives of the kept thin plate by OpenFOAM beside Theodorsen's.

python -m tests.benchmarks.thin_plate
"""

import equisection as eq
from equisection.io.derivative_table import DERIVATIVES
from equisection.validation.outline_values import LOADS, derivatives_of_moved_plate

if __name__ == "__main__":
    table = derivatives_of_moved_plate()
    plate = eq.Derivatives.theodorsen(table.reduced_velocity, table.axis)
    print("V/(f c)", *table.reduced_velocity)
    for load, (one, other) in LOADS.items():
        here, there = (t.values[:, one] + 1j * t.values[:, other] for t in (table, plate))
        off = 100 * abs(here - there) / abs(there)
        print(f"{load}, off by % of its size:", *off.round(1))
    for name, here, there in zip(DERIVATIVES, table.values.T, plate.values.T, strict=True):
        print(f"{name}* by itself, off by %:", *(100 * (here / there - 1)).round(1))
