"""Drawing of the beam and of its equivalent section: springs, axes and signs.

    python docs/drawings/beam_and_section.py docs/beam-and-section.svg      # or: make drawing

Lengths are inches of the page. Twist and deflection are drawn larger than life.
"""

from __future__ import annotations

import argparse
import math
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

import matplotlib
import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Circle, FancyArrowPatch, Polygon, Rectangle, Wedge
from numpy.typing import NDArray
from scipy.spatial import ConvexHull

Points = NDArray[np.float64]

WIDTH, HEIGHT = 9.4, 4.9
#: Places along the chord, x/c from the leading edge.
ELASTIC_AXIS, MID_CHORD, MASS_AXIS = 0.3, 0.5, 0.7
#: Rigid incidence and, of the section, twist (rad).
INCIDENCE, TWIST = math.radians(8.0), math.radians(12.0)
#: The beam, with twist and deflection of its tip.
CHORD, SPAN, TIP_TWIST, TIP_DEFLECTION = 1.38, 3.6, math.radians(11.0), 1.0

# Okabe & Ito (2008), the green darkened for text: told apart by colour-blind readers
BLUE, RED, GREEN, GREY = "#0072B2", "#C04F00", "#00785A", "#595959"
BODY, TIP_FACE, GHOST, WALL = "#D6E6F2", "#A9CBE3", "#8C8C8C", "#EFEFEF"
DASHED = (0, (4, 2))


# --- what is drawn with ---


def vector(*components: float) -> Points:
    """Return components as a vector."""
    return np.array(components)


def outline(chord: float) -> Points:
    """Return the contour of a NACA 0011 section, nose left, about its elastic axis."""
    x = 0.5 * (1.0 - np.cos(np.linspace(0.0, math.pi, 30)))
    terms = 0.2969 * np.sqrt(x) - 0.126 * x - 0.3516 * x**2 + 0.2843 * x**3 - 0.1036 * x**4
    upper = np.column_stack([x - ELASTIC_AXIS, 0.55 * terms])
    return chord * np.vstack([upper[::-1], upper[1:] * [1.0, -1.0]])


def on_chord(chord: float, place: float) -> Points:
    """Return the point at ``place`` (x/c) of the chord line, about the elastic axis."""
    return vector(chord * (place - ELASTIC_AXIS), 0.0)


def nose_up(points: Points, angle: float) -> Points:
    """Turn points about the elastic axis by an angle (rad), nose up: clockwise on the page."""
    cos, sin = math.cos(angle), math.sin(angle)
    turned: Points = points @ np.array([[cos, -sin], [sin, cos]])
    return turned


def line(ax: Axes, points: Sequence[Points] | Points, colour: str = "black", **look: Any) -> None:
    """Draw a line through points."""
    x, y = np.transpose(points)
    ax.plot(x, y, **{"color": colour, "linewidth": 1.2, "solid_capstyle": "butt", **look})


def arrow(ax: Axes, start: Points, end: Points, colour: str = "black", style: str = "-|>") -> None:
    """Draw an arrow, in bold; or thin with a head at each end, as for a dimension."""
    size, width = (10.0, 1.4) if style == "-|>" else (7.0, 0.8)
    head = FancyArrowPatch(
        tuple(start), tuple(end), arrowstyle=style, mutation_scale=size, shrinkA=0, shrinkB=0
    )
    head.set(color=colour, linewidth=width, zorder=6)
    ax.add_patch(head)


def dimension(ax: Axes, start: Points, end: Points) -> None:
    """Draw the line of a dimension."""
    arrow(ax, start, end, GREY, "<|-|>")


def turn(ax: Axes, arc: Points, colour: str) -> None:
    """Draw a curved arrow through the points of an arc."""
    line(ax, arc[:-3], colour, linewidth=1.4, zorder=6)
    arrow(ax, arc[-8], arc[-1], colour)


