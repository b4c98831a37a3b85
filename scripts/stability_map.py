"""Stability over incidence and speed of each model, and its critical speeds."""

import logging
from pathlib import Path
from typing import Any

import pandas as pd

from equisection.analysis.coarser_bodies import coarser_bodies
from equisection.analysis.loads_in_use import reactions
from equisection.analysis.mapped_models import (
    map_dataset,
    mapped_models,
    speeds_of_map,
    stability_table,
)
from equisection.analysis.onset_intervals import sensitivity_table, with_intervals
from equisection.analysis.releases_of_map import checked_in_time, in_use
from equisection.config import load_config
from equisection.files import written_whole
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.section_dataset import nominal_k_star
from equisection.run.script import logged
from equisection.solvers.registry import solver_from_config
from equisection.study.axes import AsGiven


def main(
    raw_config: dict[str, Any],
    files: dict[str, Path],
    *,
    stability_map: Path,
    stability: Path,
    sensitivities: Path,
    at_design: tuple[Path, Path] | None,
) -> None:
    """Write the map, the critical speeds with their sensitivities, and the design speed's tables.

    ``at_design`` are the files of what it is like in use and of the loads on the supports.
    """
    config = load_config(raw_config)
    data = {name: read_dataset(path) for name, path in files.items()}
    solver = solver_from_config(config, config.steady.resolution)
    given = AsGiven(nominal_k_star(data["equivalent"]), config.flow.speed)
    models = mapped_models(config, data, solver)
    write_dataset(stability_map, map_dataset(models, speeds_of_map(config, given)))
    table = checked_in_time(stability_table(models, config.flow.design_speed), models, config)
    coarser = coarser_bodies(models, config, data, given)
    found = sensitivity_table(models, config, solver, coarser)
    table = with_intervals(table, found)
    for row in table.to_dict("records"):
        logging.getLogger(__name__).info(
            "%s at %g deg: %s %.4g m/s; %s",
            row["model"],
            row["incidence_deg"],
            row["mechanism"],
            row["speed"],
            row["note"],
        )
    _write(table, stability)
    _write(found, sensitivities)
    if at_design is not None:
        _write(in_use(models, config), at_design[0])
        _write(reactions(models, config), at_design[1])


def _write(table: pd.DataFrame, output: Path) -> None:
    with written_whole(output) as aside:
        table.to_csv(aside, index=False, float_format="%.6g")


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        wanted = {
            name: Path(snakemake.input[name])
            for name in ("equivalent", "modes", "correction")
            if name in snakemake.input.keys()  # noqa: SIM118 - these are no mapping
        }
        in_use_file = snakemake.output.get("in_use")
        main(
            snakemake.params.config,
            wanted,
            stability_map=Path(snakemake.output.stability_map),
            stability=Path(snakemake.output.stability),
            sensitivities=Path(snakemake.output.sensitivities),
            at_design=(Path(in_use_file), Path(snakemake.output.reactions))
            if in_use_file
            else None,
        )
