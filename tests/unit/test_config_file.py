"""A file that is no configuration is told in one line, with the place where it is wrong."""

import time
from pathlib import Path

import pytest
from tests.conftest import ROOT

from equisection.config import check_config_files, read_config_file
from equisection.errors import ConfigError


def lines_of(path: Path, content: str | bytes) -> list[str]:
    path.write_bytes(content.encode() if isinstance(content, str) else content)
    with pytest.raises(ConfigError) as caught:
        check_config_files([path])
    return str(caught.value).splitlines()


@pytest.mark.parametrize(
    ("content", "place", "reason"),
    [
        ("# Flügel\nrun: a\n".encode("latin-1"), ", line 1, column 5", "0xfc is not UTF-8 ('ü'"),
        ("run: a\nx: Flügel\n".encode("latin-1"), ", line 2, column 6", "save the file in UTF-8"),
        (b"run: \x80\n", ", line 1, column 6", "0x80 is not UTF-8; save"),
        ("run: a\n".encode("utf-16"), ", line 1, column 1", "UTF-16; save the file in UTF-8"),
        ("run: a\n".encode("utf-32"), ", line 1, column 1", "UTF-32; save the file in UTF-8"),
        ("run: a\n".encode("utf-16-le"), ", line 1, column 2", "0x00 is none of YAML's"),
        ("beam: [1\nrun: a", ", line 2, column 4", "is no YAML: expected ',' or ']'"),
        ("beam:\n\tchord: 1\n", ", line 2, column 1", "with blanks, not with tabs"),
        ("a: b: c\n", ", line 1, column 5", "is no YAML: mapping values are not allowed here"),
        ("a: *b\n", ", line 1, column 4", "undefined alias"),
        ("a: 1\n---\nb: 2\n", ", line 2, column 1", "another document"),
        ("? [1]\n: 2\n", ", line 1, column 3", "unhashable key"),
        ("a: !!python/name:os.system\n", ", line 1, column 4", "could not determine a constructor"),
        ("a: 2024-13-45\n", "", "month must be in 1..12); put it in quotes"),
        ("[" * 10**5, "", "nested too deeply"),
        ("- a\n", "", "holds a list; allowed is a file of sections"),
        ("beam", "", "holds a text; allowed is a file of sections"),
        ("5", "", "holds int; allowed is a file of sections"),
        ("", "", "holds nothing; allowed is a file of sections"),
        ("__use_yte__: true\nrun: a\n", "", "Snakemake executes what such a file holds"),
    ],
)
def test_one_line_with_the_place(
    tmp_path: Path, content: str | bytes, place: str, reason: str
) -> None:
    path = tmp_path / "my.yaml"
    (line,) = lines_of(path, content)
    assert line.startswith(f"config: {path}{place}: ")
    assert reason in line


def test_what_is_no_file_is_said(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as caught:
        check_config_files([tmp_path / "none.yaml", tmp_path, Path("a\0b")])
    missing, folder, odd = str(caught.value).splitlines()
    assert missing.startswith(f"config: {tmp_path / 'none.yaml'}: no such file, seen from ")
    assert folder.startswith(f"config: {tmp_path}: is a folder; ")
    assert "cannot be read" in odd


@pytest.mark.parametrize(
    "content",
    [
        "run: a\nbeam: {chord: 0.2}\n",
        "\ufeffrun: a\nbeam: {chord: 0.2}\n",
        '{\n\t"run": "a",\n\t"beam": {"chord": 0.2}\n}\n',
    ],
)
def test_yaml_and_json_in_utf8_are_read(tmp_path: Path, content: str) -> None:
    path = tmp_path / "my.yaml"
    path.write_text(content, encoding="utf-8")
    assert read_config_file(path) == {"run": "a", "beam": {"chord": 0.2}}


@pytest.mark.parametrize(
    ("text", "key", "first", "again"),
    [
        ("beam: {length: 0.5}\nrun: mine\nbeam: {chord: 0.2}\n", "beam", 1, 3),
        ("sweep:\n  k_star: [5]\n  k_star: [6]\n", "sweep.k_star", 2, 3),
        ("a:\n- {b: 1,\n   b: 2}\n", "a.0.b", 2, 3),
    ],
)
def test_both_lines_of_a_key_that_stands_twice_are_named(
    tmp_path: Path, text: str, key: str, first: int, again: int
) -> None:
    (line,) = lines_of(tmp_path / "my.yaml", text)
    assert line.startswith(f"config: {key}: stands twice in {tmp_path / 'my.yaml'}, in lines ")
    assert f"lines {first} and {again};" in line


def test_the_same_key_in_two_sections_is_none(tmp_path: Path) -> None:
    (tmp_path / "my.yaml").write_text("beam: {length: 0.5}\nflow: {length: 1}\n")
    check_config_files(tmp_path.iterdir())
    check_config_files((ROOT / "config").rglob("*.yaml"))


def test_aliases_that_stand_for_billions_are_looked_at_once(tmp_path: Path) -> None:
    path = tmp_path / "my.yaml"
    layers = [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 12)]
    path.write_text("\n".join(["a0: &a0 [1, 1]", *layers]))
    started = time.process_time()
    read_config_file(path)
    assert time.process_time() - started < 2.0
