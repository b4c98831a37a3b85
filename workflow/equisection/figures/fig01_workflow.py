"""Fig. 1: the workflow as a block diagram, drawn from its own rule graph."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Mapping

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import FancyBboxPatch, PathPatch
from matplotlib.path import Path as Curve

from equisection.figures.layers import Layout, lay_out
from equisection.figures.origin import add_provenance
from equisection.figures.rule_graph import RuleGraph, RuleText
from equisection.figures.style import GREY, PAGE_WIDTH

#: Phases in the order of the legend: title, fill and edge of their boxes.
PHASES = {
    "structure": ("structure", "#DCEBF5", "#0072B2"),
    "steady": ("steady aerodynamics", "#FBEBCB", "#B97F00"),
    "equivalent": ("equivalent section", "#D6EFE6", "#009E73"),
    "unsteady": ("unsteady runs", "#F8DFD0", "#D55E00"),
    "comparison": ("comparison", "#F3DEEA", "#A8598A"),
    "figures": ("figures", "#E8E8E8", "#404040"),
}
_OTHER = ("other", "#FFFFFF", "#808080")

#: The box that stands for all rules of figures.
FIGURES_BOX = "figures"
#: Rules that make nothing, but ask for what others make.
_TARGETS = ("all", "run")

# Inches.
_BOX_WIDTH = 1.62
_BOX_HEIGHT = 0.56
_LAYER_HEIGHT = 0.79
_GAP = 0.14
_PASSING = 0.3

#: Widths of a letter, of the size of the sentences (in).
_TEXT_SIZE = 6.2
_LETTER_WIDTH = 0.6 * _TEXT_SIZE / 72


def draw(graph: RuleGraph, texts: Mapping[str, RuleText], *sources: str) -> Figure:
    """Draw the rules as boxes, coloured by the file that they stand in.

    Parameters
    ----------
    graph
        The rule graph, targets and all.
    texts
        What the rule files say of their rules.
    sources
        What the picture says of the solver and its resolution.
    """
    figures = [rule for rule in graph.rules if _phase(rule, texts) == "figures"]
    whole = graph.without(_TARGETS).folded(figures, FIGURES_BOX).acyclic()
    goes_on = {rule for rule, _ in whole.edges}

    def tells(rule: str, user: str) -> bool:
        """Tell whether an edge that others imply still leads from one phase into another."""
        return user in goes_on and _phase(rule, texts) != _phase(user, texts)

    shown = whole.reduced(tells)
    sentences = {rule: text.sentence for rule, text in texts.items()}
    sentences[FIGURES_BOX] = figures_sentence(figures)
    layout = lay_out(shown, _BOX_WIDTH + _GAP, _PASSING)
    figure = Figure(figsize=(PAGE_WIDTH, _LAYER_HEIGHT * layout.layers + 0.62))
    axes = figure.subplots()
    columns = int(_frame(axes, layout) * _BOX_WIDTH / _LETTER_WIDTH)
    for way in layout.ways.values():
        _arrow(axes, way)
    for rule in shown.rules:
        across, layer = layout.position[rule]
        phase = "figures" if rule == FIGURES_BOX else _phase(rule, texts)
        lines = textwrap.wrap(sentences.get(rule, ""), columns, max_lines=3, placeholder=" …")
        _box(axes, (across, -layer * _LAYER_HEIGHT), rule, lines, phase)
    _legend(figure, [_phase(rule, texts) for rule in graph.rules if rule not in _TARGETS])
    add_provenance(figure, "rules as Snakemake plans them", *sources)
    return figure


def figures_sentence(rules: list[str]) -> str:
    """Say which figures there are, from the names of their rules."""
    numbers = sorted(int(found[1]) for rule in rules if (found := re.match(r"fig(\d+)_", rule)))
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    words = [f"{run[0]}–{run[-1]}" if len(run) > 2 else ", ".join(map(str, run)) for run in runs]
    return f"Draw Figs. {', '.join(words)} of the paper" if words else ""


def _phase(rule: str, texts: Mapping[str, RuleText]) -> str:
    return texts[rule].phase if rule in texts else "other"


def _box(axes: Axes, centre: tuple[float, float], rule: str, lines: list[str], phase: str) -> None:
    _, fill, edge = PHASES.get(phase, _OTHER)
    x, y = centre
    axes.add_patch(
        FancyBboxPatch(
            (x - _BOX_WIDTH / 2, y - _BOX_HEIGHT / 2),
            _BOX_WIDTH,
            _BOX_HEIGHT,
            boxstyle="round,pad=0,rounding_size=0.05",
            facecolor=fill,
            edgecolor=edge,
            linewidth=0.9,
            zorder=2,
        )
    )
    top = y + 0.5 * _BOX_HEIGHT
    axes.text(
        x, top - 0.05, rule.replace("_", " "), ha="center", va="top", fontweight="bold",
        fontsize=7.5, zorder=3,
    )  # fmt: skip
    axes.text(
        x, top - 0.205, "\n".join(lines), ha="center", va="top", fontsize=_TEXT_SIZE, zorder=3,
        linespacing=1.15,
    )  # fmt: skip


def _arrow(axes: Axes, way: list[tuple[float, int]]) -> None:
    """Draw an edge from the bottom of a box to the top of another, past those between."""
    points = [(x, -layer * _LAYER_HEIGHT) for x, layer in way]
    half = _BOX_HEIGHT / 2
    vertices = [(points[0][0], points[0][1] - half)]
    codes = [Curve.MOVETO]
    for place, (x, y) in enumerate(points[1:], start=1):
        last = place == len(points) - 1
        top = y + half + (0.05 if last else 0.0)
        x0, y0 = vertices[-1]
        bend = 0.5 * (y0 - top)
        vertices += [(x0, y0 - bend), (x, top + bend), (x, top)]
        codes += [Curve.CURVE4] * 3
        if not last:
            vertices.append((x, y - half))
            codes.append(Curve.LINETO)
    axes.add_patch(
        PathPatch(Curve(vertices, codes), facecolor="none", edgecolor=GREY, linewidth=0.8, zorder=1)
    )
    x, y = vertices[-1]
    tip = Curve([(x - 0.035, y + 0.02), (x, y - 0.05), (x + 0.035, y + 0.02), (x, y)], closed=True)
    axes.add_patch(PathPatch(tip, facecolor=GREY, edgecolor="none", zorder=1))


def _frame(axes: Axes, layout: Layout) -> float:
    """Let the boxes fill the page; return how wide their inch is on it."""
    across = [x for way in layout.ways.values() for x, _ in way]
    across += [x for x, _ in layout.position.values()]
    reach = max((abs(x) for x in across), default=0.0) + _BOX_WIDTH / 2 + 0.03
    axes.set_xlim(-reach, reach)
    axes.set_ylim(
        -(layout.layers - 1) * _LAYER_HEIGHT - _BOX_HEIGHT / 2 - 0.05, _BOX_HEIGHT / 2 + 0.05
    )
    axes.set_axis_off()
    return PAGE_WIDTH / (2 * reach)


def _legend(figure: Figure, phases: list[str]) -> None:
    handles = [
        FancyBboxPatch((0, 0), 1, 1, facecolor=fill, edgecolor=edge, label=title)
        for phase, (title, fill, edge) in {**PHASES, "other": _OTHER}.items()
        if phase in phases
    ]
    figure.legend(handles=handles, loc="outside upper center", ncols=len(handles), handlelength=1.4)
