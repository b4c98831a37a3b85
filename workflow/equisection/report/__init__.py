"""The report of a run: its answer, figures and tables on one page of HTML."""
