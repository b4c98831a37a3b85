"""Find the flutter derivatives of the section from its forced motion."""

import logging
from pathlib import Path

from equisection.analysis.forced_derivatives import derivatives_of
from equisection.cases import ForcedCase
from equisection.files import written_whole
from equisection.results.netcdf import read_dataset
from equisection.run.script import logged
from equisection.store.index import read_index, result_file


def main(index: Path, table: Path, fits: Path) -> None:
    """Write the table of derivatives, and how well each history is fitted."""
    results = {}
    for name, attributes in read_index(index).items():
        data = read_dataset(result_file(index, name), str(attributes["case_hash"]))
        results[name] = ForcedCase.model_validate_json(data.attrs["case"]), data
    found = derivatives_of(results)
    for remark in (*found.remarks, *found.derivatives.doubts):
        logging.getLogger(__name__).warning("%s", remark)
    found.derivatives.write(table)
    with written_whole(fits) as aside:
        found.fits.to_csv(aside, index=False, float_format="%.6g")


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.index),
            Path(snakemake.output.table),
            Path(snakemake.output.fits),
        )
