"""Mode computation."""


rule modes:
    """Natural frequencies and mode shapes of the beam, and the frequencies on coarser meshes."""
    output:
        modes=f"{RESULTS}/structure/modes.nc",
        mesh_study=f"{RESULTS}/structure/mesh_study.nc",
    log:
        f"{LOGS}/modes.log",
    priority: FIRST + 1
    conda:
        ENVIRONMENT
    resources:
        mem_mb=2500,
        runtime=10,
    params:
        code=code("modes"),
        beam=RESOLVED["beam"],
        structure=RESOLVED["structure"],
    message:
        "modes of the beam"
    script:
        "../../scripts/modes.py"
