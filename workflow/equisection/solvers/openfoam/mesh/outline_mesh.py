r"""Mesh of a section of any outline in a channel, or in free air in a wide one.

::

    +-----------------------------------------+  ceiling
    |                 .-----.                 |
    |   ring        /  disc   \     wake     |
    |  (unturned)  |   ====    |              |
    |               \ (turned) /             |
    |                 '-----'                 |
    +-----------------------------------------+  floor

Layers at the wall and the disc around them are the same cells at every incidence, turned with the
section; the ring out to the channel is meshed for each.
"""

from __future__ import annotations

import contextlib
import importlib.metadata
import json
import math
import resource
import signal
import subprocess
import sys
from dataclasses import asdict, dataclass, field
from pathlib import Path
from typing import Any

from equisection.errors import ConfigError, SolverError
from equisection.files import write_text
from equisection.solvers.openfoam.mesh.block_mesh import ChannelBox
from equisection.solvers.openfoam.mesh.outline_sizes import FINE_UP_TO, OutlineSizes
from equisection.solvers.openfoam.process import BlowUpError

#: Versions of this mesh, a part of the case that it is made for: the second is that of a Reynolds
#: number that asks for thinner first cells.
VERSIONS = 1, 2
#: Processor seconds after which gmsh counts as hung, and how many times as long it has by the
#: clock, beside other programs.
TIME_LIMIT, BY_THE_CLOCK = 300.0, 12.0
#: Status of the process that makes a mesh where the outline has none.
NO_MESH = 3
#: Input and log of that process, in the folder of the case.
INPUT, LOG = "outline.json", "log.outline"
#: Module that makes it.
_MESHER = "outline_mesher"
#: Room between the disc and the channel's walls (chords), and between it and inlet and outlet.
_TO_WALL, _TO_END = 0.25, 1.0


def mesher(reynolds: float) -> str:
    """Return the mesher of outlines with its version and gmsh's, as a case holds it.

    Parameters
    ----------
    reynolds
        Reynolds number of the chord.

    Raises
    ------
    ConfigError
        gmsh is not installed.
    """
    try:
        version = importlib.metadata.version("gmsh")
    except importlib.metadata.PackageNotFoundError:
        raise ConfigError(
            "config: beam.outline: needs gmsh, which makes its mesh: make openfoam, or "
            "pip install -c envs/constraints.txt -e '.[openfoam]'"
        ) from None
    return f"outline {VERSIONS[reynolds > FINE_UP_TO]}, gmsh {version}"


def require_mesher(named: str, reynolds: float) -> None:
    """Refuse a case that was written for another mesher than the one installed.

    Parameters
    ----------
    named
        The mesher that the case holds.
    reynolds
        Reynolds number of the chord.

    Raises
    ------
    SolverError
        With both versions.
    """
    installed = mesher(reynolds)
    if named != installed:
        raise SolverError(
            f"the case is for the mesher '{named}', installed is '{installed}'; install that "
            "(envs/constraints.txt), or delete the run's folder 'cases' and run again"
        )


