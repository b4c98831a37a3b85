"""Mode computation."""


rule modes:
    """Natural frequencies and mode shapes of the beam."""
    output:
        f"{RESULTS}/structure/modes.nc",
    log:
        f"{LOGS}/modes.log",
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=2500,
        runtime=10,
    params:
        code=code("beam", "structure", "results/modes_dataset.py"),
        beam=RESOLVED["beam"],
        structure=RESOLVED["structure"],
    message:
        "modes of the beam"
    script:
        "../../scripts/modes.py"


rule mesh_study:
    """The natural frequencies on coarser meshes, and those of the analytic beam."""
    output:
        f"{RESULTS}/structure/mesh_study.nc",
    log:
        f"{LOGS}/mesh_study.log",
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=2000,
        runtime=10,
    params:
        code=code("beam", "structure", "results/modes_dataset.py"),
        beam=RESOLVED["beam"],
        structure=RESOLVED["structure"],
    message:
        "mesh study of the modes"
    script:
        "../../scripts/mesh_study.py"
