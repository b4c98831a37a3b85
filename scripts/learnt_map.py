"""Stability over incidence and speed of models that were learnt from releases."""

import logging
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from equisection.analysis.learning import Lessons
from equisection.analysis.learnt_lines import learnt_lines
from equisection.analysis.learnt_map import map_of_learnt, stability_of_learnt
from equisection.analysis.mapped_models import speeds_of_map
from equisection.config import load_config
from equisection.files import written_whole
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.section_dataset import nominal_k_star
from equisection.run.script import logged
from equisection.study.axes import AsGiven


def main(
    raw_config: dict[str, Any],
    files: Mapping[str, str],
    learnt: Sequence[Path],
    *,
    stability_map: Path,
    stability: Path,
) -> None:
    """Write the map and the critical speeds.

    ``files`` are ``equivalent``, ``polar_2d`` of sections, ``correction`` of corrected ones, and
    ``modes`` with ``polar_3d`` of beams; ``learnt`` are the models, by their folders.
    """
    config = load_config(raw_config)
    chord = config.beam.chord
    lines = []
    for name in config.sweep.models:
        lessons = Lessons.read(config, name, files)
        given = AsGiven(nominal_k_star(lessons.data["equivalent"]), config.flow.speed)
        own = [read_dataset(path) for path in learnt if path.parent.name == name]
        lines += learnt_lines(lessons, own, given, speeds_of_map(config, given))
    table = stability_of_learnt(lines, chord=chord, design_speed=config.flow.design_speed)
    write_dataset(stability_map, map_of_learnt(lines, table, chord=chord))
    for row in table.to_dict("records"):
        logging.getLogger(__name__).info(
            "%s at %g deg (%s): %s %.4g m/s [%.4g, %.4g]; %s; %s",
            row["model"],
            row["incidence_deg"],
            row["learnt"],
            row["mechanism"],
            row["speed"],
            row["speed_low"],
            row["speed_high"],
            row["in_time"],
            row["note"],
        )
    with written_whole(stability) as aside:
        table.to_csv(aside, index=False, float_format="%.6g")


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            snakemake.params.config,
            {
                name: str(snakemake.input[name])
                for name in ("equivalent", "polar_2d", "correction", "modes", "polar_3d")
                if name in snakemake.input.keys()  # noqa: SIM118 - these are no mapping
            },
            [Path(path) for path in snakemake.input.learnt],
            stability_map=Path(snakemake.output.stability_map),
            stability=Path(snakemake.output.stability),
        )
