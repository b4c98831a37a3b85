"""The coupled plate at the coarse preset: a time step on one and on two ranks, and the exchange."""

import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from equisection.solvers.openfoam.beam import coupled_run
from equisection.solvers.openfoam.beam.free_beam import PlateRun
from equisection.solvers.openfoam.beam.pipes import FOLDER, LOADS, PLACES, Alive, Pipes
from equisection.solvers.openfoam.beam.rigid_beam import plate_mesh_of
from equisection.solvers.openfoam.flow_setup import Coupling
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.mesh.presets import PRESETS
from tests.benchmarks.measure import Row, limit
from tests.sample_cases import UNSTEADY_PLATE, beam_modes

#: As `config/openfoam3d.yaml` has it; fewer steps where each exchange waits for a second.
STEPS, STOCK_STEPS, STEP, COUPLING = 50, 10, 0.04, Coupling(2, 0.98)


class TimedPipes(Pipes):
    """Pipes that know how long the solver has waited for the structure (s)."""

    waited = 0.0
    _received = 0.0

    def receive(self, alive: Alive) -> str | None:
        message = super().receive(alive)
        self._received = time.perf_counter()
        return message

    def send(self, message: str, alive: Alive) -> bool:
        sent = super().send(message, alive)
        type(self).waited += time.perf_counter() - self._received
        return sent


class StockFiles:
    """The exchange as `lumpedPointMovement` has it by itself: files, and a lock looked for.

    OpenFOAM removes the lock when it has written the loads, and looks for it once a second until
    it is there again. This side looks every millisecond.
    """

    def __init__(self, case: Path, silence: float) -> None:
        del silence
        self._folder = case / FOLDER
        self._lock = self._folder / "OpenFOAM.lock"
        self._folder.mkdir(parents=True)
        self._lock.touch()

    def close(self) -> None:
        """There is nothing to close."""

    def receive(self, alive: Alive) -> str | None:
        """Return what OpenFOAM hands over next; None if it ended instead."""
        while self._lock.exists():
            if not alive():
                return None
            time.sleep(1e-3)
        return (self._folder / LOADS).read_text()

    def send(self, message: str, alive: Alive) -> bool:
        """Hand over the places of the points."""
        (self._folder / PLACES).write_text(message)
        self._lock.touch()
        return alive()


def seconds_a_step(exchange: type, ranks: int, steps: int) -> float:
    """Release the plate with four modes of each kind, and follow it for some steps."""
    case = UNSTEADY_PLATE.model_copy(
        update={
            "beam": beam_modes(6.44 / 19.91, modes=4),
            "duration": steps * STEP,
            "time_step": STEP,
            "output_interval": STEP,
        }
    )
    coupled_run.Pipes = exchange  # type: ignore[misc, assignment]
    started: list[float] = []

    def tell(now: float, end: float) -> None:
        del end
        if now > 0:
            started.append(time.perf_counter())

    with tempfile.TemporaryDirectory() as folder:
        mesh = plate_mesh_of(case, PRESETS["coarse"].plate)
        PlateRun(find(), case, mesh, COUPLING, Path(folder), ranks).run(tell)
    return (started[-1] - started[0]) / (len(started) - 1)


def rows() -> Iterator[Row]:
    """A step on one and on two ranks with its exchange, and the same with the stock exchange."""
    cells = PRESETS["coarse"].plate_cells
    seconds, waited = {}, {}
    for ranks in (1, 2):
        TimedPipes.waited = 0.0
        seconds[ranks] = seconds_a_step(TimedPipes, ranks, STEPS)
        waited[ranks] = TimedPipes.waited / STEPS
        yield Row(f"seconds a step on {ranks} ranks, {cells} cells", f"{seconds[ranks]:.3g}")
        share = 100 * waited[ranks] / seconds[ranks]
        yield limit(f"part of it that the solver waits, {ranks} ranks", share, 3.0, "%")
    speed_up = seconds[1] / seconds[2]
    yield Row("two ranks against one", f"{speed_up:.2f}", ">= 1.6", speed_up >= 1.6)
    minutes = 60 / STEP * seconds[2] / 60
    yield limit("60 c/V on two ranks", minutes, 20.0, "min")
    stock = seconds_a_step(StockFiles, 1, STOCK_STEPS) - seconds[1] + waited[1]
    yield Row("stock exchange, seconds a step", f"{stock:.3g}")
    yield Row(
        "stock exchange against pipes", f"{stock / waited[1]:.0f}", ">= 4", stock / waited[1] >= 4
    )
