"""Static equilibrium of the section over k*; `snakemake static` makes it."""


rule static_cases:
    """Write the cases of the sweep into one case file."""
    input:
        equivalent=f"{RESULTS}/structure/equivalent.nc",
        polars=solver_input_files(),
    output:
        f"{RESULTS}/cases/static/2d/sweep.json",
    log:
        f"{LOGS}/static_cases.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("static_cases", "solvers"),
        config=RESOLVED,
        cases=SWEEP,
    message:
        "cases of the static section"
    script:
        "../../scripts/static_cases.py"


rule static:
    """Find the equilibrium of all cases in one job."""
    input:
        f"{RESULTS}/cases/static/2d/sweep.json",
        kept=kept_files(),
    output:
        f"{RESULTS}/static/2d/sweep.json",
    log:
        f"{LOGS}/static_2d.log",
    conda:
        ENVIRONMENT
    resources:
        mem_mb=500,
        runtime=10,
    params:
        store=STORE if CONFIG.compute else KEPT_STORE,
        reuse=CONFIG.reuse,
        compute=CONFIG.compute,
    message:
        "static section"
    script:
        "../../scripts/run_cases.py"
