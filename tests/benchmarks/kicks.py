"""Kicks of the loads on an overset mesh: half of their second difference from step to step.

python -m tests.benchmarks.kicks results/.store/<hash>/case0/free
"""

import argparse
from pathlib import Path

import numpy as np

from equisection.solvers.openfoam.reading.loads import read_loads
from tests.benchmarks.needed import needed

if __name__ == "__main__":
    parser = argparse.ArgumentParser(prog="python -m tests.benchmarks.kicks")
    parser.add_argument("free", type=Path, help="folder of the free run, in the store")
    with needed("the run with overset of docs/openfoam-mesh-motion.md"):
        loads = read_loads(parser.parse_args().free)
    late = loads.time > 1
    for name, values in (("c_l", loads.lift[late]), ("c_m", loads.moment[late])):
        kick = np.abs(np.diff(values, 2)) / 2
        print(name, "median", np.median(kick), "of a hundred", np.quantile(kick, 0.99), kick.max())
