"""Section ``rom``: the model learnt from a release, where `sweep.onset` is `model`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag

from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import Positive

AUTO: Literal["auto"] = "auto"


def _shape_of_releases(value: object) -> str:
    return "auto" if isinstance(value, str) else "list"


def _shape_of_runs(value: object) -> str:
    return "list" if isinstance(value, list | tuple) else "count"


Releases = Annotated[
    Annotated[Literal["auto"], Tag("auto")]
    | Annotated[tuple[Positive, ...], Field(min_length=1), Tag("list")],
    Discriminator(_shape_of_releases),
]


Runs = Annotated[
    Annotated[Literal[0, 2, 4], Tag("count")]
    | Annotated[tuple[Positive, ...], Field(min_length=1), Tag("list")],
    Discriminator(_shape_of_runs),
]


class Rom(KeyGroup):
    """The reduced-order model that takes the place of a sweep; used with `sweep.onset: model`."""

    learn_from: Releases = Field(
        AUTO,
        description="Values of k* (or speeds, as the sweep's) of the releases to learn from, one "
        "or two; the last one counts. `auto`: the middle of the sweep, and a second one where the "
        "model says that this is too far from the onset.",
    )
    confirm: Runs = Field(
        2,
        description="Number of the runs that check the onset, half of them on either side of its "
        "interval; where one contradicts, the model is learnt anew from it and checked again. "
        "Or a list of their values of k* (or speeds), for instance of runs that are kept.",
    )

    @property
    def most_runs(self) -> int:
        """Largest number of runs beyond the first release, at one incidence and of one model."""
        if isinstance(self.confirm, tuple):
            return 1 + len(self.confirm)
        return 1 + 2 * self.confirm


@check("rom.learn_from")
def _one_or_two(learn_from: Literal["auto"] | tuple[float, ...]) -> Iterator[Problem]:
    if learn_from == AUTO:
        return
    names = [f"{value:.6g}" for value in learn_from]
    if len(names) > 2 or len(set(names)) < len(names):
        yield Problem(
            "rom.learn_from",
            list(learn_from),
            "allowed is auto, or a list of one or two values that differ",
        )


@check("rom.confirm")
def _each_once(confirm: int | tuple[float, ...]) -> Iterator[Problem]:
    if isinstance(confirm, int):
        return
    if len({f"{value:.6g}" for value in confirm}) < len(confirm):
        yield Problem(
            "rom.confirm", list(confirm), "allowed is a list of values that differ, or 0, 2 or 4"
        )
