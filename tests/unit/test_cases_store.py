import json
import math
from collections.abc import Callable
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from tests.sample_cases import MEDIUM, STEADY, UNSTEADY

from equisection.cases import (
    Case,
    SteadyCase,
    UnsteadyCase,
    are_alike,
    case_hash,
    history_hash,
    read_cases,
    write_cases,
)
from equisection.cases.case_file import canonical
from equisection.errors import CaseFileError

#: Numbers whose rounding to 8 digits neither overflows nor loses itself in subnormals.
numbers = st.floats(min_value=-1e12, max_value=1e12).filter(lambda x: x == 0 or abs(x) > 1e-12)


def at_speed(speed: float) -> SteadyCase:
    return STEADY.model_copy(update={"medium": MEDIUM.model_copy(update={"speed": speed})})


def leaves(value: Any, path: tuple[str, ...] = ()) -> list[tuple[str, ...]]:
    """Return the path of every value of nested dictionaries."""
    if not isinstance(value, dict):
        return [path]
    return [leaf for key, item in value.items() for leaf in leaves(item, (*path, key))]


def changed(value: Any) -> Any:
    """Return another value of the same type."""
    if isinstance(value, bool):
        return not value
    if isinstance(value, int | float):
        return value * 1.5 + 1
    if isinstance(value, list):
        return [*value, 1.0]
    return {"2d": "3d", "steady": "unsteady"}.get(value, f"{value}x")


@given(numbers)
def test_a_case_is_the_same_case_after_its_file(speed: float) -> None:
    case = at_speed(speed)
    again = SteadyCase.model_validate(json.loads(canonical(case)))
    assert canonical(again) == canonical(case)
    assert case_hash(again) == case_hash(case)


@given(numbers)
def test_differences_beyond_eight_digits_are_no_other_case(speed: float) -> None:
    rounded = float(f"{speed:.8g}")
    assert case_hash(at_speed(rounded)) == case_hash(at_speed(rounded * (1 + 1e-12)))


@given(numbers.filter(bool))
def test_a_difference_in_the_sixth_digit_is_another_case(speed: float) -> None:
    assert case_hash(at_speed(speed)) != case_hash(at_speed(speed * (1 + 1e-6)))


def test_minus_zero_is_zero() -> None:
    assert "-0.0" not in canonical(at_speed(-0.0))
    assert case_hash(at_speed(-0.0)) == case_hash(at_speed(0.0))


def test_order_of_keys_does_not_matter() -> None:
    def turned(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: turned(value[key]) for key in reversed(value)}
        return value

    again = UnsteadyCase.model_validate(turned(UNSTEADY.model_dump()))
    assert case_hash(again) == case_hash(UNSTEADY)


@pytest.mark.parametrize("case", [STEADY, UNSTEADY], ids=["steady", "unsteady"])
def test_every_field_decides_the_hash(case: SteadyCase | UnsteadyCase) -> None:
    original = case.model_dump()
    hashes = {case_hash(case)}
    paths = [path for path in leaves(original) if _at(original, path) is not None]
    for path in paths:
        other = case.model_dump()
        *parents, last = path
        _at(other, tuple(parents))[last] = changed(_at(original, path))
        # values need not make sense here, so they are not validated
        hashes.add(case_hash(_Dumped(other)))  # type: ignore[arg-type]
    assert len(hashes) == len(paths) + 1


def _at(value: Any, path: tuple[str, ...]) -> Any:
    for key in path:
        value = value[key]
    return value


class _Dumped:
    """Dumps as the dictionary that it was given."""

    def __init__(self, content: dict[str, Any]) -> None:
        self._content = content

    def model_dump(self, mode: str) -> dict[str, Any]:
        assert mode == "json"
        return self._content


@given(st.lists(numbers, max_size=6, unique=True))
def test_cases_of_a_job_are_read_as_written(speeds: list[float]) -> None:
    cases: dict[str, Case] = {f"a{number}": at_speed(v) for number, v in enumerate(speeds)}
    cases["release"] = UNSTEADY
    with TemporaryDirectory() as folder:
        write_cases(Path(folder) / "cases.json", cases)
        again = read_cases(Path(folder) / "cases.json")
    assert {name: case_hash(case) for name, case in again.items()} == {
        name: case_hash(case) for name, case in cases.items()
    }


def test_no_case_is_read_as_no_case(tmp_path: Path) -> None:
    write_cases(tmp_path / "cases.json", {})
    assert read_cases(tmp_path / "cases.json") == {}


def test_what_all_cases_share_stands_once_in_their_file(tmp_path: Path) -> None:
    write_cases(tmp_path / "cases.json", {f"v{v}": at_speed(v) for v in (10.0, 20.0, 30.0)})
    text = (tmp_path / "cases.json").read_text()
    assert text.count("dynamic_viscosity") == 1
    assert text.count('"speed"') == 3


