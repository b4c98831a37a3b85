"""Reproduction of the paper: its tables, values and figure numbers, for runs of its beam alone.

With this file, `config/paper` and the package's room `paper` taken away, everything else runs.
"""

from equisection.paper.paper_case import is_paper_case
from equisection.paper.figure_numbers import WORKFLOW, caption, further_names

if is_paper_case(CONFIG):
    FURTHER_NAMES.update(further_names())
    REFERENCES += of_project("config/paper/references.csv")
    FURTHER_FILES += [
        f"{RESULTS}/comparison/paper.csv",
        f"{RESULTS}/tables/table2.csv",
        *(f"{RESULTS}/tables/table1.csv" for _ in polar_of_beam()),
        *(f"{RESULTS}/figures/{WORKFLOW}.{suffix}" for suffix in CONFIG.figure_formats),
    ]

    rule workflow_drawing:
        """Block diagram of the procedure (Fig. 1), a drawing that is kept."""
        input:
            of_project("workflow/report/workflow.*[!t]"),
        output:
            report(
                f"{RESULTS}/figures/{WORKFLOW}.png",
                caption=caption(1),
                category="Figures",
                labels={"figure": "1", "shows": "the workflow"},
            ),
            *(
                f"{RESULTS}/figures/{WORKFLOW}.{suffix}"
                for suffix in CONFIG.figure_formats
                if suffix != "png"
            ),
        log:
            f"{LOGS}/workflow_drawing.log",
        localrule: True
        conda:
            ENVIRONMENT
        message:
            "Fig. 1, the workflow"
        script:
            "../../scripts/workflow_drawing.py"

    rule paper_comparison:
        """Every number that the paper states, compared with that of this run, and its Table 2."""
        input:
            modes=f"{RESULTS}/structure/modes.nc",
            equivalent=f"{RESULTS}/structure/equivalent.nc",
            mesh_study=f"{RESULTS}/structure/mesh_study.nc",
            polar_3d=polar_of_beam(),
            index_3d=index_of_beam(CONFIG, RESULTS),
            correction=correction_of_beam(),
            bubble=bubble_of_section(),
            summary=f"{RESULTS}/comparison/summary.csv",
            onset=f"{RESULTS}/comparison/onset.csv",
        output:
            paper=report(
                f"{RESULTS}/comparison/paper.csv",
                caption="../equisection/paper/captions/paper.rst",
                category="Tables",
                labels={
                    "table": "numbers",
                    "shows": "every number that the paper states",
                },
            ),
            table2=report(
                f"{RESULTS}/tables/table2.csv",
                caption="../equisection/paper/captions/table2.rst",
                category="Tables",
                labels={"table": "2", "shows": "natural frequencies in vacuum"},
            ),
        log:
            f"{LOGS}/paper_comparison.log",
        localrule: True
        conda:
            ENVIRONMENT
        params:
            code=code("paper_comparison"),
            config=RESOLVED,
        message:
            "comparison with the paper"
        script:
            "../../scripts/paper_comparison.py"

    rule rigid_beam_table:
        """Loads of the rigid beam and those of the paper (Table 1)."""
        input:
            polar_3d=f"{RESULTS}/steady/polar_3d.nc",
        output:
            report(
                f"{RESULTS}/tables/table1.csv",
                caption="../equisection/paper/captions/table1.rst",
                category="Tables",
                labels={
                    "table": "1",
                    "shows": "force coefficients of the rigid plate",
                },
            ),
        log:
            f"{LOGS}/rigid_beam_table.log",
        localrule: True
        conda:
            ENVIRONMENT
        params:
            code=code("rigid_beam_table"),
        message:
            "Table 1, loads of the rigid beam"
        script:
            "../../scripts/rigid_beam_table.py"
