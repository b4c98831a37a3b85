"""Growth of the beam over k*: read off the twist's amplitude, and fitted to its first modes.

python -m tests.benchmarks growth-rates
"""

import math
from collections.abc import Iterator, Sequence

import numpy as np

from equisection.aerodynamics.finite_span import FiniteSpan
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.aerodynamics.vortex_rings import SpanGeometry
from equisection.motion.beams import BeamHistories, release_beams
from equisection.results.netcdf import read_dataset
from equisection.solvers.verdicts import (
    BENDING_MODES,
    Judge,
    TipMotion,
    first_modes,
    growths_of_tips,
    monitor_of,
)
from equisection.store.judged_again import tip_motion
from equisection.verdict import Criteria, assess
from equisection.verdict.growth import Growth
from tests.benchmarks.beam_growth import DEFAULT, STRIPS, beams, kept, polar
from tests.benchmarks.early_verdict import case_of
from tests.benchmarks.measure import Row
from tests.workflow.project import ROOT

#: k* of the embedded beam; of the beam by OpenFOAM those of the kept runs.
EMBEDDED = (7.0, 8.0, 9.0, 10.0, 12.0)
KEPT = {5: "", 6.44: "", 8: "", 10: "-long", 12: "-long", 14: "-long"}
#: Longest release (c/V).
DURATION = 400.0


def rows() -> Iterator[Row]:
    """Give both growth rates of the beam, by OpenFOAM and by the embedded solver."""
    known = [
        read_dataset(
            ROOT / f"results/reference/paper-plate-openfoam-3d{run}/unsteady/3d/k{k_star:g}.nc"
        )
        for k_star, run in KEPT.items()
    ]
    judges = [Judge.of(case_of(one)) for one in known]
    yield from _compared("OpenFOAM", list(KEPT), judges, [tip_motion(one) for one in known])
    yield from _compared("embedded", EMBEDDED, *_released())


def _compared(
    solver: str, k_star: Sequence[float], judges: Sequence[Judge], tips: Sequence[TipMotion]
) -> Iterator[Row]:
    amplitude = [_of_amplitude(judge, tip) for judge, tip in zip(judges, tips, strict=True)]
    fitted = [growths_of_tips([judge], [tip])[0] for judge, tip in zip(judges, tips, strict=True)]
    for what, growths, wanted in (
        ("amplitude of the twist", amplitude, ""),
        ("first modes together", fitted, "falls"),
    ):
        words = ", ".join(
            f"{one:g}: {1e3 * growth.rate:.1f} +- {1e3 * growth.standard_error:.1f}"
            for one, growth in zip(k_star, growths, strict=True)
        )
        falls = bool((np.diff([growth.rate for growth in growths]) < 0.0).all())
        yield Row(
            f"beam, {solver}, growth in 0.001 V/c at k*, {what}",
            words,
            wanted,
            falls if wanted else None,
        )


def _of_amplitude(judge: Judge, tip: TipMotion) -> Growth:
    """Return the growth of the twist's amplitude over the window of the verdict."""
    return assess(
        tip.time,
        tip.twist,
        tip.deflection,
        judge.criteria,
        final=True,
        natural_frequency=judge.natural_frequency,
    ).growth


def _released() -> tuple[list[Judge], list[TipMotion]]:
    """Release the beam at each k* until its verdict is in."""
    _, case = kept("8")
    modes = [
        {
            **case["beam"],
            **{
                name: np.array(case["beam"][name]) * math.sqrt(k_star / 8.0)
                for name in ("torsion_frequency", "bending_frequency")
            },
        }
        for k_star in EMBEDDED
    ]
    judges = [
        Judge(
            Criteria(),
            float(one["torsion_frequency"][0]) / math.tau,
            tuple(one["bending_frequency"][:BENDING_MODES] / math.tau),
        )
        for one in modes
    ]
    channel = SpanGeometry.of(STRIPS, 1.0, 3.7, 4.0, 4.0)
    run = release_beams(
        beams([{"beam": one} for one in modes], FiniteSpan.of(channel)),
        UnsteadyLoads.from_polar(polar(DEFAULT)),
        math.radians(2.5),
        DURATION,
        monitor=monitor_of(judges, _tip),
    )
    return judges, [_tip(run, lane, slice(int(end))) for lane, end in enumerate(run.samples)]


def _tip(run: BeamHistories, lane: int, part: slice) -> TipMotion:
    modes = first_modes(run.torsion_amplitudes[part, lane].T, run.bending_amplitudes[part, lane].T)
    return TipMotion(
        run.time[part], run.tip_twist[part, lane], run.tip_deflection[part, lane], modes
    )
