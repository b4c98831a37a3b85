"""The paper's figures, one rule each, named by the paper's number."""

# What every figure is made with; the rules name the modules of their own beside.
DRAWING = (
    "figures/panels.py",
    "figures/origin.py",
    "figures/save.py",
    "figures/style.py",
)
CASES_SHOWN = (
    "figures/cases_shown.py",
    "figures/drawn_history.py",
    "figures/models.py",
    "figures/models_shown.py",
)
(STYLE,) = of_project("envs/equisection.mplstyle")
(SNAKEFILE,) = of_project("workflow/Snakefile")
RULE_FILES = of_project("workflow/rules/*.smk")


rule fig01_workflow:
    """Block diagram of the procedure: the rules and what flows between them (Fig. 1)."""
    input:
        config=f"{RESULTS}/config.resolved.yaml",
        snakefile=SNAKEFILE,
        rule_files=RULE_FILES,
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig01-workflow.png",
            caption="../report/fig01.rst",
            category="Figures",
            labels={"figure": "1", "shows": "the workflow"},
        ),
        svg=f"{RESULTS}/figures/fig01-workflow.svg",
        pdf=f"{RESULTS}/figures/fig01-workflow.pdf",
    log:
        f"{LOGS}/fig01_workflow.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(
            *DRAWING,
            "figures/fig01_workflow.py",
            "figures/layers.py",
            "figures/rule_graph.py",
            "figures/snakemake_query.py",
        ),
    message:
        "Fig. 1, the workflow"
    script:
        "../../scripts/fig01_workflow.py"


rule fig03_modes:
    """Deformation modes along the span (Fig. 3)."""
    input:
        modes=f"{RESULTS}/structure/modes.nc",
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig03-modes.png",
            caption="../report/fig03.rst",
            category="Figures",
            labels={"figure": "3", "shows": "modes"},
        ),
        svg=f"{RESULTS}/figures/fig03-modes.svg",
        pdf=f"{RESULTS}/figures/fig03-modes.pdf",
    log:
        f"{LOGS}/fig03_modes.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(
            *DRAWING,
            "figures/mode_shapes.py",
            "structure/analytic.py",
            "structure/span.py",
        ),
        beam=RESOLVED["beam"],
    message:
        "Fig. 3, modes"
    script:
        "../../scripts/fig03_modes.py"


rule fig05_section_mesh:
    """The mesh of the section: channel, near field, leading edge (Fig. 5)."""
    input:
        section_mesh=f"{RESULTS}/steady/section_mesh.nc",
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig05-section-mesh.png",
            caption="../report/fig05.rst",
            category="Figures",
            labels={"figure": "5", "shows": "mesh of the section"},
        ),
        svg=f"{RESULTS}/figures/fig05-section-mesh.svg",
        pdf=f"{RESULTS}/figures/fig05-section-mesh.pdf",
    log:
        f"{LOGS}/fig05_section_mesh.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(
            *DRAWING,
            "figures/mesh_of_section.py",
            "figures/mesh_lines.py",
            "results/plane_mesh.py",
        ),
    message:
        "Fig. 5, mesh of the section"
    script:
        "../../scripts/fig05_section_mesh.py"


rule fig06_section_polar:
    """Section polars at each resolution (Fig. 6)."""
    input:
        polar_2d=f"{RESULTS}/steady/polar_2d.nc",
        grid_study=grid_study_of_section(),
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig06-section-polar.png",
            caption="../report/fig06.rst",
            category="Figures",
            labels={"figure": "6", "shows": "section polars"},
        ),
        svg=f"{RESULTS}/figures/fig06-section-polar.svg",
        pdf=f"{RESULTS}/figures/fig06-section-polar.pdf",
    log:
        f"{LOGS}/fig06_section_polar.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(*DRAWING, "figures/section_polar.py"),
    message:
        "Fig. 6, section polars"
    script:
        "../../scripts/fig06_section_polar.py"


