"""Correct the section's loads for the finite beam (Eq. 20)."""

from pathlib import Path

from equisection.reduction.correction import CorrectionFactors
from equisection.results.correction_dataset import factors_to_dataset
from equisection.results.modes_dataset import modes_from_dataset
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.polar_dataset import polar_at
from equisection.run.script import logged


def main(
    polar_2d: Path, polar_3d: Path, resolution: str, output: Path, modes: Path | None = None
) -> None:
    """Divide the section's coefficients by the beam's, at the run's resolution.

    With modes the beam's coefficients are the loads on these (:mod:`.modal_load`).
    """
    weights = None if modes is None else modes_from_dataset(read_dataset(modes))
    section = polar_at(read_dataset(polar_2d), resolution)
    beam = polar_at(read_dataset(polar_3d), resolution, weights)
    factors = factors_to_dataset(CorrectionFactors(section, beam))
    correction = "mean" if modes is None else "modal"
    write_dataset(output, factors.assign_attrs(correction=correction))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.polar_2d),
            Path(snakemake.input.polar_3d),
            snakemake.params.resolution,
            Path(snakemake.output[0]),
            Path(snakemake.input.modes) if snakemake.input.modes else None,
        )
