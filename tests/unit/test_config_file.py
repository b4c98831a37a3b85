"""A key that stands twice in a configuration is refused, for YAML's readers take the last."""

from pathlib import Path

import pytest
from tests.conftest import ROOT

from equisection.config import check_repeated_keys
from equisection.errors import ConfigError


def lines_of(path: Path, text: str) -> list[str]:
    path.write_text(text)
    with pytest.raises(ConfigError) as caught:
        check_repeated_keys([path])
    return str(caught.value).splitlines()


@pytest.mark.parametrize(
    ("text", "key", "first", "again"),
    [
        ("beam: {length: 0.5}\nrun: mine\nbeam: {chord: 0.2}\n", "beam", 1, 3),
        ("sweep:\n  k_star: [5]\n  k_star: [6]\n", "sweep.k_star", 2, 3),
        ("a:\n- {b: 1,\n   b: 2}\n", "a.0.b", 2, 3),
    ],
)
def test_both_lines_are_named(tmp_path: Path, text: str, key: str, first: int, again: int) -> None:
    (line,) = lines_of(tmp_path / "my.yaml", text)
    assert line.startswith(f"config: {key}: stands twice in {tmp_path / 'my.yaml'}, in lines ")
    assert f"lines {first} and {again};" in line


def test_the_same_key_in_two_sections_is_none(tmp_path: Path) -> None:
    (tmp_path / "my.yaml").write_text("beam: {length: 0.5}\nflow: {length: 1}\n")
    (tmp_path / "broken.yaml").write_text("beam: {")
    check_repeated_keys(sorted(tmp_path.iterdir()))
    check_repeated_keys((ROOT / "config").rglob("*.yaml"))
