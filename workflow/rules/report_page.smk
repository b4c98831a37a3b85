"""The report: the answer, figures and tables on one page; asked for by name (`make report`)."""


rule report_page:
    """The answer, the map of stability, figures and tables on one page of HTML."""
    input:
        files_of_run(),
        map=map_files()[:2],
        config=f"{RESULTS}/config.resolved.yaml",
        figures=list(figures_of_report().values()),
        tables=list(tables_of_report().values()),
    output:
        f"{RESULTS}/report.html",
    log:
        f"{LOGS}/report_page.log",
    localrule: True
    conda:
        ENVIRONMENT
    params:
        code=code("report_page"),
        figures=list(figures_of_report()),
        tables=list(tables_of_report()),
        marks=marks,
        config={"run": CONFIG.run, "solver": CONFIG.solver},
        design_speed=CONFIG.flow.design_speed,
    message:
        "report"
    script:
        "../../scripts/report_page.py"
