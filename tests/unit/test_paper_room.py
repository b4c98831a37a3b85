"""What is the paper's alone: its case, the numbers of its figures, and its values in them."""

from pathlib import Path

import pandas as pd
import pytest

from equisection.config import Config, load_config
from equisection.figures.catalogue import CATALOGUE
from equisection.figures.references import COLUMNS, read_references
from equisection.paper.figure_numbers import NUMBERED, further_names
from equisection.paper.paper_case import is_paper_case
from equisection.paper.printed_values import BUBBLE_2D, PUBLISHED

ROOT = Path(__file__).parents[2]
REFERENCES = ROOT / "config" / "paper" / "references.csv"


def test_defaults_are_the_papers_case() -> None:
    assert is_paper_case(Config())
    assert is_paper_case(load_config({"sweep": {"k_star": [5, 6]}, "reduction": "paper"}))


@pytest.mark.parametrize("changes", [{"flow": {"speed": 21.0}}, {"beam": {"chord": 0.11}}])
def test_another_beam_or_flow_is_another_case(changes: dict[str, dict[str, float]]) -> None:
    assert not is_paper_case(load_config(changes))


def test_numbered_figures_are_in_the_catalogue_and_have_captions() -> None:
    assert set(NUMBERED) <= {entry.name for entry in CATALOGUE}
    assert [number for number, _ in NUMBERED.values()] == [3, *range(5, 18)]
    for further in further_names().values():
        assert (ROOT / "workflow" / "rules" / further.caption).resolve().is_file()


def test_values_drawn_in_figures_are_those_printed() -> None:
    table = pd.read_csv(REFERENCES)
    assert tuple(table.columns) == COLUMNS
    bubble = read_references([REFERENCES], "bubble")
    assert dict(zip(bubble["at"], bubble["value"], strict=True)) == BUBBLE_2D
    printed = {value.quantity: value.value for value in PUBLISHED}
    for quantity, stated in (
        ("onset_k_star", "k* of the onset"),
        ("courant_number_limit", "CFL of 90 % of the volume, 2D"),
    ):
        assert read_references([REFERENCES], quantity)["value"].tolist() == [printed[stated]]