@dataclass(frozen=True)
class OutlineMesh:
    """Input of the mesh of a section in a channel.

    Attributes
    ----------
    outline
        Vertices of the contour over the chord from mid-chord, counter-clockwise.
    channel
        The channel.
    incidence
        Incidence (rad), nose up.
    refinement
        Refinement of each direction.
    sizes
        Sizes that are refined.
    """

    outline: tuple[tuple[float, float], ...]
    channel: ChannelBox
    incidence: float
    refinement: float
    sizes: OutlineSizes = field(default_factory=OutlineSizes)

    @property
    def centre(self) -> tuple[float, float]:
        """Middle of the outline in its own frame."""
        x, y = zip(*self.outline, strict=True)
        return (min(x) + max(x)) / 2, (min(y) + max(y)) / 2

    def reach(self, incidence: float) -> tuple[float, float]:
        """Return the lowest and the highest y of the outline at an incidence (rad), chords."""
        cosine, sine = math.cos(incidence), math.sin(incidence)
        heights = [y * cosine - x * sine for x, y in self.outline]
        return min(heights), max(heights)

    @property
    def disc_radius(self) -> float:
        """Radius of the disc: that of the sizes, more for a section that is high."""
        x0, y0 = self.centre
        reach = max(math.hypot(x - x0, y - y0) for x, y in self.outline)
        return max(self.sizes.disc, reach + self.sizes.disc / 2)

    def require_room(self) -> None:
        """Refuse a channel that the disc does not fit into.

        Raises
        ------
        SolverError
            With the channel and what the disc needs.
        """
        radius, (x0, y0) = self.disc_radius, self.centre
        cosine, sine = math.cos(self.incidence), math.sin(self.incidence)
        x, y = x0 * cosine + y0 * sine, y0 * cosine - x0 * sine
        channel = self.channel
        fits = (
            channel.floor <= y - radius - _TO_WALL
            and y + radius + _TO_WALL <= channel.ceiling
            and radius - x + _TO_END <= channel.upstream
            and radius + x + _TO_END <= channel.downstream
        )
        if not fits:
            raise SolverError(
                f"the mesh around the outline, of radius {radius:.3g} c, does not fit into a "
                f"channel of {channel.height:g} c from {-channel.upstream:g} c to "
                f"{channel.downstream:g} c{channel.words}; enlarge flow.channel"
            )

    def write(self, folder: Path, time_limit: float = TIME_LIMIT) -> None:
        """Make the mesh and write ``constant/polyMesh``, in a process of its own.

        Raises
        ------
        BlowUpError
            The outline has no mesh.
        SolverError
            gmsh is missing, crashed, or did not end within the time limit (processor s).
        """
        self.require_room()
        made_by(_MESHER, folder, asdict(self), time_limit)


def made_by(module: str, folder: Path, mesh: dict[str, Any], time_limit: float) -> None:
    """Have a mesh made by a module that runs as a process of its own, from its input.

    The limit is of processor time where the system can set it (Linux), so that a busy machine ends
    no mesh; by the clock the process has :data:`BY_THE_CLOCK` times as long.

    Raises
    ------
    BlowUpError
        The outline has no mesh.
    SolverError
        gmsh is missing, crashed, or did not end within the time limit (processor s).
    """
    write_text(folder / INPUT, json.dumps(mesh))
    command = [sys.executable, "-m", f"{__package__}.{module}", str(folder.resolve())]
    by_the_clock = BY_THE_CLOCK * time_limit
    with (
        (folder / LOG).open("wb") as log,
        subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT
        ) as process,
    ):
        _limit_processor_time(process.pid, time_limit)
        try:
            status = process.wait(by_the_clock)
        except subprocess.TimeoutExpired:
            process.kill()
            raise _unended(f"{by_the_clock:g} s", folder) from None
        except BaseException:
            process.kill()
            raise
    if status == -signal.SIGXCPU:
        raise _unended(f"{math.ceil(time_limit)} s of processor", folder)
    if status == 0:
        return
    said = (folder / LOG).read_text(encoding="utf-8", errors="replace").strip().splitlines()
    last = said[-1] if said else "it said nothing"
    if status == NO_MESH:
        raise BlowUpError(last)
    how = f"status {status}" if status > 0 else f"signal {-status}"
    raise SolverError(f"the mesh of the outline: {last} ({how}); see {folder / LOG}")


def _limit_processor_time(pid: int, seconds: float) -> None:
    """Have the system end a process after seconds of processor, rounded up, where it can."""
    prlimit = getattr(resource, "prlimit", None)
    if prlimit is None:
        return
    limit = math.ceil(seconds)
    with contextlib.suppress(ProcessLookupError):  # it has ended already
        _, hard = prlimit(pid, resource.RLIMIT_CPU)
        if hard == resource.RLIM_INFINITY or limit < hard:
            prlimit(pid, resource.RLIMIT_CPU, (limit, hard))


def _unended(limit: str, folder: Path) -> SolverError:
    return SolverError(
        f"gmsh did not end the mesh of the outline within {limit} and was ended; "
        f"see {folder / INPUT}"
    )
