"""A graph laid out in layers: edges run downwards, with few crossings.

Layers are longest ways from the top (rules that nothing precedes stand just above the first
that uses them). An edge that passes a layer gets a way-point there. Barycentre sweeps order
each layer (Sugiyama, Tagawa & Toda 1981); positions then move towards those of the neighbours
as far as the room allows.
"""

from __future__ import annotations

import itertools
import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from equisection.figures.rule_graph import Edge, RuleGraph

_SWEEPS = 24
#: First orders that the sweeps are tried from.
_STARTS = 60

#: A rule, or the way-point of an edge in a layer.
Stop = tuple[str, ...]


@dataclass(frozen=True)
class Layout:
    """Where everything stands.

    Attributes
    ----------
    position : dict
        Place of each rule: across (0 in the middle, in the unit of the widths), and layer from
        the top.
    ways : dict
        Places that each edge passes, from its first rule to its last.
    """

    position: dict[str, tuple[float, int]]
    ways: dict[Edge, list[tuple[float, int]]]

    @property
    def layers(self) -> int:
        """Number of layers."""
        return 1 + max((layer for _, layer in self.position.values()), default=-1)


def lay_out(graph: RuleGraph, width: float, passing: float) -> Layout:
    """Lay out a graph without cycles.

    Parameters
    ----------
    graph
        The graph.
    width
        Width of a rule, with the space beside it.
    passing
        Width of the room for an edge that passes a layer.
    """
    layer = _layers(graph)
    ways: dict[Edge, list[Stop]] = {}
    for a, b in sorted(graph.edges):
        between = [(a, b, str(level)) for level in range(layer[a] + 1, layer[b])]
        ways[a, b] = [(a,), *between, (b,)]
    level_of: dict[Stop, int] = {(rule,): layer[rule] for rule in graph.rules}
    neighbours: dict[Stop, tuple[list[Stop], list[Stop]]] = {}
    for (a, _), way in ways.items():
        for step, stop in enumerate(way):
            level_of.setdefault(stop, layer[a] + step)
    for stop in level_of:
        neighbours[stop] = ([], [])
    for way in ways.values():
        for upper, lower in itertools.pairwise(way):
            neighbours[upper][1].append(lower)
            neighbours[lower][0].append(upper)
    rows: list[list[Stop]] = [[] for _ in range(max(level_of.values(), default=-1) + 1)]
    for stop in sorted(level_of):
        rows[level_of[stop]].append(stop)
    rows = _ordered(rows, neighbours)
    room = {stop: width if len(stop) == 1 else passing for stop in level_of}
    across = _placed(rows, neighbours, room)
    return Layout(
        {rule: (across[rule,], layer[rule]) for rule in graph.rules},
        {edge: [(across[stop], level_of[stop]) for stop in way] for edge, way in ways.items()},
    )


def _layers(graph: RuleGraph) -> dict[str, int]:
    before: dict[str, list[str]] = {rule: [] for rule in graph.rules}
    after: dict[str, list[str]] = {rule: [] for rule in graph.rules}
    for a, b in graph.edges:
        before[b].append(a)
        after[a].append(b)
    layer: dict[str, int] = {}

    def longest(rule: str) -> int:
        if rule not in layer:
            layer[rule] = 1 + max((longest(other) for other in before[rule]), default=-1)
        return layer[rule]

    for rule in graph.rules:
        longest(rule)
    for rule in graph.rules:
        if not before[rule] and after[rule]:
            layer[rule] = min(layer[other] for other in after[rule]) - 1
    return layer


def _ordered(
    rows: list[list[Stop]], neighbours: Mapping[Stop, tuple[list[Stop], list[Stop]]]
) -> list[list[Stop]]:
    """Return the best order of the rows that sweeps from several first orders pass."""
    best, least = [list(row) for row in rows], _crossings(rows, neighbours)
    shuffler = random.Random(0)  # the same graph gives the same picture
    for _ in range(_STARTS):
        for sweep in range(_SWEEPS):
            if least == 0:
                return best
            side = sweep % 2  # 0: by the row above, downwards; 1: by the row below, upwards
            for row in rows if side == 0 else reversed(rows):
                place = {stop: n for line in rows for n, stop in enumerate(line)}
                row.sort(key=lambda stop: _mean(neighbours[stop][side], place, place[stop]))
            now = _crossings(rows, neighbours)
            if now < least:
                best, least = [list(row) for row in rows], now
        for row in rows:
            shuffler.shuffle(row)
    return best


def _mean(stops: Sequence[Stop], place: Mapping[Stop, float], own: float = 0.0) -> float:
    return sum(place[stop] for stop in stops) / len(stops) if stops else own


def _crossings(
    rows: Sequence[Sequence[Stop]], neighbours: Mapping[Stop, tuple[list[Stop], list[Stop]]]
) -> int:
    count = 0
    for row, below in itertools.pairwise(rows):
        place = {stop: n for n, stop in enumerate(below)}
        ends = [(n, place[lower]) for n, stop in enumerate(row) for lower in neighbours[stop][1]]
        count += sum(a < c and b > d for a, b in ends for c, d in ends)
    return count


def _placed(
    rows: Sequence[Sequence[Stop]],
    neighbours: Mapping[Stop, tuple[list[Stop], list[Stop]]],
    room: Mapping[Stop, float],
) -> dict[Stop, float]:
    """Return places across: near those of the neighbours, no closer than the room asks."""
    across: dict[Stop, float] = {}
    for row in rows:
        whole = sum(room[stop] for stop in row)
        edge = -whole / 2
        for stop in row:
            across[stop] = edge + room[stop] / 2
            edge += room[stop]
    for _ in range(_SWEEPS):
        for row in rows:
            wanted = [
                _mean([*neighbours[stop][0], *neighbours[stop][1]], across, across[stop])
                for stop in row
            ]
            across.update(zip(row, _spread(wanted, [room[stop] for stop in row]), strict=True))
    middle = (min(across.values(), default=0.0) + max(across.values(), default=0.0)) / 2
    return {stop: value - middle for stop, value in across.items()}


def _spread(wanted: Sequence[float], room: Sequence[float]) -> list[float]:
    """Return the places nearest to those wanted (least squares) that keep the order and room.

    With the room taken off this is an isotonic regression, solved by pooling neighbours.
    """
    offsets = [0.0]
    for left, right in itertools.pairwise(room):
        offsets.append(offsets[-1] + (left + right) / 2)
    pools: list[list[float]] = []
    for want, offset in zip(wanted, offsets, strict=False):
        pools.append([want - offset])
        while len(pools) > 1 and _middle(pools[-2]) > _middle(pools[-1]):
            last = pools.pop()
            pools[-1] += last
    flat = [_middle(pool) for pool in pools for _ in pool]
    return [value + offset for value, offset in zip(flat, offsets, strict=False)]


def _middle(values: Sequence[float]) -> float:
    return sum(values) / len(values)