def arc_about(centre: Points, radius: float, start: float, end: float) -> Points:
    """Return points of an arc between two angles (deg), counted nose up from the nose's side."""
    angles = np.radians(np.linspace(start, end, 40))
    return centre + radius * np.column_stack([-np.cos(angles), np.sin(angles)])


def label(ax: Axes, at: Points, text: str, colour: str = "black", align: str = "center") -> None:
    """Write at a point."""
    ax.text(at[0], at[1], text, color=colour, ha=align, va="center", linespacing=1.3, zorder=8)


def title(ax: Axes, x: float, text: str) -> None:
    """Write the heading of a part of the drawing."""
    ax.text(x, HEIGHT - 0.22, text, fontsize=11, fontweight="bold", ha="left", va="center")


def pin(ax: Axes, at: Points, colour: str = "black") -> None:
    """Mark the elastic axis where it goes through the page."""
    ax.add_patch(Circle(tuple(at), 0.05, facecolor="white", edgecolor=colour, lw=1.4, zorder=7))


def point_of_loads(ax: Axes, at: Points) -> None:
    """Mark mid-chord, which lift and moment are taken about."""
    ax.add_patch(Circle(tuple(at), 0.035, color=RED, zorder=7))


def centre_of_mass(ax: Axes, at: Points) -> None:
    """Mark the mass axis where it goes through the page."""
    ax.add_patch(Circle(tuple(at), 0.085, facecolor="white", edgecolor="black", zorder=7))
    for start in (0, 180):
        ax.add_patch(Wedge(tuple(at), 0.085, start, start + 90, facecolor="black", zorder=7))


# --- the beam ---


def on_page(points: Points) -> Points:
    """Project points (x, y, z) of the beam's axes to the page, seen from upwind and above."""
    azimuth, elevation = math.radians(55.0), math.radians(36.0)
    x, y, z = np.moveaxis(points, -1, 0)
    across = x * math.cos(azimuth) + z * math.sin(azimuth)
    away = x * math.sin(azimuth) - z * math.cos(azimuth)
    up = y * math.cos(elevation) + away * math.sin(elevation)
    return np.stack([across, up], axis=-1) + vector(0.8, 2.6)


def place(x: float, y: float, z: float) -> Points:
    """Return where the point (x, y, z) is on the page."""
    return on_page(vector(x, y, z))


def of_section(points: Points, z: float, part: float = 1.0) -> Points:
    """Return points of the section at z on the page, with a part of twist and deflection."""
    s = z / SPAN
    turned = nose_up(points, INCIDENCE + part * TIP_TWIST * math.sin(math.pi * s / 2))
    lifted = turned + vector(0.0, part * TIP_DEFLECTION * s**2 * (6 - 4 * s + s**2) / 3)
    return on_page(np.column_stack([lifted, np.full(len(points), z)]))


def along(x_over_c: float, part: float = 1.0) -> Points:
    """Return the line at x/c from root to tip, on the page."""
    point = on_chord(CHORD, x_over_c)[None, :]
    return np.vstack([of_section(point, z, part) for z in np.linspace(0.0, SPAN, 30)])


def at_tip(points: Points) -> Points:
    """Return points of the tip's plane, about its deflected elastic axis, on the page."""
    lifted = points + vector(0.0, TIP_DEFLECTION)
    return on_page(np.column_stack([lifted, np.full(len(points), SPAN)]))


