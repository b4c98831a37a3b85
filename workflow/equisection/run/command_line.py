"""The command ``equisection``: questions about a run at a terminal.

The workflow itself is started with ``snakemake``; this command reads the files of its runs.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import equisection
from equisection.errors import EquisectionError

if TYPE_CHECKING:  # what a command needs is imported there, so that --help comes at once
    from equisection.config import Config

_EXAMPLES = """\
examples:
  snakemake --cores 2                    run the workflow (config/config.yaml)
  equisection status                     how far the runs in results/ are
  equisection status results/my-beam     how far one run is
  equisection status --plain | grep failed
  equisection status --html status.html  the same as a page for a browser
  equisection check my-wing.yaml         whether it can be run; else what is wrong, in a line each
  equisection cost my-wing.yaml          what its jobs will ask for, and the core hours
  equisection verify                     whether results, figures and tables are what they say
  equisection cost-model                 what a cell of a mesh costs, by the results
  equisection polar results/my-beam/steady/2d/coarse_a*.nc > my_section.csv
"""


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command; return its exit status: 0, 1 if something is wrong, 2 on a wrong usage."""
    parser = _parser()
    options = parser.parse_args(arguments)
    if options.command is None:
        parser.print_help()
        return 0
    try:
        if options.command == "folder":
            print(Path("results") / _config(options.configfile).run)
        elif options.command == "check":
            _check(options.configfile)
        elif options.command == "cost":
            _cost(options.configfile)
        elif options.command == "polar":
            print(_polar(options.results, options.format), end="")
        elif options.command == "keep":
            _keep(options.run_folder, options.folder)
        elif options.command == "seal":
            return 0 if _seal(options.place) else 1
        elif options.command == "cost-model":
            _cost_model(options.folder, options.write)
        elif options.command == "verify":
            return 0 if _verify(options.folder) else 1
        else:
            _status(options.run_folder, options.plain, options.html)
    except EquisectionError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    except BrokenPipeError:  # the reader of a pipe has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="equisection",
        description="A flexible beam in a flow, its equivalent two-dimensional section, and "
        "where they go unstable. The workflow is started with snakemake; this command tells "
        "how far it is.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--version", action="version", version=f"equisection {equisection.__version__}"
    )
    commands = parser.add_subparsers(dest="command", title="commands", metavar="COMMAND")
    status = commands.add_parser(
        "status",
        help="how far the runs are",
        description="Tell of each case of a run whether it is done (and what it turned out to "
        "be), running, failed (and why), stopped, broken or waiting. Steady cases are listed "
        "while they are not done.",
    )
    status.add_argument(
        "run_folder",
        nargs="*",
        type=Path,
        metavar="RUN_FOLDER",
        help="folder of a run (default: every run in results/)",
    )
    status.add_argument(
        "--plain",
        action="store_true",
        help="tab-separated lines with every case, for pipes; the first names the columns",
    )
    status.add_argument(
        "--html",
        type=Path,
        metavar="FILE",
        help="write a page that needs neither network nor script, with every case",
    )
    verify = commands.add_parser(
        "verify",
        help="whether results, figures and tables are what they say",
        description="Compute the hashes again of everything that figures and tables are made of, "
        "and name what is stale, foreign, missing or broken. The exit status is 0 if nothing is.",
    )
    verify.add_argument(
        "folder",
        nargs="*",
        type=Path,
        metavar="FOLDER",
        help="folder of a run, or one with kept results (default: all in results/)",
    )
    folder = commands.add_parser(
        "folder",
        help="where a configuration's results go",
        description="Print the folder of the run that config/config.yaml and the files given "
        "configure, as 'snakemake --configfile' reads them.",
    )
    folder.add_argument("configfile", nargs="*", type=Path, metavar="CONFIGFILE")
    check = commands.add_parser(
        "check",
        help="whether a configuration can be run",
        description="Check config/config.yaml and the files given, as 'snakemake --configfile' "
        "reads them, and the files that they name: what is wrong is said in one line each, with "
        "file, line and column, or key and value.",
    )
    check.add_argument("configfile", nargs="*", type=Path, metavar="CONFIGFILE")
    cost = commands.add_parser(
        "cost",
        help="what a configuration's jobs ask for: memory, time, core hours",
        description="List the jobs that run the solver, by config/config.yaml and the files given, "
        "as 'snakemake --configfile' reads them: how many, and the memory and time that each asks "
        "for. Core hours are those of all of them, at most: every run to its longest duration, "
        "none taken from kept results. From the cost model, workflow/profiles/cost.yaml.",
    )
    cost.add_argument("configfile", nargs="*", type=Path, metavar="CONFIGFILE")
    polar = commands.add_parser(
        "polar",
        help="a polar file from steady results",
        description="Write the steady results of one solver on one mesh as the CSV file that the "
        "keys 'embedded.polars' and 'steady.beam_polar' take, with how each value was obtained, or "
        "as an airfoil table of AeroDyn (OpenFAST), with moments about the quarter chord.",
    )
    polar.add_argument(
        "--format",
        choices=("csv", "aerodyn"),
        default="csv",
        help="format of the file (default: csv)",
    )
    polar.add_argument(
        "results",
        nargs="+",
        type=Path,
        metavar="RESULT",
        help="files of results/<run>/steady/<dimension>/",
    )
    keep = commands.add_parser(
        "keep",
        help="keep a run's results for other runs",
        description="Copy the results of a run's cases to a folder that other runs take results "
        "from (the key 'reuse', by default results/reference). Cases that failed are left out.",
    )
    keep.add_argument("run_folder", type=Path, metavar="RUN_FOLDER", help="folder of a run")
    keep.add_argument(
        "folder",
        nargs="?",
        type=Path,
        metavar="FOLDER",
        help="where to keep them (default: results/reference/<name of the run>)",
    )
    seal = commands.add_parser(
        "seal",
        help="digests for results that have none",
        description="Write a digest to NetCDF results that have none, since they are from before "
        "digests were written or another program wrote them. Length, variables and case are "
        "checked; for the values you vouch. What is broken is named, and the exit status is 1.",
    )
    seal.add_argument("place", nargs="+", type=Path, metavar="FILE_OR_FOLDER")
    cost_model = commands.add_parser(
        "cost-model",
        help="what a cell costs, by the results that are there",
        description="Fit the time of a cell of OpenFOAM's meshes to what results took, and print "
        "it. Jobs ask a cluster for time by it (docs/cluster.md).",
    )
    cost_model.add_argument(
        "folder",
        nargs="*",
        type=Path,
        metavar="FOLDER",
        help="where results are looked for (default: results)",
    )
    cost_model.add_argument(
        "--write",
        type=Path,
        metavar="FILE",
        help="also write it to the cost model, workflow/profiles/cost.yaml",
    )
    return parser


