"""Style of every figure: the style file, widths, and colours by their names."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Literal

import matplotlib

#: A line style: solid, dotted, or an offset and the lengths of dashes and gaps (points).
Dash = Literal["-", ":"] | tuple[float, tuple[float, ...]]

#: Width of a full page (in).
PAGE_WIDTH = 7.1

#: Colours of Okabe & Ito (2008), told apart by colour-blind readers.
BLACK = "#000000"
ORANGE = "#E69F00"
SKY = "#56B4E9"
GREEN = "#009E73"
BLUE = "#0072B2"
VERMILLION = "#D55E00"
PURPLE = "#CC79A7"

#: Text and lines that stand behind the data.
GREY = "#606060"
LIGHT_GREY = "#D3D3D3"

#: Line styles of a series, in the order of the colours of the style file.
DASHES: tuple[Dash, ...] = (
    "-",
    (0, (5, 1.6)),
    (0, (2.2, 1.2)),
    (0, (6, 1.4, 1.2, 1.4)),
    (0, (1, 1)),
    (0, (8, 2)),
    (0, (3, 1, 1, 1, 1, 1)),
)
#: Colours of a series, those of the style file.
COLOURS = (BLACK, VERMILLION, BLUE, GREEN, PURPLE, ORANGE, SKY)
#: Markers of a series.
MARKERS = ("o", "s", "^", "D", "v", "P", "X")


@contextmanager
def drawing_style(path: Path) -> Iterator[None]:
    """Draw and save inside this block in the style of a file, whatever the user's own is."""
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rcParams.update(matplotlib.rc_params_from_file(path, use_default_template=False))
        yield
