"""Drawings of the examples of the gallery: the beam from above, and its section in the wind.

    python docs/drawings/examples.py docs/gallery      # or: make drawing

Supports, axes and lengths are those of the configurations; the span is drawn shorter than it is.
"""

from __future__ import annotations

import argparse
import math
from pathlib import Path
from typing import Any

import yaml
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Polygon, Rectangle

from equisection.beam.beam import Beam
from equisection.config.groups.flow import Flow
from equisection.figures.save import save_figure
from equisection.figures.style import BLUE, GREY, LIGHT_GREY, VERMILLION, drawing_style

ROOT = Path(__file__).parents[2]
#: Configuration of each example, by the name that `equisection init --like` has for it.
EXAMPLES = {
    "tracker": "config/examples/tracker_over_tilt.yaml",
    "bridge": "config/examples/bridge_deck.yaml",
    "wing": "config/examples/goland_wing.yaml",
    "plate": "config/examples/plate_over_incidence.yaml",
}
#: Span and chord from above, and chord of the section, on the page (in).
SPAN, DEPTH, SECTION = 3.1, 0.72, 1.5
HEIGHT = 1.75
#: Places on the page: left end and middle of the beam, elastic axis of the section.
ROOT_END, MIDDLE, AXIS = 0.45, 0.82, (5.65, 0.82)
BODY = "#D6E6F2"


def draw(beam: Beam, incidence_deg: float) -> Figure:
    """Draw a beam from above and its section from its root, at a rigid incidence (deg)."""
    figure = Figure(figsize=(7.1, HEIGHT))
    axes = figure.subplots()
    axes.set(xlim=(0, 7.1), ylim=(0, HEIGHT), aspect="equal")
    axes.set_axis_off()
    _from_above(axes, beam)
    _section(axes, beam, incidence_deg)
    return figure


def _from_above(axes: Axes, beam: Beam) -> None:
    leading = MIDDLE - 0.5 * DEPTH
    axes.add_patch(Rectangle((ROOT_END, leading), SPAN, DEPTH, fc=BODY, ec=BLUE, lw=1.0))
    elastic, mass = (leading + at * DEPTH for at in (beam.elastic_axis, beam.mass_axis))
    ends = [ROOT_END, ROOT_END + SPAN]
    axes.plot(ends, [elastic, elastic], color="black", lw=0.9, dashes=(6, 2), zorder=3)
    if mass != elastic:
        axes.plot(ends, [mass, mass], color=VERMILLION, lw=0.9, dashes=(2, 2), zorder=3)
    for x, name in zip(ends, beam.boundary.split("-"), strict=False):
        _end(axes, x, name, elastic, leading)
    for support in beam.supports:
        x = ROOT_END + support.at * SPAN
        holds_twist = support.twist == "fixed"
        axes.plot(x, elastic, marker="s" if holds_twist else "o", ms=7 if holds_twist else 5,
                  mfc="black" if holds_twist else "white", mec="black", zorder=4)  # fmt: skip
    for x in (ROOT_END + part * SPAN for part in (0.15, 0.5, 0.85)):
        _arrow(axes, (x, 0.1), (x, 0.4))
    axes.text(ROOT_END + 0.18 * SPAN, 0.2, "wind", color=GREY, va="center")
    top = leading + DEPTH + 0.2
    _arrow(axes, (ends[0], top), (ends[1], top), "<|-|>", 0.6)
    axes.text(sum(ends) / 2, top + 0.14, f"span {beam.length:g} m", ha="center", va="center")
    _arrow(axes, (ends[1] + 0.28, leading), (ends[1] + 0.28, leading + DEPTH), "<|-|>", 0.6)
    axes.text(ends[1] + 0.34, MIDDLE, f"{beam.chord:g} m", va="center")


def _end(axes: Axes, x: float, name: str, elastic: float, leading: float) -> None:
    """Draw what holds an end: a wall, a fork, or nothing."""
    outwards = -1.0 if x == ROOT_END else 1.0
    if name == "clamped":
        left = x if outwards > 0.0 else x - 0.12
        axes.add_patch(
            Rectangle(
                (left, leading - 0.12), 0.12, DEPTH + 0.24, fc="white", ec=GREY, hatch="/////"
            )
        )
    elif name == "pinned":
        tip, foot = (x, elastic), x + 0.2 * outwards
        corners = [tip, (foot, elastic + 0.13), (foot, elastic - 0.13)]
        axes.add_patch(Polygon(corners, fc="white", ec="black", zorder=4))


def _section(axes: Axes, beam: Beam, incidence_deg: float) -> None:
    angle = math.radians(incidence_deg)
    half = 0.5 * max(beam.thickness / beam.chord, 0.04) * SECTION

    def place(along: float, up: float) -> tuple[float, float]:
        """Return a point by its place on the chord (x/c) and its height above it (in)."""
        x = (along - beam.elastic_axis) * SECTION
        cos, sin = math.cos(angle), math.sin(angle)
        return AXIS[0] + x * cos + up * sin, AXIS[1] - x * sin + up * cos

    corners = [place(0, half), place(1, half), place(1, -half), place(0, -half)]
    axes.plot([4.85, 6.95], [AXIS[1], AXIS[1]], color=LIGHT_GREY, lw=0.8, zorder=0)
    axes.add_patch(Polygon(corners, fc=BODY, ec=BLUE, lw=1.0))
    axes.plot(*AXIS, marker="o", ms=5, mfc="white", mec="black", zorder=4)
    axes.text(AXIS[0], AXIS[1] - 0.45, "elastic axis", ha="center", va="center")
    if beam.mass_axis != beam.elastic_axis:
        centre = place(beam.mass_axis, 0.0)
        axes.plot(*centre, marker="o", ms=4, color=VERMILLION, zorder=4)
        axes.text(centre[0] + 0.1, centre[1] + 0.3, "centre of mass", color=VERMILLION, va="center")
    _arrow(axes, (4.25, 1.2), (4.65, 1.2))
    axes.text(4.25, 1.36, "wind", color=GREY, va="center")
    axes.text(6.95, AXIS[1] - 0.2, f"{incidence_deg:g} deg", ha="right", va="center")


def _arrow(axes: Axes, start: Any, end: Any, style: str = "-|>", width: float = 1.1) -> None:
    look = {"arrowstyle": style, "color": GREY, "lw": width, "shrinkA": 0, "shrinkB": 0}
    axes.annotate("", end, start, arrowprops=look)


def main(folder: Path) -> None:
    """Write the drawing of each example to a folder."""
    with drawing_style(ROOT / "envs" / "equisection.mplstyle"):
        for name, path in EXAMPLES.items():
            keys = yaml.safe_load((ROOT / path).read_text(encoding="utf-8"))
            beam = Beam.from_yaml(ROOT / path) if "beam" in keys else Beam()
            figure = draw(beam, float(keys["flow"].get("incidence_deg", Flow().incidence_deg)))
            save_figure(figure, [folder / f"{name}-drawing.png"])


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Draw the examples of the gallery.")
    parser.add_argument("folder", type=Path, help="where the pictures go, such as docs/gallery")
    main(parser.parse_args().folder)
