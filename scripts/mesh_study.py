"""Natural frequencies on coarser and coarser meshes, and of the analytic beam."""

from pathlib import Path

from equisection.beam.beam import Beam
from equisection.config.groups import Structure
from equisection.results.modes_dataset import mesh_study_to_dataset
from equisection.results.netcdf import write_dataset
from equisection.run.script import logged
from equisection.structure.modes import compute_modes, mesh_study


def main(beam: Beam, structure: Structure, output: Path) -> None:
    """Compute the first modes on each mesh of the study."""
    levels = [(mesh.chord, mesh.span, mesh.thickness) for mesh in structure.mesh_study]
    method = "beam" if structure.method == "analytic" else structure.method
    study = mesh_study(beam, levels, method)
    analytic = compute_modes(beam, "analytic", levels[-1], count=24)
    write_dataset(output, mesh_study_to_dataset(study, analytic))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Beam(**snakemake.params.beam),
            Structure(**snakemake.params.structure),
            Path(snakemake.output[0]),
        )
