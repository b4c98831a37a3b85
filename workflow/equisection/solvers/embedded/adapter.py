"""The embedded solver: steady and unsteady loads from section polars, with nothing but Python.

Section polar, lifting line and lagged separation take the place of CFD. Figures and files name the
solver wherever they show its results.
"""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from equisection.aerodynamics.lifting_line import LiftingLine
from equisection.aerodynamics.polar import Polar
from equisection.aerodynamics.separation import SeparationLags
from equisection.aerodynamics.span_strips import SpanStrips, cosine_strips
from equisection.aerodynamics.vortex_rings import SpanGeometry
from equisection.beam.beam import MID_CHORD
from equisection.cases import BeamModes, ForcedCase, Geometry, SteadyCase, UnsteadyCase
from equisection.config import Config
from equisection.config.groups import FLAT_PLATE, Embedded
from equisection.errors import IncidenceOutOfRangeError, SolverError
from equisection.results.forced_result import ForcedResult
from equisection.results.steady_result import SteadyResult
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers.embedded.known_errors import known_error
from equisection.solvers.embedded.known_spreads import known_spread
from equisection.solvers.known_error import KnownError
from equisection.solvers.known_spread import KnownSpread
from equisection.solvers.protocol import ONE_THREAD, Allocation, Capability, Progress
from equisection.solvers.steady_polar import section_of_polar

if TYPE_CHECKING:
    from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
    from equisection.motion.body_in_flow import BodyInFlow

Floats = NDArray[np.float64]

#: Incidences that the thin analytic plate covers (rad).
FLAT_PLATE_LIMIT = math.radians(30.0)
#: Cases that run together; bounds the memory of their histories.
LANES = 500


