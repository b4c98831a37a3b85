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
        cases=cases_of_sweep,
    message:
        "cases of {wildcards.model}, {wildcards.batch}"
    script:
        "../../scripts/unsteady_cases.py"


if len(WRITTEN_TOGETHER) > 1:

    ruleorder: sweep_cases > unsteady_cases

    checkpoint sweep_cases:
        """Write the cases of the sweep of all models, a case file for each."""
        input:
            **structure_of_models(),
            polars=solver_input_files(),
        output:
            sweeps_of(WRITTEN_TOGETHER, "cases/"),
        log:
            f"{LOGS}/sweep_cases.log",
        priority: FIRST
        localrule: True
        conda:
            ENVIRONMENT
        params:
            code=code("unsteady_cases", "solvers"),
            config=RESOLVED,
            cases=cases_of_sweeps(),
        message:
            "cases of the sweep"
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

    if SECTIONS_TOGETHER:

        ruleorder: sections_batch > unsteady_batch

        use rule steady_batch as sections_batch with:
            input:
                sweeps_of(SECTIONS_TOGETHER, "cases/"),
                kept=kept_files(),
            output:
                sweeps_of(SECTIONS_TOGETHER, ""),
            log:
                f"{LOGS}/unsteady_sections_sweep.log",
            message:
                "sweep of the sections"

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


if plan.learns(CONFIG):

    checkpoint refine_onset:
        """Choose the releases that a model learns from, and those that confirm its onset."""
        input:
            unpack(learnt_before_round),
        output:
            f"{RESULTS}/comparison/refine/{{model}}_{{batch}}.json",
        log:
            f"{LOGS}/learn_onset_{{model}}_{{batch}}.log",
        localrule: True
        conda:
            ENVIRONMENT
        params:
            code=code("learn_onset", "solvers"),
            config=RESOLVED,
        message:
            "onset of {wildcards.model} by a learnt model, {wildcards.batch}"
        script:
            "../../scripts/learn_onset.py"

    rule learnt_model:
        """Learn the model of the loads, and predict growth and onset over the sweep."""
        input:
            unpack(learnt_in_all),
        output:
            expand(
                f"{RESULTS}/rom/{{model}}/{{name}}.nc",
                name=plan.learnt_names(CONFIG),
                allow_missing=True,
            ),
        log:
            f"{LOGS}/learnt_model_{{model}}.log",
        localrule: True
        conda:
            ENVIRONMENT
        params:
            code=code("learnt_model", "solvers"),
            config=RESOLVED,
        message:
            "{wildcards.model}: model learnt from its releases"
        script:
            "../../scripts/learnt_model.py"

else:

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
