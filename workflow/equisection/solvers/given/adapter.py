"""Polars and histories from files in the place of runs; fulfils the solver protocol.

A case holds what its file means and the digest of its content, so that an edited file is judged
again. Its motion is weighed against its loads before anything is judged
(:mod:`equisection.aerodynamics.load_balance`).
"""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from equisection.aerodynamics.polar import Polar
from equisection.cases import Case, ForcedCase, SteadyCase, UnsteadyCase
from equisection.config import Config
from equisection.config.groups.given_keys import PLACEHOLDER
from equisection.errors import HistoryFileError, IncidenceOutOfRangeError, SolverError
from equisection.provenance import file_hash
from equisection.results.forced_result import ForcedResult
from equisection.results.steady_result import SteadyResult
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers.protocol import (
    HAS_VORTICES,
    ONE_THREAD,
    Allocation,
    Capability,
    Progress,
)
from equisection.solvers.steady_polar import section_of_polar

if TYPE_CHECKING:
    from equisection.io.history_file import HistoryColumns, HistoryScales
    from equisection.solvers.given.recorded_release import RecordAxes, RecordedRelease

logger = logging.getLogger(__name__)

_NOTHING = np.empty(0)
#: Settings of a release: what its file means.
_MEANING = (
    "columns",
    "units",
    "signs",
    "span",
    "moment_axis",
    "deflection_axis",
    "release",
)


class Adapter:
    """Files of another program or a wind tunnel."""

    name = "given"
    version = "1"
    provides = frozenset({Capability.BATCH, Capability.RECORDS})

    def __init__(self, settings: dict[str, Any]) -> None:
        self._settings = settings

    @classmethod
    def from_config(cls, config: Config, resolution: str) -> Adapter:
        """Return the files of a configuration, with the polar of a resolution.

        Raises
        ------
        PolarFileError
            The polar file cannot be used.
        """
        keys = config.given
        polar = Polar.read(
            keys.polars[resolution], symmetric=keys.symmetric, moment_axis=keys.polar_moment_axis
        )
        return cls(
            {
                "source": keys.source or keys.basis,
                "polar": polar.as_settings(),
                "histories": keys.histories,
                "forced": keys.forced,
                "elastic_axis": config.beam.elastic_axis,
                HAS_VORTICES: keys.basis != "time",
                **{name: keys.model_dump()[name] for name in _MEANING},
            }
        )

    @classmethod
    def from_settings(
        cls, settings: dict[str, Any], allocation: Allocation = ONE_THREAD
    ) -> Adapter:
        """Return the files of a case, which are read in one thread."""
        del allocation
        return cls(settings)

    def settings(self, dimension: str) -> dict[str, Any]:
        """Return the polar; that of a release comes from :meth:`record_of`."""
        del dimension
        return {name: self._settings[name] for name in ("source", "polar")}

    def record_of(self, model: str, case: str, point: Mapping[str, float]) -> dict[str, Any]:
        """Return the settings of a release: the file, its digest, and what it means.

        Parameters
        ----------
        model, case
            Names of the model and of the case.
        point
            Values of the case on the axes of the study by their names.
        """
        known = {name: f"{value:g}" for name, value in point.items()}
        record = self._record("histories", {"model": model, "case": case} | known)
        return record if self._settings[HAS_VORTICES] else {**record, HAS_VORTICES: False}

    def motion_record_of(self, case: str, known: Mapping[str, str]) -> dict[str, Any]:
        """Return the settings of a forced motion: those of a release, and the polar.

        Parameters
        ----------
        case
            Name of the case.
        known
            What the path of its file may name, beside the case.
        """
        record = self._record("forced", {"case": case, **known})
        for axis in ("moment_axis", "deflection_axis"):  # a moved section has no other axis
            if record[axis] is None:
                record[axis] = self._settings["elastic_axis"]
        return {**record, "polar": self._settings["polar"]}

    def _record(self, key: str, known: Mapping[str, str]) -> dict[str, Any]:
        """Return the file that a key names, its digest, and what it means."""
        path = PLACEHOLDER.sub(lambda found: known.get(found[1], found[0]), self._settings[key])
        meaning = {name: self._settings[name] for name in _MEANING}
        return {
            "source": self._settings["source"],
            "file": path,
            "digest": file_hash(Path(path)) if path else "",
            **meaning,
        }

    def describe(self, dimension: str) -> str:
        """Return the source in words."""
        del dimension
        return f"given files ({self._settings['source']})"

    def missing(self, case: Case) -> str:
        """Return why a case has no result; empty if there was a file of it that can be read."""
        is_recorded = isinstance(case, UnsteadyCase | ForcedCase)
        if not is_recorded or case.not_run or self._settings["digest"]:
            return ""
        key = "given.forced" if isinstance(case, ForcedCase) else "given.histories"
        if not self._settings["file"]:
            return f"{key} names no file"
        path = Path(self._settings["file"])
        what = "a file that cannot be read is" if path.exists() else "no file"
        return f"{what} {path}, which {key} names for it"

    def run_steady(
        self, cases: Sequence[SteadyCase], work: Path, progress: Progress
    ) -> list[SteadyResult]:
        """Read the polar at each incidence."""
        del work
        polar = Polar.of_settings(self._settings["polar"])
        results = []
        for number, case in enumerate(cases, start=1):
            try:
                results.append(
                    section_of_polar(polar, math.radians(case.incidence_deg), "given polar")
                )
            except IncidenceOutOfRangeError as error:
                results.append(SteadyResult.without_value(str(error)))
            progress(number, len(cases))
        return results

    def run_unsteady(
        self, cases: Sequence[UnsteadyCase], work: Path, progress: Progress
    ) -> list[UnsteadyResult]:
        """Read each release, weigh it, and judge it."""
        del work
        total, done, results = sum(case.duration for case in cases), 0.0, []
        for case in cases:
            results.append(self._release(case))
            done += case.duration
            progress(done, total)
        return results

    def run_forced(
        self, cases: Sequence[ForcedCase], work: Path, progress: Progress
    ) -> list[ForcedResult]:
        """Read each forced motion, and compare it with its case and with the polar."""
        del work
        total, done, results = sum(case.duration for case in cases), 0.0, []
        for case in cases:
            results.append(self._forced(case))
            done += case.duration
            progress(done, total)
        return results

    def _forced(self, case: ForcedCase) -> ForcedResult:
        from equisection.solvers.given.recorded_motion import recorded_motion  # noqa: PLC0415

        path = self._unchanged()
        try:
            return recorded_motion(
                path,
                *self._meaning(case),
                case=case,
                polar=Polar.of_settings(self._settings["polar"]),
            )
        except HistoryFileError as error:
            return ForcedResult.without_history(str(error))

    def _unchanged(self) -> Path:
        """Return the file of a case.

        Raises
        ------
        SolverError
            It is another since the case was written.
        """
        path = Path(self._settings["file"])
        if file_hash(path) != self._settings["digest"]:
            raise SolverError(f"{path} was changed or removed while its case waited; run again")
        return path

    def _meaning(
        self, case: UnsteadyCase | ForcedCase
    ) -> tuple[HistoryColumns, HistoryScales, RecordAxes]:
        """Return what the columns of the file mean."""
        # Imported here: writing a case file takes this module too, and none of what follows.
        from equisection.io.history_file import HistoryColumns, HistoryScales  # noqa: PLC0415
        from equisection.solvers.given.recorded_release import RecordAxes  # noqa: PLC0415

        of, medium = self._settings, case.medium
        return (
            HistoryColumns(of["columns"], of["units"], of["signs"], of["release"]),
            HistoryScales(case.geometry.chord, medium.density, medium.speed, of["span"]),
            RecordAxes(of["moment_axis"], of["deflection_axis"]),
        )

    def _release(self, case: UnsteadyCase) -> UnsteadyResult:
        from equisection.solvers.verdicts import refused  # noqa: PLC0415

        path = self._unchanged()
        try:
            record = self._read(path, case)
            if not record.balance.is_explained:
                raise HistoryFileError(f"{path}: {record.balance.text}")
            return _judged(path, case, record)
        except HistoryFileError as error:
            return refused(case.model_copy(update={"refusal": str(error), "diverges": False}))

    def _read(self, path: Path, case: UnsteadyCase) -> RecordedRelease:
        from equisection.solvers.given.recorded_release import recorded_release  # noqa: PLC0415

        assert case.section is not None, "the registry lets no 3D case through"
        return recorded_release(
            path,
            *self._meaning(case),
            section=case.section,
            incidence_rad=math.radians(case.incidence_deg),
            interval=case.output_interval,
            load_factors=(case.lift_factor, case.moment_factor),
            k_star=case.k_star,
        )


