"""Forced motion of section and beam, flutter derivatives, and forces on the modes of the beam.

Nothing asks for it but `forced.run: true`, or a file such as `derivatives/2d.csv` by its name. Case files
are written by checkpoints, for the reason given in steady.smk.
"""


checkpoint forced_cases:
    """Write the cases of pitch and heave, or of the beam's modes, into one case file."""
    input:
        polars=solver_input_files(),
        modes=modes_of_motions,
    output:
        f"{RESULTS}/cases/forced/{{dimension}}/forced.json",
    log:
        f"{LOGS}/forced_cases_{{dimension}}.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("forced_cases", "solvers"),
        config=RESOLVED,
        cases=motions,
    message:
        "cases of the forced {wildcards.dimension} motion"
    script:
        "../../scripts/forced_cases.py"


checkpoint forced_case_file:
    """Write the case file of one motion."""
    input:
        polars=solver_input_files(),
        modes=modes_of_motions,
    output:
        f"{RESULTS}/cases/forced/{{dimension}}/{{motion}}.json",
    log:
        f"{LOGS}/forced_case_file_{{dimension}}_{{motion}}.log",
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
        f"{RESULTS}/cases/forced/{{dimension}}/{{motion}}.json",
    output:
        f"{RESULTS}/forced/{{dimension}}/{{motion}}.nc",
    log:
        f"{LOGS}/forced_{{dimension}}_{{motion}}.log",
    message:
        "forced motion {wildcards.motion}"


if IN_ONE_JOB:

    use rule steady_batch as forced_batch with:
        input:
            f"{RESULTS}/cases/forced/{{dimension}}/forced.json",
            kept=kept_files(),
        output:
            f"{RESULTS}/forced/{{dimension}}/forced.json",
        log:
            f"{LOGS}/forced_{{dimension}}.log",
        resources:
            mem_mb=1000,
            runtime=10,
        message:
            "forced {wildcards.dimension} motions"

else:

    use rule steady_results as forced_results with:
        input:
            cases=case_files_of_motions,
            results=results_of_motions,
        output:
            f"{RESULTS}/forced/{{dimension}}/forced.json",
        log:
            f"{LOGS}/forced_results_{{dimension}}.log",
        message:
            "index of the forced {wildcards.dimension} motions"


rule forced_derivatives:
    """Find the flutter derivatives from the loads in forced motion."""
    input:
        cases=case_files_of_forced("2d"),
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


rule forced_modes:
    """Find the generalised aerodynamic forces on the modes of the beam from the loads in motion."""
    input:
        cases=case_files_of_forced("3d"),
        index=f"{RESULTS}/forced/3d/forced.json",
    output:
        table=report(
            f"{RESULTS}/derivatives/3d.csv",
            caption="../report/generalised_forces.rst",
            category="Tables",
            labels={
                "table": "forces on modes",
                "shows": "generalised aerodynamic forces of the beam",
            },
        ),
        fits=f"{RESULTS}/derivatives/3d-fit.csv",
    log:
        f"{LOGS}/forced_modes.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("forced_modes"),
    message:
        "generalised aerodynamic forces of the beam"
    script:
        "../../scripts/forced_modes.py"
