"""Summary of all runs, the bracket of the onset, and the numbers that the paper states."""

# Modules of the classical baseline.
LINEAR_THEORY = (
    "aerodynamics/indicial.py",
    "aerodynamics/thin_airfoil.py",
    "analysis/linear_theory.py",
    "beam/section.py",
    "motion/linear_flutter.py",
    "results/section_dataset.py",
)


rule config_resolved:
    """The configuration with every default filled in."""
    output:
        f"{RESULTS}/config.resolved.yaml",
    log:
        f"{LOGS}/config_resolved.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code("config", "keys"),
        config=RESOLVED,
    message:
        "resolved configuration"
    script:
        "../../scripts/config_resolved.py"


rule summary:
    """One line for each run of each model."""
    input:
        indices=indices_of_sweep,
    output:
        report(
            f"{RESULTS}/comparison/summary.csv",
            caption="../report/summary.rst",
            category="Tables",
            labels={"table": "summary", "shows": "one line for each run"},
        ),
    log:
        f"{LOGS}/summary.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code("analysis/summary.py", "results"),
        models=list(CONFIG.sweep.shown),
    message:
        "summary"
    script:
        "../../scripts/summary.py"


rule missing:
    """Name the cases that no kept result answers, where none is computed."""
    input:
        indices=indices_of_sweep,
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
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code("analysis/missing.py", "store/index.py"),
    message:
        "cases without a kept result"
    script:
        "../../scripts/missing.py"


rule onset:
    """The bracket of the onset of each model."""
    input:
        summary=f"{RESULTS}/comparison/summary.csv",
        equivalent=f"{RESULTS}/structure/equivalent.nc",
        polar_2d=f"{RESULTS}/steady/polar_2d.nc",
    output:
        report(
            f"{RESULTS}/comparison/onset.csv",
            caption="../report/onset.rst",
            category="Tables",
            labels={"table": "onset", "shows": "bracket of the onset of each model"},
        ),
    log:
        f"{LOGS}/onset.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code("analysis/onset.py", *LINEAR_THEORY),
        resolution=CONFIG.steady.resolution,
        incidence_deg=CONFIG.flow.incidence_deg,
        speed=CONFIG.flow.speed,
        reduction=CONFIG.reduction,
    message:
        "onset of the instability"
    script:
        "../../scripts/onset.py"


rule linear_theory:
    """Growth and frequency of the section by classical linear theory."""
    input:
        equivalent=f"{RESULTS}/structure/equivalent.nc",
    output:
        report(
            f"{RESULTS}/comparison/linear_theory.csv",
            caption="../report/linear_theory.rst",
            category="Tables",
            labels={
                "table": "linear theory",
                "shows": "what Theodorsen's theory sees",
            },
        ),
    log:
        f"{LOGS}/linear_theory.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code(*LINEAR_THEORY),
        k_star=list(CONFIG.sweep.values()),
    message:
        "linear theory"
    script:
        "../../scripts/linear_theory.py"


rule paper_comparison:
    """Every number that the paper states, beside that of this run."""
    input:
        modes=f"{RESULTS}/structure/modes.nc",
        equivalent=f"{RESULTS}/structure/equivalent.nc",
        mesh_study=f"{RESULTS}/structure/mesh_study.nc",
        polar_3d=polar_of_beam(),
        index_3d=index_of_beam(),
        correction=correction_of_beam(),
        bubble=bubble_of_section(),
        summary=f"{RESULTS}/comparison/summary.csv",
        onset=f"{RESULTS}/comparison/onset.csv",
    output:
        paper=report(
            f"{RESULTS}/comparison/paper.csv",
            caption="../report/paper.rst",
            category="Tables",
            labels={"table": "numbers", "shows": "every number that the paper states"},
        ),
        table2=report(
            f"{RESULTS}/tables/table2.csv",
            caption="../report/table2.rst",
            category="Tables",
            labels={"table": "2", "shows": "natural frequencies in vacuum"},
        ),
    log:
        f"{LOGS}/paper_comparison.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code("analysis", "paper", "results/correction_dataset.py"),
        is_paper_case=CONFIG.is_paper_case,
        config=RESOLVED,
    message:
        "comparison with the paper"
    script:
        "../../scripts/paper_comparison.py"


rule rigid_beam_table:
    """Loads of the rigid beam beside those of the paper (Table 1)."""
    input:
        polar_3d=f"{RESULTS}/steady/polar_3d.nc",
    output:
        report(
            f"{RESULTS}/tables/table1.csv",
            caption="../report/table1.rst",
            category="Tables",
            labels={"table": "1", "shows": "force coefficients of the rigid plate"},
        ),
    log:
        f"{LOGS}/rigid_beam_table.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=500,
        runtime=5,
    params:
        code=code("paper/tables.py", "paper/printed_values.py"),
        is_paper_case=CONFIG.is_paper_case,
    message:
        "Table 1, loads of the rigid beam"
    script:
        "../../scripts/rigid_beam_table.py"