def draw_beam(ax: Axes) -> None:
    """Draw the cantilever at rest and deflected."""
    wall = [place(-1.0, -0.8, 0), place(1.5, -0.8, 0), place(1.5, 0.85, 0), place(-1.0, 0.85, 0)]
    ax.add_patch(Polygon(wall, facecolor=WALL, edgecolor=GHOST, hatch="///", linewidth=0.8))
    shape = outline(CHORD)
    for edge in (0.0, 1.0):
        line(ax, along(edge, 0.0), GHOST, linewidth=0.9, linestyle=DASHED)
        line(ax, along(edge), BLUE, linewidth=1.1, zorder=3)
    at_rest = of_section(shape, SPAN, 0.0)
    ax.add_patch(Polygon(at_rest, fill=False, edgecolor=GHOST, linewidth=0.9, linestyle=DASHED))
    stations = np.linspace(0.0, SPAN, 25)
    for far, near in pairwise(stations):
        both = np.vstack([of_section(shape, far), of_section(shape, near)])
        strip = both[ConvexHull(both).vertices]
        ax.add_patch(Polygon(strip, facecolor=BODY, edgecolor=BODY, linewidth=0.6, zorder=2))
    tip = of_section(shape, SPAN)
    ax.add_patch(Polygon(tip, facecolor=TIP_FACE, edgecolor=BLUE, linewidth=1.1, zorder=4))
    line(ax, along(ELASTIC_AXIS), linewidth=1.0, linestyle=(0, (7, 2, 1.5, 2)), zorder=5)
    line(ax, along(MASS_AXIS), linewidth=1.0, linestyle=(0, (1.5, 1.5)), zorder=5)


def label_beam(ax: Axes) -> None:
    """Write the names of the beam's parts, its dimensions and axes, and what the tip does."""
    for z in (1.2, 2.1, 3.0):
        arrow(ax, place(-1.9, 0, z), place(-1.05, 0, z))
    label(ax, place(-1.9, 0, 1.65) + vector(-0.12, -0.08), "wind $V$", align="right")
    dimension(ax, place(-0.7, 0, 0.0), place(-0.7, 0, SPAN))
    label(ax, place(-0.7, 0, 1.75) + vector(-0.06, -0.12), "$L$", GREY)
    nose, tail = on_chord(CHORD, 0.0)[0], on_chord(CHORD, 1.0)[0]
    dimension(ax, place(nose, 0.06, SPAN + 0.25), place(tail, -0.13, SPAN + 0.25))
    label(ax, place(0.5 * (nose + tail), 0, SPAN + 0.25) + vector(0.1, -0.08), "$c$", GREY)
    origin = vector(3.45, 3.75)
    for axis, name in (
        (vector(0.6, 0, 0), "$x$"),
        (vector(0, 0.6, 0), "$y$"),
        (vector(0, 0, 0.6), "$z$"),
    ):
        direction = on_page(axis) - place(0, 0, 0)
        arrow(ax, origin, origin + direction)
        label(ax, origin + 1.25 * direction, name)
    elastic_axis_at_rest, elastic_axis = along(ELASTIC_AXIS, 0.0)[-1], along(ELASTIC_AXIS)[-1]
    arrow(ax, elastic_axis_at_rest, elastic_axis, GREEN)
    label(ax, 0.5 * (elastic_axis_at_rest + elastic_axis) + vector(0.1, 0.0), "$w$", GREEN, "left")
    for name, point, text in (
        ("mass axis", along(MASS_AXIS)[8], vector(2.1, 3.5)),
        ("elastic axis", along(ELASTIC_AXIS)[14], vector(2.75, 3.1)),
    ):
        line(ax, [point, text - vector(0.0, 0.1)], GREY, linewidth=0.7, zorder=7)
        label(ax, text, name)
    for angle, colour in ((INCIDENCE, GHOST), (INCIDENCE + TIP_TWIST, BLUE)):
        chord_line = nose_up(np.array([[0.0, 0.0], [-0.95, 0.0]]), angle)
        line(ax, at_tip(chord_line), colour, linewidth=0.8, linestyle=DASHED, zorder=1)
    rigid, whole = math.degrees(INCIDENCE), math.degrees(INCIDENCE + TIP_TWIST)
    arc = at_tip(arc_about(vector(0.0, 0.0), 0.85, rigid, whole))
    turn(ax, arc, GREEN)
    label(ax, arc[20] + vector(-0.12, -0.05), r"$\theta$", GREEN)
    label(ax, along(1.0)[-1] + vector(0.1, 0.1), "tip", align="left")
    label(ax, place(-0.2, 0.85, 0) + vector(0.0, 0.2), "root")


