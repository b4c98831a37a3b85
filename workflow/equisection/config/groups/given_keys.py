"""Section ``given``: histories and polars of another program or a wind tunnel."""

from __future__ import annotations

import glob
import re
from collections.abc import Iterable, Iterator
from typing import Annotated, Literal

from pydantic import Field

from equisection.config.groups.solver_keys import SolverKeys
from equisection.config.groups.sweep import Range
from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import EMPTY, NULLABLE, NUMBER, WHOLE, Name, Number, Positive, Truth

#: Placeholders of the path of histories.
PLACEHOLDERS = ("model", "case", "k_star", "speed", "incidence_deg")
#: Placeholders of the path of forced motions.
OF_FORCED = ("case", "component", "reduced_velocity", "incidence_deg")
#: A placeholder in a path.
PLACEHOLDER = re.compile(r"\{(\w*)\}")

_Text = Annotated[str, Field(min_length=1)]
_Place = Annotated[
    Annotated[float, Field(ge=0, le=1, allow_inf_nan=False), NUMBER] | None, NULLABLE
]
_Sign = Annotated[int, Field(ge=-1, le=1), WHOLE]


class GivenColumns(KeyGroup):
    """Names of the columns of a history, as its line of names has them."""

    time: _Text = Field("time", description="Column of the time.")
    twist: _Text = Field(
        "twist", description="Column of the twist, counted from the rigid section."
    )
    deflection: _Text = Field("deflection", description="Column of the deflection.")
    lift: _Text = Field("lift", description="Column of the lift, across the stream.")
    moment: _Text = Field("moment", description="Column of the moment.")
    drag: Annotated[str, EMPTY] = Field(
        "",
        description="Column of the drag, which moves a moment to another axis with the lift; "
        "empty for none.",
    )


class GivenUnits(KeyGroup):
    """Units of the columns; `b` is the semi-chord, and 1 a coefficient over q c or q c²."""

    time: Literal["s", "ms", "c/V", "b/V"] = Field("s", description="Unit of the time.")
    twist: Literal["rad", "deg"] = Field("rad", description="Unit of the twist.")
    deflection: Literal["m", "mm", "c", "b"] = Field("m", description="Unit of the deflection.")
    lift: Literal["N", "N/m", "1"] = Field("N/m", description="Unit of the lift.")
    moment: Literal["N m", "N m/m", "1"] = Field("N m/m", description="Unit of the moment.")
    drag: Literal["N", "N/m", "1"] = Field("N/m", description="Unit of the drag.")


class GivenSigns(KeyGroup):
    """Signs of the columns: 1, or -1 where positive is the other way."""

    twist: _Sign = Field(1, description="1 nose up, -1 nose down.")
    deflection: _Sign = Field(1, description="1 up, -1 down.")
    lift: _Sign = Field(1, description="1 up, -1 down.")
    moment: _Sign = Field(1, description="1 nose up, -1 nose down.")


class Given(SolverKeys):
    """Histories and polars from files, of sections."""

    histories: Annotated[str, EMPTY] = Field(
        "",
        description="Path of the history of each release, with `{model}` and `{case}` (such as "
        "`k6.44`), or `{k_star}`, `{speed}`, `{incidence_deg}`, in their places: "
        "`data/{model}/k{k_star}.csv`. A release without a file is named in "
        "`comparison/missing.csv`, and the others go on.",
    )
    forced: Annotated[str, EMPTY] = Field(
        "",
        description="Path of the history of each forced motion, with `{case}` (`pitch` and "
        "`heave`, or `pitch_v12` with `forced.motion: harmonic`), or `{component}`, "
        "`{reduced_velocity}`, `{incidence_deg}`, in their places: `data/forced/{case}.csv`. "
        "Columns, units and signs are those of the releases.",
    )
    polars: dict[Name, _Text] = Field(
        {},
        description="Section polar of each resolution, in a format of `embedded.polars`.",
    )
    symmetric: Truth = Field(
        True, description="Whether the section is symmetric, as `embedded.symmetric`."
    )
    polar_moment_axis: _Place = Field(
        None,
        description="Point that moments of the polars are about, as `embedded.moment_axis`.",
    )
    basis: Literal["cfd", "experiment", "time"] = Field(
        "cfd",
        description="What the histories are: `cfd`, `experiment` (a wind tunnel), or `time` (a "
        "computation in time with loads of the motion alone, such as strips or a vortex lattice: "
        "no vortices of the section's own beat with the motion). `comparison/critical_speed.csv` "
        "says so.",
    )
    source: Annotated[str, EMPTY] = Field(
        "",
        description="Program or wind tunnel that they are from, in words, as figures show it; "
        "empty for not said.",
    )
    columns: GivenColumns = Field(GivenColumns(), description="Columns of the histories.")
    units: GivenUnits = Field(GivenUnits(), description="Units of the histories.")
    signs: GivenSigns = Field(GivenSigns(), description="Signs of the histories.")
    span: Positive = Field(
        1.0, description="Length of the section that forces in N, and moments in N m, are of (m)."
    )
    moment_axis: _Place = Field(
        None,
        description="Point that the recorded moments are about, which moves with the section (x/c "
        "from the leading edge). With null it is the elastic axis.",
    )
    deflection_axis: _Place = Field(
        None,
        description="Point whose deflection is recorded (x/c from the leading edge). With null it "
        "is the elastic axis.",
    )
    release: Annotated[Number | None, NULLABLE] = Field(
        None,
        description="Time of the release, in the unit of the time column; earlier lines are left "
        "out. With null it is the first line.",
    )

    @property
    def said_basis(self) -> str:
        """Basis of the histories: CFD, experiment, or another computation."""
        return self.basis

    def input_files(self) -> list[str]:
        """Return polars and the histories that are there."""
        patterns = [PLACEHOLDER.sub("*", _escaped(path)) for path in (self.histories, self.forced)]
        found = {path for one in patterns for path in glob.glob(one)}  # noqa: PTH207, of any root
        return [*self.polars.values(), *sorted(found)]


