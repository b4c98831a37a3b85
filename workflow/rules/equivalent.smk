"""Equivalent properties of the section, and the correction factors for the finite beam."""


rule equivalent_section:
    """Reduce the beam to its equivalent section, in both forms."""
    input:
        modes=f"{RESULTS}/structure/modes.nc",
    output:
        f"{RESULTS}/structure/equivalent.nc",
    log:
        f"{LOGS}/equivalent_section.log",
    priority: FIRST
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("equivalent_section"),
        beam=RESOLVED["beam"],
        flow=RESOLVED["flow"],
        method=CONFIG.structure.method,
    message:
        "equivalent section"
    script:
        "../../scripts/equivalent_section.py"


rule correction_factors:
    """Correct the section's loads for the finite beam (Eq. 20)."""
    input:
        polar_2d=f"{RESULTS}/steady/polar_2d.nc",
        polar_3d=f"{RESULTS}/steady/polar_3d.nc",
        modes=f"{RESULTS}/structure/modes.nc" if CONFIG.correction == "modal" else [],
        section_of_beam=given(filter(None, [CONFIG.steady.beam_polar_section])),
    output:
        f"{RESULTS}/steady/correction.nc",
    log:
        f"{LOGS}/correction_factors.log",
    priority: FIRST
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("correction_factors"),
        resolution=CONFIG.steady.resolution,
        may_lack=not CONFIG.compute and not plan.corrects(CONFIG),
    message:
        "correction factors"
    script:
        "../../scripts/correction_factors.py"
