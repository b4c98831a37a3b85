"""Kicks of the loads on an overset mesh: half of their second difference from step to step.

python -m tests.benchmarks.kicks results/.store/<hash>/case0/free
"""

import sys
from pathlib import Path

import numpy as np

from equisection.solvers.openfoam.reading.loads import read_loads

if __name__ == "__main__":
    loads = read_loads(Path(sys.argv[1]))
    late = loads.time > 1
    for name, values in (("c_l", loads.lift[late]), ("c_m", loads.moment[late])):
        kick = np.abs(np.diff(values, 2)) / 2
        print(name, "median", np.median(kick), "of a hundred", np.quantile(kick, 0.99), kick.max())
