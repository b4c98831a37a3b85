"""Judgement of the embedded solver on releases, most of which its lags were not identified from."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import asdict, dataclass, fields

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.identification import LoadMisfit, load_misfit
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.motion.sections import SectionHistories, release_sections
from equisection.verdict.cycles import find_cycles

Floats = NDArray[np.float64]

JUDGED_FROM = 20.0
"""Convective times after the release from which growth, frequency and means are taken."""


@dataclass(frozen=True)
class ReleaseNumbers:
    """Numbers that characterise one release.

    Parameters
    ----------
    growth_rate
        Of the twist amplitude, least squares of its logarithm (per c/V).
    frequency
        omega c/V of the twist.
    mean_twist_deg, mean_deflection_chords
        Means from ``JUDGED_FROM`` on.
    last_amplitude_deg
        Half the peak-to-peak twist of the last whole cycle.
    """

    growth_rate: float
    frequency: float
    mean_twist_deg: float
    mean_deflection_chords: float
    last_amplitude_deg: float


@dataclass(frozen=True)
class ReleaseJudgement:
    """A release as recorded and as modelled, over the same time.

    Parameters
    ----------
    name
        Model and case of the release.
    k_star
        k* of its beam.
    recorded, modelled
        Numbers of the recorded release and of the model's.
    misfit
        Loads of the model under the recorded motion.
    """

    name: str
    k_star: float
    recorded: ReleaseNumbers
    modelled: ReleaseNumbers
    misfit: LoadMisfit

    @property
    def same_side_of_onset(self) -> bool:
        """Tell whether both grow or both decay; False where one has no growth rate."""
        recorded, modelled = self.recorded.growth_rate, self.modelled.growth_rate
        known = math.isfinite(recorded) and math.isfinite(modelled)
        return known and (recorded > 0.0) == (modelled > 0.0)


def release_of(history: ReferenceHistory, loads: UnsteadyLoads) -> SectionHistories:
    """Release the section of a history with the model, for as long as it was recorded."""
    end = float(history.time[-1])
    return release_sections([history.section], loads, history.incidence_rad, end)


def judge_release(history: ReferenceHistory, loads: UnsteadyLoads) -> ReleaseJudgement:
    """Release the section of ``history`` with the model and compare."""
    run = release_of(history, loads)
    valid = slice(0, int(run.samples[0]))
    return ReleaseJudgement(
        history.name,
        history.k_star,
        release_numbers(history.time, history.twist, history.deflection),
        release_numbers(run.time[valid], run.twist[valid, 0], run.deflection[valid, 0]),
        load_misfit(history, loads),
    )


def judgement_table(
    judgements: Sequence[tuple[str, ReleaseJudgement]],
) -> list[dict[str, str | float]]:
    """Return a row for each release: every number as recorded and as modelled, and the misfits.

    Parameters
    ----------
    judgements
        Use of each release, and its judgement.
    """
    return [
        {
            "use": use,
            "release": judgement.name,
            "k_star": judgement.k_star,
            **{
                f"{number.name}{suffix}": getattr(numbers, number.name)
                for number in fields(ReleaseNumbers)
                for suffix, numbers in (
                    ("", judgement.recorded),
                    ("_modelled", judgement.modelled),
                )
            },
            **asdict(judgement.misfit),
        }
        for use, judgement in judgements
    ]


def release_numbers(time: Floats, twist: Floats, deflection: Floats) -> ReleaseNumbers:
    """Characterise a release by its histories of twist (rad) and w/c, each of shape (n,)."""
    late = time > JUDGED_FROM
    cycles = find_cycles(time[late], twist[late])
    if cycles.amplitude.size < 2:
        growth = frequency = last = float("nan")
    else:
        growth = float(np.polyfit(cycles.amplitude_time, np.log(cycles.amplitude), 1)[0])
        frequency = 2.0 * math.pi / cycles.period(cycles.time.size)
        last = math.degrees(float(cycles.amplitude[-1]))
    return ReleaseNumbers(
        growth,
        frequency,
        math.degrees(float(twist[late].mean())),
        float(deflection[late].mean()),
        last,
    )
