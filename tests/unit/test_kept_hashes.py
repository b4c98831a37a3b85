"""Cases of the kept results, read by the models of today, have the hashes that they were kept by.

What a case is made of may grow; a result that has been computed stays the result of its case.
"""

from __future__ import annotations

import json
from pathlib import Path

import netCDF4
import pytest
from tests.sample_cases import UNSTEADY

from equisection.beam.section import Section
from equisection.cases import Start, UnsteadyCase, case_hash
from equisection.cases.kinds import kind_named

ROOT = Path(__file__).parents[2]


def attributes(path: Path) -> dict[str, str]:
    with netCDF4.Dataset(path) as data:
        return {name: data.getncattr(name) for name in data.ncattrs()}


KEPT = [
    pytest.param(found["case"], found["case_hash"], id=str(path.relative_to(ROOT)))
    for path in sorted((ROOT / "results/reference").rglob("*.nc"))
    if "case" in (found := attributes(path))
]


def test_there_are_cases_of_every_kind_and_dimension() -> None:
    cases = [json.loads(param.values[0]) for param in KEPT]  # type: ignore[arg-type]
    kinds = {(case["kind"], case["dimension"]) for case in cases}
    known = {(kind, dim) for kind in ("steady", "unsteady") for dim in ("2d", "3d")}
    assert kinds == {*known, ("forced", "2d")}
    assert len(cases) >= 135


@pytest.mark.parametrize(("text", "digest"), KEPT)
def test_kept_case_has_its_hash(text: str, digest: str) -> None:
    case = json.loads(text)
    assert case_hash(kind_named(case["kind"]).case.model_validate(case)) == digest


@pytest.mark.parametrize("start", [Start(twist_deg=0.1), Start(heave_rate=0.01)])
def test_start_makes_another_case(start: Start) -> None:
    assert "start" not in UNSTEADY.model_dump()
    assert case_hash(UNSTEADY.model_copy(update={"start": Start()})) == case_hash(UNSTEADY)
    case = UNSTEADY.model_copy(update={"start": start})
    assert case_hash(case) != case_hash(UNSTEADY)
    assert UnsteadyCase.model_validate_json(case.model_dump_json()) == case


@pytest.mark.parametrize(
    ("member", "value"),
    [
        ("static_imbalance", 0.5),
        ("flexural_damping", 0.01),
        ("torsional_damping", 0.01),
        ("elastic_axis", 0.33),
    ],
)
def test_what_a_section_has_beyond_its_springs_makes_another_case(
    member: str, value: float
) -> None:
    assert UNSTEADY.section is not None
    section = Section(**{**dict(UNSTEADY.section), member: value})
    case = UNSTEADY.model_copy(update={"section": section})
    assert case.model_dump()["section"][member] == value
    assert case_hash(case) != case_hash(UNSTEADY)
    assert UnsteadyCase.model_validate_json(case.model_dump_json()) == case