def _cost_model(folders: Sequence[Path], model: Path | None) -> None:
    # Imported here, so that --help and --version come at once.
    from equisection.run.cost import read_cost_model  # noqa: PLC0415
    from equisection.run.cost_fit import fits, fitted, write_cost_model  # noqa: PLC0415

    found = fits(folders or [Path("results")])
    for fit in found:
        print(fit.words())
    if not found:
        print("no result of OpenFOAM that says what it took; the cost model stays as it is")
    elif model is not None:
        write_cost_model(model, fitted(read_cost_model(model), found))


def _keep(run: Path, folder: Path | None) -> None:
    # Imported here, so that --help and --version come at once.
    from equisection.store.kept import keep_results  # noqa: PLC0415

    folder = folder or Path("results/reference") / run.resolve().name
    copies = keep_results(run, folder)
    print(f"{len(copies)} results of cases are kept in {folder}")


def _seal(places: Sequence[Path]) -> bool:
    # Imported here, so that --help and --version come at once.
    from equisection.store.seal import seal  # noqa: PLC0415

    found = list(seal(places))
    for path, fault in found:
        if fault:
            print(f"{path}: {fault}", file=sys.stderr)
    sealed = sum(not fault for _, fault in found)
    print(f"{sealed} files have a digest now" if sealed else "no file has been given a digest")
    return sealed == len(found)


