"""The block diagram: Snakemake's rule graph is read, thinned out and laid out."""

from __future__ import annotations

import itertools
import sys

import pytest

from equisection.figures import snakemake_query
from equisection.figures.fig01_workflow import figures_sentence
from equisection.figures.layers import lay_out
from equisection.figures.rule_graph import RuleGraph, RuleText, parse_dot, read_rule_texts
from equisection.figures.snakemake_query import RuleGraphError, ask_rule_graph

DOT = """
digraph snakemake_dag {
    graph[bgcolor=white, margin=0];
    node[shape=box, style=rounded, fontname=sans, fontsize=10, penwidth=2];
    edge[penwidth=2, color=grey];
	0[label = "all", color = "0.00 0.6 0.85", style="rounded"];
	1[label = "modes", color = "0.36 0.6 0.85", style="rounded"];
	2[label = "polar\\ndimension: 2d", color = "0.44 0.6 0.85", style="dashed"];
	3[label = "correction", color = "0.05 0.6 0.85", style="rounded"];
	1 -> 0
	3 -> 0
	1 -> 3
	2 -> 3
	2 -> 2
}
"""


def graph(*edges: str) -> RuleGraph:
    pairs = [(edge[0], edge[1]) for edge in edges]
    return RuleGraph(tuple(sorted({rule for pair in pairs for rule in pair})), frozenset(pairs))


def never(rule: str, user: str) -> bool:
    return False


def test_dot_is_read():
    found = parse_dot(DOT)
    assert found.rules == ("all", "correction", "modes", "polar")
    assert found.edges == {
        ("modes", "all"),
        ("correction", "all"),
        ("modes", "correction"),
        ("polar", "correction"),
    }


def test_anything_else_is_an_empty_graph():
    assert parse_dot("Building DAG of jobs...\n") == RuleGraph((), frozenset())


def test_rules_are_taken_out_and_together():
    found = graph("ab", "bc", "bd", "ce", "de")
    assert found.without("e").edges == graph("ab", "bc", "bd").edges
    assert found.folded("cd", "f").edges == graph("ab", "bf", "fe").edges
    assert found.folded("xy", "f") == found


def test_implied_edges_go_unless_wanted():
    found = graph("ab", "bc", "ac", "cd", "ad")
    assert found.reduced(never).edges == graph("ab", "bc", "cd").edges
    assert found.reduced(lambda a, b: b == "c").edges == graph("ab", "bc", "ac", "cd").edges


def test_cycles_are_opened():
    opened = graph("ab", "bc", "cb", "cd").acyclic()
    assert opened.edges == graph("ab", "bc", "cd").edges


def test_rule_files_are_read():
    text = '''
checkpoint refine:
    """Choose the next k* (Eq. 17 of the paper) for a model. It may be none."""
    input: "a"

if SOLVER:
    rule run_all:
        """Run all
        cases."""
        output: "b"
'''
    assert read_rule_texts({"unsteady": text}) == {
        "refine": RuleText("Choose the next k* (Eq. 17 of the paper) for a model", "unsteady"),
        "run_all": RuleText("Run all cases", "unsteady"),
    }


def test_figures_are_counted():
    rules = [
        "fig13_lift",
        "fig01_workflow",
        "fig03_modes",
        "fig14_moment",
        "fig15_modal",
        "fig17_a",
        "fig18_b",
    ]
    assert figures_sentence(rules) == "Draw Figs. 1, 3, 13–15, 17, 18 of the paper"
    assert figures_sentence([]) == ""


def test_layout_runs_downwards_without_overlap():
    found = graph("ab", "ac", "bd", "cd", "de", "ae", "fe", "gd", "hb", "hc")
    layout = lay_out(found, 1.0, 0.3)
    for way in layout.ways.values():
        levels = [layer for _, layer in way]
        assert levels == list(range(levels[0], levels[-1] + 1))
    by_layer: dict[int, list[float]] = {}
    for across, layer in layout.position.values():
        by_layer.setdefault(layer, []).append(across)
    for row in by_layer.values():
        assert all(right - left > 1.0 - 1e-9 for left, right in itertools.pairwise(sorted(row)))
    assert layout.position["f"][1] == layout.position["e"][1] - 1
    assert layout == lay_out(found, 1.0, 0.3)


def test_layout_without_crossings_where_there_is_one():
    # Way-points beside boxes: drawn with the long edge a-d on the wrong side, it would cross.
    found = graph("ab", "ad", "cb", "bd", "xc")
    ways = list(lay_out(found, 1.0, 0.3).ways.values())
    segments = [(upper, lower) for way in ways for upper, lower in itertools.pairwise(way)]
    for (a, b), (c, d) in itertools.combinations(segments, 2):
        if a[1] == c[1]:
            assert (a[0] - c[0]) * (b[0] - d[0]) >= 0.0


def test_an_empty_graph_has_no_layers():
    assert lay_out(RuleGraph((), frozenset()), 1.0, 0.3).layers == 0


def test_a_refusal_of_snakemake_is_told(monkeypatch, tmp_path):
    fake = tmp_path / "snakemake"
    fake.write_text(f"#!{sys.executable}\nimport sys\nsys.exit('no such rule')\n")
    fake.chmod(0o755)
    monkeypatch.setattr(snakemake_query.sys, "executable", str(tmp_path / "python"))
    with pytest.raises(RuleGraphError, match="exit status 1\nno such rule"):
        ask_rule_graph(tmp_path / "Snakefile", tmp_path / "config.yaml")


def test_a_missing_snakemake_is_told(monkeypatch, tmp_path):
    monkeypatch.setattr(snakemake_query.sys, "executable", str(tmp_path / "python"))
    monkeypatch.setenv("PATH", str(tmp_path))
    with pytest.raises(RuleGraphError, match="no 'snakemake' beside"):
        ask_rule_graph(tmp_path / "Snakefile", tmp_path / "config.yaml")
