"""Unsteady runs over k*: the section, the corrected section and the beam.

Case files are written by checkpoints, for the reason given in steady.smk.
"""


ruleorder: unsteady_cases > refined_case


checkpoint unsteady_cases:
    """Write the case file of each k* of the sweep for a model."""
    input:
        unpack(structure_of_model),
        polars=solver_input_files(),
        sources=sources("cases", "solvers", "plan.py"),
    output:
        expand(
            f"{RESULTS}/cases/unsteady/{{model}}/{{case}}.json",
            case=SWEEP,
            allow_missing=True,
        ),
    log:
        f"{LOGS}/unsteady_cases_{{model}}.log",
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        config=RESOLVED,
        model="{model}",
    message:
        "case files of the sweep, model {wildcards.model}"
    script:
        "../../scripts/unsteady_cases.py"


checkpoint refined_case:
    """Write the case file of a k* that the refinement of the onset asks for."""
    input:
        unpack(structure_of_model),
        polars=solver_input_files(),
        sources=sources("cases", "solvers", "plan.py"),
    output:
        f"{RESULTS}/cases/unsteady/{{model}}/{{case}}.json",
    log:
        f"{LOGS}/refined_case_{{model}}_{{case}}.log",
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        config=RESOLVED,
        model="{model}",
    message:
        "case file of {wildcards.case}, model {wildcards.model}"
    script:
        "../../scripts/unsteady_cases.py"


rule unsteady_case:
    """Run one k* of a model until its verdict is in."""
    input:
        f"{RESULTS}/cases/unsteady/{{model}}/{{case}}.json",
    output:
        f"{RESULTS}/unsteady/{{model}}/{{case}}.nc",
    log:
        f"{LOGS}/unsteady_{{model}}_{{case}}.log",
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=2000,
        runtime=1440,
    params:
        store=STORE,
    message:
        "{wildcards.model} at {wildcards.case}"
    script:
        "../../scripts/run_cases.py"


if Capability.BATCH in PROVIDES:

    ruleorder: unsteady_batch > unsteady_case

    rule unsteady_batch:
        """Run all k* of the sweep for a model in one job."""
        input:
            expand(
                f"{RESULTS}/cases/unsteady/{{model}}/{{case}}.json",
                case=SWEEP,
                allow_missing=True,
            ),
        output:
            expand(
                f"{RESULTS}/unsteady/{{model}}/{{case}}.nc",
                case=SWEEP,
                allow_missing=True,
            ),
        log:
            f"{LOGS}/unsteady_{{model}}.log",
        conda:
            ENVIRONMENT
        threads: 1
        resources:
            mem_mb=2000,
            runtime=60,
        params:
            store=STORE,
        message:
            "sweep of {wildcards.model}"
        script:
            "../../scripts/run_cases.py"


checkpoint refine_onset:
    """Choose the next k* inside the bracket of a model's onset."""
    input:
        unpack(results_before_round),
        sources=sources("comparison", "plan.py"),
    output:
        f"{RESULTS}/comparison/refine/{{model}}_{{round}}.json",
    log:
        f"{LOGS}/refine_onset_{{model}}_{{round}}.log",
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        tolerance=CONFIG.sweep.onset_tolerance,
        points=CONFIG.sweep.onset_points,
    message:
        "onset of {wildcards.model}, round {wildcards.round}"
    script:
        "../../scripts/refine_onset.py"