rule fig07_surface:
    """Wall distance, pressure and friction along the section (Fig. 7)."""
    input:
        index=f"{RESULTS}/steady/2d/polar.json",
        bubble=f"{RESULTS}/tables/bubble.csv",
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig07-surface.png",
            caption="../report/fig07.rst",
            category="Figures",
            labels={"figure": "7", "shows": "wall distance and pressure"},
        ),
        svg=f"{RESULTS}/figures/fig07-surface.svg",
        pdf=f"{RESULTS}/figures/fig07-surface.pdf",
    log:
        f"{LOGS}/fig07_surface.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(
            *DRAWING,
            "paper/printed_values.py",
            "figures/surface_loads.py",
            "results/surface.py",
        ),
        resolution=CONFIG.steady.resolution,
        incidence_deg=CONFIG.flow.incidence_deg,
        is_paper_case=CONFIG.is_paper_case,
    message:
        "Fig. 7, wall distance and pressure"
    script:
        "../../scripts/fig07_surface.py"


rule fig08_courant_number:
    """Courant number on the mesh of the section (Fig. 8)."""
    input:
        section_mesh=f"{RESULTS}/steady/section_mesh.nc",
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig08-courant-number.png",
            caption="../report/fig08.rst",
            category="Figures",
            labels={"figure": "8", "shows": "Courant number"},
        ),
        svg=f"{RESULTS}/figures/fig08-courant-number.svg",
        pdf=f"{RESULTS}/figures/fig08-courant-number.pdf",
    log:
        f"{LOGS}/fig08_courant_number.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(*DRAWING, "figures/courant_number.py", "results/section_mesh.py"),
    message:
        "Fig. 8, Courant number"
    script:
        "../../scripts/fig08_courant_number.py"


rule fig09_plate_mesh:
    """The meshes of the plate: solid, and flow around it (Fig. 9)."""
    input:
        plate_mesh=f"{RESULTS}/steady/plate_mesh.nc",
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig09-plate-mesh.png",
            caption="../report/fig09.rst",
            category="Figures",
            labels={"figure": "9", "shows": "meshes of the plate"},
        ),
        svg=f"{RESULTS}/figures/fig09-plate-mesh.svg",
        pdf=f"{RESULTS}/figures/fig09-plate-mesh.pdf",
    log:
        f"{LOGS}/fig09_plate_mesh.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(
            *DRAWING,
            "figures/mesh_of_beam.py",
            "figures/mesh_lines.py",
            "results/plane_mesh.py",
        ),
        structure=RESOLVED["structure"],
    message:
        "Fig. 9, meshes of the plate"
    script:
        "../../scripts/fig09_plate_mesh.py"


rule fig10_spanwise_loads:
    """Lift and moment along the span (Fig. 10)."""
    input:
        polar_3d=f"{RESULTS}/steady/polar_3d.nc",
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig10-spanwise-loads.png",
            caption="../report/fig10.rst",
            category="Figures",
            labels={"figure": "10", "shows": "spanwise loads"},
        ),
        svg=f"{RESULTS}/figures/fig10-spanwise-loads.svg",
        pdf=f"{RESULTS}/figures/fig10-spanwise-loads.pdf",
    log:
        f"{LOGS}/fig10_spanwise_loads.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(*DRAWING, "figures/spanwise_loads.py", "figures/incidences.py"),
        resolution=CONFIG.steady.resolution,
    message:
        "Fig. 10, spanwise loads"
    script:
        "../../scripts/fig10_spanwise_loads.py"


rule fig11_plate_surface:
    """Pressure and wall shear stress over the rigid plate (Fig. 11)."""
    input:
        index=f"{RESULTS}/steady/3d/polar.json",
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig11-plate-surface.png",
            caption="../report/fig11.rst",
            category="Figures",
            labels={
                "figure": "11",
                "shows": "pressure and shear stress over the plate",
            },
        ),
        svg=f"{RESULTS}/figures/fig11-plate-surface.svg",
        pdf=f"{RESULTS}/figures/fig11-plate-surface.pdf",
    log:
        f"{LOGS}/fig11_plate_surface.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(
            *DRAWING,
            "figures/surface_of_beam.py",
            "figures/incidences.py",
            "results/plate_surface.py",
            "results/surface.py",
        ),
        resolution=CONFIG.steady.resolution,
    message:
        "Fig. 11, surface of the plate"
    script:
        "../../scripts/fig11_plate_surface.py"


