"""Summary of all runs, the bracket of the onset, and how the models compare."""


rule config_resolved:
    """The configuration with every default filled in."""
    output:
        f"{RESULTS}/config.resolved.yaml",
    log:
        f"{LOGS}/config_resolved.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("config_resolved"),
        config=RESOLVED,
    message:
        "resolved configuration"
    script:
        "../../scripts/config_resolved.py"


rule summary:
    """One line for each run of each model."""
    input:
        indices=indices_of_sweep(CONFIG, RESULTS),
        equivalent=f"{RESULTS}/structure/equivalent.nc",
    output:
        report(
            f"{RESULTS}/comparison/summary.csv",
            caption="../report/summary.rst",
            category="Tables",
            labels={"table": "summary", "shows": "one line for each run"},
        ),
    log:
        f"{LOGS}/summary.log",
    priority: FIRST
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("summary"),
        models=list(CONFIG.sweep.shown),
        speed=CONFIG.flow.speed,
        reduction=CONFIG.reduction,
    message:
        "summary"
    script:
        "../../scripts/summary.py"


rule missing:
    """Name the cases that no kept result, or no file of a record, answers."""
    input:
        indices=indices_of_sweep(CONFIG, RESULTS),
        steady=expand(
            f"{RESULTS}/steady/{{dimension}}/polar.json", dimension=DIMENSIONS
        ),
    output:
        f"{RESULTS}/comparison/missing.csv",
    log:
        f"{LOGS}/missing.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("missing"),
    message:
        "cases without a result"
    script:
        "../../scripts/missing.py"


rule onset:
    """The bracket of the onset of each model, linear theory, and the sections against the beam."""
    input:
        summary=f"{RESULTS}/comparison/summary.csv",
        equivalent=f"{RESULTS}/structure/equivalent.nc",
        polar_2d=f"{RESULTS}/steady/polar_2d.nc",
        stability=stability_table_of_map(),
        derivatives=table_of_derivatives(),
        forces=forces_on_modes(),
        modes=modes_of_table(),
        learnt=learnt_models(),
    output:
        onset=report(
            f"{RESULTS}/comparison/onset.csv",
            caption="../report/onset.rst",
            category="Tables",
            labels={"table": "onset", "shows": "bracket of the onset of each model"},
        ),
        linear_theory=report(
            f"{RESULTS}/comparison/linear_theory.csv",
            caption="../report/linear_theory.rst",
            category="Tables",
            labels={
                "table": "linear theory",
                "shows": "what Theodorsen's theory sees",
            },
        ),
        critical_speed=report(
            f"{RESULTS}/comparison/critical_speed.csv",
            caption="../report/critical_speed.rst",
            category="Tables",
            labels={
                "table": "critical speed",
                "shows": "speed of the onset of each model, in m/s",
            },
        ),
        section_and_beam=[
            report(
                path,
                caption="../report/section_and_beam.rst",
                category="Tables",
                labels={
                    "table": "section and beam",
                    "shows": "how far each section is from the beam",
                },
            )
            for path in sections_against_beam()
        ],
    log:
        f"{LOGS}/onset.log",
    priority: FIRST
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("onset"),
        resolution=CONFIG.steady.resolution,
        incidence_deg=CONFIG.flow.incidence_deg,
        speed=CONFIG.flow.speed,
        reduction=CONFIG.reduction,
        values=list(CONFIG.sweep.values()),
        along=onset_axis(varied(CONFIG)).name,
        config=RESOLVED,
    message:
        "onset of the instability"
    script:
        "../../scripts/onset.py"


if plan.has_learnt_map(CONFIG):

    rule stability_map:
        """Stability over incidence and speed of models that were learnt from releases."""
        input:
            **structure_of_map(),
            **polars_of_learnt(),
            learnt=learnt_models(),
        output:
            stability_map=f"{RESULTS}/comparison/stability_map.nc",
            stability=report(
                f"{RESULTS}/comparison/stability.csv",
                caption="../report/stability.rst",
                category="Tables",
                labels={
                    "table": "stability",
                    "shows": "critical speed over incidence",
                },
            ),
        log:
            f"{LOGS}/stability_map.log",
        priority: FIRST
        localrule: True
        conda:
            ENVIRONMENT
        params:
            code=code("learnt_map", "solvers"),
            config=RESOLVED,
        message:
            "stability over incidence and speed, by learnt models"
        script:
            "../../scripts/learnt_map.py"

elif plan.has_stability_map(CONFIG):

    rule stability_map:
        """Stability over incidence and speed, its critical speeds, and the design speed."""
        input:
            **structure_of_map(),
            polars=solver_input_files(),
        output:
            **in_use_of_map(),
            stability_map=f"{RESULTS}/comparison/stability_map.nc",
            stability=report(
                f"{RESULTS}/comparison/stability.csv",
                caption="../report/stability.rst",
                category="Tables",
                labels={
                    "table": "stability",
                    "shows": "critical speed over incidence",
                },
            ),
            sensitivities=f"{RESULTS}/comparison/sensitivities.csv",
        log:
            f"{LOGS}/stability_map.log",
        priority: FIRST
        localrule: True
        conda:
            ENVIRONMENT
        params:
            code=code("stability_map"),
            config=RESOLVED,
        message:
            "stability over incidence and speed"
        script:
            "../../scripts/stability_map.py"
