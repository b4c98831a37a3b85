"""A job as the workflow runs it, in a process of its own: `python tests/run_one_job.py <folder>`.

Runs the cases of `<folder>/cases.json`; results, store, log and progress go to the folder.
"""

import sys
from pathlib import Path

from equisection.cases import read_cases
from equisection.run.script import logged
from equisection.store.job import run_cases

if __name__ == "__main__":
    place = Path(sys.argv[1])
    print("begins", flush=True)
    with logged(str(place / "job.log")):
        cases = read_cases(place / "cases.json")
        run_cases(cases, place, place / "store", place / "progress.json")
