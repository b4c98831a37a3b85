"""Section ``derivatives``: flutter derivatives of the section, measured or computed."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from equisection.keys.group import KeyGroup
from equisection.keys.values import EMPTY


class DerivativeKeys(KeyGroup):
    """Flutter derivatives, from which the onset follows without a run in time."""

    table: Annotated[str, EMPTY] = Field(
        "",
        description="Table of flutter derivatives H1 to A4 over the reduced velocity (CSV file, "
        "which says its convention; path from the working directory, or one of the project's). "
        "Its onset stands in `comparison/critical_speed.csv`, with the basis `derivatives`. "
        "Empty for none.",
    )
