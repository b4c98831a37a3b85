"""Known values of other codes and authors, each within its tolerance, and the page of them."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from equisection.aerodynamics.derivatives import Derivatives
from equisection.clone import CLONE
from equisection.validation.__main__ import COMMAND, PAGE, known_values, main
from equisection.validation.known_values import ORIGINS, KnownValue
from equisection.validation.outline_values import derivatives_of_moved_plate

VALUES = known_values()


@pytest.mark.parametrize("value", VALUES, ids=lambda value: f"{value.case}: {value.quantity}")
def test_known_value(value: KnownValue) -> None:
    assert value.agrees, (
        f"{value.computed:.9g} {value.unit} here, {value.known:.9g} known ({value.source.words}); "
        f"off by {value.difference:.2e}, allowed is {value.tolerance:.2e}: {value.reason}"
    )


def test_a_value_that_is_off_does_not_agree() -> None:
    value = VALUES[0]
    assert not replace(value, known=(1 + 2 * value.tolerance) * value.known).agrees
    assert not replace(value, known=(1 - 2 * value.tolerance) * value.known).agrees


def test_every_value_has_an_origin_and_a_tolerance_with_a_reason() -> None:
    for value in VALUES:
        assert value.source.origin in ORIGINS
        assert value.source.words
        assert value.reason
        assert value.tolerance < 0.2


def test_the_page_is_what_the_command_writes(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--check"]) == 0, capsys.readouterr().out


def test_a_page_that_is_out_of_date_is_told(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    old = tmp_path / PAGE
    old.parent.mkdir()
    old.write_text((CLONE / PAGE).read_text(encoding="utf-8").replace("# Validation", "# Other", 1))
    assert main(["--check"], tmp_path) == 1
    told = capsys.readouterr()
    assert "-# Other" in told.out
    assert COMMAND in told.err


def test_loads_of_the_moved_plate_have_the_phase_of_theodorsens() -> None:
    """The page compares sizes; the distance of each complex load, phase and all, is within 13 %."""
    here = derivatives_of_moved_plate()
    there = Derivatives.theodorsen(here.reduced_velocity, here.axis)
    for real, imaginary in ((0, 3), (1, 2), (4, 7), (5, 6)):
        ours, theirs = (
            one.values[:, real] + 1j * one.values[:, imaginary] for one in (here, there)
        )
        assert (abs(ours - theirs) < 0.13 * abs(theirs)).all()
