"""Correct the section's loads for the finite beam (Eq. 20)."""

import logging
from collections.abc import Sequence
from pathlib import Path

from equisection.aerodynamics.polar import Polar
from equisection.errors import ResultFileError
from equisection.io.polar_rows import MID_CHORD
from equisection.reduction.carried_beam import beam_carried_over
from equisection.reduction.correction import CorrectionFactors
from equisection.results.correction_dataset import factors_to_dataset, no_factors
from equisection.results.modes_dataset import modes_from_dataset
from equisection.results.netcdf import read_dataset, write_dataset
from equisection.results.polar_dataset import polar_at
from equisection.run.script import logged

logger = logging.getLogger(__name__)


def main(
    polar_2d: Path,
    polar_3d: Path,
    resolution: str,
    output: Path,
    *,
    modes: Path | None = None,
    section_of_beam: Path | None = None,
    may_lack: bool = False,
) -> None:
    """Divide the section's coefficients by the beam's, at the run's resolution.

    Where a run from kept results alone corrects no section, it may lack a polar: there are no
    factors then. With modes the beam's coefficients are the loads on these (:mod:`.modal_load`).
    With the polar of another section, that of the beam, their ratio is kept
    (:mod:`.carried_beam`).
    """
    weights = None if modes is None else modes_from_dataset(read_dataset(modes))
    try:
        section = polar_at(read_dataset(polar_2d), resolution)
        beam = polar_at(read_dataset(polar_3d), resolution, weights)
    except ResultFileError as error:
        if not may_lack:
            raise
        logger.warning("there is no correction, which no model needs: %s", error)
        write_dataset(output, no_factors())
        return
    if section_of_beam is not None:
        belongs = Polar.read(section_of_beam, symmetric=False, moment_axis=MID_CHORD)
        beam = beam_carried_over(section, CorrectionFactors(belongs, beam))
    factors = factors_to_dataset(CorrectionFactors(section, beam))
    correction = "mean" if modes is None else "modal"
    write_dataset(output, factors.assign_attrs(correction=correction))


def _only(files: Sequence[str] | str) -> Path | None:
    """Return the one file of an input that may have none."""
    if not files:
        return None
    return Path(files if isinstance(files, str) else files[0])


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Path(snakemake.input.polar_2d),
            Path(snakemake.input.polar_3d),
            snakemake.params.resolution,
            Path(snakemake.output[0]),
            modes=_only(snakemake.input.modes),
            section_of_beam=_only(snakemake.input.section_of_beam),
            may_lack=snakemake.params.may_lack,
        )
