"""The rules of the workflow and what waits for what, from Snakemake's own rule graph."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass

Edge = tuple[str, str]

_NODE = re.compile(r'^\s*(\d+)\s*\[\s*label\s*=\s*"([^"\\]+)', re.MULTILINE)
_EDGE = re.compile(r"^\s*(\d+)\s*->\s*(\d+)", re.MULTILINE)
_RULE = re.compile(
    r'^[ \t]*(?:rule|checkpoint)[ \t]+(?P<name>\w+)[ \t]*:\s*\n\s*"""(?P<text>.*?)"""',
    re.MULTILINE | re.DOTALL,
)


@dataclass(frozen=True)
class RuleText:
    """What a rule file says of one of its rules: the first sentence, and the file's name."""

    sentence: str
    phase: str


@dataclass(frozen=True)
class RuleGraph:
    """Rules, and pairs of a rule and one that uses what it makes."""

    rules: tuple[str, ...]
    edges: frozenset[Edge]

    def without(self, unwanted: Iterable[str]) -> RuleGraph:
        """Return the graph without some rules."""
        gone = set(unwanted)
        return RuleGraph(
            tuple(rule for rule in self.rules if rule not in gone),
            frozenset(edge for edge in self.edges if not gone.intersection(edge)),
        )

    def folded(self, members: Iterable[str], name: str) -> RuleGraph:
        """Return the graph with some rules taken together as one."""
        inside = set(members).intersection(self.rules)
        if not inside:
            return self
        new = {rule: name if rule in inside else rule for rule in self.rules}
        return RuleGraph(
            tuple(dict.fromkeys(new.values())),
            frozenset((new[a], new[b]) for a, b in self.edges if new[a] != new[b]),
        )

    def acyclic(self) -> RuleGraph:
        """Return the graph without the edges that close a cycle (the refinement's own loop)."""
        after = self._after()
        kept: set[Edge] = set()
        state: dict[str, str] = {}

        def visit(rule: str) -> None:
            state[rule] = "open"
            for other in sorted(after[rule]):
                if state.get(other) != "open":
                    kept.add((rule, other))
                if other not in state:
                    visit(other)
            state[rule] = "done"

        for rule in self.rules:
            if rule not in state:
                visit(rule)
        return RuleGraph(self.rules, frozenset(kept))

    def reduced(self, kept_anyway: Callable[[str, str], bool]) -> RuleGraph:
        """Return the graph, which has no cycles, without edges that a longer way implies.

        Parameters
        ----------
        kept_anyway
            Tells of an implied edge whether it stays all the same.
        """
        after = self._after()
        reach = {rule: _reachable(rule, after) for rule in self.rules}
        kept = {
            (a, b)
            for a, b in self.edges
            if kept_anyway(a, b) or not any(b in reach[other] for other in after[a] - {b})
        }
        return RuleGraph(self.rules, frozenset(kept))

    def _after(self) -> dict[str, set[str]]:
        """Return the rules that use what each rule makes."""
        after: dict[str, set[str]] = {rule: set() for rule in self.rules}
        for a, b in self.edges:
            after[a].add(b)
        return after


def _reachable(start: str, after: Mapping[str, set[str]]) -> set[str]:
    found: set[str] = set()
    left = list(after[start])
    while left:
        rule = left.pop()
        if rule not in found:
            found.add(rule)
            left += after[rule]
    return found


def parse_dot(dot: str) -> RuleGraph:
    """Return the graph of what ``snakemake --rulegraph`` prints.

    Names are the first lines of the labels; rules that stand twice count once.
    """
    names = {number: label.strip() for number, label in _NODE.findall(dot)}
    edges = {(names[a], names[b]) for a, b in _EDGE.findall(dot) if a in names and b in names}
    return RuleGraph(
        tuple(sorted(set(names.values()))),
        frozenset((a, b) for a, b in edges if a != b),
    )


def read_rule_texts(files: Mapping[str, str]) -> dict[str, RuleText]:
    """Return what the rule files say of their rules.

    Parameters
    ----------
    files
        Text of each rule file by its phase (its name without suffix).
    """
    return {
        found["name"]: RuleText(_first_sentence(found["text"]), phase)
        for phase, text in files.items()
        for found in _RULE.finditer(text)
    }


def _first_sentence(docstring: str) -> str:
    words = " ".join(docstring.split())
    return re.split(r"(?<=[.!?]) (?=[A-Z])", words)[0].removesuffix(".")
