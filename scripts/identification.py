"""Identify the lags of the embedded solver from CFD histories, and judge it on others."""

import logging
from collections.abc import Sequence
from pathlib import Path

import pandas as pd
import yaml

from equisection.aerodynamics.identification import identify_lags
from equisection.aerodynamics.unsteady_loads import UnsteadyLoads
from equisection.config.groups import Embedded
from equisection.figures.identified_lags import draw
from equisection.figures.save import save_figure
from equisection.figures.style import drawing_style
from equisection.files import write_text, written_whole
from equisection.motion.release_judgement import judge_release, judgement_table
from equisection.results.recorded_history import read_reference_history
from equisection.run.script import logged
from equisection.solvers.embedded.adapter import read_section_polar

FITTED_TO, JUDGED_ON = "fitted to", "judged on"


def main(
    embedded: Embedded,
    resolution: str,
    *,
    style: Path,
    lags_file: Path,
    judgement_file: Path,
    figures: Sequence[Path],
) -> None:
    """Write the lags in the form of a configuration, their judgement, and its figure."""
    polar = read_section_polar(embedded, resolution)
    fitted_to = [read_reference_history(Path(path)) for path in embedded.identification.fitted_to]
    judged_on = [read_reference_history(Path(path)) for path in embedded.identification.judged_on]
    found = identify_lags(polar, fitted_to)
    lags = found.lags
    values = {
        "relaxation": round(lags.relaxation, 3),
        "delay": round(lags.delay, 3),
        "lift_lag": round(lags.lift_lag, 3),
    }
    logging.info("lags %s after %d evaluations", values, found.evaluations)
    if found.untold:
        logging.warning(
            "these histories do not tell %s; give others, of larger amplitude or another k*, or no "
            "lags at all for a section that stays attached",
            " and ".join(found.untold),
        )
    write_text(lags_file, yaml.safe_dump({"embedded": {"separation": values}}))
    loads = UnsteadyLoads.from_polar(polar, lags)
    releases = [(FITTED_TO, history) for history in fitted_to]
    releases += [(JUDGED_ON, history) for history in judged_on]
    judgements = [(use, judge_release(history, loads)) for use, history in releases]
    table = pd.DataFrame(judgement_table(judgements))
    with written_whole(judgement_file) as aside:
        table.to_csv(aside, index=False, float_format="%.5g")
    sources = [history.source for _, history in releases]
    with drawing_style(style):
        save_figure(draw(judgements, FITTED_TO, polar.label, sources), figures)


if __name__ == "__main__":
    with logged(snakemake.log[0], snakemake.input, snakemake.output):
        main(
            Embedded(**snakemake.params.embedded),
            snakemake.params.resolution,
            style=Path(snakemake.input.style),
            lags_file=Path(snakemake.output.lags),
            judgement_file=Path(snakemake.output.judgement),
            figures=[Path(path) for path in snakemake.output.figures],
        )