def _escaped(path: str) -> str:
    """Return a path in which nothing but its placeholders is a pattern."""
    return re.sub(r"([\[?*])", r"[\1]", path)


@check("given.histories", "solver", "forced.run")
def _names_histories(histories: str, solver: str, forced: bool) -> Iterator[Problem]:
    if solver != "given" or (forced and not histories):
        return
    if not _is_path(histories, PLACEHOLDERS):
        yield Problem(
            "given.histories",
            histories,
            f"allowed with solver 'given' is a path with {_in_braces(PLACEHOLDERS)} in it, such as "
            "data/{model}/{case}.csv",
        )


def _is_path(path: str, placeholders: tuple[str, ...]) -> bool:
    """Tell whether a path is there and has no other braces than placeholders."""
    wrong = [name for name in PLACEHOLDER.findall(path) if name not in placeholders]
    return bool(path) and not wrong and not {"{", "}"} & set(PLACEHOLDER.sub("", path))


def _in_braces(placeholders: Iterable[str]) -> str:
    return ", ".join(f"{{{name}}}" for name in placeholders)


@check(
    "given.histories",
    "solver",
    "sweep.models",
    "sweep.k_star",
    "sweep.speed",
    "sweep.incidence_deg",
)
def _history_of_each(
    histories: str, solver: str, models: tuple[str, ...], *axes: tuple[float, ...] | Range | None
) -> Iterator[Problem]:
    """Refuse a path that names one file for several releases."""
    if solver != "given" or not histories:
        return
    there = set(PLACEHOLDER.findall(histories))
    lacks = [] if len(models) == 1 or "model" in there else ["model"]
    for name, values in zip(PLACEHOLDERS[2:], axes, strict=True):
        several = isinstance(values, Range) or len(values or ()) > 1
        if several and not there & {"case", name}:
            lacks.append(name)
    if lacks:
        yield Problem(
            "given.histories",
            histories,
            f"allowed is a path with {_in_braces(lacks)} in it, of which this study has several, "
            "such as data/{model}/{case}.csv: each release has a file of its own",
        )


@check("given.polars", "steady.resolution", "steady.study", "solver")
def _polar_of_each(
    polars: dict[str, str], resolution: str, study: tuple[str, ...], solver: str
) -> Iterator[Problem]:
    if solver != "given":
        return
    for key, name in (
        ("steady.resolution", resolution),
        *((f"steady.study.{place}", one) for place, one in enumerate(study)),
    ):
        if name not in polars:
            there = ", ".join(sorted(polars)) or "none yet: write given.polars: {name: file}"
            yield Problem(
                key, name, f"allowed with solver 'given' is a name in given.polars: {there}"
            )


@check(
    "given.signs.twist",
    "given.signs.deflection",
    "given.signs.lift",
    "given.signs.moment",
)
def _signs_are_not_zero(twist: int, deflection: int, lift: int, moment: int) -> Iterator[Problem]:
    of = {"twist": twist, "deflection": deflection, "lift": lift, "moment": moment}
    for name, sign in of.items():
        if sign == 0:
            yield Problem(f"given.signs.{name}", sign, "allowed is 1 or -1")


@check("solver", "forced.run", "given.forced", "forced.beam_modes")
def _names_forced_motions(
    solver: str, run: bool, forced: str, beam_modes: int
) -> Iterator[Problem]:
    """Refuse motions that nobody has recorded."""
    if solver != "given" or not run:
        return
    if not _is_path(forced, OF_FORCED):
        yield Problem(
            "given.forced",
            forced,
            f"allowed with solver 'given' and forced.run is a path with {_in_braces(OF_FORCED)} in "
            "it, such as data/forced/{case}.csv; a table of flutter derivatives goes into "
            "derivatives.table",
        )
    if beam_modes:
        yield Problem(
            "forced.beam_modes", beam_modes, "allowed with solver 'given' is 0, the section alone"
        )


@check("solver", "sweep.onset")
def _no_further_releases(solver: str, onset: str) -> Iterator[Problem]:
    """Refuse rounds of runs that nobody has recorded."""
    if solver == "given" and onset != "sweep":
        yield Problem(
            "sweep.onset",
            onset,
            "allowed with solver 'given' is 'sweep': other values choose further releases, which "
            "no file has",
        )
