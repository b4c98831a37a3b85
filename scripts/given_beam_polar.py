"""Take the polar of the rigid beam from a file instead of from steady results."""

from pathlib import Path

from equisection.aerodynamics.polar import Polar
from equisection.io.polar_rows import MID_CHORD
from equisection.results.netcdf import write_dataset
from equisection.results.polar_dataset import given_polar
from equisection.run.script import logged


def main(polar: Path, resolution: str, output: Path) -> None:
    """Write the file's polar as that of the run's resolution."""
    beam = Polar.read(polar, symmetric=False, moment_axis=MID_CHORD)
    write_dataset(output, given_polar(beam, resolution))


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(Path(snakemake.input[0]), snakemake.params.resolution, Path(snakemake.output[0]))