rule fig12_tip_flow:
    """Flow and turbulence near the tip, rigid and flexible (Fig. 12)."""
    input:
        rigid=f"{RESULTS}/steady/3d/polar.json",
        flexible=index_of_beam(),
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig12-tip-flow.png",
            caption="../report/fig12.rst",
            category="Figures",
            labels={"figure": "12", "shows": "flow near the tip"},
        ),
        svg=f"{RESULTS}/figures/fig12-tip-flow.svg",
        pdf=f"{RESULTS}/figures/fig12-tip-flow.pdf",
    log:
        f"{LOGS}/fig12_tip_flow.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(*DRAWING, "figures/flow_at_tip.py", "results/tip_flow.py"),
        resolution=CONFIG.steady.resolution,
        incidence_deg=CONFIG.flow.incidence_deg,
    message:
        "Fig. 12, flow near the tip"
    script:
        "../../scripts/fig12_tip_flow.py"


rule fig13_lift_correction:
    """Lift of section, root and beam, and its correction factor (Fig. 13)."""
    input:
        polar_2d=f"{RESULTS}/steady/polar_2d.nc",
        polar_3d=f"{RESULTS}/steady/polar_3d.nc",
        correction=f"{RESULTS}/steady/correction.nc",
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig13-lift-correction.png",
            caption="../report/fig13.rst",
            category="Figures",
            labels={"figure": "13", "shows": "correction of the lift"},
        ),
        svg=f"{RESULTS}/figures/fig13-lift-correction.svg",
        pdf=f"{RESULTS}/figures/fig13-lift-correction.pdf",
    log:
        f"{LOGS}/fig13_lift_correction.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(
            *DRAWING,
            "figures/lift_correction.py",
            "figures/load_correction.py",
            "figures/models.py",
        ),
        resolution=CONFIG.steady.resolution,
    message:
        "Fig. 13, correction of the lift"
    script:
        "../../scripts/fig13_lift_correction.py"


rule fig14_moment_correction:
    """Moment of section, root and beam, and its correction factor (Fig. 14)."""
    input:
        polar_2d=f"{RESULTS}/steady/polar_2d.nc",
        polar_3d=f"{RESULTS}/steady/polar_3d.nc",
        correction=f"{RESULTS}/steady/correction.nc",
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig14-moment-correction.png",
            caption="../report/fig14.rst",
            category="Figures",
            labels={"figure": "14", "shows": "correction of the moment"},
        ),
        svg=f"{RESULTS}/figures/fig14-moment-correction.svg",
        pdf=f"{RESULTS}/figures/fig14-moment-correction.pdf",
    log:
        f"{LOGS}/fig14_moment_correction.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(
            *DRAWING,
            "figures/moment_correction.py",
            "figures/load_correction.py",
            "figures/models.py",
        ),
        resolution=CONFIG.steady.resolution,
    message:
        "Fig. 14, correction of the moment"
    script:
        "../../scripts/fig14_moment_correction.py"


rule fig15_modal_contributions:
    """Contribution of each mode to the deformation (Fig. 15)."""
    input:
        modes=f"{RESULTS}/structure/modes.nc",
        index=index_of_beam(),
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig15-modal-contributions.png",
            caption="../report/fig15.rst",
            category="Figures",
            labels={"figure": "15", "shows": "modal contributions"},
        ),
        svg=f"{RESULTS}/figures/fig15-modal-contributions.svg",
        pdf=f"{RESULTS}/figures/fig15-modal-contributions.pdf",
    log:
        f"{LOGS}/fig15_modal_contributions.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(*DRAWING, "figures/modal_contributions.py"),
    message:
        "Fig. 15, modal contributions"
    script:
        "../../scripts/fig15_modal_contributions.py"


