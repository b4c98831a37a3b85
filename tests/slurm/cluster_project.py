"""A copy of the project whose jobs go to SLURM, by the profile that it comes with."""

import os
import sys
from pathlib import Path

from tests.workflow.project import Project

#: Where `make slurm` has Snakemake's part.
PLUGIN = Path(sys.prefix) / "slurm"


class ClusterProject(Project):
    """A copy of the project on a cluster that does not account for jobs."""

    program = (str(Path(__file__).with_name("snakemake_without_patience.py")),)
    where = (
        "--workflow-profile",
        "workflow/profiles/slurm",
        "--slurm-no-account",
        "--slurm-status-command=squeue",
        "--latency-wait=5",
    )

    def environment(self) -> dict[str, str]:
        """Return the environment, in which Snakemake finds its part."""
        there = super().environment()
        return there | {"PYTHONPATH": os.pathsep.join([there["PYTHONPATH"], str(PLUGIN)])}
