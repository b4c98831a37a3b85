"""What the report shows, and what the rules say of it."""

from snakemake.io import is_flagged

# As Snakemake knows a file of this workflow, which may be a module with a prefix.
as_known = workflow.modifier.modify_path


def figures_of_report():
    """Return the pictures of the report in reading order, by their names in the catalogue."""
    drawn = names_of(catalogue.figures(CONFIG))
    further = [path for path in FURTHER_FILES if path.endswith(".png")]
    return {
        **{Path(path).stem: path for path in further},
        **{
            name: f"{RESULTS}/figures/{number or name}.png"
            for name, number in drawn.items()
        },
    }


def tables_of_report():
    """Return the tables that the report may show in reading order, by their names."""
    files = [*comparison_files(), *derivative_files(), *table_files(), *FURTHER_FILES]
    tables = {Path(path).stem: path for path in files if path.endswith(".csv")}
    first = [name for name in ("critical_speed", "onset") if name in tables]
    return {name: tables[name] for name in dict.fromkeys([*first, *tables])}


def marks(wildcards):
    """Return what the rules say of the files that they mark for a report, by file name: labels,
    caption, and the values that the caption may name.
    """
    files = [*figures_of_report().values(), *tables_of_report().values()]
    return {
        Path(path).name: mark for path in files for mark in marks_of(as_known(path))
    }


def marks_of(path):
    """Yield what the rule of a file says of it, if it marks it for a report."""
    for one in workflow.rules:
        for output in one.output:
            if is_flagged(output, "report") and output.match(path):
                mark = output.flags["report"]
                yield {
                    "labels": dict(mark.labels),
                    "caption": workflow.sourcecache.open(mark.caption).read(),
                    "values": dict(one.params.items()).get("values", {}),
                }