class Adapter:
    """The embedded solver on one section polar; fulfils the solver protocol."""

    name = "embedded"
    version = "6"
    provides = frozenset({Capability.BATCH, Capability.STATES})

    def __init__(
        self, polar: Polar, strips: int, lags: SeparationLags, incidence_point: float
    ) -> None:
        self._polar = polar
        self._strips = strips
        self._lags = lags
        self._incidence_point = incidence_point

    @classmethod
    def from_config(cls, config: Config, resolution: str) -> Adapter:
        """Return the solver on the polar of a resolution.

        Raises
        ------
        PolarFileError
            The polar file cannot be used.
        """
        section = config.embedded
        polar = read_section_polar(section, resolution)
        lags = SeparationLags(**section.separation.model_dump(), provenance="configuration")
        return cls(polar, section.strips, lags, section.incidence_point)

    @classmethod
    def from_settings(
        cls, settings: dict[str, Any], allocation: Allocation = ONE_THREAD
    ) -> Adapter:
        """Return the solver of a case, which runs in one thread."""
        del allocation
        polar, lags = Polar.of_settings(settings["polar"]), SeparationLags(**settings["separation"])
        return cls(polar, settings["strips"], lags, settings["incidence_point"])

    def settings(self, dimension: str) -> dict[str, Any]:
        """Return the polar, the strips, the lags of the separation and the incidence point."""
        del dimension
        lags = asdict(self._lags)
        del lags["provenance"]
        return {
            "polar": self._polar.as_settings(),
            "strips": self._strips,
            "separation": lags,
            "incidence_point": self._incidence_point,
        }

    def describe(self, dimension: str) -> str:
        """Return solver and resolution in words; the beam's strips carry the section's polar."""
        del dimension
        return f"embedded solver, polar {self._polar.label}"

    @property
    def section_loads(self) -> tuple[Polar, SeparationLags]:
        """Polar of the section, and lags of its separation."""
        return self._polar, self._lags

    def known_error(self, dimension: str, basis: str) -> KnownError | None:
        """Return the error of the growth that is known with this polar and these lags."""
        return known_error(dimension, basis, self._polar.label, self._lags)

    def known_spread(self, parameter: str, incidence_deg: float) -> KnownSpread | None:
        """Return the half-range of a lag or of a coefficient that is known with this polar."""
        return known_spread(parameter, incidence_deg, self._polar.label, self._lags)

    def run_steady(
        self, cases: Sequence[SteadyCase], work: Path, progress: Progress
    ) -> list[SteadyResult]:
        """Read the polar (2D) or solve the lifting line on it (3D) at each incidence."""
        del work
        results = []
        for number, case in enumerate(cases, start=1):
            try:
                run = self._section if case.dimension == "2d" else self._beam
                results.append(run(case))
            except (IncidenceOutOfRangeError, SolverError) as error:
                results.append(SteadyResult.without_value(str(error)))
            progress(number, len(cases))
        return results

    def run_unsteady(
        self, cases: Sequence[UnsteadyCase], work: Path, progress: Progress
    ) -> list[UnsteadyResult]:
        """Release sections or beams together, each until its verdict is in."""
        del work
        total = sum(case.duration for case in cases)
        results: dict[int, UnsteadyResult] = {}
        done = 0.0
        for group in _groups(cases):
            members = [cases[index] for index in group]
            share = sum(case.duration for case in members)

            def tell(now: float, end: float, share: float = share, before: float = done) -> None:
                progress(before + share * now / end, total)

            results.update(zip(group, self._release(members, tell), strict=True))
            done += share
        return [results[index] for index in range(len(cases))]

    def run_forced(
        self, cases: Sequence[ForcedCase], work: Path, progress: Progress
    ) -> list[ForcedResult]:
        """Follow the loads of each section or beam in its prescribed motion."""
        from equisection.aerodynamics.finite_span import FiniteSpan  # noqa: PLC0415
        from equisection.solvers.embedded.forced_beams import forced_beam  # noqa: PLC0415
        from equisection.solvers.embedded.forced_sections import forced_section  # noqa: PLC0415

        del work
        loads = self._loads()
        total, done, results = sum(case.duration for case in cases), 0.0, []
        for case in cases:
            if case.dimension == "2d":
                results.append(forced_section(case, loads))
            else:
                strips, span = self._span(case.geometry)
                results.append(forced_beam(case, loads, strips, FiniteSpan.of(span)))
            done += case.duration
            progress(done, total)
        return results

    def _release(self, cases: list[UnsteadyCase], progress: Progress) -> list[UnsteadyResult]:
        # Imported here: writing a case file takes this module too, and none of what follows.
        from equisection.aerodynamics.finite_span import FiniteSpan  # noqa: PLC0415
        from equisection.solvers.embedded.releases import (  # noqa: PLC0415
            release_all_beams,
            release_all_sections,
        )

        loads = self._loads()
        if cases[0].dimension == "2d":
            return release_all_sections(cases, loads, progress)
        strips, span = self._span(cases[0].geometry)
        return release_all_beams(cases, loads, strips, FiniteSpan.of(span), progress)

    def body(self, case: UnsteadyCase) -> BodyInFlow:
        """Return section or beam of a case in a flow of any speed, without its correction."""
        from equisection.motion.body_in_flow import BodyInFlow  # noqa: PLC0415

        speed = case.medium.speed
        if case.beam is not None:
            return self.beam_body(case.beam, case.geometry, speed=speed, k_star=case.k_star)
        assert case.section is not None, "a case that is not run has no body"
        chord = case.geometry.chord
        return BodyInFlow.of_section_in_flow(
            case.section, self._loads(), speed=speed, chord=chord, k_star=case.k_star
        )

    def beam_body(
        self, modes: BeamModes, geometry: Geometry, *, speed: float, k_star: float
    ) -> BodyInFlow:
        """Return a beam whose modes are those at a speed (m/s), where it has a k* (-)."""
        from equisection.aerodynamics.finite_span import FiniteSpan  # noqa: PLC0415
        from equisection.motion.body_in_flow import BodyInFlow  # noqa: PLC0415
        from equisection.solvers.embedded.releases import beam_parameters  # noqa: PLC0415

        strips, span = self._span(geometry)
        return BodyInFlow.of_beam(
            beam_parameters([modes], strips, FiniteSpan.of(span)),
            self._loads(),
            speed=speed,
            chord=geometry.chord,
            k_star=k_star,
        )

    def _loads(self) -> UnsteadyLoads:
        from equisection.aerodynamics.unsteady_loads import UnsteadyLoads  # noqa: PLC0415

        rear_point = self._incidence_point - MID_CHORD
        return UnsteadyLoads.from_polar(self._polar, self._lags, rear_point)

    def _section(self, case: SteadyCase) -> SteadyResult:
        return section_of_polar(self._polar, math.radians(case.incidence_deg), "section polar")

    def _beam(self, case: SteadyCase) -> SteadyResult:
        strips, span = self._span(case.geometry)
        line = LiftingLine.of(self._polar, strips, span)
        loads = line.solve(math.radians(case.incidence_deg))
        return SteadyResult(
            drag=loads.drag,
            lift=loads.lift,
            moment=loads.moment,
            span=strips.stations,
            section_lift=loads.cl_section,
            section_moment=loads.cm_section,
            method="lifting line on the section polar",
        )

    def _span(self, geometry: Geometry) -> tuple[SpanStrips, SpanGeometry]:
        strips = cosine_strips(self._strips, geometry.root_on_wall)
        width = None if geometry.tip_gap is None else geometry.span + geometry.tip_gap
        return strips, SpanGeometry.of(
            strips,
            1.0,
            geometry.span,
            width,
            geometry.channel_height,
            root_on_wall=geometry.root_on_wall,
        )


def read_section_polar(section: Embedded, resolution: str) -> Polar:
    """Return the section polar that a configuration names for a resolution.

    Raises
    ------
    PolarFileError
        The file cannot be used.
    """
    source = section.polars[resolution]
    if source == FLAT_PLATE:
        return Polar.flat_plate(FLAT_PLATE_LIMIT)
    return Polar.read(
        source,
        symmetric=section.symmetric,
        moment_axis=section.moment_axis,
        columns=section.columns.given,
    )


def _groups(cases: Sequence[UnsteadyCase]) -> list[list[int]]:
    """Group cases that differ in their structure's numbers alone, a bounded number at a time."""

    def what_they_share(case: UnsteadyCase) -> str:
        shared = case.model_dump(exclude={"k_star", "section", "lift_factor", "moment_factor"})
        beam = shared["beam"] or {}
        for lane in ("torsion_frequency", "bending_frequency"):
            beam.pop(lane, None)
        if beam.get("fittings"):
            beam["fittings"] = "some"  # dashpots go with the stiffness
        return json.dumps(shared, sort_keys=True)

    groups: dict[str, list[int]] = {}
    for index, case in enumerate(cases):
        groups.setdefault(what_they_share(case), []).append(index)
    return [
        members[at : at + LANES]
        for members in groups.values()
        for at in range(0, len(members), LANES)
    ]
