"""Snakemake on many configurations, in forks of one process that has loaded what jobs load.

``python forked_runs.py TARGET CONFIGURATION ...`` makes a file of each run; its words go to
``CONFIGURATION.log``, and the last line of that is the status. A job costs a fork in the place of a
start of Python, which takes longer than most jobs of a short run. Figures are PNG alone. Nothing
else differs: each script has Snakemake's preamble, and a process that ends.
"""

import contextlib
import importlib
import os
import runpy
import sys
import traceback
from collections.abc import Callable
from pathlib import Path

import yaml
from snakemake.cli import main
from snakemake.script import PythonScript

from equisection.figures import catalogue

#: Loaded once, with all that they load.
_LOADED = (
    *("equisection.store.job", "equisection.analysis.onset", "equisection.report.report_page"),
    *("equisection.report.captions", "equisection.report.interactive_map", "scipy.optimize"),
    *("equisection.figures.save", "equisection.structure.modes", "plotly.offline"),
)


def in_a_fork(work: Callable[[], object]) -> int:
    """Do work in a fork; return the status that a process of its own would end with."""
    sys.stdout.flush()
    sys.stderr.flush()
    child = os.fork()
    if child == 0:
        status = 1
        try:
            work()
            status = 0
        except SystemExit as end:
            status = end.code if isinstance(end.code, int) else int(end.code is not None)
        except BaseException:  # a child must not go on as a second parent
            traceback.print_exc()
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(status)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def run_script(self: PythonScript, fname: str, edit: bool = False) -> None:
    """Do what :meth:`PythonScript.execute_script` does, without a start of Python."""
    del self, edit
    status = in_a_fork(lambda: runpy.run_path(fname, run_name="__main__"))
    if status:
        raise RuntimeError(f"{Path(fname).name} ended with status {status}")


def run_snakemake(configuration: Path, target: str) -> None:
    """Make a file of a run."""
    name = yaml.safe_load(configuration.read_text(encoding="utf-8"))["run"]
    with configuration.with_suffix(".log").open("w", encoding="utf-8") as log:
        os.dup2(log.fileno(), 1)
        os.dup2(log.fileno(), 2)
        with contextlib.redirect_stdout(log), contextlib.redirect_stderr(log):
            main(
                [
                    *("--cores", "1", "--configfile", str(configuration)),
                    *("--", f"results/{name}/{target}"),
                ]
            )


if __name__ == "__main__":
    for module in _LOADED:
        importlib.import_module(module)
    PythonScript.execute_script = run_script
    catalogue.FORMATS = ("png",)
    for path in map(Path, sys.argv[2:]):
        ended = in_a_fork(lambda path=path: run_snakemake(path, sys.argv[1]))
        print(path.stem, ended, flush=True)
