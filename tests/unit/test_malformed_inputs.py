"""What is malformed is refused in one clear line, and nothing is read with another meaning."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

import pytest
import yaml
from tests.malformed.all import KINDS, sound
from tests.malformed.polars import GOOD, comma

from equisection.errors import ConfigError, PolarFileError
from equisection.io.formats import read_rows
from equisection.keys.config_file import read_config_file

#: A number as it is written, with D as Fortran writes an exponent; `re.ASCII` leaves out the digits
#: of other scripts.
DECIMAL = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eEdD][-+]?\d+)?", re.ASCII)
#: How lines of a polar begin that are no points.
COMMENTS = "#%!"
CONFIG = """\
run: mine
beam: {chord: 0.25, length: 1.5, thickness: 1.0e-2}
flow:
  speed: 20 # m/s
  incidence_deg: -2.5
sweep:
  k_star: [6, 10.5, 21]
  models: [2d, 3d]
embedded:
  polars: {own: "my polar.csv"}
  symmetric: true
"""
#: What a slip of a finger, or a file of another program, puts into a text.
SLIPS = [*"0123456789_:.,;xeED-+ \t\n#'\"[]{}&*!|>%@~?", "\u0661", "\uff11", "\u2212", "\xa0"]


@pytest.fixture(autouse=True)
def elsewhere(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder with a configuration that is read first in no time."""
    (tmp_path / "config").mkdir()
    (tmp_path / "config/config.yaml").write_text("run: mine\n")
    monkeypatch.chdir(tmp_path)


@pytest.mark.parametrize("kind", KINDS)
def test_each_malformed_input_is_refused_in_one_line_that_names_it(
    kind: str, tmp_path: Path
) -> None:
    inputs, look = KINDS[kind]
    otherwise = {}
    for number, one in enumerate(inputs):
        folder = tmp_path / f"{number}"
        folder.mkdir()
        answer, said = look(one, folder)
        if answer != "named":
            otherwise[one.what] = (answer, said)
    assert otherwise == {}


def test_what_they_are_made_of_is_accepted(tmp_path: Path) -> None:
    """Or each of them could be refused for what is the same in all."""
    answers = {}
    for number, (what, (one, look)) in enumerate(sound().items()):
        folder = tmp_path / f"{number}"
        folder.mkdir()
        answers[what] = look(one, folder)[0]
    assert set(answers.values()) == {"accepted"}, answers
    assert len(KINDS["configurations"][0]) >= 200
    assert len(KINDS["polars"][0]) >= 100


def slipped(text: str, number: int) -> Iterator[str]:
    """Give a text with a character put in, left out or exchanged, so many times."""
    chance = random.Random(0)
    for _ in range(number):
        place, slip = chance.randrange(len(text)), chance.choice(SLIPS)
        ends = chance.choice([(place, place), (place, place + 1), (place, place + 1)])
        yield text[: ends[0]] + chance.choice([slip, slip, ""]) + text[ends[1] :]


def numbers(node: yaml.Node, value: object) -> Iterator[tuple[str, object]]:
    """Give each number of a document as it is written and as it was read."""
    if isinstance(node, yaml.MappingNode):
        assert isinstance(value, dict)
        for key, inner in node.value:
            yield from numbers(inner, value[key.value])
    elif isinstance(node, yaml.SequenceNode):
        assert isinstance(value, list)
        for inner, item in zip(node.value, value, strict=True):
            yield from numbers(inner, item)
    elif isinstance(value, int | float) and not isinstance(value, bool):
        yield node.value, value


def test_numbers_of_a_configuration_with_a_slip_are_those_that_are_written(tmp_path: Path) -> None:
    path, read = tmp_path / "mine.yaml", 0
    refusals: list[str] = []
    for text in slipped(CONFIG, 200):
        path.write_text(text, encoding="utf-8")
        try:
            found = read_config_file(path)
        except ConfigError as error:
            refusals += str(error).split("\n")
            continue
        read += 1
        for written, value in numbers(yaml.compose(text, yaml.SafeLoader), found):
            assert DECIMAL.fullmatch(written), text
            assert value == float(Fraction(written)), text
    assert all(line.startswith("config: ") for line in refusals)
    assert 40 < read < 160  # neither everything nor nothing is refused


def test_points_of_a_polar_with_a_slip_are_those_that_are_written(tmp_path: Path) -> None:
    path, read = tmp_path / "mine.csv", 0
    refusals: list[str] = []
    for text in slipped(comma(GOOD), 600):
        path.write_text(text, encoding="utf-8")
        try:
            rows = read_rows(path, False).rows
        except PolarFileError as error:
            refusals.append(str(error))
            continue
        read += 1
        lines = text.splitlines()
        names = [name.strip().lower() for name in lines[0].split(",")]
        for row in rows:
            cells = [cell.strip() for cell in lines[row.line - 1].split(",")]
            assert all(map(DECIMAL.fullmatch, cells)), text
            there = dict(zip(("alpha", "cl", "cm", "cd"), row.values, strict=True))
            for name, cell in zip(names, cells, strict=True):
                assert there.get(name) == float(Fraction(cell.lower().replace("d", "e"))), text
        points = {line for line in map(str.strip, lines[1:]) if line and line[0] not in COMMENTS}
        assert len(rows) == len(points), text
    assert all(line.startswith(f"{path}") and "\n" not in line for line in refusals)
    assert 100 < read < 500
