"""Reduce the beam to its equivalent section, in both forms."""

import logging
from pathlib import Path

from equisection.beam.beam import Beam
from equisection.beam.section import Section
from equisection.config.groups import Flow
from equisection.reduction.flutter_bias import FlutterBias, flutter_bias
from equisection.reduction.integrals import span_integrals
from equisection.reduction.reduce import (
    REDUCTIONS,
    not_reducible,
    section_of_pair,
    validity_warnings,
)
from equisection.results.modes_dataset import modes_from_dataset
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.section_dataset import equivalent_to_dataset, with_flutter
from equisection.run.script import logged
from equisection.structure.warping import warping_warnings


def main(beam: Beam, flow: Flow, modes_file: Path, output: Path, *, method: str = "solid") -> None:
    """Reduce the modes of the beam (Eqs. 6, 7, 12 and 17)."""
    modes = modes_from_dataset(read_dataset(modes_file))
    count = min(modes.kind.count("bending"), modes.kind.count("torsion"))
    integrals = span_integrals(beam, modes, count)
    pair = modes.section_pair()[0]
    sections: dict[str, Section] = {
        reduction: section_of_pair(beam, pair, reduction) for reduction in REDUCTIONS
    }
    flutter: dict[str, FlutterBias] = {
        reduction: flutter_bias(section, beam, modes, flow.density)
        for reduction, section in sections.items()
    }
    poor = flutter["consistent"].warnings("consistent")
    of_pair = span_integrals(beam, pair, 1)
    soft = warping_warnings(beam, method)
    reason = not_reducible(of_pair, "consistent")
    none = [f"no section stands for this beam: {reason}"] if reason else []
    warnings = (*beam.warnings, *soft, *poor, *none, *validity_warnings(of_pair))
    logging.info(beam.axes_in_words)
    for warning in warnings:
        logging.warning(warning)
    dataset = equivalent_to_dataset(
        sections,
        integrals,
        warnings,
        pair=of_pair,
        places=modes.places,
        density=flow.density,
        speed=flow.speed,
    )
    write_dataset(output, with_flutter(dataset, flutter, flow.density))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Beam(**snakemake.params.beam),
            Flow(**snakemake.params.flow),
            Path(snakemake.input.modes),
            Path(snakemake.output[0]),
            method=snakemake.params.method,
        )
