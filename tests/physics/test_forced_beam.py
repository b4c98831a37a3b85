"""Forced modes of a beam: loads by its own states, and the onset that follows from them."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import scipy
import xarray as xr

from equisection.aerodynamics.derivatives import Derivatives
from equisection.aerodynamics.finite_span import FiniteSpan
from equisection.aerodynamics.generalised_forces import GeneralisedForces
from equisection.aerodynamics.load_response import load_response
from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.analysis.forced_modes import MovedModes, generalised_forces_of
from equisection.cases import ForcedCase
from equisection.cases.beam_in_flow import beam_modes_in_flow
from equisection.config import Config, load_config
from equisection.errors import ArgumentError, ConfigError, DerivativesFileError, ResultFileError
from equisection.motion.body_in_flow import BodyInFlow
from equisection.motion.derivative_flutter import FlowingBody, derivative_onset
from equisection.motion.forced_signal import ForcedSignal, schroeder_phases
from equisection.motion.steady_states import least_stable_eigenvalue
from equisection.motion.strip_system import StripSystem
from equisection.results.forced_result import signal_of
from equisection.results.modes_dataset import modes_from_dataset, modes_to_dataset
from equisection.solvers.embedded.adapter import Adapter
from equisection.solvers.embedded.forced_beams import forced_beam
from equisection.solvers.embedded.releases import beam_parameters
from equisection.solvers.registry import solver_from_config
from equisection.structure.modal_matrices import modal_matrices
from equisection.structure.mode_set import frequency_constants
from equisection.structure.modes import compute_modes
from equisection.study.forced_cases import forced_case
from equisection.study.plan import forced_names

#: The paper's plate with its centre of mass behind its axis, so that it flutters.
SECTION = {
    "bending_rigidity": 1.76,
    "torsional_rigidity": 2.607,
    "mass_per_length": 0.472,
    "inertia_per_length": 4.61e-4,
}
#: A thin plate on few strips, whose loads are linear.
RAW: dict[str, Any] = {
    "embedded": {"polars": {"thin": "flat-plate"}, "strips": 6},
    "steady": {"resolution": "thin"},
    "flow": {"incidence_deg": 0.5},
    "sweep": {"models": ["3d"]},
    "beam": {"mass_axis": 0.62, "cross_section": SECTION},
    "structure": {"method": "beam", "bending_modes": 1, "torsion_modes": 1},
    "forced": {"run": True, "beam_modes": 1, "reduced_velocity": [6, 8, 10, 13, 17, 23, 30]},
}


def modes_of(config: Config) -> xr.Dataset:
    """Return the modes of the configured beam."""
    modes = compute_modes(config.beam, "beam", (24, 44, 1), count=8)
    return modes_to_dataset(modes, list(frequency_constants(modes, config.beam)))


def moved_beam(raw: dict[str, Any], *names: str) -> dict[str, tuple[ForcedCase, xr.Dataset]]:
    """Return case and result of each forced mode, or of some."""
    config = load_config(raw)
    solver, modes = solver_from_config(config, config.steady.resolution), modes_of(config)
    assert isinstance(solver, Adapter)
    chosen = names or forced_names(config, "3d")
    cases = [forced_case(config, name, solver, modes) for name in chosen]
    results = solver.run_forced(cases, Path(), lambda now, end: None)
    return {
        name: (case, result.of_case(case))
        for name, case, result in zip(chosen, cases, results, strict=True)
    }


@pytest.fixture(scope="module")
def results() -> dict[str, tuple[ForcedCase, xr.Dataset]]:
    return moved_beam(RAW)


@pytest.fixture(scope="module")
def moved(results: dict[str, tuple[ForcedCase, xr.Dataset]]) -> MovedModes:
    return generalised_forces_of(results)


@pytest.fixture(scope="module")
def body() -> BodyInFlow:
    """The same beam, free."""
    config = load_config(RAW)
    solver = solver_from_config(config, config.steady.resolution)
    assert isinstance(solver, Adapter)
    case = forced_case(config, "bending1", solver, modes_of(config))
    strips, span = solver._span(case.geometry)
    flow, modes = config.flow, modes_from_dataset(modes_of(config))
    own = beam_modes_in_flow(config.beam, modes, (1, 1), density=flow.density, speed=flow.speed)
    parameters = beam_parameters([own], strips, FiniteSpan.of(span))
    return BodyInFlow.of_beam(
        parameters, solver._loads(), speed=flow.speed, chord=config.beam.chord, k_star=1.0
    )


def exact_forces(system: StripSystem, omega: float) -> np.ndarray:
    """Return Q of the linear states of a system at omega c/V, shape (2, 2)."""
    layout, structure = system.layout, system.structure
    m, n, strips = layout.structural, layout.size, layout.strips
    f, g, h = structure.torsion_shapes, structure.bending_shapes, structure.weights
    mass, inertia = structure.apparent
    found = np.empty((2, 2), dtype=complex)
    for column, (place, rate) in enumerate(
        ((layout.deflection, layout.deflection_rate), (layout.twist, layout.twist_rate))
    ):
        given = np.zeros(m, dtype=complex)
        given[place], given[rate] = 1.0, 1j * omega
        own = 1j * omega * np.eye(n - m) - system.rates[0, m:, m:n]
        state = np.concatenate([given, np.linalg.solve(own, system.rates[0, m:, :m] @ given)])
        rates = (layout.deflection_rate, layout.twist_rate)
        free = [system.rates[0, each, :n] @ state for each in rates]
        heaved, turned = (-(omega**2) * (number == column) - free[number] for number in range(2))
        lift = system.strip_loads[0, :strips, :n] @ state - mass @ (g @ heaved)
        moment = system.axis_moments[0, :, :n] @ state - inertia @ (f @ turned)
        found[:, column] = (h * g[:, 0]) @ lift, (h * f[:, 0]) @ moment
    return found


def test_forces_are_those_of_the_states_of_the_beam(moved: MovedModes, body: BodyInFlow) -> None:
    """Real and imaginary parts within 0.05 % of the largest of each pair."""
    system = body.system(np.array([20.0]), np.array([0.0]))
    forces = moved.forces
    exact = np.array([exact_forces(system, math.tau / v) for v in forces.reduced_velocity])
    assert forces.modes == ("bending1", "torsion1")
    assert np.abs(forces.values - exact).max(axis=0) == pytest.approx(0.0, abs=2e-3)
    assert (np.abs(forces.values - exact) < 5e-4 * np.abs(exact).max(axis=0)).all()
    assert not moved.remarks


def test_onset_by_forces_is_that_of_the_eigenvalues(moved: MovedModes, body: BodyInFlow) -> None:
    """Bending and torsion on one mode each, with the induction of the finite span in both."""

    def growth(speed: float) -> float:
        system = body.system(np.array([speed]), np.array([0.0]))
        return float(least_stable_eigenvalue(system)[0].real)

    exact = scipy.optimize.brentq(growth, 50.0, 75.0, xtol=1e-3)
    config = load_config(RAW)
    beam, modes = config.beam, modes_from_dataset(modes_of(config))
    matrices = modal_matrices(beam, modes, 1, 1)
    chord, axis, density = beam.chord, beam.elastic_axis, config.flow.density
    moving = FlowingBody.of_moved_beam(matrices, chord, axis, density)
    found = derivative_onset(moving, moved.forces)
    assert found.speed == pytest.approx(exact, rel=1e-3)
    assert found.speed_low <= exact <= found.speed_high
    strips = FlowingBody.of_beam(matrices, chord, axis, density)
    table = Derivatives.theodorsen(moved.forces.reduced_velocity)
    assert derivative_onset(strips, table).speed < 0.9 * exact  # without what the span induces


def test_strips_without_a_span_are_those_of_a_thin_plate() -> None:
    """Theodorsen's loads times the integrals of two shapes, but for the lags of Jones: 2.4 %."""
    config = load_config({**RAW, "embedded": {**RAW["embedded"], "strips": 12}})
    solver = solver_from_config(config, "thin")
    assert isinstance(solver, Adapter)
    case = forced_case(config, "torsion1", solver, modes_of(config))
    strips, _ = solver._span(case.geometry)
    result = forced_beam(case, solver._loads(), strips, None)
    record, signal = result.time >= case.settling, signal_of(case)
    shapes = case.shapes
    assert shapes is not None
    g, f = np.array(shapes.bending[0]), np.array(shapes.torsion[0])
    thin = np.array([ThinAirfoil().influence(omega) for omega in signal.frequencies])
    for row, (load, shape) in enumerate(((result.bending_load, g), (result.torsion_load, f))):
        found = load_response(result.time[record], load[0][record], signal.frequencies)
        exact = thin[:, row, 1] * np.trapezoid(shape * f, shapes.span)
        assert (np.abs(found.response / signal.response - exact) < 0.026 * np.abs(exact)).all()


