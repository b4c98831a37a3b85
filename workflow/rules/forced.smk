"""Forced motion of the section, and its flutter derivatives.

Nothing asks for it but `forced.run: true`, or the file `derivatives/2d.csv` by its name. Case files
are written by checkpoints, for the reason given in steady.smk.
"""


checkpoint forced_cases:
    """Write the cases of pitch and heave into one case file."""
    input:
        polars=solver_input_files(),
    output:
        f"{RESULTS}/cases/forced/2d/forced.json",
    log:
        f"{LOGS}/forced_cases.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("forced_cases", "solvers"),
        config=RESOLVED,
        cases=FORCED_NAMES,
    message:
        "cases of the forced motion"
    script:
        "../../scripts/forced_cases.py"


checkpoint forced_case_file:
    """Write the case file of one motion."""
    input:
        polars=solver_input_files(),
    output:
        f"{RESULTS}/cases/forced/2d/{{motion}}.json",
    log:
        f"{LOGS}/forced_case_file_{{motion}}.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("forced_cases", "solvers"),
        config=RESOLVED,
        cases=this_motion,
    message:
        "case file of the forced motion {wildcards.motion}"
    script:
        "../../scripts/forced_cases.py"


use rule steady_case as forced_case with:
    input:
        f"{RESULTS}/cases/forced/2d/{{motion}}.json",
    output:
        f"{RESULTS}/forced/2d/{{motion}}.nc",
    log:
        f"{LOGS}/forced_{{motion}}.log",
    message:
        "forced motion {wildcards.motion}"


if IN_ONE_JOB:

    use rule steady_batch as forced_batch with:
        input:
            f"{RESULTS}/cases/forced/2d/forced.json",
            kept=kept_files(),
        output:
            f"{RESULTS}/forced/2d/forced.json",
        log:
            f"{LOGS}/forced.log",
        resources:
            mem_mb=1000,
            runtime=10,
        message:
            "forced motions"

else:

    use rule steady_results as forced_results with:
        input:
            cases=case_files_of_motions(),
            results=expand(f"{RESULTS}/forced/2d/{{motion}}.nc", motion=FORCED_NAMES),
        output:
            f"{RESULTS}/forced/2d/forced.json",
        log:
            f"{LOGS}/forced_results.log",
        message:
            "index of the forced motions"


rule forced_derivatives:
    """Find the flutter derivatives from the loads in forced motion."""
    input:
        cases=case_files_of_motions(),
        index=f"{RESULTS}/forced/2d/forced.json",
    output:
        table=report(
            f"{RESULTS}/derivatives/2d.csv",
            caption="../report/derivatives.rst",
            category="Tables",
            labels={
                "table": "derivatives",
                "shows": "flutter derivatives of the section",
            },
        ),
        fits=f"{RESULTS}/derivatives/2d-fit.csv",
    log:
        f"{LOGS}/forced_derivatives.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("forced_derivatives"),
    message:
        "flutter derivatives of the section"
    script:
        "../../scripts/forced_derivatives.py"