# --- the section ---


def draw_section(ax: Axes, axis: Points) -> None:
    """Draw the section on its springs, displaced and turned; ``axis`` is its elastic axis."""
    chord, rise, incidence = 2.7, 0.8, INCIDENCE + TWIST
    rest = axis - vector(0.0, rise)
    for centre in (axis, rest):
        line(ax, [centre - vector(1.62, 0.0), centre], GHOST, linewidth=0.8, zorder=1)
    for angle, colour in ((INCIDENCE, GHOST), (incidence, BLUE)):
        chord_line = axis + nose_up(np.array([[0.0, 0.0], [-1.3, 0.0]]), angle)
        line(ax, chord_line, colour, linewidth=0.8, linestyle=DASHED, zorder=1)
    at_rest = rest + nose_up(outline(chord), INCIDENCE)
    ax.add_patch(Polygon(at_rest, fill=False, edgecolor=GHOST, linewidth=0.9, linestyle=DASHED))
    body = axis + nose_up(outline(chord), incidence)
    ax.add_patch(Polygon(body, facecolor=BODY, edgecolor=BLUE, linewidth=1.2, zorder=3))
    draw_supports(ax, rest - vector(0.0, 1.0), axis)
    pin(ax, rest, GHOST)
    left = axis[0] - 1.5
    arrow(ax, vector(left, rest[1]), vector(left, axis[1]), GREEN)
    label(ax, vector(left - 0.12, axis[1] - 0.5 * rise), "$w$", GREEN)
    rigid, whole = math.degrees(INCIDENCE), math.degrees(incidence)
    turn(ax, arc_about(axis, 1.16, 0.0, rigid), GREY)
    turn(ax, arc_about(axis, 1.16, rigid, whole), GREEN)
    label(ax, axis + vector(-1.42, 0.1), r"$\theta_0$", GREY)
    label(ax, axis + vector(-1.38, 0.37), r"$\theta$", GREEN)

    centre, mass = (
        axis + nose_up(on_chord(chord, place), incidence) for place in (MID_CHORD, MASS_AXIS)
    )
    point_of_loads(ax, centre)
    arrow(ax, centre, centre + vector(0.0, 0.95), RED)
    label(ax, centre + vector(0.08, 0.85), "lift $F_L'$", RED, "left")
    turn(ax, arc_about(centre, 0.4, 65.0, 175.0), RED)
    label(ax, centre + vector(0.42, 0.28), "moment $M'$ about mid-chord", RED, "left")
    centre_of_mass(ax, mass)
    label(ax, mass + vector(0.0, -0.24), r"$m,\; I,\; S$")
    for y in (0.88, 1.06):
        arrow(ax, axis + vector(-1.65, y), axis + vector(-1.05, y))
    label(ax, axis + vector(-0.97, 0.97), "wind $V$", align="left")


def draw_supports(ax: Axes, foot: Points, axis: Points) -> None:
    """Draw ground, spring and damper of the deflection, rod, and spring of the twist."""
    ground = Rectangle((foot[0] - 0.6, foot[1] - 0.12), 1.2, 0.12, facecolor=WALL, linewidth=0.0)
    ground.set(hatch="////", edgecolor=GHOST)
    ax.add_patch(ground)
    line(ax, foot + np.array([[-0.6, 0.0], [0.6, 0.0]]))
    bar = 0.62
    zigzag = 0.09 * vector(0, 0, 1, -1, 1, -1, 1, -1, 0, 0)
    heights = bar * vector(0, 0.16, 0.22, 0.33, 0.44, 0.56, 0.67, 0.78, 0.84, 1)
    line(ax, foot + np.column_stack([zigzag - 0.25, heights]))
    damper = foot + vector(0.25, 0.0)
    cup = np.array([[-0.1, 0.62], [-0.1, 0.3], [0.1, 0.3], [0.1, 0.62]])
    for part in (cup, [[0, 0], [0, 0.3]], [[0, 0.5], [0, 1]], [[-0.08, 0.5], [0.08, 0.5]]):
        line(ax, damper + np.array(part) * [1.0, bar])
    line(ax, foot + np.array([[-0.25, bar], [0.25, bar]]), linewidth=1.8)
    line(ax, [foot + vector(0.0, bar), axis], zorder=2)
    angles = np.linspace(0.0, 4.5 * math.pi, 120)
    radius = 0.06 + 0.2 * angles / angles[-1]
    line(ax, axis + radius[:, None] * np.column_stack([np.cos(angles), -np.sin(angles)]), zorder=5)
    pin(ax, axis)
    label(ax, axis + vector(-0.52, -0.32), r"$k_\theta,\; c_\theta$")
    label(ax, foot + vector(-0.4, 0.5 * bar), "$k_w$", align="right")
    label(ax, foot + vector(0.44, 0.5 * bar), "$c_w$", align="left")


