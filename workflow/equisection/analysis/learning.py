"""Learning of an onset from releases of a run: which to run, what to predict, and whether it holds.

The course of a run: the first release; a second one, given or where the model says that the first
was too far from the onset; the runs on both sides of the predicted interval; and, where one of
these contradicts, a model that is learnt from it with runs around its interval. Every step is
decided from results alone, so that it can be repeated from them.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
import pandas as pd
import xarray as xr

from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.reference_history import ReferenceHistory
from equisection.aerodynamics.strip_polars import StripPolars
from equisection.analysis.learnt_course import Course, Learnt
from equisection.analysis.learnt_cycles import LimitCycles, cycles_of, no_cycles
from equisection.analysis.onset import is_unstable
from equisection.analysis.recorded_beam import on_strips, release_of
from equisection.analysis.reduced_beam import ReducedBeam, learnt_beam, predicted_beams
from equisection.analysis.reduced_model import (
    COLUMNS,
    PredictedOnset,
    learnt_model,
    next_release,
    predicted,
    predicted_onset,
)
from equisection.cases import UnsteadyCase
from equisection.config import Config
from equisection.errors import EquisectionError, ResultFileError
from equisection.motion.beam_lesson import BeamRelease
from equisection.results.loads_zigzag import loads_zigzag, warning_of_zigzag
from equisection.results.netcdf import read_attributes, read_dataset
from equisection.results.polar_dataset import polar_at, strip_polars_at
from equisection.results.recorded_history import history_of
from equisection.results.unsteady_result import Regime
from equisection.solvers.protocol import Solver
from equisection.solvers.registry import solver_from_config
from equisection.store.index import read_index, result_file
from equisection.study import plan
from equisection.study.assemble import case_at
from equisection.study.axes import INCIDENCE, K_STAR, Axis, Point, onset_axis, varied

#: Values over the sweep and its reach at which a model predicts, beside those of the sweep, and as
#: many of a beam, whose strips take longer.
PREDICTED, PREDICTED_BEAMS = 41, 21
#: Limit cycles above this amplitude (deg) are unstable, as in a bracket of runs.
THRESHOLD_DEG = 0.5
#: Relative difference in which a run is at an end of an interval: names have four digits.
SAME_END = 1e-3

_LOG = logging.getLogger(__name__)


@dataclass(frozen=True)
class JudgedRun:
    """A run with its verdict."""

    point: Point
    unstable: bool | None
    file: Path
    failed: bool = False
    amplitude_deg: float = math.nan


def runs_of(index: Path) -> list[JudgedRun]:
    """Return the runs that an index of results names."""
    return [
        JudgedRun(
            Point.named(name),
            is_unstable(str(found["regime"]), float(found["twist_amplitude_deg"]), THRESHOLD_DEG),
            result_file(index, name),
            failed=found["regime"] == Regime.FAILED,
            amplitude_deg=float(found["twist_amplitude_deg"]),
        )
        for name, found in read_index(index).items()
    ]


@dataclass(frozen=True)
class Lessons:
    """All that a model of the loads is learnt from.

    Attributes
    ----------
    config
        The configuration.
    name
        The model of the sweep.
    data
        ``equivalent``, with ``correction`` of a corrected model, and ``polar_2d``; of the beam
        ``modes`` and ``polar_3d``.
    releases
        Indices of the releases, in the order of their rounds.
    confirming
        Indices of the runs that confirm the onset, in the order of their rounds.
    incidence_deg
        Rigid incidence (deg) of the model, in a study that varies it; None in another.
    """

    config: Config
    name: str
    data: Mapping[str, xr.Dataset]
    releases: Sequence[Path]
    confirming: Sequence[Path] = ()
    incidence_deg: float | None = None

    @classmethod
    def read(cls, config: Config, name: str, files: Mapping[str, str | Sequence[str]]) -> Lessons:
        """Read the files of a model by name: one of each data set, indices of the two kinds."""
        data = {
            one: read_dataset(Path(str(files[one])))
            for one in ("equivalent", "polar_2d", "correction", "modes", "polar_3d")
            if one in files
        }
        releases, confirming = (
            [Path(path) for path in files.get(kind, ())] for kind in ("releases", "confirming")
        )
        return cls(config, name, data, releases, confirming)

    def at_each_incidence(self) -> list[Lessons]:
        """Return the lessons at each incidence of the study, which are apart."""
        angles = varied(self.config).get(INCIDENCE, (None,))
        return [replace(self, incidence_deg=angle) for angle in angles]

    def point(self, value: float) -> Point:
        """Return the point of the study at a value on the axis of the onset."""
        fixed = {} if self.incidence_deg is None else {INCIDENCE: self.incidence_deg}
        return Point.at({self.axis: value, **fixed})

    def _runs(self, index: Path) -> list[JudgedRun]:
        """Return the runs of an index at the incidence of the model."""
        angle = self.incidence_deg
        found = runs_of(index)
        return [
            run for run in found if angle is None or INCIDENCE.same(run.point[INCIDENCE], angle)
        ]

    @property
    def axis(self) -> Axis:
        """Axis along which the onset is looked for."""
        return onset_axis(varied(self.config))

    @property
    def _model(self) -> plan.Model:
        return plan.model(self.name, self.config.reduction)

    @cached_property
    def _solver(self) -> Solver:
        return solver_from_config(self.config, self.config.run_resolution)

    @property
    def _is_beam(self) -> bool:
        return self._model.dimension == "3d"

    @cached_property
    def polar(self) -> Polar:
        """Steady polar of the section."""
        return polar_at(self.data["polar_2d"], self.config.steady.resolution)

    def cases_at(self, values: Iterable[float]) -> list[UnsteadyCase]:
        """Return the cases of the model at values on the axis, whose sections are predicted."""
        # a history of a model has no interval that could be too long for the stiffest beam
        unsteady = self.config.unsteady.model_copy(update={"output_interval": 1e-3})
        config = self.config.model_copy(update={"unsteady": unsteady})
        model, data, solver = self._model, self.data, self._solver
        return [case_at(config, model, self.point(value), data, solver) for value in values]

    @cached_property
    def strip_polars(self) -> StripPolars:
        """Steady loads of the beam along the span."""
        return strip_polars_at(self.data["polar_3d"], self.config.steady.resolution)

    @cached_property
    def _grid(self) -> tuple[list[float], list[UnsteadyCase]]:
        """Values and cases of the beams that are predicted, by rising k*."""
        given = self.config.sweep.values()
        reach = self.config.sweep.onset_reach
        lowest, highest = min(given) / reach, max(given) * reach
        highest = min(highest, plan.highest_of_sweep(self.config))
        count = PREDICTED_BEAMS if self._is_beam else PREDICTED
        spaced = np.geomspace(lowest, highest, count)
        values = sorted({*given, *(float(f"{value:.4g}") for value in spaced)})
        cases = self.cases_at(values)
        ordered = sorted(zip(values, cases, strict=True), key=lambda pair: pair[1].k_star)
        return [value for value, _ in ordered], [case for _, case in ordered]

    def prediction(self, model: Learnt) -> pd.DataFrame:
        """Return growth and frequency over the sweep and its reach, by rising k*.

        A column has the value on the study's axis, if that is not k*. A section without a static
        equilibrium has an infinite growth rate where it diverges, else an unknown one.
        """
        values, cases = self._grid
        k_star = [case.k_star for case in cases]
        there = [place for place, case in enumerate(cases) if not case.refusal]
        found = self._predicted(model, [cases[place] for place in there])
        table = pd.DataFrame({self.axis.name: values, "k_star": k_star})
        table[list(COLUMNS)] = found.set_index(pd.Index(there))[list(COLUMNS)]
        growth = ["growth_rate", "growth_low", "growth_high"]
        table.loc[np.array([case.diverges for case in cases]), growth] = math.inf
        table["extrapolated"] = [value is True for value in table["extrapolated"]]
        return table

    def limit_cycles(self) -> LimitCycles:
        """Return the limit cycles of the sweep, by the release that grows farthest.

        One that cannot be learnt from, since it left too soon, gives way to the next. Those of a
        beam are not known.
        """
        cases = self._grid[1]
        if self._is_beam:
            return no_cycles(len(cases))
        indices = (*self.releases, *self.confirming)
        runs = [run for index in indices for run in self._runs(index)]
        growing = [run for run in runs if run.unstable]
        for run in sorted(growing, key=lambda each: -np.nan_to_num(each.amplitude_deg)):
            try:
                return cycles_of(cases, self._history(run), self.polar, self._start)
            except EquisectionError as error:
                _LOG.warning("no limit cycle is learnt from %s: %s", run.point.name, error)
        return no_cycles(len(cases))

    @property
    def _start(self) -> tuple[float, float]:
        """Twist (rad) and heave rate (over V) of the tip from which a beam is released."""
        start = self.config.unsteady.start
        return math.radians(start.twist_deg), start.heave_rate

    def _predicted(self, model: Learnt, cases: Sequence[UnsteadyCase]) -> pd.DataFrame:
        """Return growth and frequency of cases with a section or beam to move."""
        k_star = [case.k_star for case in cases]
        if isinstance(model, ReducedBeam):
            beams = on_strips([case.beam for case in cases if case.beam], model.loads.polars.strips)
            return predicted_beams(model, k_star, beams, start=self._start)
        sections = [case.section for case in cases if case.section]
        return predicted(model, k_star, sections, start=self._start)

    def learnt(self, run: JudgedRun) -> Learnt:
        """Return the model that is learnt from a run."""
        found: Learnt
        if self._is_beam:
            found = learnt_beam(self._release(run), self.strip_polars)
        else:
            found = learnt_model(self._history(run), self.polar)
        if found.missing_angles:
            _LOG.warning(
                "the polar at resolution '%s' has no points at %s deg, where the release %s moves, "
                "and the model rests on it: add them to steady.incidence_deg",
                self.config.steady.resolution,
                ", ".join(f"{angle:g}" for angle in found.missing_angles),
                run.point.name,
            )
        return found

    def _history(self, run: JudgedRun) -> ReferenceHistory:
        """Return the history of a run, with the section that moved."""
        case = self._case_of(run)
        assert case.section is not None, "a case of a section"
        return history_of(run.file, read_dataset(run.file), case, case.section)

    def _release(self, run: JudgedRun) -> BeamRelease:
        """Return the release of a run of the beam."""
        case, strips = self._case_of(run), self.strip_polars.strips
        return release_of(run.file, read_dataset(run.file), case, strips)

    def _case_of(self, run: JudgedRun) -> UnsteadyCase:
        """Return the case of a run, with the section or beam that moved."""
        model = plan.model(run.file.parent.name, self.config.reduction)
        case = case_at(self.config, model, run.point, self.data, self._solver)
        if case.refusal:
            raise ResultFileError(f"{run.file}: {case.refusal}; no model can be learnt from it")
        return case

    @cached_property
    def last_release(self) -> JudgedRun:
        """The release that counts.

        Raises
        ------
        ResultFileError
            It failed.
        """
        runs = [run for index in self.releases for run in self._runs(index)]
        if not runs or runs[-1].failed:
            name = runs[-1].point.name if runs else "none"
            raise ResultFileError(
                f"{self.releases[-1]}: the release to learn from failed, or is missing ({name}); "
                "see its log, or give another value in rom.learn_from"
            )
        return runs[-1]

    def second_release(self) -> list[Point]:
        """Return the point of the second release, none if one is enough."""
        if plan.learner(self.config, self.name) != self.name:
            return []
        given = self.config.rom.learn_from
        if given != "auto":
            return [self.point(value) for value in given[1:]]
        model = self.learnt(self.last_release)
        table = self.prediction(model)
        onset = predicted_onset(table)
        if not math.isfinite(onset.k_star):
            return self._towards_onset(table)
        k_star = next_release(model.k_star, onset)
        if k_star is None:
            return []
        nearest = np.interp(k_star, table["k_star"], table[self.axis.name])
        return [self.point(float(f"{nearest:.4g}"))]

    def _towards_onset(self, table: pd.DataFrame) -> list[Point]:
        """Return the end of the sweep where a model without an onset in reach would have it.

        All stable, that is the end of the softest beam; all unstable, of the stiffest. None where
        the model was learnt there.
        """
        rates = table["growth_rate"].to_numpy()
        rates = rates[~np.isnan(rates)]
        if not rates.size or ((rates > 0.0).any() and (rates <= 0.0).any()):
            return []
        pick = min if rates[0] <= 0.0 else max
        end = pick(self.config.sweep.values(), key=self.axis.stability)
        point = self.point(end)
        return [] if point == self.last_release.point else [point]

    def contradiction(self, onset: PredictedOnset, index: Path) -> JudgedRun | None:
        """Return a run on the wrong side of an interval of the onset, that nearest to it.

        An unstable one at or above its upper end in k*, or a stable one at or below its lower end.
        A run inside contradicts nothing, nor does any where an end is not known.
        """
        wrong = []
        for run in self._runs(index):
            k_star = self._k_star_of(run.point)
            if (run.unstable is True and k_star >= onset.high * (1.0 - SAME_END)) or (
                run.unstable is False and k_star <= onset.low * (1.0 + SAME_END)
            ):
                away = abs(math.log(k_star / onset.k_star))
                wrong.append((away, run.point.name, run))
        return min(wrong)[2] if wrong else None

    def _k_star_of(self, point: Point) -> float:
        """Return the k* of the beam at a point."""
        if K_STAR in point.axes:
            return point[K_STAR]
        return case_at(self.config, self._model, point, self.data, self._solver).k_star

    def course(self) -> Course:
        """Return the model after all that has been run, with what it predicts and what it says."""
        model, learnt_from = self.learnt(self.last_release), self.last_release
        table = self.prediction(model)
        onset = predicted_onset(table)
        wrong = [self.contradiction(onset, index) for index in self.confirming[:1]]
        contradicted = wrong[0] if wrong else None
        if contradicted is not None:
            model, learnt_from = self.learnt(contradicted), contradicted
            table = self.prediction(model)
            onset = predicted_onset(table)
        checked = [run for index in self.confirming for run in self._runs(index)]
        at_odds = [self.contradiction(onset, index) for index in self.confirming]
        return Course(
            model,
            table,
            onset,
            checked=sum(run.unstable is not None for run in checked),
            silent=sum(run.unstable is None for run in checked),
            contradicted=contradicted is not None,
            at_odds=next((run.point.name for run in at_odds if run is not None), ""),
            zigzag=_zigzag_of(learnt_from),
        )

    def confirming_points(self, course: Course) -> list[Point]:
        """Return the points at which an onset is to be checked, without those that have been run.

        They are given, or half of them are on either side of the interval: at its ends, and half of
        its width beyond.
        """
        values = self._confirming_values(course)
        points = {self.point(float(f"{value:.4g}")) for value in values}
        done = {run.point for index in self._run_so_far for run in self._runs(index)}
        return sorted(points - done, key=lambda point: point.order)

    def _confirming_values(self, course: Course) -> Sequence[float]:
        """Return values on the axis at which runs check an onset."""
        onset, asked = course.onset, self.config.rom.confirm
        if isinstance(asked, tuple):
            return asked
        if not onset.known:
            return []
        width = onset.high - onset.low
        wanted = [
            end + side * 0.5 * width * step
            for step in range(asked // 2)
            for side, end in ((-1.0, onset.low), (1.0, onset.high))
        ]
        k_star, values = course.table["k_star"], course.table[self.axis.name]
        return [float(np.interp(one, k_star, values)) for one in wanted]

    @property
    def _run_so_far(self) -> list[Path]:
        of_this = plan.learner(self.config, self.name) == self.name
        return [*(self.releases if of_this else ()), *self.confirming]

    def next_points(self, batch: str) -> list[Point]:
        """Return the points that a round of learning runs."""
        if batch == plan.LEARNING_ROUNDS[0]:
            return self.second_release()
        course = self.course()
        if batch == plan.LEARNING_ROUNDS[2] and not course.contradicted:
            return []
        return self.confirming_points(course)


def _zigzag_of(run: JudgedRun) -> str:
    """Return what is wrong with the loads of a run that zigzag from step to step."""
    found = loads_zigzag(run.file, read_attributes(run.file))
    return warning_of_zigzag(found.get("loads_zigzag", math.nan))


def points_of_round(lessons: Lessons, batch: str) -> list[Point]:
    """Return the points that a round of learning runs, at all incidences of the study.

    Where an incidence of several has nothing to learn from, the others go on.
    """
    each = lessons.at_each_incidence()
    found: list[Point] = []
    for one in each:
        try:
            found += one.next_points(batch)
        except EquisectionError as error:
            if len(each) == 1:
                raise
            _LOG.warning("%s at %g deg: %s", one.name, one.incidence_deg, error)
    return found
