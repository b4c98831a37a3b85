"""The figures, a rule for each from the catalogue, named by what they show."""

from equisection.figures import catalogue

(STYLE,) = of_project("envs/equisection.mplstyle")
THIS_RUN = catalogue.RunFiles(CONFIG, RESULTS, REFERENCES)


def inputs_of(entries):
    """Return the files that some figures are drawn from, by name."""
    return {
        name: files
        for entry in entries
        for name, files in entry.files(THIS_RUN).items()
    }


def values_of(entries):
    """Return the values of the configuration that some figures need, by name."""
    return {
        name: value
        for entry in entries
        for name, value in entry.values(RESOLVED).items()
    }


def names_of(entries):
    """Return figures by name, each with its further name, if it has one."""
    return {
        entry.name: getattr(FURTHER_NAMES.get(entry.name), "name", "")
        for entry in entries
    }


def pictures_of(entries):
    """Return the files of some figures under all of their names; the report shows one of each."""
    pictures = {}
    for entry in entries:
        further = FURTHER_NAMES.get(entry.name)
        shown, labels = further or entry, {"figure": entry.name, "shows": entry.shows}
        if further:
            pictures |= files_of(entry.name)
            labels["figure"] = further.number
        pictures |= files_of(shown.name)
        pictures[f"{shown.name}_png"] = report(
            pictures[f"{shown.name}_png"],
            caption=shown.caption,
            category="Figures",
            labels=labels,
        )
    return pictures


def files_of(name):
    """Return the files of a figure, one for each format."""
    return {
        f"{name}_{suffix}": f"{RESULTS}/figures/{name}.{suffix}"
        for suffix in CONFIG.figure_formats
    }


for job, entries in catalogue.figures_by_job(CONFIG).items():

    rule:
        """Draw the figures that the catalogue has under this name."""
        name:
            job
        input:
            **inputs_of(entries),
            style=STYLE,
        output:
            **pictures_of(entries),
        log:
            f"{LOGS}/{job}.log",
        localrule: True
        conda:
            ENVIRONMENT
        params:
            code=code("figure", *(f"figures.{entry.module}" for entry in entries)),
            names=names_of(entries),
            values=values_of(entries),
        message:
            ", ".join(entry.shows for entry in entries)
        script:
            "../../scripts/figure.py"
