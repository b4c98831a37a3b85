"""Unsteady runs over k*: the section, the corrected section and the beam.

Case files are written by checkpoints, for the reason given in steady.smk.
"""


checkpoint unsteady_cases:
    """Write the cases of a batch of k* (the sweep, or a round of refinement) into one case file."""
    input:
        unpack(inputs_of_batch),
        polars=solver_input_files(),
    output:
        f"{RESULTS}/cases/unsteady/{{model}}/{{batch}}.json",
    log:
        f"{LOGS}/unsteady_cases_{{model}}_{{batch}}.log",
    priority: FIRST
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("unsteady_cases", "solvers"),
        config=RESOLVED,
        cases=SWEEP,
    message:
        "cases of {wildcards.model}, {wildcards.batch}"
    script:
        "../../scripts/unsteady_cases.py"


checkpoint unsteady_case_file:
    """Write the case file of one k*."""
    input:
        unpack(structure_of_model),
        polars=solver_input_files(),
    output:
        f"{RESULTS}/cases/unsteady/{{model}}/{{case}}.json",
    log:
        f"{LOGS}/unsteady_case_file_{{model}}_{{case}}.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("unsteady_cases", "solvers"),
        config=RESOLVED,
        cases=this_case,
    message:
        "case file of {wildcards.model} at {wildcards.case}"
    script:
        "../../scripts/unsteady_cases.py"


use rule steady_case as unsteady_case with:
    input:
        f"{RESULTS}/cases/unsteady/{{model}}/{{case}}.json",
    output:
        f"{RESULTS}/unsteady/{{model}}/{{case}}.nc",
    log:
        f"{LOGS}/unsteady_{{model}}_{{case}}.log",
    message:
        "{wildcards.model} at {wildcards.case}"


if IN_ONE_JOB:

    use rule steady_batch as unsteady_batch with:
        input:
            f"{RESULTS}/cases/unsteady/{{model}}/{{batch}}.json",
            kept=kept_files(),
        output:
            f"{RESULTS}/unsteady/{{model}}/{{batch}}.json",
        log:
            f"{LOGS}/unsteady_{{model}}_{{batch}}.log",
        message:
            "{wildcards.model}, {wildcards.batch}"

else:

    use rule steady_results as unsteady_results with:
        input:
            unpack(cases_of_batch),
        output:
            f"{RESULTS}/unsteady/{{model}}/{{batch}}.json",
        log:
            f"{LOGS}/unsteady_results_{{model}}_{{batch}}.log",
        message:
            "index of {wildcards.model}, {wildcards.batch}"


checkpoint refine_onset:
    """Choose the next k* inside the bracket of a model's onset."""
    input:
        indices=indices_before_round,
    output:
        f"{RESULTS}/comparison/refine/{{model}}_{{batch}}.json",
    log:
        f"{LOGS}/refine_onset_{{model}}_{{batch}}.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("refine_onset"),
        tolerance=CONFIG.sweep.onset_tolerance,
        points=CONFIG.sweep.onset_points,
        given=(min(CONFIG.sweep.values()), max(CONFIG.sweep.values())),
        reach=CONFIG.sweep.onset_reach,
        highest=plan.highest_of_sweep(CONFIG),
    message:
        "onset of {wildcards.model}, {wildcards.batch}"
    script:
        "../../scripts/refine_onset.py"
