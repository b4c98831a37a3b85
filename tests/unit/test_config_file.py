"""A file that is no configuration is told in one line, with the place where it is wrong."""

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
        ("[" * 10**5, ", line 1, column 31", "nested more than 30 deep"),
        ("[" * 3000 + "]" * 3000, ", line 1, column 31", "nested more than 30 deep"),
        ("a: &a [*a]\n", ", line 1, column 8", "the alias *a stands for what holds it"),
        ("a: &a\n  b: {c: *a}\n", ", line 2, column 10", "the alias *a stands for what holds it"),
        (f"a: [{'1,' * 10**5}]\n", ", line 1, column ", "more than 10000 keys and values"),
        (f"a: [{'1,' * 10**6}]\n", "", "is larger than 1 MB"),
        (f'{{"a": [{"1," * 10**5} 1]}}', ", line 1, column ", "more than 10000 keys and values"),
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
    assert line.startswith(f"config: {path}{place}")
    assert reason in line


def test_what_is_no_file_is_said(tmp_path: Path) -> None:
    with pytest.raises(ConfigError) as caught:
        check_config_files([tmp_path / "none.yaml", tmp_path, Path("a\0b")])
    missing, folder, odd = str(caught.value).splitlines()
    assert missing.startswith(f"config: {tmp_path / 'none.yaml'}: no such file, seen from ")
    assert folder.startswith(f"config: {tmp_path}: is a folder; ")
    assert "cannot be read" in odd


def test_file_that_only_the_clone_has_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ConfigError) as caught:
        check_config_files([Path("config/openfoam.yaml"), Path("config/none.yaml")])
    of_clone, of_none = str(caught.value).splitlines()
    named = Path(of_clone.partition("the clone has one: ")[2])
    assert named.is_absolute()
    assert named.parts[-2:] == ("config", "openfoam.yaml")
    check_config_files([named])
    assert "the clone" not in of_none


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


def test_aliases_that_stand_for_billions_are_refused(tmp_path: Path) -> None:
    layers = [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 12)]
    (line,) = lines_of(tmp_path / "my.yaml", "\n".join(["a0: &a0 [1, 1]", *layers]))
    assert line.endswith("line 5, column 25: holds more than 10000 keys and values")


def test_alias_of_a_section_is_read(tmp_path: Path) -> None:
    path = tmp_path / "my.yaml"
    path.write_text("a: &a {b: 1}\nc: *a\nd: {<<: *a, e: 2}\n")
    assert read_config_file(path) == {"a": {"b": 1}, "c": {"b": 1}, "d": {"b": 1, "e": 2}}


@pytest.mark.parametrize(
    ("text", "key", "words"),
    [
        ("a: {b: 1:30}", "a.b", "'1:30' is no decimal number"),
        ("a: {b: 1:30.5}", "a.b", "'1:30.5' is no decimal number"),
        ("a: 010", "a", "'010' is no decimal number"),
        ("a: 1_0", "a", "'1_0' is no decimal number"),
        ("a: 1_0.5", "a", "'1_0.5' is no decimal number"),
        ("a: 0x5", "a", "'0x5' is no decimal number"),
        ("a: 0b1", "a", "'0b1' is no decimal number"),
        ("a: !!int '010'", "a", "'010' is no decimal number"),
        ("a: !!float 1:30", "a", "'1:30' is no decimal number"),
        ("a: [5, 0x6]", "a.1", "'0x6' is no decimal number"),
        (f"a: {'9' * 5000}", "a", "... (5000 characters)' is no decimal number"),
        ("a: 2024-01-31", "a", "is a date in YAML"),
        ("a: 2024-13-45", "a", "is a date in YAML"),
        ("a: !!binary aGk=", "a", "has the tag !!binary"),
        ("a: !!set {b}", "a", "has the tag !!set"),
        ("a: !!python/name:os.system", "a", "has the tag !!python/name:os.system"),
        ("a: !mine 5", "a", "has the tag !mine"),
        ("a: {on: 1}", "a.on", "the key 'on' is true or false in YAML"),
        ("No: 1", "No", "the key 'No' is true or false in YAML"),
        ("010: 1", "010", "the key '010' is a whole number in YAML"),
        ("1.50: 1", "1.50", "the key '1.50' is a number in YAML"),
        ("~: 1", "~", "the key '~' is nothing in YAML"),
    ],
)
def test_what_yaml_reads_otherwise_than_it_is_written_is_refused(
    tmp_path: Path, text: str, key: str, words: str
) -> None:
    (line,) = lines_of(tmp_path / "my.yaml", text)
    assert line.startswith(f"config: {key}: ")
    assert words in line
    assert line.endswith(f"({tmp_path / 'my.yaml'}, line 1)")
    assert len(line) < 400 + len(str(tmp_path))


@pytest.mark.parametrize(
    ("written", "number"),
    [
        ("90", 90),
        ("-5", -5),
        ("+5", 5),
        ("0", 0),
        ("0.5", 0.5),
        (".5", 0.5),
        ("5.", 5.0),
        ("1.5e+3", 1500.0),
    ],
)
def test_decimal_numbers_are_read_as_written(tmp_path: Path, written: str, number: float) -> None:
    path = tmp_path / "my.yaml"
    path.write_text(f"a: {written}\nb: '010'\n")
    assert read_config_file(path) == {"a": number, "b": "010"}


def test_many_odd_values_take_few_lines(tmp_path: Path) -> None:
    lines = lines_of(tmp_path / "my.yaml", f"a: [{', '.join(['0x5'] * 500)}]")
    assert len(lines) == 11
    assert lines[-1].endswith(": 490 more values of this sort")
