"""Find the generalised aerodynamic forces of the beam from its forced modes."""

import logging
from collections.abc import Sequence
from pathlib import Path

from equisection.analysis.forced_modes import generalised_forces_of
from equisection.cases import ForcedCase, case_hash, read_cases
from equisection.files import written_whole
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged
from equisection.store.index import read_index, result_file


def main(case_files: Sequence[Path], index: Path, table: Path, fits: Path) -> None:
    """Write the table of forces, and how well each history is fitted."""
    cases = {name: case for file in case_files for name, case in read_cases(file).items()}
    results = {}
    for name in read_index(index):
        case = cases[name]
        assert isinstance(case, ForcedCase)
        results[name] = case, read_dataset(result_file(index, name), case_hash(case))
    found = generalised_forces_of(results)
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
