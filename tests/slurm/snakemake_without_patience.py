"""Snakemake with its SLURM executor, but one that asks every second how its jobs are.

By itself it asks ever more seldom while none has ended, since a scheduler has other users.
"""

import sys

from snakemake.cli import main
from snakemake_executor_plugin_slurm import Executor

Executor.next_seconds_between_status_checks = property(lambda self: 1, lambda self, seconds: None)

if __name__ == "__main__":
    sys.exit(main())
