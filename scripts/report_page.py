"""The report of a run: its answer, figures and tables on one page."""

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from equisection.report.captions import caption_html
from equisection.report.report_page import MapFiles, Shown, write_report
from equisection.run.script import logged


def main(
    output: Path,
    run: Path,
    *,
    figures: Mapping[str, Path],
    tables: Mapping[str, Path],
    marks: Mapping[str, Mapping[str, Any]],
    config: Mapping[str, str],
    map_files: MapFiles | None,
    resolved: Path,
) -> None:
    """Write the report with the figures and tables that rules mark for one, by name."""

    def shown(files: Mapping[str, Path], kind: str) -> list[Shown]:
        return [
            _shown(name, path, kind, marks[path.name], config)
            for name, path in files.items()
            if path.name in marks
        ]

    lacks = write_report(
        output,
        run,
        figures=shown(figures, "figure"),
        tables=shown(tables, "table"),
        map_files=map_files,
        config_text=resolved.read_text(encoding="utf-8"),
    )
    for lack in lacks:
        print(lack, file=sys.stderr)


def _shown(
    name: str, path: Path, kind: str, mark: Mapping[str, Any], config: Mapping[str, str]
) -> Shown:
    label = str(mark["labels"][kind])
    return Shown(
        path,
        name,
        number=label if label.isdigit() else "",
        shows=str(mark["labels"]["shows"]),
        caption=caption_html(mark["caption"], config, mark["values"], name),
    )


if __name__ == "__main__":
    with logged(
        snakemake.log[0], [*snakemake.input.figures, *snakemake.input.tables], snakemake.output
    ):
        main(
            Path(snakemake.output[0]),
            Path(snakemake.input.config).parent,
            figures=dict(
                zip(snakemake.params.figures, map(Path, snakemake.input.figures), strict=True)
            ),
            tables=dict(
                zip(snakemake.params.tables, map(Path, snakemake.input.tables), strict=True)
            ),
            marks=snakemake.params.marks,
            config=snakemake.params.config,
            map_files=MapFiles(
                Path(snakemake.input.map[0]),
                Path(snakemake.input.map[1]),
                snakemake.params.design_speed,
            )
            if snakemake.input.map
            else None,
            resolved=Path(snakemake.input.config),
        )
