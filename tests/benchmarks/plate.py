"""The coupled plate at the coarse preset: a time step on one and on two ranks, and the exchange."""

import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

from equisection.solvers.openfoam import plate_free
from equisection.solvers.openfoam.flow import Coupling
from equisection.solvers.openfoam.installation import find
from equisection.solvers.openfoam.pipes import Alive, Pipes
from equisection.solvers.openfoam.plate_free import PlateRun
from equisection.solvers.openfoam.plate_rigid import plate_mesh_of
from equisection.solvers.openfoam.presets import PRESETS
from tests.benchmarks.measure import Row, limit
from tests.sample_cases import UNSTEADY_PLATE, beam_modes

STEPS, STEP, COUPLING = 50, 0.04, Coupling(2, 0.98)


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


def rows() -> Iterator[Row]:
    """Release the plate with four modes of each kind, and follow it for some steps."""
    case = UNSTEADY_PLATE.model_copy(
        update={
            "beam": beam_modes(6.44 / 19.91, modes=4),
            "duration": STEPS * STEP,
            "time_step": STEP,
            "output_interval": STEP,
        }
    )
    plate_free.Pipes = TimedPipes  # type: ignore[misc]
    seconds: dict[int, float] = {}
    for ranks in (1, 2):
        with tempfile.TemporaryDirectory() as folder:
            mesh = plate_mesh_of(case, PRESETS["coarse"].plate)
            run = PlateRun(find(), case, mesh, COUPLING, ranks, Path(folder))
            started: list[float] = []

            def tell(now: float, end: float, seen: list[float] = started) -> None:
                del end
                if now > 0:
                    seen.append(time.perf_counter())

            TimedPipes.waited = 0.0
            run.run(tell)
            seconds[ranks] = (started[-1] - started[0]) / (len(started) - 1)
            yield Row(
                f"seconds a step on {ranks} ranks, {mesh.cells} cells", f"{seconds[ranks]:.3g}"
            )
            share = 100 * TimedPipes.waited / STEPS / seconds[ranks]
            yield limit(f"part of it that the solver waits, {ranks} ranks", share, 3.0, "%")
    speed_up = seconds[1] / seconds[2]
    yield Row("two ranks against one", f"{speed_up:.2f}", ">= 1.6", speed_up >= 1.6)
