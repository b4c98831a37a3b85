"""Find the generalised aerodynamic forces of the beam from its forced modes."""

import logging
from collections.abc import Sequence
from pathlib import Path

from equisection.analysis.forced_loads import read_results
from equisection.analysis.forced_modes import generalised_forces_of
from equisection.files import written_whole
from equisection.run.script import logged


def main(case_files: Sequence[Path], index: Path, table: Path, fits: Path) -> None:
    """Write the table of forces, and how well each history is fitted."""
    found = generalised_forces_of(read_results(case_files, index))
    for remark in found.remarks:
        logging.getLogger(__name__).warning("%s", remark)
    found.forces.write(
        table, ["(int c_l g dz/L, int c_m f dz/L) = Q (W/c, Theta), modes of largest value 1"]
    )
    with written_whole(fits) as aside:
        found.fits.to_csv(aside, index=False, float_format="%.6g")


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            [Path(path) for path in snakemake.input.cases],
            Path(snakemake.input.index),
            Path(snakemake.output.table),
            Path(snakemake.output.fits),
        )
