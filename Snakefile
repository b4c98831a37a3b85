# The workflow stands in workflow/, where the catalogue of workflows looks for it.
include: "workflow/Snakefile"


rule run:
    """Everything; what `snakemake` without a target makes."""
    default_target: True
    input:
        rules.all.input,
