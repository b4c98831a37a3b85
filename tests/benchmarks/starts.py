"""Releases of the embedded solver from rest and from equilibrium, and their eigenvalues.

    python -m tests.benchmarks.starts

prints verdict, growth and time to the verdict of both starts, for the sections and the beams of the
kept releases; and verdict and growth of the kept releases by OpenFOAM from both, as if they ended
at some times; and static equilibria of the beam beside the means of its kept releases by OpenFOAM.
"""

import json
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from equisection.cases import EndCriteria, Start, UnsteadyCase
from equisection.config import load_config
from equisection.motion.beam_equilibrium import beam_in_equilibrium
from equisection.motion.equilibrium_path import path_from_rest
from equisection.motion.steady_states import least_stable
from equisection.results.netcdf import read_dataset
from equisection.results.polar_dataset import gather_polar, strip_polars_at
from equisection.results.unsteady_result import STABLE, Regime, UnsteadyResult
from equisection.solvers.embedded.adapter import Adapter
from equisection.solvers.embedded.releases import beam_parameters
from equisection.solvers.registry import solver_from_config
from equisection.solvers.verdicts import judge
from equisection.store.judged_again import tip_motion
from tests.benchmarks.measure import Row
from tests.workflow.project import ROOT

KEPT = ROOT / "results/reference"
SOURCES = {
    "2d": KEPT / "paper-plate-openfoam/unsteady/2d",
    "3d": KEPT / "paper-plate-openfoam-3d/unsteady/3d",
}
#: Kept releases of a section by OpenFOAM (3,132 cells) from both starts, and the times (c/V) at
#: which they are judged.
BY_OPENFOAM = {
    "rigid": KEPT / "paper-reductions/unsteady/2d-consistent",
    "equilibrium": KEPT / "openfoam-equilibrium/unsteady/2d",
}
#: Kept releases of the beam by OpenFOAM from rest, those of 100 c/V and others.
BEAMS_BY_OPENFOAM = (
    KEPT / "paper-plate-openfoam-3d/unsteady/3d",
    KEPT / "paper-plate-openfoam-3d-long/unsteady/3d",
)
JUDGED_AT = (40.0, 50.0, 60.0)
#: Twist (deg) of the tip by which the equilibrium is disturbed.
PUSH = 0.3
STARTS = {"rigid": Start(), "equilibrium": Start(state="equilibrium", twist_deg=PUSH)}


@dataclass(frozen=True)
class Compared:
    """Results of one case from both starts, and the growth (V/c) of its eigenvalue."""

    model: str
    k_star: float
    eigenvalue: float
    results: dict[str, UnsteadyResult]

    def error(self, start: str) -> float:
        """Return how far the growth of a result is from the eigenvalue (V/c)."""
        return abs(self.results[start].verdict["growth_rate"] - self.eigenvalue)


def cases(model: str) -> list[UnsteadyCase]:
    """Return the kept cases of a model with the times and criteria of the default configuration."""
    unsteady = load_config({}).unsteady
    found = []
    for path in SOURCES[model].glob("k*.nc"):
        case = UnsteadyCase.model_validate(json.loads(read_dataset(path).attrs["case"]))
        update = {
            "duration": unsteady.duration,
            "time_step": unsteady.time_step,
            "output_interval": unsteady.output_interval,
            "criteria": EndCriteria(**unsteady.verdict.model_dump()),
        }
        found.append(case.model_copy(update=update))
    return sorted(found, key=lambda case: case.k_star)


@cache
def compared(model: str) -> tuple[Compared, ...]:
    """Return the results of a model."""
    solver = solver_from_config(load_config({}), "coarse")
    assert isinstance(solver, Adapter)
    own = cases(model)
    results = {}
    for name, start in STARTS.items():
        started = [case.model_copy(update={"start": start}) for case in own]
        results[name] = solver.run_unsteady(started, Path(), lambda now, end: None)
    return tuple(
        Compared(
            model,
            case.k_star,
            _growth(solver, case),
            {name: results[name][place] for name in STARTS},
        )
        for place, case in enumerate(own)
    )


def _growth(solver: Adapter, case: UnsteadyCase) -> float:
    """Return the growth (V/c) of a small motion about static equilibrium."""
    body, speed = solver.body(case), case.medium.speed
    path = path_from_rest(body, np.radians(case.incidence_deg), 1.01 * speed)
    return float(least_stable(*path.system(np.array([speed])))[0].real)