def test_hash_of_a_case_does_not_depend_on_its_company(tmp_path: Path) -> None:
    write_cases(tmp_path / "alone.json", {"k6.44": UNSTEADY})
    other = UNSTEADY.model_copy(update={"k_star": 7.0})
    write_cases(tmp_path / "both.json", {"k6.44": UNSTEADY, "k7": other})
    alone, both = (read_cases(tmp_path / f"{name}.json")["k6.44"] for name in ("alone", "both"))
    assert case_hash(alone) == case_hash(both) == case_hash(UNSTEADY)


def test_case_file_has_the_same_bytes_whatever_the_order(tmp_path: Path) -> None:
    write_cases(tmp_path / "a.json", {"a": STEADY, "b": UNSTEADY})
    write_cases(tmp_path / "b.json", {"b": UNSTEADY, "a": STEADY})
    assert (tmp_path / "a.json").read_bytes() == (tmp_path / "b.json").read_bytes()


def _without_schema(raw: dict[str, Any]) -> None:
    del raw["schema_version"]


def _of_schema_2(raw: dict[str, Any]) -> None:
    raw["schema_version"] = 2


def _with_words_for_speed(raw: dict[str, Any]) -> None:
    raw["shared"]["medium"]["speed"] = "fast"


def _with_unknown_key(raw: dict[str, Any]) -> None:
    raw["shared"]["colour"] = "red"


def _without_cases(raw: dict[str, Any]) -> None:
    del raw["cases"]


def _with_a_word_for_a_case(raw: dict[str, Any]) -> None:
    raw["cases"]["a"] = "case"


def _of_unknown_kind(raw: dict[str, Any]) -> None:
    raw["shared"]["kind"] = "other"


@pytest.mark.parametrize(
    ("spoil", "says"),
    [
        (_without_schema, "schema version None; version 1 is read here"),
        (_of_schema_2, "schema version 2; version 1 is read here"),
        (_with_words_for_speed, "medium.speed"),
        (_with_unknown_key, "colour"),
        (_of_unknown_kind, "kind"),
        (_without_cases, "'shared' and 'cases'"),
        (_with_a_word_for_a_case, "'shared' and 'cases'"),
    ],
)
def test_case_file_that_does_not_fit_is_named_with_its_fault(
    spoil: Callable[[dict[str, Any]], None], says: str, tmp_path: Path
) -> None:
    path = tmp_path / "case.json"
    write_cases(path, {"a": STEADY})
    raw = json.loads(path.read_text())
    spoil(raw)
    path.write_text(json.dumps(raw))
    with pytest.raises(CaseFileError, match="delete it and run again") as caught:
        read_cases(path)
    assert str(path) in str(caught.value)
    assert says in str(caught.value)


@pytest.mark.parametrize("content", [b"", b"{", b"[1, 2]", b"\xff\xfe\x00"])
def test_file_that_is_no_case_is_named(content: bytes, tmp_path: Path) -> None:
    path = tmp_path / "case.json"
    path.write_bytes(content)
    with pytest.raises(CaseFileError, match=r"case\.json: "):
        read_cases(path)


def test_missing_case_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(CaseFileError, match=r"nothing\.json: cannot be read"):
        read_cases(tmp_path / "nothing.json")


@pytest.mark.parametrize("parts", [{"section": None}, {"dimension": "3d"}])
def test_unsteady_case_without_its_structure_is_refused(parts: dict[str, Any]) -> None:
    with pytest.raises(ValueError, match="alone"):
        UnsteadyCase.model_validate({**UNSTEADY.model_dump(), **parts})


def test_refused_case_needs_no_structure() -> None:
    case = UnsteadyCase.model_validate(
        {**UNSTEADY.model_dump(), "section": None, "refusal": "it diverges"}
    )
    assert math.isclose(case.k_star, 6.44)


def test_history_is_that_of_a_case_whatever_ends_it() -> None:
    criteria = UNSTEADY.criteria.model_copy(update={"periods": 9})
    longer = UNSTEADY.model_copy(update={"criteria": criteria, "duration": 900.0})
    assert case_hash(longer) != case_hash(UNSTEADY)
    assert history_hash(longer) == history_hash(UNSTEADY)
    for name, value in (("k_star", 5.0), ("time_step", 0.025), ("output_interval", 0.05)):
        other = UNSTEADY.model_copy(update={name: value})
        assert history_hash(other) != history_hash(UNSTEADY)


def test_cases_are_alike_but_for_what_is_not_known() -> None:
    one = json.loads(canonical(UNSTEADY))
    for difference, alike in ((1e-5, True), (1e-3, False)):
        other = json.loads(canonical(UNSTEADY))
        other["section"]["mass"] *= 1 + difference
        assert are_alike(one, other) is alike
    assert not are_alike(one, json.loads(canonical(STEADY)))
    assert are_alike([1.0, 1e-6], [1.0, 2e-6])  # beside the largest of a list
    assert not are_alike([1.0, 1e-9], [1.0])
    assert not are_alike({"mesh": "coarse"}, {"mesh": "fine"})