def _polar(results: Sequence[Path], form: str) -> str:
    # Imported here, so that --help and --version come at once.
    from equisection.analysis.polar_of_results import (  # noqa: PLC0415
        polar_aerodyn,
        polar_csv,
    )

    return polar_aerodyn(results) if form == "aerodyn" else polar_csv(results)


def _cost(files: Sequence[Path]) -> None:
    # Imported here, so that --help and --version come at once.
    from rich.console import Console  # noqa: PLC0415

    from equisection.run.cost import COST_MODEL, read_cost_model  # noqa: PLC0415
    from equisection.run.jobs import solver_jobs, table  # noqa: PLC0415
    from equisection.run.start import here_or_in_project, project_of_package  # noqa: PLC0415

    model = here_or_in_project(COST_MODEL, project_of_package())
    jobs = solver_jobs(_config(files), read_cost_model(model))
    if jobs:
        Console(highlight=False).print(table(jobs))
    else:
        print("no job runs a solver: compute is false, results are taken from what is kept")


def _config(files: Sequence[Path]) -> Config:
    """Return the configuration that the files make on top of the default one.

    Raises
    ------
    ConfigError
        A file cannot be read, or the configuration is not valid.
    """
    # Imported here, so that --help and --version come at once.
    from equisection.config import load_config  # noqa: PLC0415

    return load_config(_keys(files))


def _keys(files: Sequence[Path]) -> dict[str, Any]:
    """Return the keys of the default configuration and of the files on top of it."""
    # Imported here, so that --help and --version come at once.
    from snakemake.utils import update_config  # noqa: PLC0415

    from equisection.config import check_config_files, read_config_file  # noqa: PLC0415
    from equisection.run import start  # noqa: PLC0415

    first = start.here_or_in_project(start.CONFIG_FILE, start.project_of_package())
    paths = start.config_files(first, files)
    check_config_files(paths)
    raw: dict[str, Any] = {}
    for path in paths:
        update_config(raw, read_config_file(path))
    return raw


def _check(files: Sequence[Path]) -> None:
    """Look at the configuration and at the files that it names, as the workflow does first."""
    # Imported here, so that --help and --version come at once.
    from equisection.run import start  # noqa: PLC0415

    config = start.checked_config(_keys(files), start.project_of_package() or Path.cwd())
    start.say(start.notices(config))
    print(f"the configuration is valid; its results go to {start.RESULTS / config.run}")


def _status(folders: Sequence[Path], plain: bool, page: Path | None) -> None:
    # Imported here, so that --help and --version come at once.
    from rich.console import Console  # noqa: PLC0415

    from equisection.run.status import StatusError, find_runs, run_status  # noqa: PLC0415
    from equisection.run.status_page import write_page  # noqa: PLC0415
    from equisection.run.status_text import plain_lines, print_status  # noqa: PLC0415

    default = Path("results")
    places = list(folders) or ([default] if default.is_dir() else [])
    runs = [run_status(run) for place in places for run in find_runs(place)]
    where = ", ".join(map(str, places)) or f"{Path.cwd()} (it has no folder 'results')"
    if page is not None:
        try:
            write_page(page, runs, where)
        except OSError as error:
            raise StatusError(f"{page}: the page cannot be written there ({error})") from None
        print(f"page: {page}")
        return
    if plain:
        print("\n".join(plain_lines(runs)), flush=True)
        return
    if not runs:
        print(f"There is no run in {where} yet. Start one with 'snakemake --cores 2'.")
    console = Console(highlight=False)
    for run in runs:
        print_status(console, run)
    sys.stdout.flush()


def _verify(folders: Sequence[Path]) -> bool:
    # Imported here, so that --help and --version come at once.
    from equisection.run.verify import verify_folder, words  # noqa: PLC0415

    found = [
        verified for folder in folders or [Path("results")] for verified in verify_folder(folder)
    ]
    for verified in found:
        print("\n".join(words(verified)))
    if not found:
        print("there is no run and no kept result to verify")
    sys.stdout.flush()
    return not any(verified.faults for verified in found)


if __name__ == "__main__":
    sys.exit(main())