def draw_chord(ax: Axes, axis: Points) -> None:
    """Draw where the axes are along the chord; ``axis`` is the elastic one."""
    chord = 3.7
    ax.add_patch(Polygon(axis + outline(chord), facecolor=BODY, edgecolor=BLUE, lw=1.2, zorder=3))
    nose, centre, mass, tail = (
        axis + on_chord(chord, place) for place in (0.0, MID_CHORD, MASS_AXIS, 1.0)
    )
    pin(ax, axis)
    point_of_loads(ax, centre)
    centre_of_mass(ax, mass)
    label(ax, axis + vector(-0.1, 0.34), "elastic axis")
    label(ax, centre + vector(0.0, 0.34), "mid-chord", RED)
    label(ax, mass + vector(0.08, 0.34), "mass axis")
    for point in (axis, mass):
        line(ax, point + np.array([[0.0, -0.05], [0.0, -0.36]]), GREY, linewidth=0.7, zorder=4)
    dimension(ax, axis - vector(0.0, 0.3), mass - vector(0.0, 0.3))
    label(ax, centre - vector(0.0, 0.45), "$S/m$", GREY)
    thickest = nose + vector(0.2 * chord, 0.0)
    half = vector(0.0, outline(chord)[:, 1].max())
    dimension(ax, thickest - half, thickest + half)
    label(ax, thickest - vector(0.12, 0.0), "$h$", GREY)
    label(ax, nose + vector(0.0, -0.36), "leading edge\n$x/c = 0$", GREY)
    label(ax, tail + vector(0.0, -0.36), "trailing edge\n$x/c = 1$", GREY)


def draw(path: Path) -> None:
    """Draw beam, section and places along the chord, and write the picture."""
    with matplotlib.rc_context():
        matplotlib.rcdefaults()
        matplotlib.rc("font", size=9.5)
        matplotlib.rc("mathtext", fontset="dejavusans")
        matplotlib.rc("hatch", linewidth=0.4)
        matplotlib.rc("svg", hashsalt="equisection")
        figure = Figure(figsize=(WIDTH, HEIGHT), facecolor="white")
        ax = figure.add_axes((0, 0, 1, 1), xlim=(0, WIDTH), ylim=(0, HEIGHT), aspect="equal")
        ax.set_axis_off()
        title(ax, 0.15, "Beam")
        draw_beam(ax)
        label_beam(ax)
        title(ax, 4.75, "Equivalent section, per unit span")
        draw_section(ax, vector(6.45, 3.3))
        draw_chord(ax, vector(6.32, 0.68))
        for part in ax.get_children():
            part.set_clip_on(False)
        metadata = {"Date": None, "Creator": None} if path.suffix == ".svg" else {}
        figure.savefig(path, metadata=metadata)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="Draw the beam and its equivalent section.")
    parser.add_argument("path", type=Path, help="the picture, such as docs/beam-and-section.svg")
    draw(parser.parse_args().path)
