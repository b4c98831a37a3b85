"""Python and the packages that equisection runs on, looked for before any of them is imported.

It and `clone` are the first modules of the package to be imported, and an old Python must be able
to read them.
"""

import sys
from importlib.util import find_spec
from pathlib import Path

from equisection.clone import CLONE

#: The oldest Python that is supported.
OLDEST_PYTHON = (3, 11)
#: Modules of the packages that `pyproject.toml` names.
MODULES = (
    "snakemake",
    "numpy",
    "scipy",
    "pandas",
    "xarray",
    "netCDF4",
    "yaml",
    "pydantic",
    "skfem",
    "foamlib",
    "matplotlib",
    "PIL",
    "rich",
    "shtab",
    "pygments",
    "jinja2",
    "docutils",
)


def require() -> None:
    """Refuse to go on where the package cannot run.

    Raises
    ------
    ImportError
        Python is too old, or packages are missing; the message says what to do.
    SystemExit
        The same, in one line without a traceback, for a program of the project: the command
        ``equisection``, ``python -m equisection...`` or a script.
    """
    fault = missing()
    if fault and _runs_a_program():
        print(f"error: {fault}", file=sys.stderr)
        raise SystemExit(1)
    if fault:
        raise ImportError(fault)


def missing(version: "tuple[int, ...]" = sys.version_info[:2]) -> str:
    """Return what is missing and what to do about it, as a sentence; empty if nothing is."""
    if version < OLDEST_PYTHON:
        return (
            f"equisection needs Python {_dotted(OLDEST_PYTHON)} or newer, and {sys.executable} is "
            f"{_dotted(version)}: 'make run PYTHON=python3.12' in {CLONE} makes an environment "
            "with another one"
        )
    absent = [name for name in MODULES if name not in sys.modules and not find_spec(name)]
    if not absent:
        return ""
    return (
        f"equisection is not installed in {sys.prefix} (missing: {', '.join(absent)}): "
        f"'pip install -c envs/constraints.txt -e .' in {CLONE}, or 'make run' there"
    )


def _dotted(version: "tuple[int, ...]") -> str:
    return ".".join(map(str, version))


def _runs_a_program() -> bool:
    """Tell whether a program of the project is running, not one that imports the package."""
    program = Path(sys.argv[0] if sys.argv else "").absolute()
    # Python has "-m" there while it looks for the module; Snakemake copies scripts to its folder
    return (
        sys.argv[:1] == ["-m"]
        or program.name == "equisection"
        or program.parent == CLONE / "scripts"
        or program.parts[-3:-1] == (".snakemake", "scripts")
    )