rule fig16_response:
    """Mean deformation over k*, and histories of the twist (Fig. 16)."""
    input:
        summary=f"{RESULTS}/comparison/summary.csv",
        onset=f"{RESULTS}/comparison/onset.csv",
        indices=indices_of_histories,
        equivalent=f"{RESULTS}/structure/equivalent.nc",
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig16-response.png",
            caption="../report/fig16.rst",
            category="Figures",
            labels={"figure": "16", "shows": "response"},
        ),
        svg=f"{RESULTS}/figures/fig16-response.svg",
        pdf=f"{RESULTS}/figures/fig16-response.pdf",
    log:
        f"{LOGS}/fig16_response.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(*DRAWING, *CASES_SHOWN, "figures/response.py"),
        reduction=CONFIG.reduction,
        boundary=CONFIG.beam.boundary,
    message:
        "Fig. 16, response"
    script:
        "../../scripts/fig16_response.py"


rule fig17_hysteresis:
    """Hysteresis loops and phase portraits (Fig. 17)."""
    input:
        summary=f"{RESULTS}/comparison/summary.csv",
        onset=f"{RESULTS}/comparison/onset.csv",
        indices=indices_of_histories,
        equivalent=f"{RESULTS}/structure/equivalent.nc",
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/fig17-hysteresis.png",
            caption="../report/fig17.rst",
            category="Figures",
            labels={"figure": "17", "shows": "hysteresis"},
        ),
        svg=f"{RESULTS}/figures/fig17-hysteresis.svg",
        pdf=f"{RESULTS}/figures/fig17-hysteresis.pdf",
    log:
        f"{LOGS}/fig17_hysteresis.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(*DRAWING, *CASES_SHOWN, "figures/hysteresis.py"),
        reduction=CONFIG.reduction,
    message:
        "Fig. 17, hysteresis"
    script:
        "../../scripts/fig17_hysteresis.py"


rule growth_rate:
    """Growth rate and frequency over k*, beside those of classical linear theory."""
    input:
        summary=f"{RESULTS}/comparison/summary.csv",
        linear_theory=f"{RESULTS}/comparison/linear_theory.csv",
        style=STYLE,
    output:
        png=report(
            f"{RESULTS}/figures/growth-rate.png",
            caption="../report/growth-rate.rst",
            category="Figures",
            labels={"figure": "growth", "shows": "growth rate, linear theory"},
        ),
        svg=f"{RESULTS}/figures/growth-rate.svg",
        pdf=f"{RESULTS}/figures/growth-rate.pdf",
    log:
        f"{LOGS}/growth_rate.log",
    localrule: True
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(*DRAWING, "figures/growth_rate.py", "figures/models.py"),
        is_paper_case=CONFIG.is_paper_case,
    message:
        "growth rate and linear theory"
    script:
        "../../scripts/growth_rate.py"


rule section_and_beam:
    """How far each section is from the beam that it stands for."""
    input:
        summary=f"{RESULTS}/comparison/summary.csv",
        style=STYLE,
    output:
        table=report(
            f"{RESULTS}/comparison/section_and_beam.csv",
            caption="../report/section_and_beam.rst",
            category="Tables",
            labels={
                "table": "section and beam",
                "shows": "how far each section is from the beam",
            },
        ),
        png=report(
            f"{RESULTS}/figures/section-and-beam.png",
            caption="../report/section-and-beam.rst",
            category="Figures",
            labels={"figure": "reductions", "shows": "section against beam"},
        ),
        svg=f"{RESULTS}/figures/section-and-beam.svg",
        pdf=f"{RESULTS}/figures/section-and-beam.pdf",
    log:
        f"{LOGS}/section_and_beam.log",
    conda:
        ENVIRONMENT
    threads: 1
    resources:
        mem_mb=1000,
        runtime=5,
    params:
        code=code(
            *DRAWING,
            "analysis/section_and_beam.py",
            "figures/section_against_beam.py",
            "figures/models.py",
        ),
    message:
        "sections against the beam"
    script:
        "../../scripts/section_and_beam.py"
