"""Beams with lumps and dashpots, from the configuration to the end of an embedded release."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.linalg import expm

from equisection.config import load_config
from equisection.reduction.integrals import span_integrals
from equisection.reduction.reduce import REDUCTIONS, reduce_beam
from equisection.results.modes_dataset import modes_to_dataset
from equisection.results.section_dataset import equivalent_to_dataset
from equisection.solvers.registry import solver_from_config
from equisection.structure.modal_matrices import modal_matrices
from equisection.structure.modes import modes_of_kinds
from equisection.study import plan
from equisection.study.assemble import case_at, k_star_as_given
from equisection.study.axes import K_STAR, SPEED, Point

NUMBER = 2
CHORD, SPEED_AS_GIVEN, TWIST = 1.8288, 100.0, 0.5
#: Goland's wing with a store at 0.8 of its span, behind the axis, and a damped strut under 0.6,
#: all but in vacuum.
RAW: dict[str, Any] = {
    "beam": {
        "chord": CHORD,
        "length": 6.096,
        "thickness": 0.1,
        "elastic_axis": 0.33,
        "mass_axis": 0.43,
        "cross_section": {
            "bending_rigidity": 9.773e6,
            "torsional_rigidity": 9.876e5,
            "mass_per_length": 35.717,
            "inertia_per_length": 8.642,
        },
        "damping": {"bending": 0.01, "torsion": 0.02},
        "lumps": [{"at": 0.8, "mass": 60.0, "inertia_about_centre": 10.0, "behind_axis": 0.2}],
        "supports": [
            {
                "at": 0.6,
                "deflection_stiffness": 2e5,
                "deflection_damping": 800.0,
                "twist_damping": 150.0,
            }
        ],
    },
    "flow": {"speed": SPEED_AS_GIVEN, "density": 1e-4, "incidence_deg": 0.0, "channel": None},
    "structure": {
        "method": "beam",
        "elements": {"span": 40},
        "bending_modes": NUMBER,
        "torsion_modes": NUMBER,
    },
    "embedded": {
        "polars": {"thin": "flat-plate"},
        "strips": 8,
        "separation": {"relaxation": 0.0, "delay": 0.0, "lift_lag": 0.0},
    },
    "steady": {"resolution": "thin"},
    "unsteady": {"start": {"twist_deg": TWIST}, "duration": 140.0, "time_step": 0.01},
}


@pytest.mark.parametrize("twice_as_fast", [False, True], ids=["as given", "at twice the speed"])
def test_release_in_vacuum_is_the_motion_of_the_modal_matrices(
    twice_as_fast: bool, tmp_path: Path
) -> None:
    """exp(A t) of M q'' + C q' + K q = 0, M with the lumps and C with the dashpots.

    Over k*, the same beam at another speed is the same motion over another time.
    """
    config = load_config(RAW)
    beam, flow = config.beam, config.flow
    modes = modes_of_kinds(beam, "beam", (1, 40, 1), (NUMBER, NUMBER), 4)
    sections = {name: reduce_beam(beam, modes, name) for name in REDUCTIONS}
    data = {
        "modes": modes_to_dataset(modes, [0.0] * len(modes.kind)),
        "equivalent": equivalent_to_dataset(
            sections,
            span_integrals(beam, modes, NUMBER),
            (),
            density=flow.density,
            speed=flow.speed,
        ),
    }
    speed = SPEED_AS_GIVEN * (2.0 if twice_as_fast else 1.0)
    k_star = k_star_as_given(config, data["equivalent"]) * (SPEED_AS_GIVEN / speed) ** 2
    solver = solver_from_config(config, "thin")
    case = case_at(config, plan.model("3d", "consistent"), Point.at({K_STAR: k_star}), data, solver)
    (result,) = solver.run_unsteady([case], tmp_path, lambda now, end: None)

    matrices = modal_matrices(beam, modes, NUMBER, NUMBER)
    inverse, size = np.linalg.inv(matrices.mass), 2 * NUMBER
    rates = np.block(
        [
            [np.zeros((size, size)), np.eye(size)],
            [-inverse @ matrices.stiffness, -inverse @ matrices.damping],
        ]
    )
    torsion = modes.torsion(1).shape[0]
    start = np.zeros(2 * size)
    start[NUMBER] = math.radians(TWIST) / torsion[np.abs(torsion).argmax()]
    seconds = result.time * CHORD / speed
    step = expm(rates * (seconds[1] - seconds[0]))
    motion = np.empty((seconds.size, 2 * size))
    motion[0] = start
    for number in range(1, seconds.size):
        motion[number] = step @ motion[number - 1]

    assert seconds[-1] > 4 * 2 * math.pi / matrices.natural_frequencies[0]
    found = np.concatenate([CHORD * result.bending_amplitudes, result.torsion_amplitudes])
    scale = np.abs(motion[:, :size]).max(axis=0)
    np.testing.assert_allclose(found.T / scale, motion[:, :size] / scale, atol=5e-3)
    assert np.abs(motion[-1, NUMBER]) < 0.7 * start[NUMBER]  # damped, by what is compared


def test_speed_and_k_star_are_one_case() -> None:
    """Lumps, springs and dashpots at V are those at the k* that the beam has at V."""
    config = load_config(RAW | {"flow": {**RAW["flow"], "density": 1.225}})
    beam, flow = config.beam, config.flow
    modes = modes_of_kinds(beam, "beam", (1, 40, 1), (NUMBER, NUMBER), 4)
    data = {
        "modes": modes_to_dataset(modes, [0.0] * len(modes.kind)),
        "equivalent": equivalent_to_dataset(
            {name: reduce_beam(beam, modes, name) for name in REDUCTIONS},
            span_integrals(beam, modes, NUMBER),
            (),
            density=flow.density,
            speed=flow.speed,
        ),
    }
    solver, model = solver_from_config(config, "thin"), plan.model("3d", "consistent")
    k_star = k_star_as_given(config, data["equivalent"]) / 1.44
    one = case_at(config, model, Point.at({K_STAR: k_star}), data, solver).beam
    other = case_at(config, model, Point.at({SPEED: 1.2 * SPEED_AS_GIVEN}), data, solver).beam
    assert one is not None
    assert other is not None
    assert one.fittings is not None
    assert other.fittings is not None
    for name in ("mass", "inertia", "imbalance", "bending_dashpots", "torsion_dashpots"):
        np.testing.assert_allclose(getattr(one.fittings, name), getattr(other.fittings, name))
    np.testing.assert_allclose(one.bending_frequency, other.bending_frequency)
