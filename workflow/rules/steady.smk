"""Steady polars of the section (2D) and of the rigid beam (3D).

Case files are written by checkpoints: after one, Snakemake looks again at what has to run, by
content, and so drops the solver jobs whose case came out unchanged. After a rule it would run
every job that depends on a file written anew. (A rule that is inherited is no checkpoint.)
"""


checkpoint steady_cases:
    """Write the cases of all incidences and resolutions, a case file for each dimension."""
    input:
        polars=solver_input_files(),
    output:
        of_dimensions(f"{RESULTS}/cases/steady/{{dimension}}/polar.json"),
    log:
        log_of_dimensions("steady_cases"),
    priority: FIRST
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("steady_cases", "solvers"),
        config=RESOLVED,
        cases=STEADY,
    message:
        "cases of the steady polar: {output}"
    script:
        "../../scripts/steady_cases.py"


checkpoint steady_case_file:
    """Write the case file of one incidence and resolution."""
    input:
        polars=solver_input_files(),
    output:
        f"{RESULTS}/cases/steady/{{dimension}}/{{angle}}.json",
    log:
        f"{LOGS}/steady_case_file_{{dimension}}_{{angle}}.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("steady_cases", "solvers"),
        config=RESOLVED,
        cases=this_angle,
    message:
        "case file of the steady {wildcards.dimension} case {wildcards.angle}"
    script:
        "../../scripts/steady_cases.py"


rule steady_case:
    """Run one case."""
    input:
        f"{RESULTS}/cases/steady/{{dimension}}/{{angle}}.json",
    output:
        f"{RESULTS}/steady/{{dimension}}/{{angle}}.nc",
    log:
        f"{LOGS}/steady_{{dimension}}_{{angle}}.log",
    priority: FIRST
    conda:
        ENVIRONMENT
    threads: ranks
    resources:
        mem_mb=memory,
        runtime=runtime,
        tasks=ranks,
        cpus_per_task=1,
        mpi=launcher,
    params:
        store=STORE,
        reuse=CONFIG.reuse,
        compute=True,
    message:
        "steady {wildcards.dimension} case {wildcards.angle}"
    script:
        "../../scripts/run_cases.py"


if IN_ONE_JOB:

    rule steady_batch:
        """Run all cases of a batch in one job."""
        input:
            f"{RESULTS}/cases/steady/{{dimension}}/polar.json",
            kept=kept_files(),
        output:
            f"{RESULTS}/steady/{{dimension}}/polar.json",
        log:
            f"{LOGS}/steady_{{dimension}}.log",
        priority: FIRST
        conda:
            ENVIRONMENT
        resources:
            mem_mb=memory,
            runtime=runtime,
        params:
            store=STORE if CONFIG.compute else KEPT_STORE,
            reuse=CONFIG.reuse,
            compute=CONFIG.compute,
        message:
            "steady {wildcards.dimension} cases"
        script:
            "../../scripts/run_cases.py"

else:

    rule steady_results:
        """Index the results of a batch whose cases ran one by one."""
        input:
            cases=expand(
                f"{RESULTS}/cases/steady/{{dimension}}/{{angle}}.json",
                angle=STEADY,
                allow_missing=True,
            ),
            results=expand(
                f"{RESULTS}/steady/{{dimension}}/{{angle}}.nc",
                angle=STEADY,
                allow_missing=True,
            ),
        output:
            f"{RESULTS}/steady/{{dimension}}/polar.json",
        log:
            f"{LOGS}/steady_results_{{dimension}}.log",
        localrule: True
        conda:
            ENVIRONMENT
        message:
            "index of the steady {wildcards.dimension} results"
        script:
            "../../scripts/index_results.py"


if CONFIG.steady.beam_polar:

    ruleorder: given_beam_polar > polar

    rule given_beam_polar:
        """Take the polar of the rigid beam from the file that the configuration names."""
        input:
            given([CONFIG.steady.beam_polar]),
        output:
            f"{RESULTS}/steady/polar_3d.nc",
        log:
            f"{LOGS}/given_beam_polar.log",
        localrule: True
        conda:
            ENVIRONMENT
        params:
            code=code("given_beam_polar"),
            resolution=CONFIG.steady.resolution,
        message:
            "3d polar, given"
        script:
            "../../scripts/given_beam_polar.py"


rule polar:
    """Gather the steady results of each dimension into its polar."""
    input:
        indices=of_dimensions(f"{RESULTS}/steady/{{dimension}}/polar.json"),
    output:
        of_dimensions(f"{RESULTS}/steady/polar_{{dimension}}.nc"),
    log:
        log_of_dimensions("polar"),
    priority: FIRST
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("polar"),
        cases=STEADY,
    message:
        "polar: {output}"
    script:
        "../../scripts/polar.py"


rule section_mesh:
    """Make the section's mesh, and its Courant number in the steady flow at the run's incidence."""
    input:
        case=f"{RESULTS}/cases/steady/2d/{MESH_CASE}.json",
        kept=kept_files(),
    output:
        f"{RESULTS}/steady/section_mesh.nc",
    log:
        f"{LOGS}/section_mesh.log",
    conda:
        ENVIRONMENT
    resources:
        mem_mb=2000,
        runtime=60,
    params:
        store=STORE,
        reuse=CONFIG.reuse,
        compute=CONFIG.compute,
        time_step=CONFIG.unsteady.time_step,
    message:
        "mesh of the section"
    script:
        "../../scripts/section_mesh.py"


rule plate_mesh:
    """Make the mesh of the rigid beam at the run's incidence."""
    input:
        case=f"{RESULTS}/cases/steady/3d/{MESH_CASE}.json",
        kept=kept_files(),
    output:
        f"{RESULTS}/steady/plate_mesh.nc",
    log:
        f"{LOGS}/plate_mesh.log",
    conda:
        ENVIRONMENT
    resources:
        mem_mb=memory_of_plate_mesh,
        runtime=60,
    params:
        store=STORE,
        reuse=CONFIG.reuse,
        compute=CONFIG.compute,
    message:
        "mesh of the beam"
    script:
        "../../scripts/plate_mesh.py"


rule grid_study:
    """Observed order and grid convergence index of the section's polar."""
    input:
        polar_2d=f"{RESULTS}/steady/polar_2d.nc",
    output:
        report(
            f"{RESULTS}/tables/grid_study.csv",
            caption="../report/grid_study.rst",
            category="Tables",
            labels={
                "table": "grid study",
                "shows": "convergence of the section polar",
            },
        ),
    log:
        f"{LOGS}/grid_study.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("grid_study"),
        config=RESOLVED,
    message:
        "grid study of the section polar"
    script:
        "../../scripts/grid_study.py"


rule bubble:
    """Length of the section's bubble, and y+, at each resolution and incidence."""
    input:
        index=f"{RESULTS}/steady/2d/polar.json",
    output:
        report(
            f"{RESULTS}/tables/bubble.csv",
            caption="../report/bubble.rst",
            category="Tables",
            labels={
                "table": "bubble",
                "shows": "length of the bubble and wall distance",
            },
        ),
    log:
        f"{LOGS}/bubble.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("bubble"),
        cases=STEADY,
    message:
        "bubble of the section"
    script:
        "../../scripts/bubble.py"
