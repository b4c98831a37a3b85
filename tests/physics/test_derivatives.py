"""Flutter derivatives: closed forms, published values, and onsets from tables."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import equisection as eq
from equisection.aerodynamics.derivatives import Derivatives
from equisection.aerodynamics.thin_airfoil import ThinAirfoil
from equisection.errors import ArgumentError, DerivativesFileError
from equisection.motion.beam_flutter import section_flutter
from equisection.motion.derivative_flutter import FlowingBody, derivative_onset
from equisection.motion.exact_roots import exact_growth_and_frequency
from equisection.motion.linear_flutter import growth_and_frequency
from equisection.validation.flutter_values import deck

AIR = 1.22
SPACINGS = (4.0, 2.0, 1.0)


def thin(spacing: float = 2.0, axis: float = 0.5) -> Derivatives:
    """Return Theodorsen's table at reduced velocities from 2 to 30."""
    return Derivatives.theodorsen(np.arange(2.0, 30.1, spacing), axis)


def test_closed_forms_of_a_flat_plate() -> None:
    """H1 = -2 pi F/K, H4 = (pi/2)(1 + 4 G/K), A1 = pi F/(2 K): Simiu and Scanlan, section 6.5."""
    table = thin()
    k = math.tau / table.reduced_velocity
    lag = np.array([(ThinAirfoil().influence(one)[0, 0] - math.pi / 2 * one**2) for one in k])
    circulation = lag / (-2j * math.pi * k)  # C(k) of the lift by heave
    h1, _, _, h4, a1, *_ = table.values.T
    assert h1 == pytest.approx(-math.tau * circulation.real / k, rel=1e-12)
    assert h4 == pytest.approx(0.5 * math.pi * (1.0 + 4.0 * circulation.imag / k), rel=1e-12)
    assert a1 == pytest.approx(0.5 * math.pi * circulation.real / k, rel=1e-12)


def test_slow_motion_is_the_quasi_steady_plate() -> None:
    """K H1 and K^2 H3 go to -2 pi, K A1 and K^2 A3 to pi/2."""
    table = Derivatives.theodorsen([100.0, 1e3, 1e4, 1e5])
    k = math.tau / table.reduced_velocity[-1]
    h1, _, h3, _, a1, _, a3, _ = table.values[-1]
    limits = (-math.tau, -math.tau, math.pi / 2, math.pi / 2)
    assert (k * h1, k**2 * h3, k * a1, k**2 * a3) == pytest.approx(limits, rel=1e-3)


def test_loads_of_the_rows_are_those_of_the_plate() -> None:
    """The signs of heave and lift, and the factors of K, there and back."""
    table = thin()
    for velocity, loads in zip(table.reduced_velocity, table.loads, strict=True):
        assert loads == pytest.approx(ThinAirfoil().influence(math.tau / velocity), rel=1e-12)


def test_loads_about_another_axis() -> None:
    for axis in (0.25, 0.6):
        k = math.tau / 10.0
        assert thin().influence(k, axis) == pytest.approx(thin(axis=axis).influence(k), rel=1e-12)


def test_interpolation_converges_with_the_rows() -> None:
    """At second order: monotone cubics lose an order at the ends of a table."""
    k = np.geomspace(0.25, 3.0, 200)
    exact = np.array([ThinAirfoil().influence(one) for one in k])
    errors = [np.max(np.abs(thin(spacing).influence(k) - exact)) for spacing in (1.0, 0.5, 0.25)]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert (orders > 1.8).all()


@pytest.mark.parametrize("damping", [0.0, 0.003, 0.02])
def test_onset_of_the_deck_from_its_own_table(damping: float) -> None:
    """Deck of IABSE's TG3.1 (Diana et al., 2020): within 0.1 % of Theodorsen's exact loads."""
    exact = section_flutter(deck(damping), AIR)
    for spacing in SPACINGS:
        found = derivative_onset(FlowingBody.of_section(deck(damping), AIR), thin(spacing))
        assert found.speed == pytest.approx(exact.speed, rel=1e-3)
        assert found.omega == pytest.approx(exact.omega, rel=1e-3)
        assert found.mechanism == "flutter"
        assert found.speed_low <= exact.speed <= found.speed_high


