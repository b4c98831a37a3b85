"""Each extension of the project takes five files or fewer, and works in a copy of it."""

from tests.extending.__main__ import all_outcomes, problems
from tests.extending.page import PAGE, table, table_of


def test_extensions_work_and_the_page_has_their_table() -> None:
    outcomes = all_outcomes()
    assert problems(outcomes) == []
    page = table_of(PAGE.read_text(encoding="utf-8"))
    assert page == table(outcomes), "python -m tests.extending --write"