def test_mean_twist_is_a_mean_of_the_loads(
    results: dict[str, tuple[ForcedCase, xr.Dataset]],
) -> None:
    """A linear section has the same forces about a twisted beam, and more mean lift."""
    twisted = {**RAW, "forced": {**RAW["forced"], "twist_deg": 1.0}}
    rows = moved_beam(twisted, "bending1")
    ((case, data),) = rows.values()
    assert case.mean_twist_deg == 1.0
    _, plain = results["bending1"]
    assert float(data["cl"][0]) > 1.5 * float(plain["cl"][0])
    swing = [(one["bending_load"] - one["bending_load"][:, 0]).to_numpy() for one in (data, plain)]
    assert swing[0] == pytest.approx(swing[1], abs=1e-9)
    with pytest.raises(ResultFileError, match=r"no torsion1 at the reduced velocity 6"):
        generalised_forces_of(rows)


def test_table_is_read_as_it_is_written(moved: MovedModes, tmp_path: Path) -> None:
    path = tmp_path / "3d.csv"
    moved.forces.write(path, ["a comment"])
    again = GeneralisedForces.read(path)
    assert again.values == pytest.approx(moved.forces.values, rel=1e-7)
    assert again.spread == pytest.approx(moved.forces.spread, rel=1e-7)
    assert (again.modes, again.axis, again.incidence_deg) == (moved.forces.modes, 0.5, 0.5)
    assert again.label == "forced modes, solver embedded, thin"
    lines = path.read_text().splitlines()
    path.write_text("\n".join(lines[:-1]) + "\n")
    with pytest.raises(DerivativesFileError, match=r"no load on torsion1 by torsion1 at .* 30"):
        GeneralisedForces.read(path)
    path.write_text("\n".join(lines).replace("\n6,", "\n0,"))
    with pytest.raises(DerivativesFileError, match=r"3d\.csv: .* begins with 0; wanted above 0$"):
        GeneralisedForces.read(path)
    with pytest.raises(ArgumentError, match="the forces cover"):
        again.influence(10.0)


