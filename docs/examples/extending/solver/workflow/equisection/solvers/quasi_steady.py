"""Quasi-steady sections: thin-airfoil loads of the incidence at three quarters of the chord.

    c_l = a (theta_0 + theta - w' + theta'/4),    c_m = c_l/4 - (pi/8) theta',    ' = d/ds,

about mid-chord, with w in chords (Fung, *An Introduction to the Theory of Aeroelasticity*, section
6.8, without apparent mass). The section is linear with them, and its motion an exponential.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from equisection.beam.section import Section
from equisection.cases import SteadyCase, UnsteadyCase
from equisection.results.steady_result import SteadyResult
from equisection.results.unsteady_result import UnsteadyResult
from equisection.solvers.protocol import ONE_THREAD, Allocation, Capability, Progress

if TYPE_CHECKING:  # jobs need not build the models of the configuration
    from numpy.typing import NDArray

    from equisection.config import Config

_NOTHING = np.empty(0)
#: Twist (rad) at which a run ends, far beyond what is linear.
_LARGEST_TWIST = 1.0


class Adapter:
    """The quasi-steady solver; fulfils the solver protocol."""

    name = "quasi_steady"
    version = "1"
    provides = frozenset({Capability.BATCH})

    def __init__(self, lift_slope: float) -> None:
        self._slope = lift_slope

    @classmethod
    def from_config(cls, config: Config, resolution: str) -> Adapter:
        """Return the solver, which is the same at every resolution."""
        del resolution
        return cls(config.quasi_steady.lift_slope)

    @classmethod
    def from_settings(
        cls, settings: dict[str, Any], allocation: Allocation = ONE_THREAD
    ) -> Adapter:
        """Return the solver of a case, which runs in one thread."""
        del allocation
        return cls(**settings)

    def settings(self, dimension: str) -> dict[str, Any]:
        """Return the slope of the lift."""
        del dimension
        return {"lift_slope": self._slope}

    def describe(self, dimension: str) -> str:
        """Return the solver in words."""
        del dimension
        return f"quasi-steady section, lift slope {self._slope:.4g}"

    def run_steady(
        self, cases: Sequence[SteadyCase], work: Path, progress: Progress
    ) -> list[SteadyResult]:
        """Return lift and moment of each incidence."""
        del work
        progress(len(cases), len(cases))
        lifts = [self._slope * math.radians(case.incidence_deg) for case in cases]
        return [
            SteadyResult(0.0, lift, lift / 4, _NOTHING, _NOTHING, _NOTHING, "thin airfoil")
            for lift in lifts
        ]

    def run_unsteady(
        self, cases: Sequence[UnsteadyCase], work: Path, progress: Progress
    ) -> list[UnsteadyResult]:
        """Release each section, at rest and untwisted, until it has turned by a radian."""
        del work
        results = []
        for number, case in enumerate(cases, start=1):
            results.append(self._release(case))
            progress(number, len(cases))
        return results

    def _release(self, case: UnsteadyCase) -> UnsteadyResult:
        from equisection.solvers.verdicts import TipMotion, judge  # noqa: PLC0415

        assert case.section is not None, "the registry lets no 3D case through"
        rigid = math.radians(case.incidence_deg)
        time = np.arange(0.0, case.duration, case.output_interval)
        motion = self._motion(case.section, rigid, time)
        time = time[: len(motion)]
        deflection, twist, heaving, pitching = motion.T
        lift = self._slope * (rigid + twist - heaving + pitching / 4)
        section = case.section
        tip = TipMotion(
            time, twist / section.twist_recovery, deflection / section.deflection_recovery
        )
        return UnsteadyResult(
            time=time,
            twist=twist,
            deflection=deflection,
            tip_twist=tip.twist,
            tip_deflection=tip.deflection,
            lift=lift,
            moment=lift / 4 - math.pi / 8 * pitching,
            incidence=rigid + twist,
            verdict=judge(case, tip),
        )

    def _motion(
        self, section: Section, rigid: float, time: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return (w, theta, w', theta') over time, shape (n, 4), up to the largest twist."""
        import scipy.linalg  # noqa: PLC0415

        section.require_defaults(
            "the quasi-steady solver",
            but=("static_imbalance", "flexural_damping", "torsional_damping"),
        )
        load = self._slope * np.array([1.0, 0.25])
        by_place = np.outer(load, [0.0, 1.0])
        by_rate = np.outer(load, [-1.0, 0.25]) - np.diag([0.0, math.pi / 8])
        system = np.zeros((5, 5))  # of the states and 1
        system[:2, 2:4] = np.eye(2)
        system[2:4] = np.linalg.solve(
            section.mass_matrix,
            np.column_stack(
                [
                    by_place - section.stiffness_matrix,
                    by_rate - section.damping_matrix,
                    load * rigid,
                ]
            ),
        )
        step = scipy.linalg.expm(system * (time[1] - time[0]))
        states = np.zeros((time.size, 5))
        states[0, 4] = 1.0
        for number in range(1, time.size):
            states[number] = step @ states[number - 1]
            if abs(states[number, 1]) > _LARGEST_TWIST:
                return states[: number + 1, :4]
        return states[:, :4]
