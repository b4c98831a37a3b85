"""The lags of the embedded solver, identified again from CFD histories; asked for by name."""


rule identification:
    """Fit the lags to some releases and judge the model on others."""
    input:
        polar=section_polar(),
        fitted_to=given(CONFIG.embedded.identification.fitted_to),
        judged_on=given(CONFIG.embedded.identification.judged_on),
        style=STYLE,
    output:
        lags=f"{RESULTS}/identification/lags.yaml",
        judgement=f"{RESULTS}/identification/judgement.csv",
        figures=multiext(
            f"{RESULTS}/identification/judgement",
            *(f".{suffix}" for suffix in CONFIG.figure_formats),
        ),
    log:
        f"{LOGS}/identification.log",
    conda:
        ENVIRONMENT
    resources:
        mem_mb=1000,
        runtime=10,
    params:
        code=code("identification"),
        embedded=RESOLVED["embedded"],
        resolution=CONFIG.steady.resolution,
    message:
        "lags of the embedded solver"
    script:
        "../../scripts/identification.py"