def _judged(path: Path, case: UnsteadyCase, record: RecordedRelease) -> UnsteadyResult:
    """Return the result of a release that its loads explain, up to its verdict.

    Raises
    ------
    HistoryFileError
        The record is too short for a verdict.
    """
    from equisection.solvers.verdicts import TipMotion, decided_at, judge, pitch_frequency  # noqa: PLC0415

    section, history = case.section, record.history
    assert section is not None
    tip = TipMotion(
        history.time,
        history.twist / section.twist_recovery,
        history.deflection / section.deflection_recovery,
    )
    end, last, remark = decided_at(case, tip), float(history.time[-1]), ""
    if math.isinf(end) and last < case.duration - 1.5 * case.output_interval:
        least = case.criteria.periods / pitch_frequency(case)
        if last < least:
            raise HistoryFileError(
                f"{path}: the record ends at {last:.4g} c/V without a verdict; allowed is "
                f"{least:.4g} c/V or more, {case.criteria.periods} natural periods: go on with the "
                "run"
            )
        remark = (
            f"; the record ends at {last:.4g} of {case.duration:g} c/V and is judged as far as it "
            "goes"
        )
        logger.warning("%s%s", path, remark)
    kept = history.time <= min(end, case.duration) * (1 + 1e-9)
    tip = tip.until(min(end, case.duration))
    verdict = judge(case, tip)
    verdict["reason"] = f"{verdict['reason']}; {record.balance.text}{remark}"
    return UnsteadyResult(
        time=tip.time,
        twist=history.twist[kept],
        deflection=history.deflection[kept],
        tip_twist=tip.twist,
        tip_deflection=tip.deflection,
        lift=history.lift_coefficient[kept],
        moment=history.moment_coefficient[kept],
        axis_moment=record.axis_moment[kept] if section.axis_behind_mid_chord else _NOTHING,
        incidence=history.incidence_rad + history.twist[kept],
        verdict=verdict,
    )