def agrees(one: Compared, start: str) -> bool:
    """Tell whether a verdict is that of the eigenvalue: growing or stable."""
    wanted = {Regime.GROWING} if one.eigenvalue > 0.0 else STABLE
    return one.results[start].verdict["regime"] in wanted


def rows() -> Iterator[Row]:
    """Yield how many verdicts of either start are those of the eigenvalues."""
    for model in SOURCES:
        own = compared(model)
        for start in STARTS:
            right = sum(agrees(one, start) for one in own)
            all_are_wanted = start == "equilibrium"
            yield Row(
                f"verdicts of {model} as the eigenvalue, from {start}",
                f"{right} of {len(own)}",
                f"{len(own)}" if all_are_wanted else "",
                right == len(own) if all_are_wanted else None,
            )


def of_openfoam() -> Iterator[tuple[float, str, float, dict[str, Any]]]:
    """Yield k*, start, time and verdict of the kept releases of a section from both starts."""
    for path in sorted(
        BY_OPENFOAM["equilibrium"].glob("k*.nc"), key=lambda one: float(one.stem[1:])
    ):
        for start, folder in BY_OPENFOAM.items():
            kept = read_dataset(folder / path.name)
            raw = json.loads(kept.attrs["case"])
            del raw["criteria"]["rules"]
            case = UnsteadyCase.model_validate(raw)
            for end in JUDGED_AT:
                yield case.k_star, start, end, judge(case, tip_motion(kept, end))


def equilibria() -> Iterator[tuple[float, tuple[float, float], tuple[float, float]]]:
    """Yield k* of the kept beams by OpenFOAM, their equilibrium, and the mean of their releases.

    Each has twist (deg) and deflection (chords) of the tip.
    """
    paths = (KEPT / "paper-plate-openfoam-3d/steady/3d").glob("coarse_a*.nc")
    steady = map(read_dataset, paths)
    rigid = {("coarse", float(one.attrs["incidence_deg"])): one for one in steady}
    polars = strip_polars_at(gather_polar(rigid), "coarse")
    released = [path for folder in BEAMS_BY_OPENFOAM for path in folder.glob("k*.nc")]
    for path in sorted(released, key=lambda one: float(one.stem[1:])):
        kept = read_dataset(path)
        case = UnsteadyCase.model_validate(json.loads(kept.attrs["case"]))
        assert case.beam is not None, "the plate"
        beam = beam_parameters([case.beam], polars.strips, None)
        position = beam_in_equilibrium(beam, polars, np.radians(case.incidence_deg))
        assert position is not None, "far from the fold"
        modes = beam.torsion_at_tip.size
        twist = float(np.degrees(position[:modes] @ beam.torsion_at_tip))
        rest = twist, float(position[modes:] @ beam.bending_at_tip)
        names = ("mean_twist_deg", "mean_deflection_chords")
        yield case.k_star, rest, (kept.attrs[names[0]], kept.attrs[names[1]])


def main() -> None:
    """Print the table."""
    print("model k*    eigenvalue  start        regime       growth    c/V")
    for model in SOURCES:
        for one in compared(model):
            for name, result in one.results.items():
                verdict = result.verdict
                print(
                    f"{model:5} {one.k_star:<5g} {one.eigenvalue:+10.4f}  {name:12} "
                    f"{verdict['regime']:12} {verdict['growth_rate']:+.4f} {result.time[-1]:6.0f}"
                )
    print(
        "section by OpenFOAM: k*, start, c/V, regime, growth with the interval of 95 %, amplitude"
    )
    for k_star, start, end, verdict in of_openfoam():
        half = 0.5 * (verdict["growth_high"] - verdict["growth_low"])
        print(
            f"{k_star:<5g} {start:12} {end:3.0f} {verdict['regime']:12} "
            f"{verdict['growth_rate']:+.4f} +- {half:.4f} {verdict['twist_amplitude_deg']:.2f} deg"
        )
    print("beam by OpenFOAM: k*, twist (deg) and deflection (c) of equilibrium, and of releases")
    for k_star, rest, mean in equilibria():
        print(f"{k_star:<5g} {rest[0]:.3f} {rest[1]:.3f}, {mean[0]:.3f} {mean[1]:.3f}")


if __name__ == "__main__":
    main()
