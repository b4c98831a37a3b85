"""Figures as files: the same data gives the same bytes, and a file is whole or not there."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib
from matplotlib.figure import Figure

import equisection
from equisection.errors import EquisectionError
from equisection.figures.panels import nothing_drawn
from equisection.files import written_whole

logger = logging.getLogger(__name__)
logging.getLogger("fontTools").setLevel(logging.WARNING)  # it tells of every glyph it embeds

_MADE_BY = f"equisection {equisection.__version__}"
#: Keyword of a PNG's text that says why nothing is drawn (PNG specification, textual keywords).
WARNING = "Warning"
#: What each format says about itself; dates would make every drawing differ.
_METADATA: dict[str, dict[str, Any]] = {
    "png": {"Software": _MADE_BY},
    "svg": {"Date": None, "Creator": _MADE_BY},
    "pdf": {"CreationDate": None, "Creator": _MADE_BY, "Producer": None},
}


class FigureFormatError(EquisectionError):
    """A figure is asked for in a format that is not written here."""


def save_figure(figure: Figure, paths: Sequence[Path]) -> None:
    """Write a figure to each path, in the format of its suffix.

    The PNG of a figure that shows nothing says why (:data:`.WARNING`), for a page to leave it out.

    Raises
    ------
    FigureFormatError
        A suffix is not ``.png``, ``.svg`` or ``.pdf``.
    """
    unknown = [path for path in paths if path.suffix.removeprefix(".") not in _METADATA]
    if unknown:
        raise FigureFormatError(
            f"{unknown[0]}: format '{unknown[0].suffix.removeprefix('.')}' is not written here; "
            f"{', '.join(_METADATA)} are"
        )
    empty = nothing_drawn(figure)
    said = {name: {WARNING: empty} if empty and name == "png" else {} for name in _METADATA}
    figure.draw_without_rendering()  # lays the panels out, which costs more than drawing them
    # Matplotlib lays out anew for each file, also where only the style asks for a layout engine.
    with matplotlib.rc_context({"figure.constrained_layout.use": False}):
        figure.set_layout_engine(None)
        for path in paths:
            suffix = path.suffix.removeprefix(".")
            with written_whole(path) as aside:
                figure.savefig(aside, format=suffix, metadata=_METADATA[suffix] | said[suffix])
            logger.info("%s", path)
