"""The installation of OpenFOAM on this machine, and the start of its programs.

It is looked for in this order: a command before each program (a launcher or a container call, from
the variable ``EQUISECTION_OPENFOAM``, which the workflow sets from its configuration), an
environment that was sourced, programs on the path (as Debian installs them), a launcher such as
``openfoam2312``. The version is no part of a case, but it is written with each result.
"""

from __future__ import annotations

import os
import re
import shlex
import shutil
import subprocess
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from pathlib import Path

from equisection.config.groups.openfoam_keys import PREFIX_VARIABLE
from equisection.errors import SolverError
from equisection.solvers.protocol import MPIRUN

#: Programs that a case needs.
PROGRAMS = ("blockMesh", "checkMesh", "simpleFoam", "pimpleFoam", "postProcess")
#: Where Debian's package has OpenFOAM's ``etc``; its own ``etc/bashrc`` cannot be sourced.
DEBIAN = Path("/usr/share/openfoam")
_HOW = (
    "install OpenFOAM (`make openfoam` does it on Debian and Ubuntu), source the etc/bashrc of an "
    f"installation, or name the command before its programs in {PREFIX_VARIABLE} or in "
    "openfoam.prefix"
)
#: Jobs share the cores of a machine, which Open MPI cannot know: each of them would bind its first
#: rank to the first core, and a rank that waits would keep others from going on. In a container it
#: runs as root.
_OPEN_MPI = {
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
}
_LAUNCHER = re.compile(r"openfoam-?v?\d{2,4}$")


@dataclass(frozen=True)
class Installation:
    """Installation of OpenFOAM, by which its programs are started.

    Attributes
    ----------
    prefix
        Words before the program.
    environment
        Variables in addition to those of the process.
    found
        Place where it was found, in words.
    launcher
        Command that starts ranks of MPI, on one machine or on all that the job has.
    """

    prefix: tuple[str, ...] = ()
    environment: Mapping[str, str] = field(default_factory=dict)
    found: str = ""
    launcher: str = MPIRUN

    def command(self, program: str, ranks: int = 1) -> list[str]:
        """Return the command line of a program, on several ranks of MPI where there are more.

        ``mpirun`` is that of the installation, so it comes behind the prefix. Another launcher, a
        scheduler's, comes before it: the prefix, a container for instance, is started on each rank.
        """
        if ranks == 1:
            return [*self.prefix, program]
        launch = [*shlex.split(self.launcher), "-n", str(ranks)]
        words = [*self.prefix, *launch] if self.launcher == MPIRUN else [*launch, *self.prefix]
        return [*words, program, "-parallel"]

    def variables(self) -> dict[str, str]:
        """Return the environment of a program: one thread a rank, ranks not bound to cores."""
        return {**_OPEN_MPI, **os.environ, "OMP_NUM_THREADS": "1", **self.environment}

    def version(self) -> str:
        """Return the version that the programs say of themselves, for instance ``v1912``.

        Raises
        ------
        SolverError
            A program does not start.
        """
        return _version(self.prefix, tuple(sorted(self.environment.items())))


def find(
    search: str | None = None, debian: Path = DEBIAN, *, launcher: str = MPIRUN
) -> Installation:
    """Return the installation of this machine.

    Parameters
    ----------
    search
        Folders in which programs are looked for (by default ``PATH``).
    debian
        Folder in which Debian's package has ``etc/controlDict``.
    launcher
        Command that starts ranks of MPI.

    Raises
    ------
    SolverError
        There is none, or a part of it is missing; the message names it and the remedy.
    """
    search = os.environ.get("PATH", "") if search is None else search
    return replace(_found(search, debian), launcher=launcher)


def _found(search: str, debian: Path) -> Installation:
    prefix = os.environ.get(PREFIX_VARIABLE, "")
    if prefix:
        words = tuple(shlex.split(prefix))
        if shutil.which(words[0], path=search) is None:
            raise SolverError(
                f"OpenFOAM's prefix '{prefix}': no program '{words[0]}' on the path; {_HOW}"
            )
        return Installation(words, {}, f"prefix {prefix}")
    missing = [name for name in PROGRAMS if shutil.which(name, path=search) is None]
    if len(missing) < len(PROGRAMS):
        return _on_the_path(missing, debian)
    script = _script(search)
    if script:
        return Installation((script,), {}, f"launcher {script}")
    raise SolverError(f"OpenFOAM is not on this machine (no {PROGRAMS[0]} on the path): {_HOW}")


def _on_the_path(missing: list[str], debian: Path) -> Installation:
    if missing:
        raise SolverError(f"OpenFOAM is not whole, {', '.join(missing)} missing: {_HOW}")
    if os.environ.get("WM_PROJECT_DIR"):
        return Installation(found=f"environment, {os.environ['WM_PROJECT_DIR']}")
    if (debian / "etc" / "controlDict").is_file():
        return Installation((), {"WM_PROJECT_DIR": str(debian)}, f"Debian's package, {debian}")
    raise SolverError(
        "OpenFOAM's programs are on the path, but WM_PROJECT_DIR is not set and its files are not "
        f"in {debian}: source the etc/bashrc of that installation"
    )


def _script(search: str) -> str | None:
    """Return the launcher of the newest version on the path."""
    names = {
        path.name
        for folder in search.split(os.pathsep)
        if folder and Path(folder).is_dir()
        for path in Path(folder).glob("openfoam*")
        if _LAUNCHER.match(path.name) and os.access(path, os.X_OK)
    }
    return max(names, key=lambda name: int(re.sub(r"\D", "", name)), default=None)


@lru_cache(maxsize=4)
def _version(prefix: tuple[str, ...], environment: tuple[tuple[str, str], ...]) -> str:
    try:
        said = subprocess.run(
            [*prefix, "blockMesh", "-help"],
            env={**os.environ, **dict(environment)},
            capture_output=True,
            text=True,
            timeout=300,
            check=False,
        )
    except (OSError, subprocess.TimeoutExpired) as error:
        raise SolverError(f"OpenFOAM does not start ({error}): {_HOW}") from None
    if said.returncode != 0:
        last = (said.stderr or said.stdout).strip().splitlines()[-1:] or ["no output"]
        raise SolverError(f"OpenFOAM does not start ({last[0]}): {_HOW}")
    return version_in(said.stdout)


def version_in(text: str) -> str:
    """Return the version in the output of a program; 'unknown' if there is none."""
    for pattern in (r"Using: OpenFOAM-\s*\(?(\w[\w.]*)", r"Build:.*?OPENFOAM=(\w+)", r"v(\d{4})"):
        match = re.search(pattern, text)
        if match:
            return f"v{match[1].removeprefix('v')}"
    return "unknown"