def test_growth_is_that_of_the_p_k_method_and_has_the_sign_of_the_exact_roots() -> None:
    section, speeds = deck(0.003), [60.0, 77.0, 77.5, 85.0]
    found = eq.stability(section, thin(0.5), speed=speeds, density=AIR)
    for number, speed in enumerate(speeds):
        flow, one = section.in_flow(AIR, speed), np.array([1.0])
        roots, exact = growth_and_frequency(flow, one)[0], exact_growth_and_frequency(flow, one)[0]
        least = roots[np.argmax(roots.real)]
        growth = float(found.growth_rate_convective[number])
        assert growth == pytest.approx(least.real, rel=0.01)
        assert float(found.frequency_strouhal[number]) * math.tau == pytest.approx(
            least.imag, rel=1e-3
        )
        assert np.sign(growth) == np.sign(np.nanmax(exact.real))
    assert found.mechanism.values.tolist() == ["none", "none", "flutter", "flutter"]


def test_critical_speed_has_a_neutral_motion() -> None:
    onset = eq.critical_speed(deck(0.003), thin(), speed=(10.0, 120.0), density=AIR)
    at = eq.stability(deck(0.003), thin(), speed=float(onset.critical_speed), density=AIR)
    assert float(at.growth_rate_convective) == pytest.approx(0.0, abs=1e-8)
    assert float(at.frequency) == pytest.approx(float(onset.frequency), rel=1e-6)


def test_damping_raises_the_onset_of_galloping_in_pitch() -> None:
    """One motion with A2 > 0 is unstable where K^2 A2/I* exceeds 2 zeta omega c/V."""
    section = deck(0.0).model_copy(update={"torsional_damping": 2.0e4})
    velocity = np.arange(2.0, 20.1, 0.5)
    values = np.zeros((velocity.size, 8))
    values[:, 5] = 0.02 * (velocity - 4.0)  # A2 alone: no other load
    table = Derivatives(velocity, values)
    found = derivative_onset(FlowingBody.of_section(section, AIR), table)
    # omega = sqrt(k_theta/I); c_theta = (rho/2) c^4 omega A2 with A2 of V/(f c)
    omega = math.sqrt(section.torsional_stiffness / section.inertia)
    a2 = section.torsional_damping / (0.5 * AIR * section.chord**4 * omega)
    speed = (4.0 + a2 / 0.02) * omega / math.tau * section.chord
    assert found.speed == pytest.approx(speed, rel=1e-3)


def test_section_that_is_unstable_wherever_the_table_is() -> None:
    """A2 > 0 without damping: no onset, and no claim that it is stable below."""
    velocity = np.arange(2.0, 20.0)
    values = np.zeros((velocity.size, 8))
    values[:, 5] = 0.1
    found = derivative_onset(FlowingBody.of_section(deck(0.0), AIR), Derivatives(velocity, values))
    assert found.mechanism == "flutter"
    assert math.isnan(found.speed)
    assert math.isnan(found.speed_low)
    assert found.speed_high > 0.0


def test_table_that_ends_before_the_onset_says_how_far_it_knows() -> None:
    table = Derivatives.theodorsen(np.arange(1.0, 8.0))
    found = derivative_onset(FlowingBody.of_section(deck(0.0), AIR), table)
    assert math.isnan(found.speed)
    assert found.mechanism == "none"
    assert found.speed_low < section_flutter(deck(0.0), AIR).speed
    assert "reduced velocities 1 to 7" in found.reason
    beyond = eq.stability(deck(0.0), table, speed=60.0, density=AIR)
    assert str(beyond.mechanism.values) == "unknown"


def test_spread_widens_the_interval_in_proportion() -> None:
    table = thin()
    widths = []
    for part in (0.01, 0.02):
        spread = replace(table, spread=part * np.abs(table.values))
        found = derivative_onset(FlowingBody.of_section(deck(0.003), AIR), spread)
        assert found.speed_low < found.speed < found.speed_high
        widths.append(found.speed_high - found.speed_low)
    assert widths[1] == pytest.approx(2.0 * widths[0], rel=0.05)


def test_written_and_read_again(tmp_path: Path) -> None:
    table = replace(thin(), spread=0.1 * np.abs(thin().values), incidence_deg=1.5)
    table.write(tmp_path / "table.csv")
    again = eq.Derivatives.read(tmp_path / "table.csv")
    assert again.values == pytest.approx(table.values, rel=1e-6)
    assert again.spread == pytest.approx(table.spread, rel=1e-6)
    assert (again.axis, again.incidence_deg) == (0.5, 1.5)


def variant(text: str, tmp_path: Path) -> Derivatives:
    (tmp_path / "variant.csv").write_text(text)
    return Derivatives.read(tmp_path / "variant.csv")


