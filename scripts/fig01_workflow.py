"""Fig. 1: block diagram of the procedure, from the workflow's own rule graph."""

from collections.abc import Sequence
from pathlib import Path

import yaml

from equisection.figures.fig01_workflow import draw
from equisection.figures.rule_graph import parse_dot, read_rule_texts
from equisection.figures.save import save_figure
from equisection.figures.snakemake_query import ask_rule_graph
from equisection.figures.style import drawing_style
from equisection.run.script import logged


def main(
    snakefile: Path,
    rule_files: Sequence[Path],
    config: Path,
    style: Path,
    outputs: Sequence[Path],
) -> None:
    """Draw the rules and what waits for what."""
    graph = parse_dot(ask_rule_graph(snakefile, config))
    texts = read_rule_texts({path.stem: path.read_text(encoding="utf-8") for path in rule_files})
    run = yaml.safe_load(config.read_text(encoding="utf-8"))
    sources = (f"run '{run['run']}'", f"solver '{run['solver']}'",
               f"resolution {run['steady']['resolution']}")  # fmt: skip
    with drawing_style(style):
        save_figure(draw(graph, texts, *sources), outputs)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.snakefile),
            [Path(path) for path in snakemake.input.rule_files],
            Path(snakemake.input.config),
            Path(snakemake.input.style),
            [Path(path) for path in snakemake.output],
        )
