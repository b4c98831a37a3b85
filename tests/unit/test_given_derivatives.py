"""The table of derivatives that a configuration names is looked into before any job starts."""

from __future__ import annotations

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from equisection.aerodynamics.derivatives import Derivatives
from equisection.analysis.critical_speeds import COLUMNS, in_words, with_margin
from equisection.analysis.derivative_speeds import from_derivatives
from equisection.config import load_config
from equisection.config.input_files import check_files
from equisection.errors import ConfigError
from equisection.motion.derivative_flutter import FlowingBody
from equisection.study.axes import AsGiven
from equisection.study.given_derivatives import check_derivatives
from equisection.validation.flutter_values import deck

THIN = Derivatives.theodorsen(np.arange(2.0, 30.0, 2.0))


def line_of(folder: Path) -> str:
    config = load_config({"derivatives": {"table": "own.csv"}})
    with pytest.raises(ConfigError) as caught:
        check_derivatives(config, folder)
    return str(caught.value)


def test_a_broken_table_is_named_by_its_key_and_line(tmp_path: Path) -> None:
    THIN.write(tmp_path / "own.csv")
    text = (tmp_path / "own.csv").read_text().replace("\n4,", "\nfour,")
    (tmp_path / "own.csv").write_text(text)
    line = line_of(tmp_path)
    assert line.startswith("config: derivatives.table: 'own.csv': line 8: reduced_velocity is")
    assert "\n" not in line


def test_a_table_off_the_equilibrium_is_said_to_be() -> None:
    """The row has the incidence of the table, which need not be the rigid one."""
    bodies = {"2d": FlowingBody.of_section(deck(0.003), 1.22)}
    table = replace(THIN, incidence_deg=3.0)
    for there, number in ((3.1, 0), (4.0, 1), (math.nan, 0)):
        found, remarks = from_derivatives(
            bodies,
            table,
            given=AsGiven(2.0, 80.0),
            incidence_deg=2.5,
            equilibrium=lambda model, speed, there=there: there,
        )
        assert found["incidence_deg"].tolist() == [3.0]
        assert len(remarks) == number
        assert all("forced.incidence_deg" in remark for remark in remarks)


def test_a_missing_table_is_named(tmp_path: Path) -> None:
    config = load_config({"reuse": "", "derivatives": {"table": "none.csv"}})
    with pytest.raises(ConfigError, match=r"derivatives\.table: 'none\.csv': no such file"):
        check_files(config, tmp_path)


def test_rows_have_the_basis_and_the_margin_of_the_lower_end() -> None:
    bodies = {"2d": FlowingBody.of_section(deck(0.003), 1.22)}
    found, remarks = from_derivatives(bodies, THIN, given=AsGiven(2.0, 80.0), incidence_deg=0.0)
    table = with_margin([found], 60.0)
    assert tuple(table.columns) == COLUMNS
    (row,) = table.to_dict("records")
    assert (row["basis"], row["mechanism"]) == ("derivatives", "flutter")
    assert row["margin"] == pytest.approx(row["speed_low"] / 60.0)
    assert row["k_star"] == pytest.approx(2.0 * (80.0 / row["speed"]) ** 2)
    assert not remarks


def test_an_onset_without_an_interval_is_said_to_have_none() -> None:
    bodies = {"2d": FlowingBody.of_section(deck(0.003), 1.22)}
    few = Derivatives.theodorsen([8.0, 11.0, 14.0, 18.0])
    found, remarks = from_derivatives(bodies, few, given=AsGiven(2.0, 80.0), incidence_deg=0.0)
    (row,) = found.to_dict("records")
    assert math.isnan(row["speed_low"])
    assert row["speed"] == pytest.approx(77.242, rel=2e-3)
    assert any("too few rows" in remark for remark in remarks)
    assert in_words(found)[0].endswith("m/s, without an interval")
