"""Every number that the paper states, and its tables, compared with those of this run."""

from pathlib import Path
from typing import Any

import pandas as pd

from equisection.config import load_config
from equisection.files import written_whole
from equisection.paper.comparison import paper_table
from equisection.paper.quantities import Run
from equisection.paper.tables import table_2
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged
from equisection.store.index import read_index, result_file
from equisection.study import plan


def main(
    raw_config: dict[str, Any],
    inputs: dict[str, Path],
    outputs: dict[str, Path],
) -> None:
    """Write ``paper`` and ``table2`` of ``outputs``.

    ``inputs`` holds ``modes``, ``equivalent``, ``mesh_study``, ``summary`` and ``onset``, with
    ``polar_3d`` and ``correction`` where the solver has 3D cases and ``reference_3d`` where the
    beam is run, and ``bubble`` where the solver has surface data.
    """
    config = load_config(raw_config)
    data = {name: read_dataset(path) for name, path in inputs.items() if path.suffix == ".nc"}
    mesh_study = data.pop("mesh_study")
    tables = {name: pd.read_csv(path) for name, path in inputs.items() if path.suffix == ".csv"}
    run = Run(config, **data, **tables)
    thickness_over_span = config.beam.thickness / config.beam.length
    frames = {
        "paper": paper_table(run),
        "table2": table_2(run.modes, mesh_study, thickness_over_span),
    }
    for name, frame in frames.items():
        with written_whole(outputs[name]) as aside:
            frame.to_csv(aside, index=False, float_format="%.6g")


if __name__ == "__main__":
    WANTED = ("modes", "equivalent", "mesh_study", "summary", "onset")
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        inputs = {name: Path(snakemake.input[name]) for name in WANTED}
        for name in ("polar_3d", "correction", "bubble"):
            for path in snakemake.input[name]:
                inputs[name] = Path(path)
        for index in map(Path, snakemake.input.index_3d):
            stiffest = plan.stiffest_case(read_index(index))
            if stiffest is not None:
                inputs["reference_3d"] = result_file(index, stiffest)
        main(
            dict(snakemake.params.config),
            inputs,
            {name: Path(path) for name, path in snakemake.output.items()},
        )
