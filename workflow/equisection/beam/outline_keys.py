"""Keys of the outline (``beam.outline``), and the outline that they give.

The modules with the shapes are imported where they are called, since every start of the workflow
reads the keys.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from pydantic import BeforeValidator, Field

from equisection.errors import OutlineError
from equisection.keys.checks import Problem, check
from equisection.keys.group import KeyGroup
from equisection.keys.values import EMPTY, NULLABLE, NotNegative, Number, Positive

if TYPE_CHECKING:
    from equisection.beam.outline import Outline


#: x and y.
Place = Annotated[tuple[Number, ...], Field(min_length=2, max_length=2)]


def _digits(value: object) -> object:
    """Return digits as text; YAML reads 0012 without quotes as another number."""
    if isinstance(value, int) and not isinstance(value, bool):
        if value < 1000:
            raise ValueError("not in quotes")
        return str(value)
    return "" if value is None else value


class RoundedRectangle(KeyGroup):
    """A rectangle, its edges rounded."""

    thickness: Annotated[Positive | None, NULLABLE] = Field(
        None, description="Thickness (m); `null` is `beam.thickness`."
    )
    edge_radius: NotNegative = Field(
        0.0, description="Radius of the edges (m), up to half the thickness."
    )


class OutlineKeys(KeyGroup):
    """Outline of the section in the flow, for OpenFOAM: one of rectangle, NACA section and file."""

    rectangle: Annotated[RoundedRectangle | None, NULLABLE] = Field(
        None, description="A rectangle with rounded edges."
    )
    naca: Annotated[str, BeforeValidator(_digits)] = Field(
        "", description="Digits of a four-digit NACA section, in quotes: `'0012'`."
    )
    file: Annotated[str, EMPTY] = Field(
        "",
        description="File with the points: `.dat` of an airfoil (Selig or Lednicer; smooth but for "
        "its trailing edge) or `.csv` with the corners `x,y` of a polygon; either way round, open "
        "or closed, x aft and y up, in any unit.",
    )
    chord: Annotated[Positive | None, NULLABLE] = Field(
        None, description="The chord in the file's unit; `null` is the extent along x."
    )
    axis: Annotated[Place | None, NULLABLE] = Field(
        None,
        description="Place `[x, y]` of the elastic axis in the file's unit, such as a torque "
        "tube's below its panel. `null`: at `beam.elastic_axis` of the chord, and y = 0.",
    )

    @property
    def given(self) -> tuple[str, ...]:
        """Keys of the shape that are given."""
        there = {"rectangle": self.rectangle is not None, "naca": self.naca, "file": self.file}
        return tuple(key for key, is_there in there.items() if is_there)

    @property
    def is_symmetric(self) -> bool:
        """Tell whether it is symmetric about the chord for certain; that in a file may be."""
        return not self.file and not (self.naca and not self.naca.startswith("00"))

    def outline(
        self, chord: float, thickness: float, elastic_axis: float, directory: Path = Path()
    ) -> Outline:
        """Return the outline over the chord.

        Parameters
        ----------
        chord, thickness
            Those of the beam (m).
        elastic_axis
            Place of the elastic axis (x/c from the leading edge).
        directory
            Folder that the file is seen from.

        Raises
        ------
        OutlineError
            The file cannot be read, or the outline not be used.
        """
        from equisection.beam import outline as shapes  # noqa: PLC0415
        from equisection.io.outline_file import read_outline  # noqa: PLC0415

        if self.rectangle is not None:
            own = self.rectangle
            height = thickness if own.thickness is None else own.thickness
            return shapes.outline_of(shapes.rectangle(height / chord, own.edge_radius / chord))
        if self.naca:
            return shapes.outline_of(shapes.placed(shapes.naca(self.naca), 1.0), is_airfoil=True)
        found = read_outline(directory / self.file)
        axis = None if self.axis is None else (self.axis[0], self.axis[1], elastic_axis)
        try:
            points = shapes.placed(found.points, self.chord, axis)
            return shapes.outline_of(points, is_airfoil=found.is_airfoil)
        except OutlineError as error:
            raise OutlineError(f"{self.file}: {error}") from None


@check("beam.outline")
def _one_shape(outline: OutlineKeys | None) -> Iterator[Problem]:
    if outline is None:
        return
    if len(outline.given) != 1:
        yield Problem(
            "beam.outline",
            ", ".join(outline.given) or "no shape",
            "allowed is one of rectangle, naca and file",
        )
        return
    for key in ("chord", "axis"):
        if getattr(outline, key) is not None and not outline.file:
            yield Problem(
                f"beam.outline.{key}",
                getattr(outline, key),
                "allowed is null without beam.outline.file, in whose unit it is",
            )


@check("beam.outline", "beam.chord", "beam.thickness")
def _shape_without_a_file(
    outline: OutlineKeys | None, chord: float, thickness: float
) -> Iterator[Problem]:
    """Refuse digits that are no section, and edges that are no circle."""
    if outline is None or len(outline.given) != 1 or outline.file:
        return
    from equisection.beam import outline as shapes  # noqa: PLC0415

    own = outline.rectangle
    try:
        if own is not None:
            shapes.rectangle((own.thickness or thickness) / chord, own.edge_radius / chord)
        else:
            shapes.naca(outline.naca)
    except OutlineError as error:
        if own is not None:
            yield Problem("beam.outline.rectangle.edge_radius", own.edge_radius, str(error))
        else:
            yield Problem("beam.outline.naca", outline.naca, str(error))
