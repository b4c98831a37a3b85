"""Block diagram of the workflow: boxes of the paper's Fig. 1, with the rules that they are here.

``python docs/workflow_drawing.py`` draws it anew, where rules have changed their names.
"""

from pathlib import Path
from typing import NamedTuple

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch

from equisection.figures.save import save_figure
from equisection.figures.style import GREY, drawing_style

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "workflow" / "report"
#: Colours of a box and of its edge, by what it is about.
COLOURS = {
    "given": ("#FFFFFF", "#808080"),
    "structure": ("#DCEBF5", "#0072B2"),
    "steady": ("#FBEBCB", "#B97F00"),
    "section": ("#D6EFE6", "#009E73"),
    "unsteady": ("#F8DFD0", "#D55E00"),
    "end": ("#F3DEEA", "#A8598A"),
}
WIDTH, HEIGHT = 1.74, 0.62


class Box(NamedTuple):
    """A box: its place (in), what it is about, its title, and the rules that make it."""

    x: float
    y: float
    about: str
    title: str
    rules: tuple[str, ...] = ()


STEADY, UNSTEADY = ("steady_cases", "steady_batch"), ("unsteady_cases", "unsteady_batch")
BOXES = {
    "beam": Box(0.0, 5.0, "given", "beam, flow and\nsection polar"),
    "modes": Box(-2.8, 4.0, "structure", "modes of the beam", ("modes",)),
    "polar_2d": Box(0.0, 4.0, "steady", "steady 2D polar", (*STEADY, "polar")),
    "polar_3d": Box(2.6, 4.0, "steady", "steady 3D polar", (*STEADY, "polar")),
    "section": Box(-1.5, 3.0, "section", "equivalent section", ("equivalent_section",)),
    "factors": Box(1.3, 3.0, "steady", "correction factors", ("correction_factors",)),
    "2d": Box(-1.5, 2.0, "unsteady", "unsteady 2D", UNSTEADY),
    "2d-corrected": Box(1.3, 2.0, "unsteady", "unsteady 2D, corrected", UNSTEADY),
    "3d": Box(-3.4, 2.0, "unsteady", "unsteady 3D", UNSTEADY),
    "onset": Box(-1.5, 1.0, "end", "comparison, onset", ("summary", "onset")),
    "figures": Box(1.3, 1.0, "end", "figures", ("response", "growth_rate", "…")),
}
ARROWS = (
    *(("beam", "modes"), ("beam", "polar_2d"), ("beam", "polar_3d"), ("modes", "section")),
    *(("polar_2d", "factors"), ("polar_3d", "factors"), ("section", "2d"), ("modes", "3d")),
    *(("section", "2d-corrected"), ("factors", "2d-corrected"), ("2d", "onset")),
    *(("2d-corrected", "onset"), ("3d", "onset"), ("onset", "figures")),
)


def draw() -> Figure:
    """Draw the boxes and what flows between them."""
    figure = Figure(figsize=(7.1, 4.3))
    axes = figure.subplots()
    axes.set(xlim=(-4.3, 3.5), ylim=(0.6, 5.4))
    axes.set_axis_off()
    for start, end in ARROWS:
        _arrow(axes, BOXES[start], BOXES[end])
    for box in BOXES.values():
        fill, edge = COLOURS[box.about]
        corner = (box.x - WIDTH / 2, box.y - HEIGHT / 2)
        axes.add_patch(
            FancyBboxPatch(
                corner, WIDTH, HEIGHT, "round,pad=0,rounding_size=0.06", fc=fill, ec=edge, zorder=2
            )
        )
        middle = box.y + (0.12 if box.rules else 0.0)
        axes.text(box.x, middle, box.title, ha="center", va="center", weight="bold", zorder=3)
        rules = ", ".join(box.rules).replace(", ", ",\n", 1 if len(box.rules) > 1 else 0)
        axes.text(
            box.x, middle - 0.12, rules, ha="center", va="top", size=5.8, linespacing=1.0, zorder=3
        )
    return figure


def _arrow(axes: Axes, start: Box, end: Box) -> None:
    if start.y == end.y:
        tail, head = (start.x + WIDTH / 2, start.y), (end.x - WIDTH / 2, end.y)
    else:
        tail, head = (start.x, start.y - HEIGHT / 2), (end.x, end.y + HEIGHT / 2)
    axes.annotate(
        "", head, tail, arrowprops={"arrowstyle": "-|>", "color": GREY, "lw": 0.8}, zorder=1
    )


if __name__ == "__main__":
    with drawing_style(ROOT / "envs" / "equisection.mplstyle"):
        save_figure(draw(), [FOLDER / f"workflow.{suffix}" for suffix in ("png", "svg", "pdf")])