def test_shifted_forces_differ_in_one_part_by_their_spread(moved: MovedModes) -> None:
    forces = moved.forces
    assert forces.quantities == 8
    assert forces.spread is not None
    change = forces.shifted(5, 2.0).values - forces.values
    assert change[:, 1, 0] == pytest.approx(2j * forces.spread[:, 1, 0])
    change[:, 1, 0] = 0.0
    assert not change.any()


def test_motion_has_its_own_derivatives() -> None:
    """Velocity and acceleration are those of the motion, also while it sets in."""
    signal = ForcedSignal(np.array([0.4, 1.0]), np.array([0.1, 0.2]), schroeder_phases(2), 5.0)
    step = 1e-3
    time = step * np.arange(8000)
    x, v, a = signal.moving(time)
    assert x == pytest.approx(signal.at(time), abs=1e-14)
    assert v[1:-1] == pytest.approx((x[2:] - x[:-2]) / (2 * step), abs=1e-6)
    assert a[1:-1] == pytest.approx((v[2:] - v[:-2]) / (2 * step), abs=2e-5)


def test_strip_beyond_the_polar_has_no_forces() -> None:
    raw = {**RAW, "steady": {}, "embedded": {"strips": 6}}
    raw["forced"] = {**RAW["forced"], "amplitude_deg": 20.0}
    with pytest.raises(ResultFileError, match=r"forced case torsion1: .*forced\.amplitude_deg"):
        generalised_forces_of(moved_beam(raw, "torsion1"))


def test_mean_twist_beyond_the_polar_is_named() -> None:
    """There is no steady flow to begin with, so no incidence that could be told."""
    far = {**RAW, "forced": {**RAW["forced"], "twist_deg": 80.0}}
    with pytest.raises(
        ResultFileError, match=r"leaves polar 'thin flat plate', .*forced\.twist_deg"
    ):
        generalised_forces_of(moved_beam(far, "bending1"))


def test_more_modes_than_there_are_is_refused() -> None:
    with pytest.raises(ConfigError, match=r"forced\.beam_modes: 5: allowed is 0 to 4"):
        load_config({"forced": {"beam_modes": 5}})
