"""Snakemake whose scripts run in forks of its own process, which has loaded what they load.

A job costs a fork in the place of a start of Python, which takes longer than most jobs of a short
run. Nothing else differs: each script has the preamble of Snakemake, and a process that ends.
"""

import importlib
import os
import runpy
import sys
import traceback
from pathlib import Path

from snakemake.cli import main
from snakemake.script import PythonScript

#: Loaded once, with all that they load.
_LOADED = (
    *("equisection.store.job", "equisection.analysis.onset", "equisection.report.report_page"),
    *("equisection.report.captions", "equisection.report.interactive_map", "scipy.optimize"),
    *("equisection.figures.save", "equisection.structure.modes", "plotly.offline"),
)


def _exit_status(script: str) -> int:
    """Run a script to its end and return the status that its process would end with."""
    try:
        runpy.run_path(script, run_name="__main__")
    except SystemExit as end:
        return end.code if isinstance(end.code, int) else int(end.code is not None)
    except BaseException:  # the child must not go on as a second Snakemake
        traceback.print_exc()
        return 1
    return 0


def run_in_a_fork(self: PythonScript, fname: str, edit: bool = False) -> None:
    """Do what :meth:`PythonScript.execute_script` does, without a start of Python."""
    del self, edit
    child = os.fork()
    if child == 0:
        status = _exit_status(fname)
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(status)
    _, ended = os.waitpid(child, 0)
    if ended:
        raise RuntimeError(
            f"{Path(fname).name} ended with status {os.waitstatus_to_exitcode(ended)}"
        )


if __name__ == "__main__":
    for module in _LOADED:
        importlib.import_module(module)
    PythonScript.execute_script = run_in_a_fork
    sys.exit(main())
