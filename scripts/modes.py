"""Mode computation: natural frequencies and shapes of the beam, and their mesh study."""

import logging
from pathlib import Path

from equisection.beam.beam import Beam
from equisection.config.groups import Structure
from equisection.results.modes_dataset import mesh_study_to_dataset, modes_to_dataset
from equisection.results.netcdf import write_dataset
from equisection.run.script import logged
from equisection.structure.mode_set import frequency_constants
from equisection.structure.modes import compute_modes, mesh_study, modes_of_kinds

#: Modes computed beside those of bending and torsion that are wanted, since some are in-plane;
#: a slender beam needs more, which are then computed.
OTHER_MODES = 4
#: Modes of the analytic beam that those of the mesh study are looked for among.
ANALYTIC_MODES = 24


def main(beam: Beam, structure: Structure, output: Path, study_output: Path) -> None:
    """Compute the modes that the configuration asks for, and the first on each mesh of the study.

    The modes and their file are complete before the study begins.
    """
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
    levels = [(mesh.chord, mesh.span, mesh.thickness) for mesh in structure.mesh_study]
    method = "beam" if structure.method == "analytic" else structure.method
    study = mesh_study(beam, levels, method, solved=modes)
    closed_form = None
    if not beam.has_fittings:
        closed_form = compute_modes(beam, "analytic", levels[-1], count=ANALYTIC_MODES)
    write_dataset(study_output, mesh_study_to_dataset(study, closed_form))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Beam(**snakemake.params.beam),
            Structure(**snakemake.params.structure),
            Path(snakemake.output.modes),
            Path(snakemake.output.mesh_study),
        )
