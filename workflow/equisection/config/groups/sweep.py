"""Section ``sweep``: the values of k* or speed, the models, and the search for the onset."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import Discriminator, Field, Tag, model_validator

from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import NULLABLE, NUMBER, WHOLE, Angle, Positive

ModelName = Literal[
    "2d",
    "2d-corrected",
    "3d",
    "2d-paper",
    "2d-corrected-paper",
    "2d-consistent",
    "2d-corrected-consistent",
]

#: Most cases of a model that a run has; the workflow lists each of them.
MOST_CASES = 100_000


class Range(KeyGroup):
    """Evenly spaced values, including both ends."""

    start: Positive = Field(description="First value.")
    stop: Positive = Field(description="Last value, above the first.")
    number: Annotated[int, Field(ge=2, le=20000), WHOLE] = Field(description="How many values (-).")

    def values(self) -> tuple[float, ...]:
        """Return the values, ascending."""
        step = (self.stop - self.start) / (self.number - 1)
        return tuple(self.start + step * place for place in range(self.number))


def _shape_of_values(value: object) -> str:
    if value is None:
        return "nothing"
    return "range" if isinstance(value, dict | Range) else "list"


Values = Annotated[
    Annotated[tuple[Positive, ...], Field(min_length=1), Tag("list")]
    | Annotated[Range, Tag("range")]
    | Annotated[None, Tag("nothing")],
    Discriminator(_shape_of_values),
    NULLABLE,
]


class Sweep(KeyGroup):
    """The sweep over the non-dimensional torsional stiffness k*, or over the speed."""

    k_star: Values = Field(
        (4.0, 4.5, 5.0, 5.5, 6.0, 6.44, 7.0, 8.0, 9.0, 10.0, 12.0, 15.0, 18.0, 21.0),
        description="Values of k* = k_theta/(q c^2) (-), different in their first six digits: a "
        "list, or `start`, `stop` and `number` of evenly spaced ones. `null` with `speed`.",
    )
    speed: Values = Field(
        None,
        description="Speeds V (m/s) in the place of `k_star`, in the same forms: the beam as it is "
        "given, in a flow of each speed, up to Mach 0.3. Rigid polars are those at `flow.speed`.",
    )
    incidence_deg: tuple[Angle, ...] = Field(
        (),
        description="Rigid incidences theta_0 (deg) in the place of `flow.incidence_deg`: each "
        "model runs at each of them, and `comparison/stability_map.nc` has its stability over "
        "incidence and speed. Empty for `flow.incidence_deg` alone.",
    )
    models: Annotated[tuple[ModelName, ...], Field(min_length=1)] = Field(
        ("2d", "2d-corrected", "3d", "2d-paper", "2d-corrected-paper"),
        description="Models to run, each once. `2d` and `2d-corrected` use the chosen "
        "`reduction`; with the ending `-paper` or `-consistent` they use that one.",
    )
    onset: Literal["sweep", "refine", "model"] = Field(
        "sweep",
        description="`refine` runs further values inside the bracket of the onset of each model "
        "until it is narrower than `onset_tolerance`; where all values are stable, or all "
        "unstable, it looks beyond their end first. `model` runs the releases of "
        "`rom` in their place, and learns a model that predicts the others.",
    )
    onset_tolerance: Positive = Field(
        0.02, description="Width of the onset's bracket, relative to its unstable side (-)."
    )
    onset_points: Annotated[int, Field(ge=1, le=50), WHOLE] = Field(
        3, description="Values that one round of refinement runs at once (-)."
    )
    onset_reach: Annotated[float, Field(ge=1, le=100, allow_inf_nan=False), NUMBER] = Field(
        2.0,
        description="How far `refine` looks beyond the ends of the values that are given, as a "
        "factor on k* or speed (-). 1: not at all.",
    )

    taken: dict[ModelName, str] = Field(
        {},
        description="Models whose results are those of another run, beside the ones run here: the "
        "index of them (`results/<run>/unsteady/<model>/sweep.json`) by the model's name.",
    )

    @model_validator(mode="before")
    @classmethod
    def _speed_in_the_place_of_k_star(cls, data: Any) -> Any:
        """Leave the default k* out where speeds are given."""
        if isinstance(data, dict) and data.get("speed") is not None and "k_star" not in data:
            return {**data, "k_star": None}
        return data

    @property
    def shown(self) -> tuple[str, ...]:
        """The models that are compared: those run, then those taken."""
        return (*self.models, *self.taken)

    def values(self) -> tuple[float, ...]:
        """Return the values of k*, or of the speed (m/s), ascending."""
        given = self.k_star if self.speed is None else self.speed
        if given is None:  # the check below refuses it
            return ()
        return given.values() if isinstance(given, Range) else tuple(sorted(given))


@check("sweep.incidence_deg")
def _distinct_incidences(angles: tuple[float, ...]) -> Iterator[Problem]:
    yield from _distinct("sweep.incidence_deg", "incidence", angles)


@check("sweep.k_star")
def _distinct_k_star(k_star: tuple[float, ...] | Range | None) -> Iterator[Problem]:
    yield from _distinct("sweep.k_star", "k*", k_star)


@check("sweep.speed")
def _distinct_speeds(speed: tuple[float, ...] | Range | None) -> Iterator[Problem]:
    yield from _distinct("sweep.speed", "speed", speed)


def _distinct(key: str, word: str, given: tuple[float, ...] | Range | None) -> Iterator[Problem]:
    if isinstance(given, Range):
        yield from _distinct_in_range(key, given)
        return
    names: set[str] = set()
    for place, value in enumerate(given or ()):
        name = f"{value:.6g}"
        if name in names:
            yield Problem(
                f"{key}.{place}",
                value,
                f"allowed is each {word} once; {name} stands before it, and the first six digits "
                "name the files of a case",
            )
        names.add(name)


def _distinct_in_range(key: str, given: Range) -> Iterator[Problem]:
    if not given.stop > given.start:
        yield Problem(
            f"{key}.stop", given.stop, f"allowed is a number above start, {given.start:g}"
        )
    elif len({f"{value:.6g}" for value in given.values()}) < given.number:
        yield Problem(
            f"{key}.number",
            given.number,
            f"allowed are fewer values, so that those between {given.start:g} and "
            f"{given.stop:g} differ in the first six digits, which name the files of a case",
        )


@check("sweep.k_star", "sweep.speed", "sweep.incidence_deg")
def _not_too_many_cases(
    k_star: tuple[float, ...] | Range | None,
    speed: tuple[float, ...] | Range | None,
    angles: tuple[float, ...],
) -> Iterator[Problem]:
    key, given = ("sweep.k_star", k_star) if speed is None else ("sweep.speed", speed)
    values = given.number if isinstance(given, Range) else len(given or ())
    number = values * max(len(angles), 1)
    if number > MOST_CASES:
        yield Problem(
            f"{key}.number" if isinstance(given, Range) else key,
            values,
            f"allowed are up to {MOST_CASES:,} cases of a model, and these values at "
            f"{max(len(angles), 1)} incidences are {number:,}; take fewer",
        )


@check("sweep.k_star", "sweep.speed")
def _one_of_both(
    k_star: tuple[float, ...] | Range | None, speed: tuple[float, ...] | Range | None
) -> Iterator[Problem]:
    if k_star is None and speed is None:
        yield Problem("sweep.k_star", None, "allowed is null with sweep.speed alone")
    elif k_star is not None and speed is not None:
        yield Problem(
            "sweep.speed",
            list(speed) if isinstance(speed, tuple) else speed.model_dump(),
            "allowed is one of sweep.k_star and sweep.speed; sweep.k_star: null takes away the "
            "one of another file",
        )


@check("sweep.k_star", "sweep.speed", "sweep.onset")
def _two_to_refine(
    k_star: tuple[float, ...] | Range | None,
    speed: tuple[float, ...] | Range | None,
    onset: str,
) -> Iterator[Problem]:
    for key, word, given in (("k_star", "k*", k_star), ("speed", "speeds", speed)):
        if onset == "refine" and isinstance(given, tuple) and len(given) < 2:
            yield Problem(
                f"sweep.{key}",
                list(given),
                f"allowed with sweep.onset 'refine' are two {word} or more",
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
