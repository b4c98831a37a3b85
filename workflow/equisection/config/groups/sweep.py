"""Section ``sweep``: the values of k*, the models, and the search for the onset."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Literal

from pydantic import Discriminator, Field, Tag

from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import WHOLE, Positive

ModelName = Literal[
    "2d",
    "2d-corrected",
    "3d",
    "2d-paper",
    "2d-corrected-paper",
    "2d-consistent",
    "2d-corrected-consistent",
]


class Range(KeyGroup):
    """Evenly spaced values, including both ends."""

    start: Positive = Field(description="First value (-).")
    stop: Positive = Field(description="Last value (-), above the first.")
    number: Annotated[int, Field(ge=2, le=20000), WHOLE] = Field(description="How many values (-).")

    def values(self) -> tuple[float, ...]:
        """Return the values, ascending."""
        step = (self.stop - self.start) / (self.number - 1)
        return tuple(self.start + step * place for place in range(self.number))


def _shape_of_k_star(value: object) -> str:
    return "range" if isinstance(value, dict | Range) else "list"


KStar = Annotated[
    Annotated[tuple[Positive, ...], Field(min_length=1), Tag("list")]
    | Annotated[Range, Tag("range")],
    Discriminator(_shape_of_k_star),
]


class Sweep(KeyGroup):
    """The sweep over the non-dimensional torsional stiffness k*."""

    k_star: KStar = Field(
        (4.0, 4.5, 5.0, 5.5, 6.0, 6.44, 7.0, 8.0, 9.0, 10.0, 12.0, 15.0, 18.0, 21.0),
        description="Values of k* = k_theta/(q c^2) (-), different in their first six digits: a "
        "list, or `start`, `stop` and `number` of evenly spaced ones.",
    )
    models: Annotated[tuple[ModelName, ...], Field(min_length=1)] = Field(
        ("2d", "2d-corrected", "3d", "2d-paper", "2d-corrected-paper"),
        description="Models to run, each once. `2d` and `2d-corrected` use the chosen "
        "`reduction`; with the ending `-paper` or `-consistent` they use that one.",
    )
    onset: Literal["sweep", "refine"] = Field(
        "sweep",
        description="`refine` runs further k* inside the bracket of the onset of each model "
        "until it is narrower than `onset_tolerance`.",
    )
    onset_tolerance: Positive = Field(
        0.02, description="Width of the onset's bracket, relative to its unstable k* (-)."
    )
    onset_points: Annotated[int, Field(ge=1, le=50), WHOLE] = Field(
        3, description="Values of k* that one round of refinement runs at once (-)."
    )

    taken: dict[ModelName, str] = Field(
        {},
        description="Models whose results are those of another run, beside the ones run here: the "
        "index of them (`results/<run>/unsteady/<model>/sweep.json`) by the model's name.",
    )

    @property
    def shown(self) -> tuple[str, ...]:
        """The models that are compared: those run, then those taken."""
        return (*self.models, *self.taken)

    def values(self) -> tuple[float, ...]:
        """Return the values of k*, ascending."""
        return (
            self.k_star.values() if isinstance(self.k_star, Range) else tuple(sorted(self.k_star))
        )


@check("sweep.k_star")
def _distinct(k_star: tuple[float, ...] | Range) -> Iterator[Problem]:
    if isinstance(k_star, Range):
        yield from _distinct_in_range(k_star)
        return
    names: set[str] = set()
    for place, value in enumerate(k_star):
        name = f"{value:.6g}"
        if name in names:
            yield Problem(
                f"sweep.k_star.{place}",
                value,
                f"allowed is each k* once; {name} stands before it, and the first six digits "
                "name the files of a case",
            )
        names.add(name)


def _distinct_in_range(k_star: Range) -> Iterator[Problem]:
    if not k_star.stop > k_star.start:
        yield Problem(
            "sweep.k_star.stop", k_star.stop, f"allowed is a number above start, {k_star.start:g}"
        )
    elif len({f"{value:.6g}" for value in k_star.values()}) < k_star.number:
        yield Problem(
            "sweep.k_star.number",
            k_star.number,
            f"allowed are fewer values, so that those between {k_star.start:g} and "
            f"{k_star.stop:g} differ in the first six digits, which name the files of a case",
        )


@check("sweep.k_star", "sweep.onset")
def _two_to_refine(k_star: tuple[float, ...] | Range, onset: str) -> Iterator[Problem]:
    if onset == "refine" and not isinstance(k_star, Range) and len(k_star) < 2:
        yield Problem(
            "sweep.k_star",
            list(k_star),
            "allowed with sweep.onset 'refine' are two k* or more, with the onset between them",
        )


@check("sweep.models", "sweep.taken")
def _run_or_taken(models: tuple[str, ...], taken: dict[str, str]) -> Iterator[Problem]:
    for model, path in taken.items():
        if model in models:
            yield Problem(
                f"sweep.taken.{model}", path, "allowed is a model that is not in sweep.models"
            )
        elif Path(path).suffix != ".json" or Path(path).parent.name != model:
            yield Problem(
                f"sweep.taken.{model}",
                path,
                f"allowed is an index of results of this model, unsteady/{model}/sweep.json",
            )


@check("sweep.models")
def _once(models: tuple[str, ...]) -> Iterator[Problem]:
    for place, model in enumerate(models):
        if model in models[:place]:
            yield Problem(
                f"sweep.models.{place}", model, "allowed is each model once; it stands before"
            )
