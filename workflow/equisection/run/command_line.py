"""The command ``equisection``: a configuration to start from, a run, and questions about it.

The workflow itself is that of ``snakemake``, which ``equisection run`` starts; the other commands
read the files of its runs.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import equisection
from equisection.clone import clone_of_package
from equisection.errors import ArgumentError, ConfigError, EquisectionError
from equisection.keys.shown import printable
from equisection.run.starter import (
    DIMENSION,
    EXAMPLES,
    QUESTIONS,
    StarterError,
    asked,
    dimension,
    examples_folder,
    starter,
)

if TYPE_CHECKING:  # what a command needs is imported there, so that --help comes at once
    from equisection.config import Config

#: Kinds of exports (:data:`equisection.analysis.exported.KINDS`), known without loading them.
EXPORTS = ("polars", "models", "derivatives", "modes", "section", "openfast")
_EXAMPLES = """\
examples:
  equisection init my-row --like tracker write a configuration to start from, my-row.yaml
  equisection run my-row.yaml            run it; the same as snakemake --configfile my-row.yaml
  equisection onset results/my-row       its critical speed, by what, and how sure
  equisection show results/my-row        its figures
  equisection export results/my-row      its polars, models, modes and section for other programs
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
        return _COMMANDS[options.command](options) or 0
    except EquisectionError as error:
        print(f"error: {printable(str(error))}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        return 130
    except BrokenPipeError:  # the reader of a pipe has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


@cache
def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="equisection",
        description="A flexible beam in a flow, its equivalent two-dimensional section, and "
        "where they go unstable. This command starts the workflow, which is one of snakemake, says "
        "how far it is, and what came out.",
        epilog=_EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument(
        "--version", action="version", version=f"equisection {equisection.__version__}"
    )
    commands = parser.add_subparsers(dest="command", title="commands", metavar="COMMAND")
    _add_start(commands)
    _add_answers(commands)
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


def _add_start(commands: Any) -> None:
    """Add the commands that start a run: ``init`` and ``run``."""
    init = commands.add_parser(
        "init",
        help="a configuration to start from",
        description="Write a configuration with comments, that of an example with another name. "
        "Without --like, example and dimensions are asked for on a terminal.",
    )
    init.add_argument("name", metavar="NAME", help="name of the run; the file is NAME.yaml")
    init.add_argument("--like", choices=list(EXAMPLES), help="what the beam is like")
    for _, key, words, unit in QUESTIONS:
        option = f"--{key.replace('_', '-')}"
        init.add_argument(option, metavar=unit.upper(), help=f"{words} ({unit})")
    run = commands.add_parser(
        "run",
        help="run the workflow",
        description="Start snakemake with config/config.yaml and the files given, with the cores "
        "and the profile of 'make run', show its progress, and say what came out of a whole run.",
    )
    run.add_argument("configfile", nargs="*", type=Path, metavar="CONFIGFILE")
    run.add_argument(
        "--snakemake",
        nargs=argparse.REMAINDER,
        default=[],
        metavar="WORD",
        help="further words for snakemake, such as -n or --cores 1; the last option",
    )


def _add_answers(commands: Any) -> None:
    """Add the commands that say what came out: ``onset``, ``show``, ``export``; ``completion``."""
    onset = commands.add_parser(
        "onset",
        help="the critical speed, by what, and how sure",
        description="Say the critical speed of a run: from which model and by what, at which "
        "frequency, with which margin to the design speed, and what is known of its error.",
    )
    onset.add_argument("run_folder", nargs="?", type=Path, metavar="RUN_FOLDER")
    onset.add_argument("--json", action="store_true", help="as JSON, with every line of the table")
    show = commands.add_parser(
        "show",
        help="the figures",
        description="Open a run's figures in the viewer of this session; where there is none, "
        "print where they are.",
    )
    show.add_argument("run_folder", type=Path, metavar="RUN_FOLDER")
    show.add_argument("figure", nargs="*", metavar="FIGURE", help="names (default: all)")
    show.add_argument("--to", type=Path, metavar="FOLDER", help="copy them there instead")
    export = commands.add_parser(
        "export",
        help="polars, models, derivatives, modes and section for other programs",
        description="Write what runs have for other programs: polars as airfoil tables of AeroDyn "
        "(OpenFAST), learnt models, flutter derivatives, modes and equivalent section as CSV and "
        "JSON, and the section as input of OpenFAST's unsteady-aerodynamics driver.",
    )
    export.add_argument("run_folder", nargs="+", type=Path, metavar="RUN_FOLDER")
    export.add_argument(
        "--to",
        type=Path,
        metavar="FOLDER",
        help="where to write, with a folder for each run (default: export/ in that of the run)",
    )
    export.add_argument(
        "--only",
        action="append",
        choices=EXPORTS,
        default=[],
        help="leave out the other kinds; can be given again",
    )
    export.add_argument("--json", action="store_true", help="list the files as JSON")
    completion = commands.add_parser(
        "completion",
        help="a script by which a shell completes this command",
        description="Print a script for a shell, for instance: equisection completion bash > "
        "~/.local/share/bash-completion/completions/equisection",
    )
    completion.add_argument("shell", choices=("bash", "zsh", "tcsh"))


def _init(options: argparse.Namespace) -> None:
    values: dict[str, float] = {}
    for _, key, _, _ in QUESTIONS:
        given = getattr(options, key)
        try:
            values |= {} if given is None else {key: dimension(given)}
        except ValueError:
            raise StarterError(f"{key.replace('_', ' ')} {given}: {DIMENSION}") from None
    name = options.name.removesuffix(".yaml")
    file = Path(f"{name}.yaml")
    like = options.like
    if like is None:
        if not sys.stdin.isatty():
            raise StarterError(f"--like is missing; allowed are {', '.join(EXAMPLES)}")
        if file.exists():
            raise StarterError(f"{file}: is there already; give another name")
        like, values = asked(values)
    text = starter(like, name, file, examples_folder(clone_of_package()), values)
    try:
        with file.open("x", encoding="utf-8") as written:
            written.write(text)
    except FileExistsError:
        raise StarterError(f"{file}: is there already; give another name") from None
    except OSError as error:
        raise StarterError(f"{file}: cannot be written ({error})") from None
    print(f"{file}: edit it, then 'equisection check {file}' and 'equisection run {file}'")
    try:  # dimensions of one's own may not go together with what is left of the example
        _config([file])
    except ConfigError as error:
        print(f"as it stands it cannot run yet:\n{error}")


def _run(files: Sequence[Path], further: Sequence[str]) -> int:
    # Imported here, so that --help and --version come at once.
    from rich.console import Console  # noqa: PLC0415

    from equisection.run import start  # noqa: PLC0415
    from equisection.run.answer import CRITICAL_SPEEDS, answer_of  # noqa: PLC0415
    from equisection.run.launch import is_whole, launch, snakemake_command  # noqa: PLC0415

    config = start.checked_config(_keys(files), clone_of_package() or Path.cwd())
    status = launch(snakemake_command(files, further), Console(highlight=False))
    folder = start.RESULTS / config.run
    if status == 0 and is_whole(further) and (folder / CRITICAL_SPEEDS).is_file():
        print("\n".join(answer_of(folder).lines()))
        print(f"files           {folder}; figures: equisection show {folder}")
    return status


def _onset(folder: Path | None, as_json: bool) -> None:
    # Imported here, so that --help and --version come at once.
    from equisection.run.answer import AnswerError, answer_of  # noqa: PLC0415
    from equisection.run.status import find_runs  # noqa: PLC0415

    if folder is None:
        runs = find_runs(Path("results"))
        if len(runs) != 1:
            there = ", ".join(map(str, runs)) or "none yet"
            raise AnswerError(f"which run? In results/ there are: {there}")
        folder = runs[0]
    answer = answer_of(folder)
    print(answer.as_json() if as_json else "\n".join(answer.lines()))


def _show(run: Path, names: Sequence[str], folder: Path | None) -> None:
    # Imported here, so that --help and --version come at once.
    from equisection.run.shown_figures import copied, figures_of, opened  # noqa: PLC0415

    pictures = figures_of(run, names)
    if folder is not None:
        pictures = copied(pictures, folder)
    elif opened(pictures):
        return
    print("\n".join(map(str, pictures)))


def _export(runs: Sequence[Path], to: Path | None, kinds: Sequence[str], as_json: bool) -> None:
    # Imported here, so that --help and --version come at once.
    import json  # noqa: PLC0415

    from equisection.analysis.exported import exported  # noqa: PLC0415

    places = {run: run / "export" if to is None else to / run.resolve().name for run in runs}
    if len(set(places.values())) < len({run.resolve() for run in runs}):
        raise ArgumentError(f"--to {to}: two of the runs have one name; export each by itself")
    files = [file for run, place in places.items() for file in exported(run, place, kinds)]
    if as_json:
        print(json.dumps([{**asdict(file), "path": str(file.path)} for file in files], indent=2))
        return
    for file in files:
        print(f"left out        {file.path}: {file.left_out}" if file.left_out else file.path)


def _completion(shell: str) -> None:
    # Imported here, so that --help and --version come at once.
    import shtab  # noqa: PLC0415

    print(shtab.complete(_parser(), shell=shell))


def _cost_model(folders: Sequence[Path], model: Path | None) -> None:
    # Imported here, so that --help and --version come at once.
    from equisection.run.cost import read_cost_model  # noqa: PLC0415
    from equisection.run.cost_fit import fits, fitted, write_cost_model  # noqa: PLC0415

    for folder in folders:
        if not folder.is_dir():
            raise ArgumentError(f"{folder}: no such folder; give one with results")
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
    from equisection.run.start import checked_config, here_or_in_project  # noqa: PLC0415

    project = clone_of_package()
    config = checked_config(_keys(files), project or Path.cwd())
    jobs = solver_jobs(config, read_cost_model(here_or_in_project(COST_MODEL, project)))
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

    first = start.here_or_in_project(start.CONFIG_FILE, clone_of_package())
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

    config = start.checked_config(_keys(files), clone_of_package() or Path.cwd())
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
        print(f"There is no run in {where} yet. Start one with 'equisection run CONFIGFILE'.")
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


#: What each command does with its options; nothing that it returns is the exit status 0.
_COMMANDS: dict[str, Callable[[argparse.Namespace], int | None]] = {
    "init": _init,
    "run": lambda of: _run(of.configfile, of.snakemake),
    "onset": lambda of: _onset(of.run_folder, of.json),
    "show": lambda of: _show(of.run_folder, of.figure, of.to),
    "export": lambda of: _export(of.run_folder, of.to, of.only, of.json),
    "completion": lambda of: _completion(of.shell),
    "status": lambda of: _status(of.run_folder, of.plain, of.html),
    "verify": lambda of: int(not _verify(of.folder)),
    "folder": lambda of: print(Path("results") / _config(of.configfile).run),
    "check": lambda of: _check(of.configfile),
    "cost": lambda of: _cost(of.configfile),
    "polar": lambda of: print(_polar(of.results, of.format), end=""),
    "keep": lambda of: _keep(of.run_folder, of.folder),
    "seal": lambda of: int(not _seal(of.place)),
    "cost-model": lambda of: _cost_model(of.folder, of.write),
}


if __name__ == "__main__":
    sys.exit(main())
