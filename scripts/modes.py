"""Mode computation: natural frequencies and shapes of the beam."""

import logging
from pathlib import Path

from equisection.beam.beam import Beam
from equisection.config.groups import Structure
from equisection.results.modes_dataset import modes_to_dataset
from equisection.results.netcdf import write_dataset
from equisection.run.script import logged
from equisection.structure.mode_set import frequency_constants
from equisection.structure.modes import modes_of_kinds

#: Modes computed beside those of bending and torsion that are wanted, since some are in-plane;
#: a slender beam needs more, which are then computed.
OTHER_MODES = 4


def main(beam: Beam, structure: Structure, output: Path) -> None:
    """Compute the modes that the configuration asks for."""
    elements = structure.elements
    bending, torsion = structure.bending_modes, structure.torsion_modes
    modes = modes_of_kinds(
        beam,
        structure.method,
        (elements.chord, elements.span, elements.thickness),
        (bending, torsion),
        count=bending + torsion + OTHER_MODES,
    )
    for frequency, kind in zip(modes.frequency, modes.kind, strict=True):
        logging.info("%9.3f Hz %s", frequency, kind)
    write_dataset(output, modes_to_dataset(modes, list(frequency_constants(modes, beam))))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Beam(**snakemake.params.beam),
            Structure(**snakemake.params.structure),
            Path(snakemake.output[0]),
        )