def rewritten(first: str, of: str, head: str) -> str:
    """Return Theodorsen's table with another first column and head."""
    table = thin()
    rows = []
    for velocity, values in zip(table.reduced_velocity, table.values, strict=True):
        column = {"K": math.tau / velocity, "k": math.pi / velocity}.get(first, velocity)
        signs = {"up": [1, -1, -1, 1, -1, 1, 1, -1]}.get(of, [1] * 8)
        rows.append(
            ",".join(
                f"{one:.12g}" for one in (column, *(values * signs * (0.5 if of == "rho" else 1)))
            )
        )
    return f"{head}\n{first},H1*,H2*,H3*,H4*,A1*,A2*,A3*,A4*\n" + "\n".join(rows) + "\n"


HEAD = "# convention: Scanlan\n# force: {}\n# heave: {}\n# axis: 0.5"


@pytest.mark.parametrize("first", ["reduced_velocity", "K", "k"])
@pytest.mark.parametrize(
    ("of", "force", "heave"),
    [("", "rho V^2 B/2", "down"), ("up", "1/2 rho V^2 B", "up"), ("rho", "rho V^2 B", "down")],
)
def test_conventions_mean_the_same_plate(
    first: str, of: str, force: str, heave: str, tmp_path: Path
) -> None:
    table = variant(rewritten(first, of, HEAD.format(force, heave)), tmp_path)
    assert table.values == pytest.approx(thin().values, rel=1e-9)
    assert table.reduced_velocity == pytest.approx(thin().reduced_velocity, rel=1e-9)
    assert table.doubts == ()


@pytest.mark.parametrize(
    ("factor", "said"),
    [
        (math.tau, "2 pi times too large"),
        (1 / math.tau, "2 pi times too small"),
        (2.0, "half the chord"),
        (0.5, "K for k"),
    ],
)
def test_reduced_velocity_of_another_meaning_is_doubted(factor: float, said: str) -> None:
    table = replace(thin(), reduced_velocity=factor * thin().reduced_velocity)
    (doubt,) = table.doubts
    assert said in doubt


def test_heave_and_lift_of_opposite_directions_are_doubted() -> None:
    """Heave alone turned round changes H1, H4, A1, A4."""
    values = thin().values * [-1, 1, 1, -1, -1, 1, 1, -1]
    (doubt,) = replace(thin(), values=values).doubts
    assert "positive direction of heave" in doubt


@pytest.mark.parametrize(
    ("wrong", "right", "said"),
    [
        ("# convention: Scanlan\n", "", "no comment says convention"),
        ("Scanlan", "Zasso", "J. Wind Eng"),
        ("H1,H2,H3,H4,A1,A2,A3,A4", "h1,h2,h3,h4,a1,a2,a3,a4", "small letters"),
        ("rho V^2 B/2", "q c", "force is 'q c'"),
        ("heave: down", "heave: left", "heave is 'left'"),
        ("axis: 0.5", "axis: 31", "axis is '31'"),
        ("reduced_velocity,", "U_red,", "first column is 'U_red'"),
        (",A4", ",A5", "no column A4"),
        ("\n4,", "\n2,", "two rows at the reduced velocity 2"),
        ("\n4,", "\n-4,", "wanted a number above 0"),
        ("\n4,", "\nfour,", "reduced_velocity is 'four'"),
        ("\n4,", "\n4,1,", "values under"),
    ],
)
def test_file_that_could_mean_another_thing_is_refused(
    wrong: str, right: str, said: str, tmp_path: Path
) -> None:
    thin().write(tmp_path / "table.csv")
    text = (tmp_path / "table.csv").read_text().replace(wrong, right, 1)
    with pytest.raises(DerivativesFileError, match=r"variant\.csv.*") as caught:
        variant(text, tmp_path)
    assert said in str(caught.value)


def test_few_rows_are_refused_and_a_missing_file_is_named(tmp_path: Path) -> None:
    thin().write(tmp_path / "table.csv")
    lines = (tmp_path / "table.csv").read_text().splitlines()
    with pytest.raises(DerivativesFileError, match="3 rows; wanted 4"):
        variant("\n".join(lines[:9]), tmp_path)
    with pytest.raises(DerivativesFileError, match=r"none\.csv"):
        Derivatives.read(tmp_path / "none.csv")


def test_frequency_outside_of_the_rows_and_incidence_beside_them_are_refused() -> None:
    with pytest.raises(ArgumentError, match="the derivatives cover"):
        thin().influence(0.01)
    with pytest.raises(ArgumentError, match="leave it out"):
        eq.stability(deck(0.0), thin(), incidence_deg=0.0, speed=20.0)
